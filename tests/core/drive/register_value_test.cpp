#include "core/drive/register_value.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;
using drive::DataType;
using drive::Place;
using drive::Table;
using Registers = std::vector<std::uint16_t>;

Q_DECLARE_METATYPE(trapwright::drive::DataType)
Q_DECLARE_METATYPE(Registers)

class RegisterValueTest : public QObject {
    Q_OBJECT

 private slots:
    // Numbers as IEEE 754 and two's complement have them.
    void numbersAsRegisters_data() {
        QTest::addColumn<DataType>("type");
        QTest::addColumn<bool>("lowWordFirst");
        QTest::addColumn<double>("value");
        QTest::addColumn<Registers>("registers");
        QTest::newRow("uint16") << DataType::uint16 << false << 4095.0 << Registers{0x0FFF};
        QTest::newRow("int16 below 0") << DataType::int16 << false << -2.0 << Registers{0xFFFE};
        QTest::newRow("uint32") << DataType::uint32 << false << 305419896.0 << Registers{0x1234, 0x5678};
        QTest::newRow("uint32 low first")
            << DataType::uint32 << true << 305419896.0 << Registers{0x5678, 0x1234};
        QTest::newRow("int32 below 0") << DataType::int32 << false << -1.0 << Registers{0xFFFF, 0xFFFF};
        QTest::newRow("float32 1") << DataType::float32 << false << 1.0 << Registers{0x3F80, 0x0000};
        QTest::newRow("float32 -118.625")
            << DataType::float32 << false << -118.625 << Registers{0xC2ED, 0x4000};
        QTest::newRow("float32 low first")
            << DataType::float32 << true << -118.625 << Registers{0x4000, 0xC2ED};
    }
    void numbersAsRegisters() {
        QFETCH(DataType, type);
        QFETCH(bool, lowWordFirst);
        QFETCH(double, value);
        QFETCH(Registers, registers);
        const Place place{Table::holdingRegister, 0, type, lowWordFirst};
        QCOMPARE(drive::encodeRaw(place, value), registers);
        QCOMPARE(drive::decodeRaw(place, registers), value);
    }

    void whatDoesNotFitIsClamped() {
        const Place place{Table::holdingRegister, 0, DataType::uint16, false};
        QCOMPARE(drive::encodeRaw(place, 70000.0), Registers{0xFFFF});
        QCOMPARE(drive::encodeRaw(place, -3.0), Registers{0});
        QCOMPARE(drive::encodeRaw(place, std::nan("")), Registers{0});
    }

    void bitsAreThoseOfTheComplementOnTwo() {
        QCOMPARE(drive::toBits(4294967295.0), std::optional(0xFFFFFFFFU));
        QCOMPARE(drive::toBits(-1.0), std::optional(0xFFFFFFFFU));
        QCOMPARE(drive::toBits(-2147483648.0), std::optional(0x80000000U));
        QCOMPARE(drive::toBits(4294967296.0), std::optional<unsigned>());
        QCOMPARE(drive::toBits(-2147483649.0), std::optional<unsigned>());
        QCOMPARE(drive::toBits(std::nan("")), std::optional<unsigned>());
    }

    void quantitiesHaveAZeroAndAOne() {
        // 4 to 20 mA on 16 bits: 0 is 13107, 100 % is 65535.
        const drive::Quantity quantity{{}, 13107.0, 65535.0};
        QCOMPARE(drive::toRaw(quantity, 0.5), 39321.0);
        QCOMPARE(drive::fromRaw(quantity, 39321.0), 0.5);
    }
};

QTEST_APPLESS_MAIN(RegisterValueTest)
#include "register_value_test.moc"
