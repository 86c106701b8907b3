#include "core/track/print_flaws.h"

#include <QTest>
#include <utility>
#include <vector>

#include "core/track/print_solid.h"
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
    result.width = 60 * kMm;
    result.baseThickness = 3 * kMm;
    const track::TrackSolid solid = track::buildTrackSolid({}, sections, result.baseThickness);
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
        for (const char* file : {"cuboid_track.json", "cuboid_box_track.json", "cone_track.json",
                                 "bowl_track.json", "bracket_gaps_ledges_track.json"}) {
            const auto read =
                track::readTrackFile(std::string(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/" + file);
            QVERIFY2(read, file);
            QVERIFY2(isNear(track::findPrintFlaws(read->track).total(), 0.0), file);
        }
    }

    void aFlatTrackHasNone() {
        QCOMPARE(track::findPrintFlaws(extrude({{-30, 15}, {0, 15}, {30, 15}})).total(), 0.0);
    }

    // A crest of 90 degrees lacks nothing, one of 28 the last of it: 1.2 mm are as thick at 2.4 mm below its
    // tip.
    void aRidge() {
        QCOMPARE(track::findPrintFlaws(extrude({{-30, 5}, {-10, 5}, {0, 15}, {10, 5}, {30, 5}})).total(),
                 0.0);
        const PrintFlaws flaws =
            track::findPrintFlaws(extrude({{-30, 5}, {-2.5, 5}, {0, 15}, {2.5, 5}, {30, 5}}));
        QVERIFY(isNear(flaws.ridges, 2.4 * 100.0));
        QCOMPARE(flaws.total(), flaws.ridges);
    }

    // What is printed beyond a border that the surface rises to counts.
    void aRimMendsABorder() {
        const Track hill = extrude({{-30, 5}, {0, 5}, {20, 5}, {30, 20}});
        QVERIFY(!geometry::findSharpRidges(hill.solid, {}).empty());
        QCOMPARE(track::findPrintFlaws(hill).total(), 0.0);
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
            const auto printed = track::buildPrintSolid(*built, {});
            QVERIFY(printed.ok());
            const geometry::PrintReport report = geometry::checkForPrinting(*printed, {});
            QVERIFY(report.closed);
            PrintFlaws expected;
            for (const geometry::ThinWall& wall : report.thinWalls)
                expected.thin += wall.area;
            for (const geometry::SharpRidge& ridge : report.ridges)
                expected.ridges += ridge.length * ridge.lost;
            for (const geometry::Overhang& overhang : report.overhangs)
                expected.overhang += overhang.area;
            QCOMPARE(flaws.thin, expected.thin);
            QCOMPARE(flaws.ridges, expected.ridges);
            QCOMPARE(flaws.overhang, expected.overhang);
            all += flaws.total();
        }
        QVERIFY(all > 0.0);
    }
};

QTEST_APPLESS_MAIN(PrintFlawsTest)
#include "print_flaws_test.moc"
