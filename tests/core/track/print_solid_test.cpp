#include "core/track/print_solid.h"

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <array>
#include <set>

#include "core/geometry/mesh_check.h"
#include "core/geometry/mesh_files.h"
#include "core/geometry/print_check.h"
#include "core/geometry/three_mf.h"
#include "core/track/track_file.h"
#include "core/traps/groove.h"
#include "core/traps/trap_chain.h"
#include "track_scenes.h"

using namespace trapwright;
using track::Conveying;
using track::FeederShape;
using track::PrintOptions;
using track::Track;

Q_DECLARE_METATYPE(Track)
Q_DECLARE_METATYPE(PrintOptions)

namespace {

constexpr double kMm = base::kMillimetre;
constexpr double kBase = 3 * kMm;
constexpr double kWidth = 60 * kMm;
constexpr double kSurface = 15 * kMm;  // the lead-in's height

/// Flat from end to end: 80 mm lead-in, 20 mm trap, two segments of 36 mm: 172 mm.
Track makeFlat(const FeederShape& shape = {}) {
    track::CrossSection section{20 * kMm, {}};
    for (const double y : {-0.5, -0.2, 0.1, 0.5})
        section.points.emplace_back(y * kWidth, kSurface);
    track::TrackParameters parameters;
    parameters.shape = shape;
    return track::buildTrack(parameters, {{section}}).value();
}

constexpr double kLength = 172 * kMm;

Track readExample(const std::string& name) {
    const auto file =
        track::readTrackFile(std::string(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/" + name + ".json");
    if (!file) qFatal("%s", file.error().message.c_str());
    return file->track;
}

PrintOptions makeOptions(double wall, bool flange, double bolts) {
    PrintOptions options;
    options.wallHeight = wall;
    options.flange = flange;
    options.boltDiameter = bolts;
    return options;
}

using Corners = std::array<std::array<double, 3>, 3>;

/// A triangle's corners, whatever their numbers and whichever is first.
Corners cornersOf(const geometry::TriangleMesh& mesh, std::size_t triangle) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const base::Vec3& v = mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
        corners[k] = {v.x(), v.y(), v.z()};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

std::size_t countMissingSurface(const Track& track, const geometry::TriangleMesh& solid) {
    std::set<Corners> present;
    for (std::size_t i = 0; i < solid.triangles.size(); ++i)
        present.insert(cornersOf(solid, i));
    std::size_t missing = 0;
    for (std::size_t i = 0; i < track.surfaceTriangles; ++i)
        missing += 1 - present.count(cornersOf(track.solid, i));
    return missing;
}

double volumeOf(const Track& track, const PrintOptions& options) {
    const auto solid = track::buildPrintSolid(track, options);
    if (!solid) qFatal("%s", solid.error().message.c_str());
    return geometry::checkMesh(*solid).volume;
}

void compareVolume(double got, double expected, double tolerance = 1e-9) {
    if (!(std::abs(got / expected - 1.0) <= tolerance))
        QFAIL(qPrintable(
            QString("%1 instead of %2 mm^3").arg(got * 1e9, 0, 'g', 10).arg(expected * 1e9, 0, 'g', 10)));
}

}  // namespace

class PrintSolidTest : public QObject {
    Q_OBJECT

 private slots:
    void withoutOptionsItIsTheTrack() {
        const Track track = readExample("cuboid_track");
        PrintOptions bare;
        bare.rim = 0.0;
        const auto solid = track::buildPrintSolid(track, bare);
        QVERIFY(solid.ok());
        QCOMPARE(solid->triangles.size(), track.solid.triangles.size());
        std::set<Corners> one;
        std::set<Corners> other;
        for (std::size_t i = 0; i < track.solid.triangles.size(); ++i) {
            one.insert(cornersOf(track.solid, i));
            other.insert(cornersOf(*solid, i));
        }
        QVERIFY(one == other);
    }

    // Where the surface rises to its border by 60 degrees, its edge is one of 30.
    void aRimBluntsASharpBorder() {
        track::CrossSection section{20 * kMm, {}};
        const double top = kSurface + 6 * kMm * std::tan(60.0 * base::kDegree);
        for (const double y : {-30.0, 0.0, 24.0})
            section.points.emplace_back(y * kMm, kSurface);
        section.points.emplace_back(30 * kMm, top);
        const Track track = track::buildTrack({}, {{section}}).value();
        PrintOptions bare;
        bare.rim = 0.0;
        const auto sharp = track::buildPrintSolid(track, bare);
        QVERIFY(sharp.ok());
        const auto ridges = geometry::findSharpRidges(*sharp, {});
        QCOMPARE(ridges.size(), std::size_t{1});
        QVERIFY(std::abs(ridges[0].angle - 30.0 * base::kDegree) < 1.0 * base::kDegree);

        PrintOptions options;
        for (const bool flange : {false, true}) {
            options.flange = flange;
            const auto solid = track::buildPrintSolid(track, options);
            QVERIFY(solid.ok());
            const geometry::PrintReport report = geometry::checkForPrinting(*solid, {});
            QVERIFY(report.closed && report.ridges.empty() && report.thinWalls.empty());
            QCOMPARE(report.overlappingTriangles, 0);
            QCOMPARE(countMissingSurface(track, *solid), 0U);
            if (flange) continue;
            const geometry::Box box = geometry::calcBoundingBox(*solid);
            QVERIFY(std::abs(box.low.y() + 30 * kMm) < 1e-12 && std::abs(box.high.y() - 31.2 * kMm) < 1e-12);
            // Along the two segments of the lead-out and the trap, and with the lead-in it becomes less.
            const double height = kBase + top;
            const double added = report.volume - geometry::checkForPrinting(*sharp, {}).volume;
            QVERIFY(added > 1.2 * kMm * height * 72 * kMm && added < 1.2 * kMm * height * 132 * kMm);
        }
        // A lip of what is cut off inside of the track decides by tenths of a millimetre: it stays.
        track::CrossSection lip = section;
        for (base::Vec2& point : lip.points)
            point.x() = std::min(point.x(), 0.4 * point.x());
        const Track cut = track::buildTrack({}, {{lip}}).value();
        QVERIFY(!geometry::findSharpRidges(cut.solid, {}).empty());
        QCOMPARE(track::buildPrintSolid(cut, {})->triangles.size(), cut.solid.triangles.size());
        // A wall makes it blunt by itself, and a border that is not sharp needs no rim.
        QCOMPARE(track::buildPrintSolid(track, makeOptions(5 * kMm, false, 0.0))->triangles.size(), [&] {
            PrintOptions walls = makeOptions(5 * kMm, false, 0.0);
            walls.rim = 0.0;
            return track::buildPrintSolid(track, walls)->triangles.size();
        }());
        QCOMPARE(track::buildPrintSolid(makeFlat(), {})->triangles.size(), makeFlat().solid.triangles.size());
    }

    void volumesOfALinearTrack() {
        const Track track = makeFlat();
        const double plain = kLength * kWidth * (kSurface + kBase);
        compareVolume(volumeOf(track, {}), plain);
        PrintOptions options;
        options.baseThickness = 7 * kMm;
        compareVolume(volumeOf(track, options), kLength * kWidth * (kSurface + 7 * kMm));

        options = makeOptions(10 * kMm, false, 0.0);
        options.wallThickness = 2.5 * kMm;
        const double walls = 2.0 * kLength * 2.5 * kMm * (kSurface + 10 * kMm + kBase);
        compareVolume(volumeOf(track, options), plain + walls);

        options.flange = true;
        options.flangeThickness = 2 * kMm;
        options.boltEdgeDistance = 6 * kMm;
        const double flanges = 2.0 * kLength * 12 * kMm * 2 * kMm;
        compareVolume(volumeOf(track, options), plain + walls + flanges);

        // (172 - 12) / 40: five holes a side; each a 48-gon around a circle of 5 mm.
        options.boltDiameter = 5 * kMm;
        options.boltSpacing = 40 * kMm;
        const double hole = 48.0 * std::pow(2.5 * kMm, 2) * std::tan(base::kPi / 48) * 2 * kMm;
        compareVolume(volumeOf(track, options), plain + walls + flanges - 10.0 * hole);

        // Without walls the flange begins at the track's own sides.
        options.wallHeight = 0.0;
        compareVolume(volumeOf(track, options), plain + flanges - 10.0 * hole);
    }

    void sizeOfALinearTrack() {
        PrintOptions options = makeOptions(10 * kMm, true, 4 * kMm);
        const auto solid = track::buildPrintSolid(makeFlat(), options);
        QVERIFY(solid.ok());
        const geometry::Box box = geometry::calcBoundingBox(*solid);
        const double side = 0.5 * kWidth + options.wallThickness + 2.0 * options.boltEdgeDistance;
        QVERIFY((box.low - base::Vec3(0.0, -side, -kBase)).norm() < 1e-12);
        QVERIFY((box.high - base::Vec3(kLength, side, kSurface + 10 * kMm)).norm() < 1e-12);
    }

    // The insert of a bowl whose track climbs stands flat, with a flat flange; its walls climb with the
    // surface.
    void sizeOfAClimbingInsert() {
        for (const double degrees : {4.0, -4.0}) {
            const double slope = degrees * base::kDegree;
            const Track track = makeFlat(testing::makeBowl(Conveying::clockwise, slope));
            const double climb = std::abs(kLength * std::tan(slope));
            const double lowest = std::min(0.0, kLength * std::tan(slope));
            const auto solid = track::buildPrintSolid(track, makeOptions(10 * kMm, true, 4 * kMm));
            QVERIFY(solid.ok());
            const geometry::Box box = geometry::calcBoundingBox(*solid);
            QVERIFY(std::abs(box.low.z() - (lowest - kBase)) < 1e-12);
            QVERIFY(std::abs(box.size().z() - (kBase + climb + kSurface + 10 * kMm)) < 1e-12);
            const double wallsOutside = 175 * kMm + 0.5 * kWidth + 2 * kMm;
            for (const base::Vec3& v : solid->vertices) {
                if (std::hypot(v.x(), v.y()) < wallsOutside + kMm) continue;
                QVERIFY(v.z() > lowest - kBase - 1e-9 && v.z() < lowest + 1e-9);
            }
        }
    }

    // A track with walls is printed with them as it was simulated; only higher ones change it.
    void wallsOfTheTrackArePrinted() {
        for (const auto& shape : {FeederShape{}, testing::makeBowl(Conveying::anticlockwise)}) {
            const Track bare = makeFlat(shape);
            Track track = bare;
            track.walls = {0.0, 8 * kMm};
            track::addSolid(track);
            const auto printed = track::buildPrintSolid(track, {});
            QVERIFY(printed.ok());
            QCOMPARE(printed->vertices, track.solid.vertices);
            QCOMPARE(printed->triangles, track.solid.triangles);
            QCOMPARE(countMissingSurface(bare, *printed), 0U);

            const auto higher = track::buildPrintSolid(track, makeOptions(10 * kMm, false, 0.0));
            const auto bareHigher = track::buildPrintSolid(bare, makeOptions(10 * kMm, false, 0.0));
            QVERIFY(higher.ok() && bareHigher.ok());
            QCOMPARE(higher->vertices, bareHigher->vertices);

            // The inner side gets what the options say, the outer one what it had.
            const auto lower = track::buildPrintSolid(track, makeOptions(5 * kMm, true, 4 * kMm));
            QVERIFY2(lower.ok(), lower.ok() ? "" : lower.error().message.c_str());
            const geometry::MeshReport report = geometry::checkMesh(*lower, true);
            QVERIFY(report.isSolid() && report.overlappingTriangles == 0);
            const geometry::Box box = geometry::calcBoundingBox(*lower);
            QVERIFY(std::abs(box.high.z() - (kSurface + 8 * kMm)) < 1e-9);
        }
    }

    void insertOfABowl() {
        for (const Conveying conveying : {Conveying::clockwise, Conveying::anticlockwise}) {
            const FeederShape shape = testing::makeBowl(conveying);
            const Track track = makeFlat(shape);
            PrintOptions options = makeOptions(0.0, true, 0.0);
            options.insertRadius = 230 * kMm;
            const auto solid = track::buildPrintSolid(track, options);
            QVERIFY(solid.ok());
            // The foot is a sector of a ring from the track's outer side to the bowl; chords take a little.
            const double angle = kLength / shape.bowlRadius;
            const double outside = shape.bowlRadius + 0.5 * kWidth;
            const double foot = 0.5 * angle * (std::pow(230 * kMm, 2) - outside * outside) * 3 * kMm;
            const double plain = volumeOf(track, {});
            compareVolume(geometry::checkMesh(*solid).volume - plain, foot, 0.02);
            double farthest = 0.0;
            for (const base::Vec3& v : solid->vertices)
                farthest = std::max(farthest, std::hypot(v.x(), v.y()));
            QVERIFY(std::abs(farthest - 230 * kMm) < 1e-9);

            // Radius 230 - 8: (172 / 175 * 222 - 16) / 50: five holes.
            options.boltDiameter = 5 * kMm;
            const double hole = 48.0 * std::pow(2.5 * kMm, 2) * std::tan(base::kPi / 48) * 3 * kMm;
            compareVolume(geometry::checkMesh(*solid).volume - volumeOf(track, options), 5.0 * hole, 1e-6);
        }
    }

    void examplesAreClosedAndManifold_data() {
        QTest::addColumn<Track>("track");
        QTest::addColumn<PrintOptions>("options");
        const std::pair<const char*, Track> tracks[] = {{"cuboid", readExample("cuboid_track")},
                                                        {"cone", readExample("cone_track")},
                                                        {"flat", makeFlat()}};
        const std::pair<const char*, FeederShape> shapes[] = {
            {"linear", {}},
            {"clockwise", testing::makeBowl(Conveying::clockwise)},
            {"anticlockwise", testing::makeBowl(Conveying::anticlockwise)},
            {"clockwise, climbs", testing::makeBowl(Conveying::clockwise, 4.0 * base::kDegree)},
            {"anticlockwise, falls", testing::makeBowl(Conveying::anticlockwise, -15.0 * base::kDegree)}};
        const std::pair<const char*, PrintOptions> options[] = {
            {"plain", {}},
            {"walls", makeOptions(5 * kMm, false, 0.0)},
            {"flange", makeOptions(0.0, true, 0.0)},
            {"bolts", makeOptions(0.0, true, 4.5 * kMm)},
            {"walls, bolts", makeOptions(5 * kMm, true, 4.5 * kMm)}};
        for (const auto& [name, track] : tracks)
            for (const auto& [kind, shape] : shapes)
                for (const auto& [title, option] : options)
                    QTest::addRow("%s, %s, %s", name, kind, title) << testing::bend(track, shape) << option;
    }

    void examplesAreClosedAndManifold() {
        QFETCH(Track, track);
        QFETCH(PrintOptions, options);
        const auto solid = track::buildPrintSolid(track, options);
        QVERIFY2(solid.ok(), solid.ok() ? "" : solid.error().message.c_str());
        QCOMPARE(countMissingSurface(track, *solid), 0U);
        const geometry::MeshReport report = geometry::checkMesh(*solid, true);
        QVERIFY(report.isSolid());
        QCOMPARE(report.nonManifoldEdges, 0);
        QCOMPARE(report.shells, 1);
        QCOMPARE(report.overlappingTriangles, 0);

        // Still so in the single precision of a file.
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("track.stl").toStdString();
        QVERIFY(geometry::writeStl(path, *solid).ok());
        const auto read = geometry::readStl(path);
        QVERIFY(read.ok());
        const geometry::MeshReport written = geometry::checkMesh(*read);
        QVERIFY(written.isSolid());
        QCOMPARE(written.nonManifoldEdges, 0);
        QVERIFY(std::abs(written.volume / report.volume - 1.0) < 1e-5);
        const std::filesystem::path package = folder.filePath("track.3mf").toStdString();
        QVERIFY(geometry::write3mf(package, {&*solid, 1}, "track").ok());
        QVERIFY(geometry::read3mf(package).ok());
    }

    void flangeAsHighAsTheSurface() {
        // The surface touches z = 0 at its border in one place; so does a flange as thick as the base.
        track::CrossSection section{20 * kMm, {{-0.5 * kWidth, 0.0}, {0.0, 0.0}, {0.5 * kWidth, 10 * kMm}}};
        const Track track = track::buildTrack({}, {{section}}).value();
        for (const double bolts : {0.0, 4.5 * kMm}) {
            const auto solid = track::buildPrintSolid(track, makeOptions(0.0, true, bolts));
            QVERIFY(solid.ok());
            const geometry::MeshReport report = geometry::checkMesh(*solid, true);
            QVERIFY(report.isSolid());
            QCOMPARE(report.nonManifoldEdges, 0);
        }
    }

    // Walls end before the rails, and the flange goes on beside them.
    void narrowRailsAreClosed() {
        traps::TrapParameters form;
        form.pointsPerSection = 9;
        form.walls = {6 * kMm, 6 * kMm};
        const traps::TrapKind kind = traps::narrowRails();
        const std::vector<double> numbers(kind.dimensions(form).size(), 0.5);
        const auto trap = kind.build(form, traps::levelSection(form, 0.5 * form.segmentHeight), numbers);
        const Track track = track::buildTrack(form, trap).value();
        for (const double wall : {0.0, 9 * kMm}) {
            const auto solid = track::buildPrintSolid(track, makeOptions(wall, true, 4.5 * kMm));
            QVERIFY2(solid.ok(), solid.ok() ? "" : solid.error().message.c_str());
            QVERIFY(geometry::checkMesh(*solid, true).isSolid());
            QCOMPARE(countMissingSurface(track, *solid), 0U);
        }
    }

    void surfacesThatOverhangAreClosedAllTheSame() {
        traps::TrapParameters form;
        form.encoding = traps::PointEncoding::free;
        const Track track = track::buildTrack({}, testing::drawTrap(form, 5)).value();
        const auto solid = track::buildPrintSolid(track, makeOptions(5 * kMm, true, 4.5 * kMm));
        QVERIFY2(solid.ok(), solid.ok() ? "" : solid.error().message.c_str());
        QVERIFY(geometry::checkMesh(*solid).isSolid());
        QCOMPARE(countMissingSurface(track, *solid), 0U);
    }

    void problemsNameTheirOption_data() {
        QTest::addColumn<PrintOptions>("options");
        QTest::addColumn<QString>("option");
        const auto add = [](const char* option, auto change, const char* row = nullptr) {
            PrintOptions options = makeOptions(5 * kMm, true, 4.5 * kMm);
            change(options);
            QTest::newRow(row != nullptr ? row : option) << options << QString(option);
        };
        add("baseThickness", [](PrintOptions& o) { o.baseThickness = 0.0; });
        add("wallHeight", [](PrintOptions& o) { o.wallHeight = -1 * kMm; });
        add(
            "wallHeight", [](PrintOptions& o) { o.wallHeight = NAN; }, "not a number");
        add("wallThickness", [](PrintOptions& o) { o.wallThickness = 0.0; });
        add(
            "wallThickness", [](PrintOptions& o) { o.wallThickness = 5.0; }, "wall too thick");
        add("rim", [](PrintOptions& o) { o.rim = -1 * kMm; });
        add("flangeThickness", [](PrintOptions& o) { o.flangeThickness = 3.1 * kMm; });
        add("boltDiameter", [](PrintOptions& o) { o.boltDiameter = -1 * kMm; });
        add("boltEdgeDistance", [](PrintOptions& o) { o.boltEdgeDistance = 2 * kMm; });
        add(
            "boltEdgeDistance", [](PrintOptions& o) { o.boltEdgeDistance = 90 * kMm; },
            "no length for bolts");
        add("boltSpacing", [](PrintOptions& o) { o.boltSpacing = 4 * kMm; });
        add("insertRadius", [](PrintOptions& o) { o.insertRadius = -1 * kMm; });
    }

    void problemsNameTheirOption() {
        QFETCH(PrintOptions, options);
        QFETCH(QString, option);
        const auto solid = track::buildPrintSolid(makeFlat(), options);
        QVERIFY(!solid.ok());
        QCOMPARE(QString::fromStdString(solid.error().option), option);
        QVERIFY(!solid.error().message.empty());
    }

    void anInsertNeedsRoom() {
        PrintOptions options = makeOptions(5 * kMm, true, 4.5 * kMm);
        const Track track = makeFlat(testing::makeBowl(Conveying::clockwise));
        // 175 + 30 + 2 + 16 mm
        QVERIFY(std::abs(track::insertRadiusOf(track, options) - 223 * kMm) < 1e-12);
        options.insertRadius = 222 * kMm;
        const auto solid = track::buildPrintSolid(track, options);
        QVERIFY(!solid.ok());
        QCOMPARE(solid.error().option, std::string("insertRadius"));
        QVERIFY(solid.error().message.find("223 mm") != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(PrintSolidTest)
#include "print_solid_test.moc"
