#include "core/trial/start.h"

#include <QtTest>
#include <algorithm>
#include <vector>

#include "core/track/track_builder.h"

using namespace trapwright;

namespace {

part::Part makeCuboid() {
    part::Part part;
    for (const double x : {-2e-3, 2e-3}) {
        for (const double y : {-4e-3, 4e-3}) {
            for (const double z : {-6e-3, 6e-3})
                part.hull.vertices.emplace_back(x, y, z);
        }
    }
    return part;
}

track::Track makeTrack(const track::FeederShape& shape) {
    track::TrackParameters parameters;
    parameters.shape = shape;
    const track::CrossSection section{20e-3, {base::Vec2(-30e-3, 30e-3), base::Vec2(30e-3, 0.0)}};
    return *track::buildTrack(parameters, std::vector{section});
}

base::StreamKey keyOf(std::uint32_t trial) {
    return {1, 0, 0, trial, base::Purpose::trialStart};
}

// The part's rotation in the tangent frame.
base::Quaternion inTrack(const track::Track& track, const trial::PartStart& start) {
    return base::Quaternion(track.shape.tangentFrame(track.start)).conjugate() * start.pose.rotation;
}

/// The highest of the surface's triangles at (x, y) of the room. [m]
double heightAt(const track::Track& track, double x, double y) {
    double highest = -1.0;
    for (std::size_t t = 0; t < track.surfaceTriangles; ++t) {
        const geometry::Triangle& triangle = track.solid.triangles[t];
        const base::Vec3& a = track.solid.vertices[static_cast<std::size_t>(triangle[0])];
        base::Mat3 sides;
        sides.col(0) = track.solid.vertices[static_cast<std::size_t>(triangle[1])] - a;
        sides.col(1) = track.solid.vertices[static_cast<std::size_t>(triangle[2])] - a;
        sides.col(2) = base::Vec3::UnitZ();
        const base::Vec3 place = sides.inverse() * (base::Vec3(x, y, 0.0) - a);
        if (place.x() > -1e-9 && place.y() > -1e-9 && place.x() + place.y() < 1.0 + 1e-9)
            highest = std::max(highest, -place.z());
    }
    return highest;
}

}  // namespace

class StartTest : public QObject {
    Q_OBJECT

    static void addShapes() {
        QTest::addColumn<int>("shape");
        QTest::newRow("linear") << 0;
        QTest::newRow("clockwise") << 1;
        QTest::newRow("anticlockwise") << 2;
        QTest::newRow("linear, climbs") << 3;
        QTest::newRow("clockwise, climbs") << 4;
        QTest::newRow("anticlockwise, falls") << 5;
    }
    static track::FeederShape shapeOf(int index) {
        constexpr double kSlope = 4.0 * base::kDegree;
        switch (index) {
            case 1:
                return {track::FeederType::bowl, 0.175, track::Conveying::clockwise};
            case 2:
                return {track::FeederType::bowl, 0.175, track::Conveying::anticlockwise};
            case 3:
                return {track::FeederType::linear, 0.175, {}, kSlope};
            case 4:
                return {track::FeederType::bowl, 0.175, track::Conveying::clockwise, kSlope};
            case 5:
                return {track::FeederType::bowl, 0.175, track::Conveying::anticlockwise, -kSlope};
            default:
                return {};
        }
    }

 private slots:
    void liesOnTheLeadIn_data() { addShapes(); }
    void liesOnTheLeadIn() {
        QFETCH(int, shape);
        const track::Track track = makeTrack(shapeOf(shape));
        const part::Part part = makeCuboid();
        for (std::uint32_t i = 0; i < 200; ++i) {
            const auto trial = trial::drawTrial(track, part, {}, keyOf(i));
            QVERIFY(trial.stream == keyOf(i));
            QCOMPARE(trial.parts.size(), std::size_t{1});
            const trial::PartStart& start = trial.parts[0];
            QCOMPARE(start.part, std::size_t{0});
            QCOMPARE(start.time, 0.0);
            const base::Vec3 place = track.shape.toTrack(start.pose.position, track.start);
            QVERIFY(std::abs(place.x() - 60e-3) < 1e-12);
            QVERIFY(std::abs(place.y()) <= 2e-3 + 1e-12);
            double lowest = 1.0;
            for (const auto& vertex : part.hull.vertices) {
                const base::Vec3 corner = track.shape.toTrack(start.pose.apply(vertex), track.start);
                lowest = std::min(lowest, corner.z());
            }
            // A climbing bowl's facets stand out of its helix: a quarter of their width (60 mm) times 5 deg.
            const bool climbs = shape > 3;
            const double facets = climbs ? 15e-3 * 5.0 * base::kDegree * std::tan(4.0 * base::kDegree) : 0.0;
            QVERIFY(std::abs(lowest - 15e-3 - 1e-5 - facets) < 1e-12);
            QVERIFY(std::abs(start.pose.rotation.norm() - 1.0) < 1e-14);
            QVERIFY(trial.phase >= 0.0 && trial.phase < 2.0 * base::kPi);
            QCOMPARE(start.velocity, base::Vec3(base::Vec3::Zero()));
        }
    }

    // Above the mesh itself, too: no corner is in the solid, and all lie near it.
    void nothingIsInAClimbingTrack() {
        for (const int shape : {4, 5}) {
            const track::Track track = makeTrack(shapeOf(shape));
            const part::Part part = makeCuboid();
            trial::StartPolicy policy;
            policy.nearPose = base::Quaternion::Identity();
            for (std::uint32_t i = 0; i < 100; ++i) {
                const auto start = trial::drawTrial(track, part, policy, keyOf(i)).parts[0];
                double least = 1.0;
                for (const auto& vertex : part.hull.vertices) {
                    const base::Vec3 corner = start.pose.apply(vertex);
                    least = std::min(least, corner.z() - heightAt(track, corner.x(), corner.y()));
                }
                QVERIFY2(least > 0.0 && least < 0.25e-3, qPrintable(QString::number(least)));
            }
        }
    }

    // Turned with the ledge, above it and beside the wall, whichever way it was drawn.
    void liesOnASpiral_data() { addShapes(); }
    void liesOnASpiral() {
        QFETCH(int, shape);
        track::TrackParameters parameters;
        parameters.shape = shapeOf(shape);
        parameters.spiral = {14e-3, 10e-3, 8.0 * base::kDegree};
        const track::CrossSection section{
            20e-3, {{-30e-3, 30e-3}, {-10e-3, 20e-3}, {0.0, 10e-3}, {10e-3, 10e-3}, {30e-3, 0.0}}};
        const track::Track track = track::buildTrack(parameters, std::vector{section}).value();
        const part::Part part = makeCuboid();
        const double fall = std::tan(8.0 * base::kDegree);
        trial::StartPolicy policy;
        policy.nearPose = base::Quaternion::Identity();
        policy.tilt = 0.0;
        int moved = 0;
        for (std::uint32_t i = 0; i < 200; ++i) {
            const auto start = trial::drawTrial(track, part, policy, keyOf(i)).parts[0];
            // Its lower side lies on the ledge: upright across it, but for the bend of a climbing bowl.
            const base::Vec3 up = track.shape.tangentFrame(track.start).transpose() *
                                  (start.pose.rotation * base::Vec3::UnitZ());
            const bool isInward = shape == 2 || shape == 5;
            QVERIFY(std::abs(up.y() - (isInward ? -1.0 : 1.0) * std::sin(8.0 * base::kDegree)) < 1e-12);
            double least = 1.0;
            double outermost = -1.0;
            for (const auto& vertex : part.hull.vertices) {
                const base::Vec3 corner = track.shape.toTrack(start.pose.apply(vertex), track.start);
                least = std::min(least, corner.z() - (15e-3 - fall * corner.y()));
                outermost = std::max(outermost, corner.y());
            }
            QVERIFY2(least > 0.0 && least < 0.1e-3, qPrintable(QString::number(least)));
            QVERIFY2(outermost < 7e-3, qPrintable(QString::number(outermost)));
            if (outermost > 7e-3 - 1.1e-5) ++moved;
        }
        // A cuboid that reaches 4.5 mm to the side, 2 mm beside the middle, would stand on the wall's foot.
        QVERIFY(moved > 0 && moved < 100);
    }

    void dependsOnTheStreamAlone() {
        const track::Track track = makeTrack({});
        const part::Part part = makeCuboid();
        const auto a = trial::drawTrial(track, part, {}, keyOf(7));
        const auto b = trial::drawTrial(track, part, {}, keyOf(7));
        const auto c = trial::drawTrial(track, part, {}, keyOf(8));
        QVERIFY(a.parts[0].pose == b.parts[0].pose && a.phase == b.phase);
        QVERIFY(!(a.parts[0].pose == c.parts[0].pose) && a.phase != c.phase);
    }

    // Of uniform rotations, the cosine of any axis with the vertical is uniform: mean 0, variance 1/3.
    void learningStartsAnyhow() {
        const track::Track track = makeTrack({});
        const part::Part part = makeCuboid();
        constexpr int kDraws = 4000;
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint32_t i = 0; i < kDraws; ++i) {
            const auto start = trial::drawTrial(track, part, {}, keyOf(i)).parts[0];
            const double cosine = (start.pose.rotation * base::Vec3::UnitX()).z();
            sum += cosine;
            squares += cosine * cosine;
        }
        QVERIFY(std::abs(sum / kDraws) < 4.0 * std::sqrt(1.0 / 3.0 / kDraws));
        QVERIFY(std::abs(squares / kDraws - 1.0 / 3.0) < 4.0 * std::sqrt(4.0 / 45.0 / kDraws));
    }

    void validationStartsNearThePose_data() { addShapes(); }
    void validationStartsNearThePose() {
        QFETCH(int, shape);
        const track::Track track = makeTrack(shapeOf(shape));
        const part::Part part = makeCuboid();
        trial::StartPolicy policy;
        policy.nearPose = base::Quaternion(Eigen::AngleAxisd(0.5 * base::kPi, base::Vec3::UnitY()));
        policy.tilt = 3.0 * base::kDegree;
        const base::Vec3 up = policy.nearPose->conjugate() * base::Vec3::UnitZ();
        constexpr int kDraws = 4000;
        double squares = 0.0;
        base::Vec2 heading = base::Vec2::Zero();
        for (std::uint32_t i = 0; i < kDraws; ++i) {
            const base::Quaternion q =
                inTrack(track, trial::drawTrial(track, part, policy, keyOf(i)).parts[0]);
            const double tilt = std::acos(std::min(1.0, (q * up).z()));
            squares += tilt * tilt;
            heading += (q * base::Vec3::UnitZ()).head<2>();
        }
        // The squared tilt is chi-squared with two degrees of freedom: mean 2 s^2, variance 4 s^4.
        const double s2 = policy.tilt * policy.tilt;
        QVERIFY(std::abs(squares / kDraws / s2 - 2.0) < 4.0 * 2.0 / std::sqrt(kDraws));
        QVERIFY((heading / kDraws).norm() < 4.0 / std::sqrt(kDraws));
    }

    void withoutTiltItIsThePose() {
        const track::Track track = makeTrack({});
        trial::StartPolicy policy;
        policy.nearPose = base::Quaternion::Identity();
        policy.tilt = 0.0;
        policy.lateral = 0.0;
        const auto start = trial::drawTrial(track, makeCuboid(), policy, keyOf(3)).parts[0];
        QVERIFY(std::abs((start.pose.rotation * base::Vec3::UnitZ()).z() - 1.0) < 1e-15);
        QVERIFY((start.pose.position - base::Vec3(60e-3, 0.0, 15e-3 + 1e-5 + 6e-3)).norm() < 1e-15);
    }
};

QTEST_APPLESS_MAIN(StartTest)
#include "start_test.moc"
