#include "core/trial/finish.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/track/track_builder.h"

using namespace trapwright;

namespace {

constexpr double kLine = 1e-4;  // heights are compared on lines so far apart [m]

/// A box of 4 x 8 x 12 mm.
part::Part makeCuboid() {
    part::Part part;
    for (const double x : {-2e-3, 2e-3})
        for (const double y : {-4e-3, 4e-3})
            for (const double z : {-6e-3, 6e-3})
                part.mesh.vertices.emplace_back(x, y, z);
    // By bits of the index: each face as two triangles; which way round does not matter here.
    for (const std::array<int, 4>& f :
         {std::array{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
        part.mesh.triangles.push_back({f[0], f[1], f[2]});
        part.mesh.triangles.push_back({f[0], f[2], f[3]});
    }
    return part;
}

track::Track makeTrack(const track::FeederShape& shape, const std::vector<base::Vec2>& points) {
    track::TrackParameters parameters;
    parameters.shape = shape;
    return *track::buildTrack(parameters, std::vector{track::CrossSection{20e-3, points}});
}

}  // namespace

class FinishTest : public QObject {
    Q_OBJECT

    static void addShapes() {
        QTest::addColumn<int>("shape");
        QTest::newRow("linear") << 0;
        QTest::newRow("clockwise") << 1;
        QTest::newRow("anticlockwise") << 2;
        QTest::newRow("clockwise, climbs") << 3;
    }
    static track::FeederShape shapeOf(int index) {
        if (index == 0) return {};
        return {track::FeederType::bowl, 0.175,
                index == 2 ? track::Conveying::anticlockwise : track::Conveying::clockwise,
                index == 3 ? 4.0 * base::kDegree : 0.0};
    }

 private slots:
    void liesInTheMiddleOfAFlat_data() { addShapes(); }
    void liesInTheMiddleOfAFlat() {
        QFETCH(int, shape);
        const track::Track track =
            makeTrack(shapeOf(shape), {base::Vec2(-30e-3, 5e-3), base::Vec2(30e-3, 5e-3)});
        const base::Quaternion wanted(Eigen::AngleAxisd(0.5 * base::kPi, base::Vec3::UnitX()));
        const base::Pose pose = trial::findFinishPose(track, makeCuboid(), wanted);
        const base::Vec3 place = track.shape.toTrack(pose.position, track.finish);
        QVERIFY(std::abs(place.x() - track.finish) < 1e-9);
        QVERIFY(std::abs(place.y()) <= kLine);
        // On a track that climbs heights are upright, and the part stands across it.
        const double lean = shape == 3 ? std::cos(4.0 * base::kDegree) : 1.0;
        QVERIFY(std::abs(place.z() - 5e-3 - 4e-3 / lean) < 1e-9);
        const base::Quaternion inTrack =
            base::Quaternion(track.shape.tangentFrame(track.finish)).conjugate() * pose.rotation;
        QVERIFY(inTrack.angularDistance(wanted) < 1e-9);
    }

    // In a V of 45 degrees a box on its edge touches both flanks: the edge lies in the bottom.
    void liesInTheBottomOfAValley_data() { addShapes(); }
    void liesInTheBottomOfAValley() {
        QFETCH(int, shape);
        const track::Track track = makeTrack(
            shapeOf(shape), {base::Vec2(-30e-3, 40e-3), base::Vec2(10e-3, 0.0), base::Vec2(30e-3, 20e-3)});
        const base::Quaternion turned(Eigen::AngleAxisd(0.25 * base::kPi, base::Vec3::UnitX()));
        const part::Part part = makeCuboid();
        const base::Pose pose = trial::findFinishPose(track, part, turned);
        if (shape == 3) return;  // two corners of the edge are above a helix, as it is nowhere flat
        double lowest = 1.0;
        double across = 0.0;
        for (const base::Vec3& vertex : part.mesh.vertices) {
            const base::Vec3 place = track.shape.toTrack(pose.apply(vertex), track.finish);
            if (place.z() >= lowest) continue;
            lowest = place.z();
            across = place.y();
        }
        QVERIFY2(std::abs(across - 10e-3) <= 2 * kLine, qPrintable(QString::number(across)));
        QVERIFY2(std::abs(lowest) <= 2 * kLine, qPrintable(QString::number(lowest)));
    }

    void noPointIsBelowTheSurface() {
        const track::Track track =
            makeTrack({}, {base::Vec2(-30e-3, 10e-3), base::Vec2(-5e-3, 2e-3), base::Vec2(0.0, 6e-3),
                           base::Vec2(12e-3, 1e-3), base::Vec2(30e-3, 15e-3)});
        const auto& points = track.sections[static_cast<std::size_t>(track.lastTrapSection)].points;
        const part::Part part = makeCuboid();
        base::Random random({.seed = 5});
        for (int i = 0; i < 50; ++i) {
            const base::Pose pose = trial::findFinishPose(track, part, random.rotation());
            double least = 1.0;
            for (const base::Vec3& vertex : part.mesh.vertices) {
                const base::Vec3 place = pose.apply(vertex);
                for (std::size_t k = 0; k + 1 < points.size(); ++k) {
                    if (place.y() < points[k].x() || place.y() > points[k + 1].x()) continue;
                    const double share = (place.y() - points[k].x()) / (points[k + 1].x() - points[k].x());
                    least = std::min(least,
                                     place.z() - points[k].y() - share * (points[k + 1].y() - points[k].y()));
                }
            }
            QVERIFY2(least > -kLine, qPrintable(QString::number(least)));
        }
    }
};

QTEST_APPLESS_MAIN(FinishTest)
#include "finish_test.moc"
