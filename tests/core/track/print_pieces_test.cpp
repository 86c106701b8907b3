#include "core/track/print_pieces.h"

#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/geometry/mesh_check.h"
#include "core/geometry/surface_distance.h"
#include "core/geometry/triangle_mesh.h"
#include "core/track/print_mount.h"
#include "core/track/track_file.h"
#include "track_scenes.h"

using namespace trapwright;
using track::Conveying;
using track::PrintOptions;
using track::PrintPiece;
using track::SplitOptions;
using track::Track;

Q_DECLARE_METATYPE(Track)
Q_DECLARE_METATYPE(PrintOptions)

namespace {

constexpr double kMm = base::kMillimetre;

Track readExample(const std::string& name, const track::FeederShape& shape = {}) {
    const auto file =
        track::readTrackFile(std::string(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/" + name + ".json");
    if (!file) qFatal("%s", file.error().message.c_str());
    return testing::bend(file->track, shape);
}

PrintOptions makeOptions(double wall, bool flange) {
    PrintOptions options;
    options.wallHeight = wall;
    options.flange = flange;
    return options;
}

geometry::BuildSpace makeSpace(double x, double y, double height) {
    return {x * kMm, y * kMm, height * kMm};
}

double volumeOf(const geometry::TriangleMesh& mesh) {
    return geometry::checkMesh(mesh).volume;
}

}  // namespace

class PrintPiecesTest : public QObject {
    Q_OBJECT

 private slots:
    void piecesAreTheWholeWithoutTheHoles_data() {
        QTest::addColumn<Track>("track");
        QTest::addColumn<PrintOptions>("options");
        const std::pair<const char*, track::FeederShape> shapes[] = {
            {"linear", {}},
            {"clockwise", testing::makeBowl(Conveying::clockwise)},
            {"anticlockwise", testing::makeBowl(Conveying::anticlockwise)},
            {"clockwise, climbs", testing::makeBowl(Conveying::clockwise, 4.0 * base::kDegree)},
            {"clockwise, falls", testing::makeBowl(Conveying::clockwise, -4.0 * base::kDegree)}};
        for (const auto& [kind, shape] : shapes) {
            QTest::addRow("cuboid, %s", kind) << readExample("cuboid_track", shape) << PrintOptions{};
            QTest::addRow("cuboid, %s, walls, bolts", kind)
                << readExample("cuboid_track", shape) << makeOptions(5 * kMm, true);
            QTest::addRow("cone, %s, bolts", kind)
                << readExample("cone_track", shape) << makeOptions(0.0, true);
        }
    }

    void piecesAreTheWholeWithoutTheHoles() {
        QFETCH(Track, track);
        QFETCH(PrintOptions, options);
        SplitOptions split;
        const auto cuts = track::proposeCuts(track, options, split, makeSpace(180, 160, 180));
        QVERIFY2(cuts.ok(), cuts.ok() ? "" : cuts.error().message.c_str());
        QVERIFY(!cuts->empty());
        split.cuts = *cuts;
        const auto pieces = track::buildPrintPieces(track, options, split);
        QVERIFY2(pieces.ok(), pieces.ok() ? "" : pieces.error().message.c_str());
        QCOMPARE(pieces->size(), cuts->size() + 1);

        const geometry::TriangleMesh whole = track::buildPrintSolid(track, options).value();
        double volume = 0.0;
        for (const PrintPiece& piece : *pieces) {
            const geometry::MeshReport report = geometry::checkMesh(piece.solid, true);
            QVERIFY(report.isSolid());
            QCOMPARE(report.nonManifoldEdges, 0);
            QCOMPARE(report.shells, 1);
            QCOMPARE(report.overlappingTriangles, 0);
            QVERIFY(geometry::fitOnBed(piece.solid, makeSpace(180, 160, 180)).fits);
            volume += report.volume;
            for (const track::DowelHole& hole : piece.holes)
                volume += track::volumeOf(hole);
        }
        QVERIFY2(std::abs(volume / volumeOf(whole) - 1.0) < 1e-9,
                 qPrintable(QString::number(volume / volumeOf(whole) - 1.0)));
    }

    void holesMatchAndDoNotBreakThrough() {
        for (const auto& shape : {track::FeederShape{}, testing::makeBowl(Conveying::clockwise),
                                  testing::makeBowl(Conveying::anticlockwise, -4.0 * base::kDegree)}) {
            const Track track = readExample("cuboid_track", shape);
            const PrintOptions options = makeOptions(5 * kMm, true);
            SplitOptions split;
            split.cuts = track::proposeCuts(track, options, split, makeSpace(180, 160, 180)).value();
            split.dowelDiameter = 4 * kMm;
            split.dowelDepth = 6 * kMm;
            const auto pieces = track::buildPrintPieces(track, options, split);
            QVERIFY2(pieces.ok(), pieces.ok() ? "" : pieces.error().message.c_str());
            const geometry::TriangleMesh whole = track::buildPrintSolid(track, options).value();
            const geometry::SurfaceDistance surface(whole);
            for (std::size_t i = 0; i + 1 < pieces->size(); ++i) {
                // The last two of the piece before, the first two of the one after.
                const auto& before = (*pieces)[i].holes;
                const auto& after = (*pieces)[i + 1].holes;
                QVERIFY(before.size() >= 2 && after.size() >= 2);
                for (std::size_t k = 0; k < 2; ++k) {
                    const track::DowelHole& a = before[before.size() - 2 + k];
                    const track::DowelHole& b = after[k];
                    QVERIFY((a.mouth - b.mouth).norm() < 1e-12);
                    QVERIFY((a.axis + b.axis).norm() < 1e-12);
                    QVERIFY(std::abs(a.radius - 2.1 * kMm) < 1e-12 && a.radius == b.radius);
                    QVERIFY(std::abs(a.depth - 6.2 * kMm) < 1e-12 && a.depth == b.depth);
                }
                QVERIFY((after[0].mouth - after[1].mouth).norm() > 20 * kMm);
            }
            for (const PrintPiece& piece : *pieces) {
                for (const track::DowelHole& hole : piece.holes) {
                    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                        const base::Vec3 place = hole.mouth + share * hole.depth * hole.axis;
                        QVERIFY(geometry::calcWindingNumber(whole, place) > 0.5);
                        QVERIFY(surface.calcDistance(place) > hole.radius + split.dowelWall - 0.05 * kMm);
                        // A pin has room in the piece itself.
                        QVERIFY(share == 0.0 ||
                                geometry::calcWindingNumber(
                                    piece.solid, hole.mouth + 0.999 * share * hole.depth * hole.axis) < 0.5);
                    }
                }
            }
        }
    }

    void cutsLieAcrossTheConveyingDirection() {
        for (const auto& shape : {track::FeederShape{}, testing::makeBowl(Conveying::anticlockwise),
                                  testing::makeBowl(Conveying::clockwise, 4.0 * base::kDegree)}) {
            const Track track = readExample("cuboid_track", shape);
            SplitOptions split;
            split.cuts = {3};
            split.dowelDiameter = 0.0;
            PrintOptions bare;
            bare.rim = 0.0;
            const auto pieces = track::buildPrintPieces(track, bare, split);
            QVERIFY(pieces.ok());
            // Radial on a bowl: each vertex of the face has the section's x.
            const double x = track.sections[3].x;
            std::vector<std::size_t> inFace(2, 0);
            for (std::size_t i = 0; i < 2; ++i) {
                for (const base::Vec3& v : (*pieces)[i].solid.vertices) {
                    const double there = track.shape.toTrack(v, x).x();
                    QVERIFY(i == 0 ? there < x + 1e-9 : there > x - 1e-9);
                    if (std::abs(there - x) < 1e-9) ++inFace[i];
                }
            }
            QCOMPARE(inFace[0], inFace[1]);
            QCOMPARE(inFace[0], 2 * track.sections[3].points.size());
        }
    }

    void proposalIsTheFewestAndEvenest() {
        const Track track = readExample("cuboid_track");
        const geometry::BuildSpace space = makeSpace(250, 210, 220);
        const auto cuts = track::proposeCuts(track, {}, {}, space);
        QVERIFY(cuts.ok());
        QCOMPARE(cuts->size(), 1U);
        // No other single cut leaves a shorter longest piece.
        const auto longest = [&](int cut) {
            const double x = track.sections[static_cast<std::size_t>(cut)].x;
            return std::max(x - track.begin(), track.end() - x);
        };
        for (int cut = 1; cut + 1 < static_cast<int>(track.sections.size()); ++cut) {
            SplitOptions split;
            split.cuts = {cut};
            if (track::buildPrintPieces(track, {}, split).ok())
                QVERIFY(longest(cut) >= longest(cuts->front()) - 1e-12);
        }
        QVERIFY(track::proposeCuts(track, {}, {}, makeSpace(400, 400, 400)).value().empty());
    }

    void cutsAvoidBoltsWhereTheyCan() {
        const Track track = readExample("cuboid_track");
        PrintOptions options = makeOptions(0.0, true);
        options.boltDiameter = 0.0;
        const int free = track::proposeCuts(track, options, {}, makeSpace(250, 210, 220)).value().front();
        options.boltDiameter = 11 * kMm;
        const double needed = 5.5 * kMm + SplitOptions{}.dowelWall;
        const auto distanceToBolt = [&](int section) {
            double least = 1.0;
            for (const base::Vec2& bolt : track::placeBolts(track, options))
                least =
                    std::min(least, std::abs(bolt.x() - track.sections[static_cast<std::size_t>(section)].x));
            return least;
        };
        int evaded = 0;
        for (int spacing = 12; spacing < 250 && evaded < 3; ++spacing) {
            options.boltSpacing = spacing * kMm;
            if (distanceToBolt(free) >= needed) continue;
            const auto cuts = track::proposeCuts(track, options, {}, makeSpace(250, 210, 220));
            QVERIFY(cuts.ok() && cuts->size() == 1);
            QVERIFY(cuts->front() != free || spacing < 30);
            if (cuts->front() == free) continue;  // bolts so close that every section is near one
            QVERIFY(distanceToBolt(cuts->front()) >= needed);
            ++evaded;
        }
        QVERIFY(evaded > 0);
    }

    void whatCannotBeDoneIsTold_data() {
        QTest::addColumn<QString>("option");
        QTest::addColumn<QString>("word");
        QTest::newRow("order") << "cuts"
                               << "ascending";
        QTest::newRow("last") << "cuts"
                              << "section";
        QTest::newRow("thick") << "dowelDiameter"
                               << "no room";
        QTest::newRow("negative") << "dowelDiameter"
                                  << "at least 0";
        QTest::newRow("deep") << "dowelDepth"
                              << "meet";
        QTest::newRow("not a number") << "dowelClearance"
                                      << "at least 0";
    }

    void whatCannotBeDoneIsTold() {
        QFETCH(QString, option);
        QFETCH(QString, word);
        const Track track = readExample("cuboid_track");
        SplitOptions split;
        split.cuts = {2};
        const QString row = QTest::currentDataTag();
        if (row == "order") split.cuts = {3, 2};
        if (row == "last") split.cuts = {static_cast<int>(track.sections.size()) - 1};
        if (row == "thick") split.dowelDiameter = 40 * kMm;
        if (row == "negative") split.dowelDiameter = -1 * kMm;
        if (row == "not a number") split.dowelClearance = NAN;
        if (row == "deep") {
            split.cuts = {1, 2};
            split.dowelDepth = 20 * kMm;
            split.dowelDiameter = 1 * kMm;
        }
        const auto pieces = track::buildPrintPieces(track, {}, split);
        QVERIFY(!pieces.ok());
        QCOMPARE(QString::fromStdString(pieces.error().option), option);
        QVERIFY2(pieces.error().message.find(word.toStdString()) != std::string::npos,
                 pieces.error().message.c_str());
    }

    void whatNoCutHelpsIsTold() {
        const Track track = readExample("cuboid_track");
        const auto high = track::proposeCuts(track, {}, {}, makeSpace(250, 210, 20));
        QVERIFY(!high.ok());
        QVERIFY(high.error().message.find("high") != std::string::npos);
        const auto small = track::proposeCuts(track, {}, {}, makeSpace(60, 50, 200));
        QVERIFY(!small.ok());
        QVERIFY(small.error().message.find("too large for a bed of 60 x 50 mm") != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(PrintPiecesTest)
#include "print_pieces_test.moc"
