#include "core/track/printer.h"

#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A printer's file: what is read can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto printer = track::readPrinter({reinterpret_cast<const char*>(data), size});
    if (!printer) {
        fuzz::require(!printer.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    fuzz::require(track::readPrinter(track::printerToJson(*printer)).ok(), "a printer can be read again");
    return 0;
}
