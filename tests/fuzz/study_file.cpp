#include <cstddef>
#include <cstdint>

#include "tests/fuzz/read_study.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// The bytes of a study's file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFolder folder;
    fuzz::readWholeStudy(folder.keepOnly("study.trap", {data, size}));
    return 0;
}
