#include "core/track/track_file.h"

#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A track's text: what is read can be written, and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = track::trackFromJson({reinterpret_cast<const char*>(data), size});
    if (!file) {
        fuzz::require(!file.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    fuzz::require(!file->track.solid.triangles.empty(), "a track has a solid");
    const std::string text = track::trackToJson(*file);
    fuzz::require(!text.empty(), "a track can be written");
    return 0;
}
