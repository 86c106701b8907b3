#include <fuzzer/FuzzedDataProvider.h>

#include "core/study/field_text.h"
#include "core/study/pose_weights.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// What somebody types into a field or after --set: a text that is taken is one that the field shows and takes
// again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto fields = study::listFields();
    FuzzedDataProvider input(data, size);
    const std::string& key = fields[input.ConsumeIntegralInRange<std::size_t>(0, fields.size() - 1)].key;
    const std::string text = input.ConsumeRemainingBytesAsString();
    study::readCounts(text);
    study::Settings settings;
    if (!study::setField(settings, key, text)) return 0;
    study::findProblems(settings);
    const std::string shown = study::fieldText(settings, key);
    study::Settings again;
    fuzz::require(study::setField(again, key, shown).ok(), "a field takes what it shows");
    fuzz::require(study::fieldText(again, key) == shown, "a field keeps what it shows");
    return 0;
}
