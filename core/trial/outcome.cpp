#include "core/trial/outcome.h"

#include <cassert>

namespace trapwright::trial {

std::string_view endingName(Ending ending) {
    switch (ending) {
        case Ending::finished:
            return "finished";
        case Ending::fellOff:
            return "fell off";
        case Ending::stuck:
            return "stuck";
        case Ending::timedOut:
            return "timed out";
    }
    assert(false && "not an ending");
    return "";
}

}  // namespace trapwright::trial
