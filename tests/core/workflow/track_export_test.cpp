#include "core/workflow/track_export.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/file.h"
#include "core/geometry/mesh_check.h"
#include "core/part/cad_export.h"
#include "core/track/print_pieces.h"
#include "tests/core/track/track_scenes.h"

using namespace trapwright;

namespace {

constexpr double kMm = base::kMillimetre;

track::TrackFile readExample(const std::string& name, const track::FeederShape& shape) {
    auto file =
        track::readTrackFile(std::string(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/" + name + ".json");
    if (!file) qFatal("%s", file.error().message.c_str());
    file->track = testing::bend(file->track, shape);
    return *file;
}

std::vector<geometry::TriangleMesh> cutInTwo(const track::Track& track, const track::PrintOptions& options) {
    track::SplitOptions split;
    split.cuts = {static_cast<int>(track.sections.size()) / 2};
    split.dowelDiameter = 2 * kMm;
    const auto pieces = track::buildPrintPieces(track, options, split);
    if (!pieces) qFatal("%s", pieces.error().message.c_str());
    std::vector<geometry::TriangleMesh> solids;
    for (const track::PrintPiece& piece : *pieces)
        solids.push_back(piece.solid);
    return solids;
}

}  // namespace

class TrackExportTest : public QObject {
    Q_OBJECT

 private slots:
    void tracksAreMachinable_data() {
        QTest::addColumn<QString>("track");
        QTest::addColumn<bool>("bowl");
        QTest::addColumn<bool>("mounted");
        for (const char* name : {"cuboid_track", "cone_track"}) {
            for (const bool bowl : {false, true}) {
                for (const bool mounted : {false, true})
                    QTest::addRow("%s, %s%s", name, bowl ? "bowl" : "linear", mounted ? ", mounted" : "")
                        << name << bowl << mounted;
            }
        }
    }

    void tracksAreMachinable() {
        QFETCH(QString, track);
        QFETCH(bool, bowl);
        QFETCH(bool, mounted);
        const track::TrackFile design =
            readExample(track.toStdString(),
                        bowl ? testing::makeBowl(track::Conveying::clockwise) : track::FeederShape{});
        track::PrintOptions options;
        options.flange = mounted;
        options.wallHeight = mounted ? 5 * kMm : 0.0;
        const geometry::TriangleMesh solid = track::buildPrintSolid(design.track, options).value();
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("track.step").toStdString();
        const auto files = workflow::exportTrack(design, {&solid, 1}, path);
        QVERIFY2(files.ok(), files.ok() ? "" : files.error().message.c_str());
        QCOMPARE(files->size(), 1U);

        const auto contents = part::inspectStep(path);
        QVERIFY(contents.ok());
        QVERIFY(contents->valid);
        QCOMPARE(contents->solids, 1);
        const double volume = geometry::checkMesh(solid).volume;
        QVERIFY2(std::abs(contents->volume / volume - 1.0) < 1e-6,
                 qPrintable(QString::number(contents->volume / volume - 1.0)));
        QVERIFY((contents->size - geometry::calcBoundingBox(solid).size()).norm() < 1e-9);
        // Faces, not a shell of triangles: base, ends and sides are one each, or one between two rows.
        QVERIFY(contents->faces < static_cast<int>(0.75 * static_cast<double>(solid.triangles.size())));
    }

    void piecesAreNumberedFilesOrObjects_data() {
        QTest::addColumn<QString>("format");
        QTest::addColumn<int>("count");
        QTest::newRow("STL") << "stl" << 2;
        QTest::newRow("STEP") << "step" << 2;
        QTest::newRow("3MF") << "3mf" << 1;
        QTest::newRow("JSON") << "json" << 1;
    }

    void piecesAreNumberedFilesOrObjects() {
        QFETCH(QString, format);
        QFETCH(int, count);
        const track::TrackFile design = readExample("cuboid_track", {});
        const auto solids = cutInTwo(design.track, {});
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("track." + format).toStdString();
        const auto files = workflow::exportTrack(design, solids, path);
        QVERIFY2(files.ok(), files.ok() ? "" : files.error().message.c_str());
        QCOMPARE(static_cast<int>(files->size()), count);
        double volume = 0.0;
        for (std::size_t i = 0; i < files->size(); ++i) {
            QVERIFY(std::filesystem::exists((*files)[i].path));
            volume += (*files)[i].volume;
            if (count == 2) {
                QCOMPARE((*files)[i].path.filename().string(),
                         "track-" + std::to_string(i + 1) + "-of-2." + format.toStdString());
            }
        }
        if (format == "3mf") QCOMPARE(files->front().solids, 2);
        if (format == "json") return;
        const double expected = geometry::checkMesh(solids[0]).volume + geometry::checkMesh(solids[1]).volume;
        QVERIFY(std::abs(volume / expected - 1.0) < 1e-5);
    }

    void whatIsNoSolidIsNotLeftThere() {
        const track::TrackFile design = readExample("cuboid_track", {});
        auto solids = cutInTwo(design.track, {});
        solids[1].triangles.pop_back();
        const QTemporaryDir folder;
        for (const char* name : {"track.stl", "track.step", "track.3mf"}) {
            const auto files = workflow::exportTrack(design, solids, folder.filePath(name).toStdString());
            QVERIFY(!files.ok());
            QVERIFY(std::filesystem::is_empty(folder.path().toStdString()));
        }
        // Nor do those go that were there.
        const std::vector<std::string> old = {"track.3mf", "track-1-of-2.stl", "track-1-of-2.step"};
        for (const std::string& name : old)
            QVERIFY(base::writeFile(std::filesystem::path(folder.path().toStdString()) / name, name).ok());
        for (const char* name : {"track.stl", "track.step", "track.3mf"}) {
            const auto files = workflow::exportTrack(design, solids, folder.filePath(name).toStdString());
            QVERIFY(!files.ok());
            QVERIFY2(QString::fromStdString(files.error().message).contains(folder.path() + "/track"),
                     files.error().message.c_str());
        }
        for (const std::string& name : old)
            QCOMPARE(base::readFile(std::filesystem::path(folder.path().toStdString()) / name).value(), name);
        QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::NoDotAndDotDot).size(), 3);
        const auto unknown =
            workflow::exportTrack(design, solids, folder.filePath("track.obj").toStdString());
        QVERIFY(!unknown.ok() && unknown.error().message.find(".step") != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(TrackExportTest)
#include "track_export_test.moc"
