#include "core/traps/free_form.h"

#include <QtTest>
#include <limits>

#include "tests/core/track/track_scenes.h"

using namespace trapwright;
using traps::PointEncoding;
using traps::TrapParameters;

Q_DECLARE_METATYPE(TrapParameters)

class FreeFormTest : public QObject {
    Q_OBJECT

 private slots:
    void extremesOfFree() {
        const TrapParameters encoding{2, 2, 15e-3, 36e-3, 60e-3, 30e-3, PointEncoding::free};
        const std::vector<double> points = {0, 0, 1, 1, 1, 0, 0.5, 0.5};
        const std::vector<double> lengths = {0, 1};
        const auto sections = traps::decodeTrap(encoding, points, lengths);
        QCOMPARE(sections.size(), std::size_t{2});
        QCOMPARE(sections[0].x, 15e-3);
        QCOMPARE(sections[1].x, 51e-3);
        QCOMPARE(sections[0].points[0], base::Vec2(-30e-3, 0.0));
        QCOMPARE(sections[0].points[1], base::Vec2(30e-3, 30e-3));
        QCOMPARE(sections[1].points[0], base::Vec2(30e-3, 0.0));
        QCOMPARE(sections[1].points[1], base::Vec2(0.0, 15e-3));
    }

    void stripPointsKeepToTheirStrips() {
        const TrapParameters encoding;
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

    void checkNamesTheParameter_data() {
        QTest::addColumn<TrapParameters>("encoding");
        QTest::addColumn<QString>("named");
        TrapParameters e;
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
        QFETCH(TrapParameters, encoding);
        QFETCH(QString, named);
        QVERIFY(traps::checkParameters(TrapParameters{}).ok());
        const auto status = traps::checkParameters(encoding);
        QVERIFY(!status.ok());
        QVERIFY2(QString::fromStdString(status.error().message).contains(named),
                 status.error().message.c_str());
    }
};

QTEST_APPLESS_MAIN(FreeFormTest)
#include "free_form_test.moc"
