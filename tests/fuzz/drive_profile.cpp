#include <cstddef>
#include <cstdint>

#include "core/drive/profile.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A drive's profile.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto profile = drive::readProfile({reinterpret_cast<const char*>(data), size});
    if (!profile) {
        fuzz::require(!profile.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    fuzz::require(!profile->name.empty() && !profile->title.empty(), "a profile has a name and a title");
    fuzz::require(profile->timeOut > 0.0 && profile->heartbeat > 0.0, "a profile has times");
    return 0;
}
