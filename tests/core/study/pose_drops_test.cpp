#include "core/study/pose_drops.h"

#include <QtTest>
#include <cmath>

#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "core/part/shapes.h"
#include "core/part/stable_poses.h"
#include "core/study/pose_weights.h"
#include "sim/native/native_engine.h"
#include "sim/simbody/simbody_engine.h"

using namespace trapwright;

namespace {

using SharedPart = std::shared_ptr<const part::Part>;

SharedPart build(const geometry::TriangleMesh& mesh, const char* name) {
    return std::make_shared<const part::Part>(
        part::buildPart(mesh, {.name = name, .density = 7850.0}).value().part);
}

/// A ring of `sides` flat facets about the z axis. [m]
geometry::TriangleMesh makeWasher(double outer, double inner, double height, int sides) {
    geometry::TriangleMesh mesh;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * base::kPi * i / sides;
        for (const auto& [radius, z] :
             {std::pair{outer, 0.0}, {outer, height}, {inner, 0.0}, {inner, height}})
            mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    const auto quad = [&](int a, int b, int c, int d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (int i = 0; i < sides; ++i) {
        const int here = 4 * i;
        const int next = 4 * ((i + 1) % sides);
        quad(here, next, next + 1, here + 1);          // outer face
        quad(next + 2, here + 2, here + 3, next + 3);  // bore
        quad(here + 1, next + 1, next + 3, here + 3);  // top
        quad(next, here, here + 2, next + 2);          // bottom
    }
    return mesh;
}

std::size_t findRim(const part::Part& part) {
    std::size_t rim = 0;
    for (std::size_t i = 0; i < part.stablePoses.size(); ++i)
        if (part.stablePoses[i].height > part.stablePoses[rim].height) rim = i;
    return rim;
}

study::DropSettings drops(int count) {
    study::DropSettings settings;
    settings.drops = count;
    return settings;
}

}  // namespace

class PoseDropsTest : public QObject {
    Q_OBJECT

    native::NativeEngine native_{{1, 0.0}};
    simbody::SimbodyEngine simbody_{{1, 0.0}};

 private slots:
    // An M4 washer: of all directions h / sqrt(h^2 + d^2) point through its rim, but hardly one stays there.
    void washerDoesNotStayOnItsRim() {
        constexpr double d = 9e-3;
        constexpr double h = 0.8e-3;
        const SharedPart washer = build(makeWasher(0.5 * d, 2.15e-3, h, 48), "washer");
        QCOMPARE(washer->stablePoses.size(), std::size_t{3});
        const std::size_t rim = findRim(*washer);
        const double estimate = washer->stablePoses[rim].probability;
        QVERIFY(std::abs(estimate - h / std::sqrt(h * h + d * d)) < 0.001);
        const study::DropSettings settings = drops(100);
        const auto result = study::simulateDrops(native_, washer, settings, 2, {});
        QVERIFY2(result.ok(), result ? "" : result.error().message.c_str());
        QCOMPARE(result->drops(), 100);
        const study::DropRecord record = study::makeDropRecord(*washer, settings, "native", *result);
        QVERIFY2(record.bounds(rim).high < estimate, qPrintable(QString::number(record.share(rim))));
        QVERIFY(result->unsettled <= 5);
        // Clopper and Pearson of none of 100: 1 - 0.025^(1 / 100).
        if (result->counts[rim] == 0)
            QVERIFY(std::abs(record.bounds(rim).high - (1.0 - std::pow(0.025, 0.01))) < 1e-9);
    }

    // No face of a cube can be told from another.
    void cubeHasNoFavourite() {
        const SharedPart cube = build(part::makeBox({8e-3, 8e-3, 8e-3}), "cube");
        const auto result = study::simulateDrops(native_, cube, drops(300), 2, {});
        QVERIFY(result.ok());
        QCOMPARE(result->counts.size(), std::size_t{6});
        QCOMPARE(result->unsettled, 0);
        for (const int count : result->counts) {
            const stats::Interval bounds = stats::calcClopperPearson(count, 300, 0.999);
            QVERIFY2(bounds.low < 1.0 / 6.0 && bounds.high > 1.0 / 6.0, qPrintable(QString::number(count)));
        }
    }

    // A sheet does not stand on its edges; its two faces are alike. A few land on an edge and rock there from
    // one corner of it to the other, which costs a slender block hardly any energy (Housner 1963): they do
    // not settle, or count as standing; which of both hangs on the last bits, so on the instruction set.
    void sheetLies() {
        const SharedPart sheet = build(part::makeBox({20e-3, 20e-3, 0.3e-3}), "sheet");
        const auto result = study::simulateDrops(native_, sheet, drops(100), 2, {});
        QVERIFY(result.ok());
        int flat = 0;
        for (std::size_t i = 0; i < result->counts.size(); ++i)
            if (sheet->stablePoses[i].height < 1e-3) flat += result->counts[i];
        QVERIFY2(flat >= 96, qPrintable(QString::number(flat)));
    }

    // No rolling resistance is simulated, so a rod rolls on and on: it lies all the same.
    void rollingRodCountsAsLying() {
        const base::Vec2 profile[] = {{0.0, -10e-3}, {2e-3, -10e-3}, {2e-3, 10e-3}, {0.0, 10e-3}};
        const SharedPart rod = build(part::makeTurned(profile, 64), "rod");
        const auto result = study::simulateDrops(native_, rod, drops(60), 2, {});
        QVERIFY(result.ok());
        int lying = 0;
        for (std::size_t i = 0; i < result->counts.size(); ++i)
            if (rod->stablePoses[i].height < 3e-3) lying += result->counts[i];
        QVERIFY2(lying >= 55, qPrintable(QString::number(lying)));
    }

    void dropIsTheSameWhateverIsDroppedWithIt() {
        const SharedPart cube = build(part::makeBox({4e-3, 8e-3, 12e-3}), "cuboid");
        const study::DropSettings settings = drops(20);
        const auto all = study::simulateDrops(native_, cube, settings, 3, {});
        auto some = study::simulateDrops(native_, cube, settings, 1, {}, 0, 7);
        const auto others = study::simulateDrops(native_, cube, settings, 2, {}, 7, 100);
        QVERIFY(all.ok() && some.ok() && others.ok());
        QCOMPARE(some->drops(), 7);
        some->add(*others);
        QVERIFY(*some == *all);
        study::DropSettings otherSeed = settings;
        otherSeed.seed = 2;
        QVERIFY(!(*study::simulateDrops(native_, cube, otherSeed, 2, {}) == *all));
    }

    void progressCountsDrops() {
        const SharedPart cube = build(part::makeBox({4e-3, 8e-3, 12e-3}), "cuboid");
        base::RunControl control;
        QVERIFY(study::simulateDrops(native_, cube, drops(12), 2, control).ok());
        QCOMPARE(control.done(), std::int64_t{12});
        control.cancel();
        QVERIFY(!study::simulateDrops(native_, cube, drops(12), 2, control).ok());
    }

    void badSettingsAreTold_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("height");
        QTest::addColumn<double>("restitution");
        QTest::addColumn<QString>("told");
        QTest::newRow("none") << 0 << 0.03 << 0.2 << "number of drops is 0";
        QTest::newRow("below") << 10 << -0.001 << 0.2 << "drop height is -1 mm";
        QTest::newRow("no number") << 10 << std::nan("") << 0.2 << "drop height";
        QTest::newRow("gains") << 10 << 0.03 << 1.2 << "restitution is 1.2";
    }

    void badSettingsAreTold() {
        QFETCH(int, count);
        QFETCH(double, height);
        QFETCH(double, restitution);
        QFETCH(QString, told);
        study::DropSettings settings = drops(count);
        settings.height = height;
        settings.contact.restitution = restitution;
        const SharedPart cube = build(part::makeBox({8e-3, 8e-3, 8e-3}), "cube");
        const auto result = study::simulateDrops(native_, cube, settings, 1, {});
        QVERIFY(!result.ok());
        const QString message = QString::fromStdString(result.error().message);
        QVERIFY2(message.contains(told), qPrintable(message));
    }

    void weightsAreThoseThatTheUserChose() {
        const SharedPart cuboid = build(part::makeBox({4e-3, 8e-3, 12e-3}), "cuboid");
        study::Settings settings;
        settings.part.droppedCounts = study::countsText({6, 4, 3, 3, 0, 0});
        QCOMPARE(settings.part.droppedCounts, std::string("6, 4, 3, 3, 0, 0"));
        const auto estimates = study::poseWeights(*cuboid, settings);
        for (std::size_t i = 0; i < 6; ++i)
            QVERIFY(std::abs(estimates[i] - cuboid->stablePoses[i].probability) < 1e-12);
        settings.part.poseWeights = study::PoseWeights::dropped;
        QVERIFY(study::weightsInForce(*cuboid, settings) == study::PoseWeights::dropped);
        QCOMPARE(study::poseWeights(*cuboid, settings),
                 (std::vector<double>{6.0 / 16, 4.0 / 16, 3.0 / 16, 3.0 / 16, 0.0, 0.0}));
        // The estimates stand in for what is not there, of another part, or tells nothing.
        for (const char* counts : {"", "1, 2, 3", "0, 0, 0, 0, 0, 0", "6, 4, 3, x, 0, 0"}) {
            settings.part.droppedCounts = counts;
            QVERIFY(study::weightsInForce(*cuboid, settings) == study::PoseWeights::quasiStatic);
            QCOMPARE(study::poseWeights(*cuboid, settings), estimates);
        }
        QVERIFY(!study::findProblems(settings).empty());
    }

    void countsAreReadAsTheyAreWritten() {
        for (const std::vector<int>& counts : {std::vector<int>{}, {7}, {0, 12, 2147483647}})
            QVERIFY(study::readCounts(study::countsText(counts)) == counts);
        for (const char* bad : {"1,", ",1", "1;2", "-1", "1.5", " "})
            QVERIFY2(!study::readCounts(bad), bad);
    }

    void recordHoldsForItsPosesAlone() {
        const SharedPart cuboid = build(part::makeBox({4e-3, 8e-3, 12e-3}), "cuboid");
        study::DropResult result;
        result.counts.resize(cuboid->stablePoses.size(), 1);
        const study::DropRecord record = study::makeDropRecord(*cuboid, drops(6), "native", result);
        QVERIFY(study::holdsFor(record, *cuboid));
        QVERIFY(!study::holdsFor(record, *build(part::makeBox({12e-3, 8e-3, 4e-3}), "turned")));
        QVERIFY(!study::holdsFor(record, *build(makeWasher(4e-3, 2e-3, 1e-3, 32), "washer")));
    }
};

QTEST_GUILESS_MAIN(PoseDropsTest)
#include "pose_drops_test.moc"
