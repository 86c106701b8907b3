#include "core/base/file.h"
#include "core/drive/modbus_drive.h"
#include "core/drive/profile_folder.h"
#include "tests/fuzz/drive_answers.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

namespace {

/// A device that answers what the fuzzer wants, or does not.
class FuzzedDevice final : public drive::RegisterTransport {
 public:
    explicit FuzzedDevice(FuzzedDataProvider& input) : input_(input) {}

    base::Status open(double /*timeOut*/) override {
        isOpen_ = true;
        return base::success();
    }
    [[nodiscard]] bool isOpen() const override { return isOpen_; }
    base::Result<std::vector<std::uint16_t>> read(drive::Table /*table*/, int address, int count,
                                                  double /*timeOut*/) override {
        fuzz::require(address >= 0 && count >= 1 && address + count <= 0x10000, "the place is in its table");
        if (isSilent()) return base::Error{"no answer"};
        std::vector<std::uint16_t> registers(static_cast<std::size_t>(count));
        for (auto& value : registers)
            value = input_.ConsumeIntegral<std::uint16_t>();
        return registers;
    }
    base::Status write(drive::Table /*table*/, int address, std::span<const std::uint16_t> values,
                       double /*timeOut*/) override {
        fuzz::require(!values.empty(), "something is written");
        fuzz::require(address >= 0 && address + static_cast<int>(values.size()) <= 0x10000,
                      "the place is in its table");
        if (isSilent()) return base::Error{"no answer"};
        return base::success();
    }
    void close() override { isOpen_ = false; }

 private:
    // A connection that is lost in the middle of an exchange is closed, and answers nothing any more.
    bool isSilent() {
        if (!isOpen_) return true;
        constexpr int kOften = 20;
        const bool silent = input_.ConsumeIntegralInRange(0, kOften) == kOften;
        if (silent && input_.ConsumeBool()) isOpen_ = false;
        return silent;
    }

    FuzzedDataProvider& input_;
    bool isOpen_ = false;
};

drive::Place fuzzedPlace(FuzzedDataProvider& input) {
    drive::Place place;
    place.type =
        input.PickValueInArray({drive::DataType::uint16, drive::DataType::int16, drive::DataType::uint32,
                                drive::DataType::int32, drive::DataType::float32});
    place.lowWordFirst = input.ConsumeBool();
    return place;
}

/// Every quantity there is, in registers of any type.
drive::Profile fuzzedProfile(FuzzedDataProvider& input) {
    drive::Profile profile;
    const auto quantity = [&] { return drive::Quantity{fuzzedPlace(input), 0.0, 1000.0}; };
    profile.modbus.setPoint = quantity();
    profile.modbus.frequency = quantity();
    profile.modbus.acceleration = quantity();
    profile.modbus.current = quantity();
    profile.modbus.enable = drive::Switch{fuzzedPlace(input), 1, 0, 1};
    profile.modbus.fault = drive::FaultPlace{fuzzedPlace(input), {}};
    return profile;
}

/// Those that come with Trapwright and speak Modbus.
std::vector<drive::Profile> bundledProfiles() {
    auto profiles = drive::readProfileFolder(drive::findBundledProfiles()).profiles;
    std::erase_if(profiles,
                  [](const drive::Profile& profile) { return profile.protocol == drive::Protocol::reo; });
    fuzz::require(!profiles.empty(), "profiles come with Trapwright");
    return profiles;
}

}  // namespace

// What a Modbus device answers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<drive::Profile> bundled = bundledProfiles();
    FuzzedDataProvider input(data, size);
    const auto choice = input.ConsumeIntegralInRange<std::size_t>(0, bundled.size());
    const drive::Profile profile = choice < bundled.size() ? bundled[choice] : fuzzedProfile(input);
    const auto drive = drive::makeModbusDrive(profile, std::make_unique<FuzzedDevice>(input));
    fuzz::driveThrough(*drive, input);
    return 0;
}
