#include "core/track/encoding.h"

#include <QtTest>
#include <limits>

#include "track_scenes.h"

using namespace trapwright;
using track::Encoding;
using track::PointEncoding;

Q_DECLARE_METATYPE(Encoding)

class EncodingTest : public QObject {
    Q_OBJECT

 private slots:
    void extremesOfFree() {
        const Encoding encoding{2, 2, 15e-3, 36e-3, 60e-3, 30e-3, PointEncoding::free};
        const std::vector<double> points = {0, 0, 1, 1, 1, 0, 0.5, 0.5};
        const std::vector<double> lengths = {0, 1};
        const auto sections = track::decodeTrap(encoding, points, lengths);
        QCOMPARE(sections.size(), std::size_t{2});
        QCOMPARE(sections[0].x, 15e-3);
        QCOMPARE(sections[1].x, 51e-3);
        QCOMPARE(sections[0].points[0], base::Vec2(-30e-3, 0.0));
        QCOMPARE(sections[0].points[1], base::Vec2(30e-3, 30e-3));
        QCOMPARE(sections[1].points[0], base::Vec2(30e-3, 0.0));
        QCOMPARE(sections[1].points[1], base::Vec2(0.0, 15e-3));
    }

    void stripPointsKeepToTheirStrips() {
        const Encoding encoding;
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            for (const auto& section : testing::drawTrap(encoding, seed)) {
                for (int j = 0; j < encoding.points; ++j) {
                    const base::Vec2& point = section.points[static_cast<std::size_t>(j)];
                    const double low = -0.5 * encoding.width + encoding.width / encoding.points * j;
                    QVERIFY(point.x() >= low - 1e-15 &&
                            point.x() <= low + encoding.width / encoding.points + 1e-15);
                    QVERIFY(point.y() >= 0.0 && point.y() <= encoding.height);
                }
            }
        }
    }

    void roundTrip_data() {
        QTest::addColumn<Encoding>("encoding");
        QTest::newRow("strip") << Encoding{};
        QTest::newRow("free") << Encoding{5, 8, 15e-3, 36e-3, 60e-3, 30e-3, PointEncoding::free};
        QTest::newRow("one section, two points")
            << Encoding{1, 2, 20e-3, 30e-3, 40e-3, 10e-3, PointEncoding::strip};
    }
    void roundTrip() {
        QFETCH(Encoding, encoding);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto sections = testing::drawTrap(encoding, seed);
            const auto encoded = track::encodeTrap(encoding, sections);
            QVERIFY2(encoded.ok(), encoded.ok() ? "" : encoded.error().message.c_str());
            const auto again = track::decodeTrap(encoding, encoded->points, encoded->lengths);
            for (std::size_t i = 0; i < sections.size(); ++i) {
                QVERIFY(std::abs(again[i].x - sections[i].x) < 1e-15);
                for (std::size_t j = 0; j < sections[i].points.size(); ++j) {
                    QVERIFY((again[i].points[j] - sections[i].points[j]).norm() < 1e-15);
                }
            }
        }
    }

    void equalLengthsEncode() {
        Encoding encoding;
        encoding.minLength = encoding.maxLength = 30e-3;
        const auto encoded = track::encodeTrap(encoding, testing::drawTrap(encoding, 3));
        QVERIFY(encoded.ok());
        QCOMPARE(encoded->lengths, std::vector<double>(5, 0.0));
    }

    void refusesWhatItCannotExpress() {
        const Encoding encoding;
        auto trap = testing::drawTrap(encoding, 1);
        std::swap(trap[2].points[3], trap[2].points[4]);
        const auto outside = track::encodeTrap(encoding, trap);
        QVERIFY(!outside.ok());
        QVERIFY(outside.error().message.find("Point 4 of cross-section 3") != std::string::npos);

        trap = testing::drawTrap(encoding, 1);
        for (std::size_t i = 1; i < trap.size(); ++i)
            trap[i].x += 50e-3;
        const auto tooLong = track::encodeTrap(encoding, trap);
        QVERIFY(!tooLong.ok());
        QVERIFY(tooLong.error().message.find("Cross-section 2 is") != std::string::npos);
        trap.pop_back();
        QVERIFY(!track::encodeTrap(encoding, trap).ok());
    }

    void checkNamesTheParameter_data() {
        QTest::addColumn<Encoding>("encoding");
        QTest::addColumn<QString>("named");
        Encoding e;
        e.minLength = 40e-3;
        QTest::newRow("min > max") << e << "minimal segment length (40 mm) is greater";
        e = {};
        e.sections = 0;
        QTest::newRow("sections") << e << "number of cross-sections is 0";
        e = {};
        e.points = 1;
        QTest::newRow("points") << e << "points per cross-section is 1";
        e = {};
        e.width = -60e-3;
        QTest::newRow("width") << e << "segment width is -60 mm";
        e = {};
        e.height = std::numeric_limits<double>::quiet_NaN();
        QTest::newRow("height") << e << "segment height is nan mm";
    }
    void checkNamesTheParameter() {
        QFETCH(Encoding, encoding);
        QFETCH(QString, named);
        QVERIFY(track::checkEncoding(Encoding{}).ok());
        const auto status = track::checkEncoding(encoding);
        QVERIFY(!status.ok());
        QVERIFY2(QString::fromStdString(status.error().message).contains(named),
                 status.error().message.c_str());
    }
};

QTEST_APPLESS_MAIN(EncodingTest)
#include "encoding_test.moc"
