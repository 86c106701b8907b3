#include "core/bench/bench_scenes.h"

#include <QtTest>
#include <algorithm>

#include "core/geometry/mesh_check.h"

using namespace trapwright;

class BenchScenesTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        auto scenes = bench::makeScenes();
        QVERIFY2(scenes.ok(), scenes.ok() ? "" : scenes.error().message.c_str());
        scenes_ = std::move(scenes).value();
    }

    void theyHaveTheirNames() {
        const std::vector<std::string> expected = {"cuboid flat",  "cuboid rough",  "cuboid learned",
                                                   "cone learned", "bracket rough", "bowl"};
        std::vector<std::string> names;
        for (const bench::Scene& scene : scenes_)
            names.push_back(scene.name);
        QVERIFY(names == expected);
    }

    void theyCanBeSimulated() {
        for (const bench::Scene& scene : scenes_) {
            QVERIFY2(geometry::checkMesh(scene.track->solid, true).isSolid(), scene.name.c_str());
            const trial::TrialBatch batch = bench::makeBatch(scene, 3);
            QVERIFY(!trial::findProblem(batch).has_value());
            QCOMPARE(batch.trials.size(), 3U);
            QVERIFY(batch.drive.halfStroke > 0.0);
        }
    }

    // Where the lead-in is not the highest place around, the part must be lifted over it.
    void partsStartAboveTheSurface() {
        for (const bench::Scene& scene : scenes_) {
            const trial::TrialBatch batch = bench::makeBatch(scene, 20);
            for (const trial::TrialSpec& trial : batch.trials) {
                double highest = -1.0;
                for (std::size_t t = 0; t < scene.track->surfaceTriangles; ++t) {
                    for (const int index : scene.track->solid.triangles[t]) {
                        const base::Vec3& corner = scene.track->solid.vertices[index];
                        // A triangle near the part: its corners may be a segment away.
                        if ((corner - trial.parts[0].pose.position).head<2>().norm() < 9e-3)
                            highest = std::max(highest, corner.z());
                    }
                }
                double lowest = 1.0;
                for (const base::Vec3& vertex : scene.part->hull.vertices)
                    lowest = std::min(lowest, trial.parts[0].pose.apply(vertex).z());
                QVERIFY2(lowest > highest, scene.name.c_str());
            }
        }
    }

    void theTrialsAreTheSameEveryTime() {
        for (const bench::Scene& scene : scenes_) {
            const trial::TrialBatch five = bench::makeBatch(scene, 5);
            const trial::TrialBatch two = bench::makeBatch(scene, 2);
            for (std::size_t i = 0; i < two.trials.size(); ++i)
                QVERIFY(two.trials[i].parts[0].pose == five.trials[i].parts[0].pose &&
                        two.trials[i].phase == five.trials[i].phase);
        }
    }

    void theBowlIsThePapers() {
        const track::FeederShape& shape = scenes_[5].track->shape;
        QVERIFY(shape.type == track::FeederType::bowl);
        QCOMPARE(shape.bowlRadius, 175e-3);
        QVERIFY(scenes_[5].expected.has_value());
    }

 private:
    std::vector<bench::Scene> scenes_;
};

QTEST_APPLESS_MAIN(BenchScenesTest)
#include "bench_scenes_test.moc"
