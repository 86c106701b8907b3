#include "core/study/settings.h"

#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A text of settings: what is read and has no problem comes back from its own text as it was.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto settings = study::settingsFromJson({reinterpret_cast<const char*>(data), size}, {});
    if (!settings) {
        fuzz::require(!settings.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    const bool isGood = study::findProblems(*settings).empty();
    study::findRecommendations(*settings);
    const auto again = study::settingsFromJson(study::toJson(*settings), {});
    if (isGood) fuzz::require(again.ok() && *again == *settings, "settings come back as they were written");
    return 0;
}
