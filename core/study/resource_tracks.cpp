#include "core/study/resource_tracks.h"

#include "core/part/bundled.h"

namespace trapwright::study {

std::filesystem::path findResourceTrack(std::string_view file) {
    const std::filesystem::path parts = part::findBundledFile(part::listBundledParts().front()).parent_path();
    return parts.parent_path() / "tracks" / file;
}

}  // namespace trapwright::study
