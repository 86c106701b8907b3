#include "core/workflow/part_process.h"

#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

#include "core/part/bundled.h"

using namespace trapwright;
using workflow::FailureKind;

namespace {

bool same(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b) {
    return a.vertices == b.vertices && a.triangles == b.triangles;
}

bool same(const geometry::ConvexPolytope& a, const geometry::ConvexPolytope& b) {
    return a.vertices == b.vertices &&
           std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(),
                      [](const auto& x, const auto& y) {
                          return x.normal == y.normal && x.offset == y.offset && x.loop == y.loop;
                      }) &&
           std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(),
                      [](const auto& x, const auto& y) {
                          return x.from == y.from && x.to == y.to && x.left == y.left && x.right == y.right;
                      });
}

}  // namespace

/// What a process of its own imports is what this one would have imported, and no file ends this one.
class PartProcessTest : public QObject {
    Q_OBJECT

 private slots:
    void theSamePart_data() {
        QTest::addColumn<QString>("name");
        for (const part::BundledPart& part : part::listBundledParts())
            QTest::newRow(part.name.data()) << QString::fromUtf8(part.name.data());
        QTest::newRow("STEP") << QString(TRAPWRIGHT_SOURCE_DIR "/resources/parts/bracket.step");
    }

    void theSamePart() {
        QFETCH(QString, name);
        const workflow::PartRequest request{name.toStdString()};
        const auto here = workflow::importPart(request);
        std::vector<std::string> stages;
        const auto apart = workflow::importPartApart(
            request, {}, [&](std::string_view stage) { stages.emplace_back(stage); });
        QVERIFY2(apart.ok(), apart.ok() ? "" : apart.error().failure.message.c_str());
        QCOMPARE(stages.at(0), std::string("reading the file"));
        QVERIFY(stages.size() >= 3);

        QVERIFY(same(apart->stored.mesh, here->stored.mesh));
        QCOMPARE(apart->stored.options.name, here->stored.options.name);
        QCOMPARE(apart->stored.options.source, here->stored.options.source);
        QCOMPARE(apart->stored.options.density, here->stored.options.density);
        QCOMPARE(apart->stored.options.symmetryTolerance, here->stored.options.symmetryTolerance);
        QVERIFY(apart->stored.options.symmetry == here->stored.options.symmetry);
        QVERIFY(apart->settings == here->settings);
        QCOMPARE(apart->bundled, here->bundled);
        QCOMPARE(apart->unitsFromFile, here->unitsFromFile);
        QCOMPARE(apart->notes, here->notes);
        QCOMPARE(apart->candidates.size(), here->candidates.size());
        for (std::size_t i = 0; i < here->candidates.size(); ++i) {
            QCOMPARE(apart->candidates[i].name, here->candidates[i].name);
            QVERIFY(apart->candidates[i].size == here->candidates[i].size);
        }
        QCOMPARE(apart->found.shells, here->found.shells);
        QCOMPARE(apart->found.volume, here->found.volume);

        const part::Part& a = *apart->part;
        const part::Part& b = *here->part;
        QVERIFY(a.name == b.name && a.source == b.source && a.density == b.density);
        QVERIFY(same(a.mesh, b.mesh));
        QVERIFY(same(a.hull, b.hull));
        QVERIFY(std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(),
                           [](const auto& x, const auto& y) { return same(x, y); }));
        QCOMPARE(a.massProperties.mass, b.massProperties.mass);
        QCOMPARE(a.massProperties.volume, b.massProperties.volume);
        QCOMPARE(a.massProperties.area, b.massProperties.area);
        QVERIFY(a.massProperties.centre == b.massProperties.centre);
        QVERIFY(a.massProperties.inertia == b.massProperties.inertia);
        QCOMPARE(a.symmetry.name, b.symmetry.name);
        QVERIFY(a.symmetry.continuous == b.symmetry.continuous && a.symmetry.axis == b.symmetry.axis &&
                a.symmetry.flip == b.symmetry.flip && a.symmetry.sphere == b.symmetry.sphere);
        QVERIFY(std::equal(a.symmetry.rotations.begin(), a.symmetry.rotations.end(),
                           b.symmetry.rotations.begin(), b.symmetry.rotations.end(),
                           [](const auto& x, const auto& y) { return x.coeffs() == y.coeffs(); }));
        QVERIFY(std::equal(a.stablePoses.begin(), a.stablePoses.end(), b.stablePoses.begin(),
                           b.stablePoses.end(), [](const auto& x, const auto& y) {
                               return x.rotation.coeffs() == y.rotation.coeffs() && x.height == y.height &&
                                      x.probability == y.probability && x.multiplicity == y.multiplicity;
                           }));
        QCOMPARE(a.boundingRadius, b.boundingRadius);
    }

    void everyWishGoesWithIt() {
        workflow::PartRequest request{"cuboid"};
        request.material = "brass";
        request.tolerance = 0.02;
        request.symmetry = part::SymmetryUse::none;
        const auto apart = workflow::importPartApart(request);
        QVERIFY2(apart.ok(), apart.ok() ? "" : apart.error().failure.message.c_str());
        QCOMPARE(apart->settings.material, std::string("brass"));
        QCOMPARE(apart->settings.symmetryTolerance, 0.02);
        QCOMPARE(apart->part->symmetry.name, std::string("C1"));
        request.material = "unobtainium";
        const auto unknown = workflow::importPartApart(request);
        QVERIFY(unknown.error().failure.kind == FailureKind::settings);
        request = {"cuboid"};
        request.density = 1234.5;
        request.materialName = "mine";
        QCOMPARE(workflow::importPartApart(request)->settings.density, 1234.5);
        QCOMPARE(workflow::importPartApart(request)->settings.material, std::string("mine"));
    }

    void questionsComeBack() {
        const std::string open = write("open.obj",
                                       "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n"
                                       "f 1 3 2\nf 1 2 4\nf 2 3 4\n");
        const auto hole = workflow::importPartApart({open, "mm"});
        QVERIFY(!hole.ok() && hole.error().mendable);
        QCOMPARE(hole.error().mendable->openEdges, 3);
        QVERIFY(workflow::importPartApart({.part = open, .units = "mm", .closeLargeHoles = true}).ok());
        const std::string far = write("far.obj",
                                      "v 0 0 0\nv 5000 0 0\nv 0 5000 0\nv 0 0 5000\n"
                                      "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        QCOMPARE(workflow::importPartApart({far}).error().candidates.size(), std::size_t{6});
    }

    void limitsAreTold() {
        base::ChildLimits limits;
        limits.time = std::chrono::milliseconds(1);
        const auto late = workflow::importPartApart({"bolt"}, {}, {}, limits);
        QVERIFY(late.error().failure.kind == FailureKind::reading);
        QVERIFY2(late.error().failure.message.find("bolt was not imported within 0") == 0,
                 late.error().failure.message.c_str());
        const base::RunControl control;
        base::RunControl(control).cancel();
        const auto stopped = workflow::importPartApart({"bolt"}, control);
        QVERIFY(stopped.error().failure.kind == FailureKind::cancelled);
    }

 private:
    std::string write(const char* name, const std::string& text) {
        std::string path = folder_.filePath(name).toStdString();
        std::ofstream(path) << text;
        return path;
    }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(PartProcessTest)
#include "part_process_test.moc"
