#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <fstream>

#include "core/part/bundled.h"
#include "core/study/presets.h"
#include "core/study/track_design.h"
#include "ui/session/part_import.h"
#include "ui/session/track_build.h"

using namespace trapwright;
using namespace trapwright::session;

/// Parts and tracks in the background.
class PartImportTest : public QObject {
    Q_OBJECT

 private slots:
    void partComesWithItsReport() {
        PartImport import;
        QSignalSpy failed(&import, &PartImport::failed);
        QSignalSpy stages(&import, &PartImport::stageChanged);
        std::vector<ImportedPart> parts;
        connect(&import, &PartImport::finished, this,
                [&](const ImportedPart& part) { parts.push_back(part); });
        import.start({"cuboid"});
        QVERIFY(import.busy());
        QTRY_COMPARE(parts.size(), std::size_t{1});
        QVERIFY(!import.busy());
        QVERIFY(stages.count() >= 3);
        QCOMPARE(stages.front().front().toString(), QString("reading the file"));
        const ImportedPart& part = parts.front();
        QVERIFY(part.bundled);
        QCOMPARE(part.settings.file, std::string("cuboid"));
        QCOMPARE(part.part->symmetry.name, std::string("D2"));
        QVERIFY(part.found.isSolid());
        QCOMPARE(part.candidates.size(), std::size_t{6});
        for (const workflow::UnitCandidate& candidate : part.candidates)
            if (candidate.name == "inch") QVERIFY(qAbs(candidate.size.maxCoeff() - 12 * 0.0254) < 1e-6);
        QCOMPARE(failed.count(), 0);
    }

    void newestRequestWins() {
        PartImport import;
        std::vector<std::string> names;
        connect(&import, &PartImport::finished, this,
                [&](const ImportedPart& part) { names.push_back(part.part->name); });
        for (const char* name : {"cuboid", "cone", "bracket", "pin"})
            import.start({name});
        QTRY_VERIFY(!import.busy());
        QCOMPARE(names, std::vector<std::string>{"pin"});
        import.start({"cup"});
        import.cancel();
        QTest::qWait(200);
        QCOMPARE(names.size(), std::size_t{1});
    }

    void badFilesAreMessages_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("content");
        QTest::addColumn<QString>("message");
        QTest::newRow("missing") << "" << QByteArray() << "does not exist";
        QTest::newRow("empty") << "a.stl" << QByteArray() << "empty";
        QTest::newRow("text") << "a.stl" << QByteArray("hello, I am no mesh at all") << "a.stl";
        QTest::newRow("unknown kind") << "a.doc" << QByteArray("x") << "not supported";
        QTest::newRow("flat") << "a.obj" << QByteArray("v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\nf 1 3 2\n")
                              << "a.obj";
    }

    void badFilesAreMessages() {
        QFETCH(QString, name);
        QFETCH(QByteArray, content);
        QFETCH(QString, message);
        const std::filesystem::path file = write(name.isEmpty() ? "b.stl" : name, content);
        if (name.isEmpty()) std::filesystem::remove(file);
        PartImport import;
        QSignalSpy failed(&import, &PartImport::failed);
        QSignalSpy finished(&import, &PartImport::finished);
        import.start({file.string()});
        QTRY_COMPARE(failed.count(), 1);
        QVERIFY2(failed[0][1].toString().contains(message), qPrintable(failed[0][1].toString()));
        QCOMPARE(finished.count(), 0);
    }

    void missingUnitIsAsked() {
        // 3000 of a unit that nobody named: no part of a feeder in millimetres.
        const std::filesystem::path file = write("big.obj", box(3000.0, {}));
        PartImport import;
        std::vector<workflow::UnitCandidate> asked;
        connect(&import, &PartImport::unitNeeded, this,
                [&](const workflow::PartRequest&, const std::vector<workflow::UnitCandidate>& candidates) {
                    asked = candidates;
                });
        QSignalSpy failed(&import, &PartImport::failed);
        QSignalSpy finished(&import, &PartImport::finished);
        import.start({file.string()});
        QTRY_COMPARE(asked.size(), std::size_t{6});
        QCOMPARE(asked.front().name, std::string("um"));
        QVERIFY(qAbs(asked.front().size.x() - 3e-3) < 1e-12);
        import.start({file.string(), "um"});
        QTRY_COMPARE(finished.count(), 1);
        QCOMPARE(failed.count(), 0);
    }

    void largeHoleIsOfferedToBeClosed() {
        // A box without its lid, which is a hole as large as the part.
        const std::filesystem::path file = write("open.obj", box(10.0, {4, 5}));
        PartImport import;
        QSignalSpy offered(&import, &PartImport::repairNeeded);
        geometry::MeshReport found;
        connect(&import, &PartImport::repairNeeded, this,
                [&](const workflow::PartRequest&, const geometry::MeshReport& report) { found = report; });
        std::vector<ImportedPart> parts;
        connect(&import, &PartImport::finished, this,
                [&](const ImportedPart& part) { parts.push_back(part); });
        workflow::PartRequest request{file.string(), "mm"};
        import.start(request);
        QTRY_COMPARE(offered.count(), 1);
        QCOMPARE(found.holes.size(), std::size_t{1});
        QVERIFY(qAbs(found.holes[0].perimeter - 40e-3) < 1e-9);
        request.closeLargeHoles = true;
        import.start(request);
        QTRY_COMPARE(parts.size(), std::size_t{1});
        QVERIFY(qAbs(parts[0].part->massProperties.volume - 1e-6) < 1e-12);
        // What the study keeps must give the same part without being asked again.
        const auto again = part::buildPart(parts[0].stored.mesh, parts[0].stored.options);
        QVERIFY(again.ok());
        QCOMPARE(again->part.mesh.triangles.size(), parts[0].part->mesh.triangles.size());
    }

    void tracksAreBuilt() {
        const study::Settings settings = study::presetSettings("cuboid").value();
        TrackBuild build;
        std::vector<std::shared_ptr<const track::Track>> tracks;
        connect(&build, &TrackBuild::built, this,
                [&](const std::shared_ptr<const track::Track>& track) { tracks.push_back(track); });
        QSignalSpy failed(&build, &TrackBuild::failed);
        for (int i = 0; i < 20; ++i)
            build.buildLayout(settings.track);
        QTRY_VERIFY(!tracks.empty());
        QTest::qWait(50);
        QCOMPARE(tracks.size(), std::size_t{1});
        const track::Track& layout = *tracks.front();
        QCOMPARE(layout.lastTrapSection - layout.firstTrapSection, settings.track.crossSections);
        for (const track::CrossSection& section : layout.sections)
            for (const base::Vec2& point : section.points)
                QCOMPARE(point.y(), 0.5 * settings.track.segmentHeight);
        study::TrackSettings bad = settings.track;
        bad.crossSections = 0;
        build.buildLayout(bad);
        QTRY_COMPARE(failed.count(), 1);
        build.buildIndividual(settings.track, {});
        QTRY_COMPARE(failed.count(), 2);
        QCOMPARE(tracks.size(), std::size_t{1});
    }

 private:
    std::filesystem::path write(const QString& name, const QByteArray& content) {
        std::filesystem::path file = std::filesystem::path(folder_.path().toStdString()) / name.toStdString();
        std::ofstream(file, std::ios::binary) << content.toStdString();
        return file;
    }

    /// A cube of that edge as OBJ, without the triangles of these numbers.
    static QByteArray box(double edge, const std::vector<int>& without) {
        QByteArray text;
        for (int i = 0; i < 8; ++i)
            text += QString("v %1 %2 %3\n")
                        .arg(edge * (i & 1))
                        .arg(edge * (i >> 1 & 1))
                        .arg(edge * (i >> 2))
                        .toUtf8();
        const int corners[12][3] = {{1, 3, 2}, {2, 3, 4}, {1, 2, 5}, {2, 6, 5}, {5, 6, 7}, {6, 8, 7},
                                    {3, 7, 4}, {4, 7, 8}, {1, 5, 3}, {3, 5, 7}, {2, 4, 6}, {4, 8, 6}};
        for (int t = 0; t < 12; ++t)
            if (std::find(without.begin(), without.end(), t) == without.end())
                text +=
                    QString("f %1 %2 %3\n").arg(corners[t][0]).arg(corners[t][1]).arg(corners[t][2]).toUtf8();
        return text;
    }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(PartImportTest)
#include "part_import_test.moc"
