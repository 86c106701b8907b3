#include "core/drive/modbus_drive.h"

#include <QtTest>
#include <bit>
#include <map>

using namespace trapwright;
using drive::Table;

namespace {

struct Device {
    std::map<std::pair<Table, int>, std::uint16_t> values;
    std::vector<std::tuple<Table, int, std::uint16_t>> writes;
    std::vector<int> refused;  // addresses that cannot be written
    bool open = false;
};

class InMemory final : public drive::RegisterTransport {
 public:
    explicit InMemory(Device& device) : device_(device) {}
    base::Status open(double /*timeOut*/) override {
        device_.open = true;
        return base::success();
    }
    [[nodiscard]] bool isOpen() const override { return device_.open; }
    base::Result<std::vector<std::uint16_t>> read(Table table, int address, int count,
                                                  double /*timeOut*/) override {
        std::vector<std::uint16_t> values(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            values[static_cast<std::size_t>(i)] = device_.values[{table, address + i}];
        return values;
    }
    base::Status write(Table table, int address, std::span<const std::uint16_t> values,
                       double /*timeOut*/) override {
        for (const int refused : device_.refused) {
            if (refused == address) return base::Error{"refused"};
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            device_.values[{table, address + static_cast<int>(i)}] = values[i];
            device_.writes.emplace_back(table, address + static_cast<int>(i), values[i]);
        }
        return base::success();
    }
    void close() override { device_.open = false; }

 private:
    Device& device_;
};

/// An ADAM-6024 as its manual has it: 40011 and 00017.
drive::Profile adam() {
    drive::Profile profile;
    profile.modbus.setPoint = drive::Quantity{{Table::holdingRegister, 10}, 0.0, 4095.0};
    profile.modbus.enable = drive::Switch{{Table::coil, 16, drive::DataType::bit}};
    return profile;
}

using Writes = std::vector<std::tuple<Table, int, std::uint16_t>>;

drive::Command on(double setPoint) {
    drive::Command command;
    command.setPoint = setPoint;
    command.enable = true;
    return command;
}

}  // namespace

class ModbusDriveTest : public QObject {
    Q_OBJECT

 private slots:
    void offFirstAndOnLast() {
        Device device;
        auto drive = drive::makeModbusDrive(adam(), std::make_unique<InMemory>(device));
        QVERIFY(drive->connect());
        QCOMPARE(device.writes, (Writes{{Table::coil, 16, 0}, {Table::holdingRegister, 10, 0}}));
        device.writes.clear();
        const auto reading = drive->exchange(on(0.5));
        QVERIFY(reading.ok());
        QCOMPARE(device.writes, (Writes{{Table::holdingRegister, 10, 2048}, {Table::coil, 16, 1}}));
        QCOMPARE(reading->setPoint.value(), 2048.0 / 4095.0);
        QCOMPARE(reading->enabled.value(), true);
        device.writes.clear();
        drive->disconnect();
        QCOMPARE(device.writes, (Writes{{Table::coil, 16, 0}, {Table::holdingRegister, 10, 0}}));
        QVERIFY(!device.open);
    }

    void restIsTriedWhateverFails() {
        Device device;
        auto drive = drive::makeModbusDrive(adam(), std::make_unique<InMemory>(device));
        QVERIFY(drive->connect());
        QVERIFY(drive->exchange(on(0.5)).ok());
        device.refused = {16};
        drive.reset();
        const auto setPoint = device.values[{Table::holdingRegister, 10}];
        QCOMPARE(setPoint, std::uint16_t(0));
    }

    void aDriveWithoutSetPointIsOnOrOff() {
        Device device;
        drive::Profile profile;
        profile.modbus.whileEnabled = {{{Table::holdingRegister, 1}, 0.0},
                                       {{Table::holdingRegister, 1}, 1.0}};
        auto drive = drive::makeModbusDrive(profile, std::make_unique<InMemory>(device));
        QVERIFY(drive->connect());
        QVERIFY(drive->exchange(drive::Command{}).ok());
        QVERIFY(drive->exchange(on(0.0)).ok());
        QVERIFY(device.writes.empty());
        QVERIFY(drive->exchange(on(0.01)).ok());
        QCOMPARE(device.writes, (Writes{{Table::holdingRegister, 1, 0}, {Table::holdingRegister, 1, 1}}));
    }

    void whatMayFailAtTheStartMayFail() {
        Device device;
        drive::Profile profile = adam();
        profile.modbus.atConnect = {{{Table::holdingRegister, 0x1008}, 0x55AA, true},
                                    {{Table::holdingRegister, 0x1000}, 10.0, false}};
        device.refused = {0x1008};
        auto drive = drive::makeModbusDrive(profile, std::make_unique<InMemory>(device));
        QVERIFY(drive->connect());
        const auto time = device.values[{Table::holdingRegister, 0x1000}];
        QCOMPARE(time, std::uint16_t(10));
        device.refused = {0x1000};
        device.values[{Table::coil, 16}] = 1;
        QVERIFY(!drive->connect());
        // It was heard: whatever it refuses, it is told to rest.
        QVERIFY(drive->connected());
        drive->disconnect();
        const auto enable = device.values[{Table::coil, 16}];
        QCOMPARE(enable, std::uint16_t(0));
        QVERIFY(!drive->connected());
    }

    void faultsInWords() {
        Device device;
        drive::Profile profile = adam();
        drive::FaultPlace fault;
        fault.place = {Table::inputRegister, 5};
        fault.code.mask = 0x000F;
        fault.code.meanings[2] = "too hot";
        profile.modbus.fault = fault;
        auto drive = drive::makeModbusDrive(profile, std::make_unique<InMemory>(device));
        QVERIFY(drive->connect());
        device.values[{Table::inputRegister, 5}] = 0x1230;
        QVERIFY(!drive->exchange(drive::Command{})->fault);
        device.values[{Table::inputRegister, 5}] = 0x1232;
        QCOMPARE(drive->exchange(drive::Command{})->fault.value(), std::string("too hot"));
        device.values[{Table::inputRegister, 5}] = 0x1238;
        QVERIFY(drive->exchange(drive::Command{})->fault.value().find("8") != std::string::npos);
    }

    // A NaN has no bits: whoever took it for 0 would take the fault for none.
    void aFaultThatIsNoNumberIsNotTakenForNone_data() {
        QTest::addColumn<quint32>("bits");
        QTest::addColumn<bool>("known");
        QTest::newRow("good") << std::bit_cast<quint32>(0.0F) << true;
        QTest::newRow("not a number") << quint32(0x7FC00000) << false;
        QTest::newRow("infinite") << quint32(0x7F800000) << false;
        QTest::newRow("past 32 bits") << std::bit_cast<quint32>(1e20F) << false;
    }
    void aFaultThatIsNoNumberIsNotTakenForNone() {
        QFETCH(quint32, bits);
        QFETCH(bool, known);
        drive::Profile profile = adam();
        profile.modbus.fault = drive::FaultPlace{{Table::inputRegister, 5, drive::DataType::float32},
                                                 {.mask = 1, .good = 0, .meanings = {}}};
        Device device;
        device.values[{Table::inputRegister, 5}] = static_cast<std::uint16_t>(bits >> 16U);
        device.values[{Table::inputRegister, 6}] = static_cast<std::uint16_t>(bits & 0xFFFFU);
        auto drive = drive::makeModbusDrive(profile, std::make_unique<InMemory>(device));
        QVERIFY(drive->connect().ok());
        const auto reading = drive->exchange(drive::Command{});
        QCOMPARE(reading.ok(), known);
        if (!known)
            QCOMPARE(reading.error().message, std::string("the drive tells no number in input register 5"));
    }
};

QTEST_APPLESS_MAIN(ModbusDriveTest)
#include "modbus_drive_test.moc"
