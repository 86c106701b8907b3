#include "core/study/resource_tracks.h"

#include "core/base/resources.h"

namespace trapwright::study {

std::filesystem::path findResourceTrack(std::string_view file) {
    return base::findResource(std::filesystem::path("tracks") / file);
}

}  // namespace trapwright::study
