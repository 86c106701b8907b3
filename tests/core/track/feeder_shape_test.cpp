#include "core/track/feeder_shape.h"

#include <QtTest>

using namespace trapwright;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

Q_DECLARE_METATYPE(FeederShape)

class FeederShapeTest : public QObject {
    Q_OBJECT

    static void addShapes() {
        QTest::addColumn<FeederShape>("shape");
        QTest::newRow("linear") << FeederShape{};
        QTest::newRow("clockwise") << FeederShape{FeederType::bowl, 0.175, Conveying::clockwise};
        QTest::newRow("anticlockwise") << FeederShape{FeederType::bowl, 0.1, Conveying::anticlockwise};
        constexpr double kSlope = 5.0 * base::kDegree;
        QTest::newRow("linear, climbs") << FeederShape{FeederType::linear, 0.175, {}, kSlope};
        QTest::newRow("clockwise, climbs")
            << FeederShape{FeederType::bowl, 0.175, Conveying::clockwise, kSlope};
        QTest::newRow("anticlockwise, climbs")
            << FeederShape{FeederType::bowl, 0.1, Conveying::anticlockwise, kSlope};
        QTest::newRow("anticlockwise, falls")
            << FeederShape{FeederType::bowl, 0.1, Conveying::anticlockwise, -kSlope};
    }

 private slots:
    void linearIsTheRoom() {
        const base::Vec3 point(0.3, -0.02, 0.01);
        QCOMPARE(FeederShape{}.toRoom(point), point);
        QCOMPARE(FeederShape{}.tangentFrame(0.3), base::Mat3(base::Mat3::Identity()));
        // A tilted one is so in a room that is tilted with it.
        const FeederShape tilted{FeederType::linear, 0.175, {}, 0.1};
        QCOMPARE(tilted.toRoom(point), point);
        QCOMPARE(tilted.toTrack(point, 0.0), point);
        QCOMPARE(tilted.tangentFrame(0.3), base::Mat3(base::Mat3::Identity()));
    }

    // Where what is plumb leans back from the track that climbs, gravity pulls back along it.
    void gravityPullsDown() {
        QCOMPARE(FeederShape{}.down(), base::Vec3(0.0, 0.0, -1.0));
        const FeederShape tilted{FeederType::linear, 0.175, {}, 3.0 * base::kDegree};
        QVERIFY((tilted.down() - base::Vec3(-0.052335956242944, 0.0, -0.998629534754574)).norm() < 1e-15);
        QCOMPARE((FeederShape{FeederType::bowl, 0.175, {}, 0.1}.down()), base::Vec3(0.0, 0.0, -1.0));
    }

    // One turn of a helix rises by its pitch.
    void aBowlClimbsByItsPitch() {
        for (const Conveying conveying : {Conveying::clockwise, Conveying::anticlockwise}) {
            FeederShape shape{FeederType::bowl, 0.2, conveying};
            const double pitch = 0.05;
            shape.slope = std::atan(pitch / (2.0 * base::kPi * 0.2));
            const double turn = 2.0 * base::kPi * 0.2;
            QVERIFY(std::abs(shape.rise(turn) - pitch) < 1e-15);
            const base::Vec3 way = shape.toRoom({turn, 0.01, 0.002}) - shape.toRoom({0.0, 0.01, 0.002});
            QVERIFY((way - base::Vec3(0.0, 0.0, pitch)).norm() < 1e-15);
            QVERIFY(
                (shape.toTrack(shape.toRoom({turn, 0.01, 0.002}), 1.1 * turn) - base::Vec3(turn, 0.01, 0.002))
                    .norm() < 1e-14);
        }
    }

    void quarterTurn_data() {
        QTest::addColumn<Conveying>("conveying");
        QTest::addColumn<double>("side");
        QTest::newRow("clockwise goes to -y") << Conveying::clockwise << -1.0;
        QTest::newRow("anticlockwise goes to +y") << Conveying::anticlockwise << 1.0;
    }
    void quarterTurn() {
        QFETCH(Conveying, conveying);
        QFETCH(double, side);
        const FeederShape shape{FeederType::bowl, 0.2, conveying};
        const base::Vec3 begin = shape.toRoom({0.0, 0.0, 0.01});
        QVERIFY((begin - base::Vec3(0.2, 0.0, 0.01)).norm() < 1e-15);
        const base::Vec3 quarter = shape.toRoom({0.5 * base::kPi * 0.2, 0.03, 0.01});
        QVERIFY((quarter - base::Vec3(0.0, side * 0.23, 0.01)).norm() < 1e-15);
    }

    void toTrackInverts_data() { addShapes(); }
    void toTrackInverts() {
        QFETCH(FeederShape, shape);
        for (int i = -40; i <= 80; ++i) {
            const double x = 0.037 * i;
            const base::Vec3 point(x, 0.4 * std::sin(9.0 * x) * 0.05, 0.02);
            for (const double off : {-0.2, 0.0, 0.2}) {
                const base::Vec3 back = shape.toTrack(shape.toRoom(point), x + off);
                QVERIFY((back - point).norm() < 1e-13);
            }
        }
    }

    // The frame's first column is the derivative of toRoom along x at y = 0; it is a rotation.
    void tangentFrameIsTheDerivative_data() { addShapes(); }
    void tangentFrameIsTheDerivative() {
        QFETCH(FeederShape, shape);
        for (int i = -6; i <= 12; ++i) {
            const double x = 0.05 * i;
            const base::Mat3 frame = shape.tangentFrame(x);
            const double h = 1e-6;
            const base::Vec3 along = (shape.toRoom({x + h, 0, 0}) - shape.toRoom({x - h, 0, 0})) / (2 * h);
            QVERIFY((frame.col(0) - along.normalized()).norm() < 1e-8);
            QVERIFY((frame.transpose() * frame - base::Mat3::Identity()).norm() < 1e-14);
            QVERIFY(std::abs(frame.determinant() - 1.0) < 1e-14);
            const double climbs = shape.type == FeederType::bowl ? shape.slope : 0.0;
            QVERIFY(std::abs(frame(2, 2) - std::cos(climbs)) < 1e-14);
            if (climbs == 0.0) QCOMPARE(base::Vec3(frame.col(2)), base::Vec3(base::Vec3::UnitZ()));
            const base::Vec3 outward = shape.toRoom({x, 0.01, 0}) - shape.toRoom({x, 0, 0});
            const bool inwardFrame =
                shape.type == FeederType::bowl && shape.conveying == Conveying::anticlockwise;
            QVERIFY(outward.dot(frame.col(1)) * (inwardFrame ? -1.0 : 1.0) > 0.0099);
        }
    }
};

QTEST_APPLESS_MAIN(FeederShapeTest)
#include "feeder_shape_test.moc"
