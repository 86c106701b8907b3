#include "core/track/print_flaws.h"

#include <QTest>
#include <utility>
#include <vector>

#include "core/track/track_file.h"
#include "core/track/track_solid.h"
#include "track_scenes.h"

using namespace trapwright;
using track::PrintFlaws;
using track::Track;

namespace {

constexpr double kMm = base::kMillimetre;
constexpr double kSquareMm = kMm * kMm;

using Profile = std::vector<std::pair<double, double>>;  // y, z [mm]

/// This profile along 100 mm.
Track extrude(const Profile& profile) {
    std::vector<track::CrossSection> sections(3);
    for (std::size_t i = 0; i < 3; ++i) {
        sections[i].x = static_cast<double>(i) * 50 * kMm;
        for (const auto& [y, z] : profile)
            sections[i].points.emplace_back(y * kMm, z * kMm);
    }
    Track result;
    const track::TrackSolid solid = track::buildTrackSolid({}, sections, 3 * kMm);
    result.sections = sections;
    result.solid = solid.mesh;
    result.surfaceTriangles = solid.surfaceTriangles;
    return result;
}

bool isNear(double value, double squareMm) {
    return std::abs(value - squareMm * kSquareMm) < 0.01 * kSquareMm;
}

}  // namespace

class PrintFlawsTest : public QObject {
    Q_OBJECT

 private slots:
    void whatComesWithTrapwrightCanBePrinted() {
        for (const char* file : {"cuboid_box_track.json", "cone_track.json", "bowl_track.json"}) {
            const auto read =
                track::readTrackFile(std::string(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/" + file);
            QVERIFY2(read, file);
            const PrintFlaws flaws = track::findPrintFlaws(read->track);
            QVERIFY2(isNear(flaws.thin, 0.0) && isNear(flaws.overhang, 0.0), file);
        }
    }

    void aFlatTrackHasNone() {
        const PrintFlaws flaws = track::findPrintFlaws(extrude({{-30, 15}, {0, 15}, {30, 15}}));
        QCOMPARE(flaws.thin, 0.0);
        QCOMPARE(flaws.overhang, 0.0);
    }

    // A rib, 0.8 mm thick and 10 mm high. Its walls lean by a thousandth, or the solid's ends would cross
    // themselves.
    void aThinRib() {
        const Track rib = extrude({{-30, 5}, {-0.41, 5}, {-0.4, 15}, {0.4, 15}, {0.41, 5}, {30, 5}});
        QVERIFY(isNear(track::findPrintFlaws(rib).thin, 1000.0));
        QCOMPARE(track::findPrintFlaws(rib).overhang, 0.0);
        QCOMPARE(track::findPrintFlaws(rib, {0.79 * kMm}).thin, 0.0);
    }

    // A ledge of 10 mm, 5 mm thick, over a surface 5 mm below it.
    void aLedge() {
        const Track ledge = extrude({{-30, 5}, {0, 5}, {0, 10}, {-10, 10}, {-10, 15}, {30, 15}});
        QVERIFY(isNear(track::findPrintFlaws(ledge).overhang, 1000.0));
        QCOMPARE(track::findPrintFlaws(ledge, {1.2 * kMm, 90 * base::kDegree}).overhang, 0.0);
    }

    // Export and learning must say the same.
    void itIsWhatTheCheckBeforePrintingTells() {
        double all = 0.0;
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto built = track::buildTrack({}, testing::drawTrap({}, seed));
            QVERIFY(built.ok());
            const PrintFlaws flaws = track::findPrintFlaws(*built);
            const geometry::PrintReport report = geometry::checkForPrinting(built->solid, {});
            QVERIFY(report.closed);
            PrintFlaws expected;
            for (const geometry::ThinWall& wall : report.thinWalls)
                expected.thin += wall.area;
            for (const geometry::Overhang& overhang : report.overhangs)
                expected.overhang += overhang.area;
            QCOMPARE(flaws.thin, expected.thin);
            QCOMPARE(flaws.overhang, expected.overhang);
            all += flaws.thin + flaws.overhang;
        }
        QVERIFY(all > 0.0);
    }
};

QTEST_APPLESS_MAIN(PrintFlawsTest)
#include "print_flaws_test.moc"
