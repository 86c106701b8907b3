#include "core/base/bytes.h"

#include <QtTest>
#include <cmath>
#include <limits>

using namespace trapwright;

class BytesTest : public QObject {
    Q_OBJECT

 private slots:
    void numbersLieLowestByteFirst() {
        base::ByteWriter writer;
        writer.put8(0xAB);
        writer.put32(0x01020304);
        writer.put64(0x1122334455667788);
        writer.putBytes("xy");
        QCOMPARE(writer.bytes(), std::string("\xAB\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11xy"));
    }

    void everythingComesBack() {
        base::ByteWriter writer;
        writer.put32(std::numeric_limits<std::uint32_t>::max());
        writer.putDouble(-0.0);
        writer.putDouble(std::numeric_limits<double>::denorm_min());
        writer.putDouble(std::nan(""));
        writer.put8(7);
        base::ByteReader reader(writer.bytes());
        QCOMPARE(reader.get32(), std::numeric_limits<std::uint32_t>::max());
        const double zero = reader.getDouble();
        QVERIFY(zero == 0.0 && std::signbit(zero));
        QCOMPARE(reader.getDouble(), std::numeric_limits<double>::denorm_min());
        QVERIFY(std::isnan(reader.getDouble()));
        QVERIFY(reader.ok() && !reader.atEnd());
        QCOMPARE(reader.left(), std::size_t{1});
        QCOMPARE(reader.get8(), std::uint8_t{7});
        QVERIFY(reader.atEnd());
    }

    void behindTheEndIsNothing() {
        base::ByteReader reader("abc");
        QCOMPARE(reader.get32(), 0U);
        QVERIFY(!reader.ok() && !reader.atEnd());
        QCOMPARE(reader.left(), std::size_t{0});
        QCOMPARE(reader.get8(), std::uint8_t{0});
        QVERIFY(reader.getBytes(0).empty());
        QVERIFY(!reader.ok());
    }
};

QTEST_APPLESS_MAIN(BytesTest)
#include "bytes_test.moc"
