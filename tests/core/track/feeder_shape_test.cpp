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
    }

 private slots:
    void linearIsTheRoom() {
        const base::Vec3 point(0.3, -0.02, 0.01);
        QCOMPARE(FeederShape{}.toRoom(point), point);
        QCOMPARE(FeederShape{}.tangentFrame(0.3), base::Mat3(base::Mat3::Identity()));
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
            const base::Vec3 slope = (shape.toRoom({x + h, 0, 0}) - shape.toRoom({x - h, 0, 0})) / (2 * h);
            QVERIFY((frame.col(0) - slope).norm() < 1e-8);
            QVERIFY((frame.transpose() * frame - base::Mat3::Identity()).norm() < 1e-14);
            QVERIFY(std::abs(frame.determinant() - 1.0) < 1e-14);
            QCOMPARE(base::Vec3(frame.col(2)), base::Vec3(base::Vec3::UnitZ()));
            const base::Vec3 outward = shape.toRoom({x, 0.01, 0}) - shape.toRoom({x, 0, 0});
            const bool inwardFrame =
                shape.type == FeederType::bowl && shape.conveying == Conveying::anticlockwise;
            QVERIFY(outward.dot(frame.col(1)) * (inwardFrame ? -1.0 : 1.0) > 0.0099);
        }
    }
};

QTEST_APPLESS_MAIN(FeederShapeTest)
#include "feeder_shape_test.moc"
