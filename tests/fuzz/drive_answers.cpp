#include "tests/fuzz/drive_answers.h"

#include <cmath>

#include "tests/fuzz/scratch_folder.h"

namespace trapwright::fuzz {

namespace {

void check(const drive::Reading& reading) {
    for (const auto& number :
         {reading.setPoint, reading.frequency, reading.acceleration, reading.halfStroke, reading.current}) {
        require(!number || std::isfinite(*number), "a reading is a number");
    }
    require(!reading.fault || !reading.fault->empty(), "a fault is told in words");
}

}  // namespace

void driveThrough(drive::Drive& drive, FuzzedDataProvider& input) {
    if (auto status = drive.connect(); !status) {
        require(!status.error().message.empty(), "a refusal has a reason");
        // Who was heard is told to rest.
        drive.disconnect();
        require(!drive.connected(), "a drive that was let go is not connected");
    }
    while (input.remaining_bytes() > 0 && drive.connected()) {
        drive::Command command;
        command.setPoint = input.ConsumeProbability<double>();
        if (input.ConsumeBool()) command.frequency = input.ConsumeFloatingPointInRange(1.0, 1000.0);
        command.enable = input.ConsumeBool();
        const auto reading = drive.exchange(command);
        if (reading) {
            check(*reading);
        } else {
            require(!reading.error().message.empty(), "a refusal has a reason");
        }
    }
    drive.disconnect();
    require(!drive.connected(), "a drive that was let go is not connected");
}

}  // namespace trapwright::fuzz
