#include "core/workflow/part_source.h"

#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <fstream>

using namespace trapwright;
using workflow::FailureKind;

/// Parts by name and from files, and why they cannot be had.
class PartSourceTest : public QObject {
    Q_OBJECT

 private slots:
    void bundledPartHasItsMaterial() {
        const auto part = workflow::importPart({"cone"});
        QVERIFY(part.ok());
        QVERIFY(part->bundled);
        QCOMPARE(part->settings.file, std::string("cone"));
        QCOMPARE(part->settings.units, std::string("mm"));
        QVERIFY(part->settings.density > 8000.0);  // brass
        workflow::PartRequest request{"cone"};
        request.material = "ABS";
        QVERIFY(workflow::importPart(request)->settings.density < 1100.0);
        request.density = 2000.0;
        request.tolerance = 0.05;
        const auto own = workflow::importPart(request);
        QCOMPARE(own->settings.density, 2000.0);
        QCOMPARE(own->part->density, 2000.0);
        QCOMPARE(own->stored.options.symmetryTolerance, 0.05);
    }

    void fileHasTheDefaultDensity() {
        workflow::PartRequest request{tetrahedron("tetra.obj", 10.0), "mm"};
        request.defaultDensity = 1234.0;
        const auto part = workflow::importPart(request);
        QVERIFY2(part.ok(), part.ok() ? "" : part.error().failure.message.c_str());
        QVERIFY(!part->bundled && !part->unitsFromFile);
        QCOMPARE(part->settings.density, 1234.0);
        QCOMPARE(part->stored.options.name, std::string("tetra"));
        QCOMPARE(part->candidates.size(), std::size_t{6});
        for (const workflow::UnitCandidate& candidate : part->candidates)
            if (candidate.name == "cm") QVERIFY(qAbs(candidate.size.x() - 0.1) < 1e-12);
    }

    void failuresTellTheirKind() {
        workflow::PartRequest request{"cube-of-nobody"};
        QCOMPARE(workflow::importPart(request).error().failure.kind, FailureKind::reading);
        request = {"cuboid"};
        request.material = "unobtainium";
        const auto material = workflow::importPart(request);
        QCOMPARE(material.error().failure.kind, FailureKind::settings);
        QVERIFY(material.error().failure.message.find("ABS") != std::string::npos);
        QVERIFY(material.error().candidates.empty() && !material.error().mendable);
        QCOMPARE(workflow::importPart({"none.stl"}).error().failure.kind, FailureKind::reading);
    }

    void unitThatIsMissingIsToBeChosen() {
        const auto far = workflow::importPart({tetrahedron("far.obj", 5000.0)});
        QVERIFY(!far.ok());
        QCOMPARE(far.error().candidates.size(), std::size_t{6});
        QVERIFY(workflow::importPart({tetrahedron("far.obj", 5000.0), "um"}).ok());
        // A unit that was given is not asked for.
        QVERIFY(workflow::importPart({tetrahedron("far.obj", 5000.0), "parsec"}).error().candidates.empty());
    }

    void largeHoleIsMendedOnRequest() {
        workflow::PartRequest request{tetrahedron("open.obj", 10.0, false), "mm"};
        const auto open = workflow::importPart(request);
        QVERIFY(!open.ok());
        QVERIFY(open.error().mendable);
        QCOMPARE(open.error().mendable->openEdges, 3);
        request.closeLargeHoles = true;
        const auto closed = workflow::importPart(request);
        QVERIFY(closed.ok());
        QVERIFY(qAbs(closed->part->massProperties.volume - 1e-6 / 6.0) < 1e-15);
        QCOMPARE(closed->found.holes.size(), std::size_t{1});
    }

 private:
    /// Three legs of that length at right angles.
    std::string tetrahedron(const std::string& name, double leg, bool closed = true) {
        const std::filesystem::path file = std::filesystem::path(folder_.path().toStdString()) / name;
        std::ofstream out(file);
        out << "v 0 0 0\nv " << leg << " 0 0\nv 0 " << leg << " 0\nv 0 0 " << leg << "\n";
        out << "f 1 3 2\nf 1 2 4\nf 1 4 3\n" << (closed ? "f 2 3 4\n" : "");
        return file.string();
    }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(PartSourceTest)
#include "part_source_test.moc"
