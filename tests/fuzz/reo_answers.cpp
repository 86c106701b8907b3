#include "core/drive/reo_drive.h"
#include "tests/fuzz/drive_answers.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

namespace {

/// A port from which comes what the fuzzer wants, or nothing.
class FuzzedPort final : public drive::LineTransport {
 public:
    explicit FuzzedPort(FuzzedDataProvider& input) : input_(input) {}

    base::Status open(double /*timeOut*/) override {
        isOpen_ = true;
        return base::success();
    }
    [[nodiscard]] bool isOpen() const override { return isOpen_; }
    base::Result<std::string> exchange(std::string_view line, double /*timeOut*/) override {
        fuzz::require(isOpen_, "only an open port is spoken to");
        fuzz::require(drive::reo::decode(line).has_value(), "what is sent is a line of the protocol");
        constexpr std::size_t kLongest = 64;
        switch (input_.ConsumeIntegralInRange(0, 3)) {
            case 0:
                return base::Error{"no answer"};
            case 1:
                return input_.ConsumeRandomLengthString(kLongest);
            case 2:
                return input_.ConsumeBytesAsString(drive::reo::kLength - 1) + '\r';
            default: {
                drive::reo::Words words{};
                for (auto& word : words)
                    word = input_.ConsumeIntegral<std::uint16_t>();
                return drive::reo::encode(words);
            }
        }
    }
    void close() override { isOpen_ = false; }

 private:
    FuzzedDataProvider& input_;
    bool isOpen_ = false;
};

}  // namespace

// What a REO REOVIB answers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzedDataProvider input(data, size);
    drive::Profile profile;
    profile.protocol = drive::Protocol::reo;
    profile.frequency = 50.0;
    profile.reo.enabled = 1;
    profile.reo.fullAcceleration = 100.0;
    const auto drive = drive::makeReoDrive(profile, std::make_unique<FuzzedPort>(input));
    fuzz::driveThrough(*drive, input);
    return 0;
}
