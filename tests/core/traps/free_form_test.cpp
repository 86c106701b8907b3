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
        TrapParameters form;
        form.crossSections = 2;
        form.pointsPerSection = 2;
        form.encoding = PointEncoding::free;
        const std::vector<double> points = {0, 0, 1, 1, 1, 0, 0.5, 0.5};
        const std::vector<double> lengths = {0, 1};
        const auto sections = traps::decodeTrap(form, points, lengths);
        QCOMPARE(sections.size(), std::size_t{2});
        QCOMPARE(sections[0].x, 15e-3);
        QCOMPARE(sections[1].x, 51e-3);
        QCOMPARE(sections[0].points[0], base::Vec2(-30e-3, 0.0));
        QCOMPARE(sections[0].points[1], base::Vec2(30e-3, 30e-3));
        QCOMPARE(sections[1].points[0], base::Vec2(30e-3, 0.0));
        QCOMPARE(sections[1].points[1], base::Vec2(0.0, 15e-3));
    }

    void stripPointsKeepToTheirStrips() {
        const TrapParameters form;
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            for (const auto& section : testing::drawTrap(form, seed)) {
                for (int j = 0; j < form.pointsPerSection; ++j) {
                    const base::Vec2& point = section.points[static_cast<std::size_t>(j)];
                    const double low =
                        -0.5 * form.segmentWidth + form.segmentWidth / form.pointsPerSection * j;
                    QVERIFY(point.x() >= low - 1e-15 &&
                            point.x() <= low + form.segmentWidth / form.pointsPerSection + 1e-15);
                    QVERIFY(point.y() >= 0.0 && point.y() <= form.segmentHeight);
                }
            }
        }
    }

    void checkNamesTheParameter_data() {
        QTest::addColumn<TrapParameters>("form");
        QTest::addColumn<QString>("named");
        TrapParameters e;
        e.minSegmentLength = 40e-3;
        QTest::newRow("min > max") << e << "minimal segment length (40 mm) is greater";
        e = {};
        e.crossSections = 0;
        QTest::newRow("sections") << e << "number of cross-sections is 0";
        e = {};
        e.pointsPerSection = 1;
        QTest::newRow("points") << e << "points per cross-section is 1";
        e = {};
        e.segmentWidth = -60e-3;
        QTest::newRow("width") << e << "segment width is -60 mm";
        e = {};
        e.segmentHeight = std::numeric_limits<double>::quiet_NaN();
        QTest::newRow("height") << e << "segment height is nan mm";
    }
    void checkNamesTheParameter() {
        QFETCH(TrapParameters, form);
        QFETCH(QString, named);
        QVERIFY(traps::checkParameters(TrapParameters{}).ok());
        const auto status = traps::checkParameters(form);
        QVERIFY(!status.ok());
        QVERIFY2(QString::fromStdString(status.error().message).contains(named),
                 status.error().message.c_str());
    }
};

QTEST_APPLESS_MAIN(FreeFormTest)
#include "free_form_test.moc"
