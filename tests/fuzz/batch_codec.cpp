#include "core/trial/batch_codec.h"

#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

namespace {

template <class T>
void check(std::string_view bytes, const base::Result<T>& value) {
    if (value) {
        fuzz::require(trial::encode(*value) == bytes, "what was read has the same bytes again");
    } else {
        fuzz::require(!value.error().message.empty(), "a refusal has a reason");
    }
}

}  // namespace

// What another process or machine sends: a part, a track, a batch of trials or outcomes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    check(bytes, trial::decodePart(bytes));
    check(bytes, trial::decodeTrack(bytes));
    check(bytes, trial::decodeBatch(bytes));
    check(bytes, trial::decodeOutcomes(bytes));
    return 0;
}
