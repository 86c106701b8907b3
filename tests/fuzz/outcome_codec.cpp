#include "core/trial/outcome_codec.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// The stored outcomes of trials, of as many as the first two bytes tell. The checksum of the compression
// stands in the way of most of what libFuzzer tries, so the other bytes are also taken for outcomes
// themselves.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::size_t count = std::size_t{data[0]} << 8 | data[1];
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
    if (const auto outcomes = trial::unpackOutcomes(bytes, count)) {
        fuzz::require(outcomes->size() == count, "as many as were asked for");
        const auto back = trial::unpackOutcomes(trial::packOutcomes(*outcomes), count);
        fuzz::require(back.ok(), "what was read can be packed again");
    } else {
        fuzz::require(!outcomes.error().message.empty(), "a refusal has a reason");
    }

    std::vector<trial::Outcome> outcomes(std::min(bytes.size() / 65, trial::kMostPacked));
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        double numbers[8];
        std::memcpy(numbers, bytes.data() + 65 * i, sizeof numbers);
        trial::PartOutcome part;
        part.ending = static_cast<trial::Ending>(bytes[65 * i + 64] & 3);
        part.time = numbers[0];
        part.farthest.position = {numbers[1], numbers[2], numbers[3]};
        part.farthest.rotation = base::Quaternion(numbers[4], numbers[5], numbers[6], numbers[7]);
        // Most trials have one part, some have two or none.
        const int kind = bytes[65 * i + 64] & 0xf0;
        outcomes[i].parts.assign(kind == 0xf0 ? 2 : kind == 0xe0 ? 0 : 1, part);
    }
    outcomes.resize(trial::countPackable(outcomes));
    const std::string packed = trial::packOutcomes(outcomes);
    const auto back = trial::unpackOutcomes(packed, outcomes.size());
    fuzz::require(back && trial::packOutcomes(*back) == packed, "outcomes come back");
    return 0;
}
