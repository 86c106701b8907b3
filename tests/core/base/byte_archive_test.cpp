#include "core/base/byte_archive.h"

#include <QtTest>
#include <limits>

using namespace trapwright;

namespace trapwright::shapes {

enum class Colour { red, green, blue };

constexpr Colour lastOf(Colour /*unused*/) {
    return Colour::blue;
}

struct Shape {
    std::string name;
    Colour colour = Colour::red;
    std::vector<base::Vec2> corners;
    std::optional<double> weight{};
    bool closed = false;

    friend bool operator==(const Shape&, const Shape&) = default;
};

template <class Archive, base::OrConst<Shape> T>
void serialize(Archive& archive, T& shape) {
    auto& [name, colour, corners, weight, closed] = shape;
    archive(name, colour, corners, weight, closed);
}

}  // namespace trapwright::shapes

using shapes::Colour;
using shapes::Shape;

namespace {

template <class... T>
std::string bytesOf(const T&... values) {
    base::ByteWriter archive;
    archive(values...);
    return std::move(archive).bytes();
}

template <class T>
bool isRefused(const std::string& bytes) {
    base::ByteReader archive(bytes);
    T value{};
    archive(value);
    return archive.failed() && !archive.finished();
}

std::string text(std::initializer_list<int> bytes) {
    return {bytes.begin(), bytes.end()};
}

}  // namespace

class ByteArchiveTest : public QObject {
    Q_OBJECT

 private slots:
    // What another machine reads.
    void bytesAreLittleEndian() {
        QCOMPARE(bytesOf(std::uint32_t{0x01020384U}), text({0x84, 3, 2, 1}));
        QCOMPARE(bytesOf(-2), text({0xfe, 0xff, 0xff, 0xff}));
        QCOMPARE(bytesOf(std::size_t{5}), text({5, 0, 0, 0, 0, 0, 0, 0}));
        // 1.5 = 0x3ff8000000000000 in IEEE 754.
        QCOMPARE(bytesOf(1.5), text({0, 0, 0, 0, 0, 0, 0xf8, 0x3f}));
        QCOMPARE(bytesOf(true, std::string("ab"), Colour::blue), text({1, 2, 0, 0, 0, 'a', 'b', 2, 0, 0, 0}));
        QCOMPARE(bytesOf(std::optional<bool>(), std::optional(false)), text({0, 1, 0}));
        QCOMPARE(bytesOf(std::vector<std::array<std::uint8_t, 2>>{{1, 2}, {3, 4}}),
                 text({2, 0, 0, 0, 1, 2, 3, 4}));
    }

    void valuesComeBack() {
        const Shape shape{"roof", Colour::green, {{0.1, -0.0}, {1e-310, 3.0}}, 2.5, true};
        const std::vector<Shape> shapes = {shape, Shape(), shape};
        const base::Pose pose{base::Quaternion(1, 2, 3, 4), {5, 6, 7}};
        const std::string bytes = bytesOf(shapes, pose, std::numeric_limits<int>::min());
        base::ByteReader archive(bytes);
        std::vector<Shape> again = {shape};
        base::Pose poseAgain;
        int number = 0;
        archive(again, poseAgain);
        QVERIFY(!archive.failed() && !archive.finished());
        archive(number);
        QVERIFY(archive.finished());
        QVERIFY(again == shapes && poseAgain == pose);
        QCOMPARE(number, std::numeric_limits<int>::min());
        archive(number);
        QVERIFY(archive.failed() && !archive.finished());
    }

    void whatCannotBeIsRefused() {
        QVERIFY(isRefused<double>(text({1, 2, 3})));
        QVERIFY(isRefused<bool>(text({2})));
        QVERIFY(isRefused<Colour>(bytesOf(3)));
        QVERIFY(isRefused<Colour>(bytesOf(-1)));
        QVERIFY(isRefused<std::string>(text({3, 0, 0, 0, 'a', 'b'})));
        QVERIFY(isRefused<std::vector<double>>(bytesOf(std::uint32_t{2}, 1.0, true)));
        QVERIFY(isRefused<std::vector<Shape>>(bytesOf(std::uint32_t{0xffffffffU}, Shape())));
        QVERIFY(isRefused<std::optional<std::string>>(text({1, 9, 0, 0, 0})));
    }

    void bytesAsTheyAre() {
        base::ByteWriter writer;
        writer(std::uint8_t{7});
        writer.appendBytes("xyz");
        QCOMPARE(writer.bytes(), std::string("\x07xyz"));
        base::ByteReader reader(writer.bytes());
        std::uint8_t number = 0;
        reader(number);
        QCOMPARE(reader.left(), std::size_t{3});
        QVERIFY(reader.takeBytes(2) == "xy" && !reader.finished());
        QVERIFY(reader.takeBytes(2).empty() && reader.failed());
        QVERIFY(reader.takeBytes(0).empty() && reader.failed());
    }
};

QTEST_APPLESS_MAIN(ByteArchiveTest)
#include "byte_archive_test.moc"
