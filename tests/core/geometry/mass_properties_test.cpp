#include "core/geometry/mass_properties.h"

#include <QTest>

#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

class MassPropertiesTest : public QObject {
    Q_OBJECT

 private slots:
    void boxInAnyPlace_data() {
        QTest::addColumn<double>("offset");
        QTest::newRow("centred") << 0.0;
        QTest::newRow("a metre away") << 1.0;
        QTest::newRow("a kilometre away") << 1000.0;
    }
    void boxInAnyPlace() {
        QFETCH(double, offset);
        const base::Vec3 size(0.004, 0.008, 0.012);
        const base::Vec3 middle = base::Vec3::Constant(offset);
        const double density = 1050.0;
        const MassProperties properties =
            calcMassProperties(shapes::makeBox(middle - 0.5 * size, middle + 0.5 * size), density);
        // What coordinates of this magnitude can carry.
        const double relative = 1e-12 + 1e-12 * offset / 0.004;
        const double mass = density * size.prod();
        QVERIFY(std::abs(properties.mass - mass) < relative * mass);
        QVERIFY(std::abs(properties.area - 2.0 * (0.004 * 0.008 + 0.008 * 0.012 + 0.004 * 0.012)) <
                relative * 1e-3);
        QVERIFY((properties.centre - middle).norm() < relative * 0.012);
        for (int axis = 0; axis < 3; ++axis) {
            const double expected = mass / 12.0 * (size.squaredNorm() - size[axis] * size[axis]);
            QVERIFY(std::abs(properties.inertia(axis, axis) - expected) < relative * expected);
            QVERIFY(std::abs(properties.inertia(axis, (axis + 1) % 3)) < relative * expected);
        }
    }

    void tetrahedronHasItsProductsOfInertia() {
        TriangleMesh mesh;
        mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        const MassProperties properties = calcMassProperties(mesh, 6.0);
        // Closed forms of the unit right tetrahedron of mass 1, moved to its centre by Steiner's theorem.
        QVERIFY(std::abs(properties.mass - 1.0) < 1e-14);
        QVERIFY((properties.centre - base::Vec3::Constant(0.25)).norm() < 1e-14);
        QVERIFY(std::abs(properties.inertia(0, 0) - (2.0 / 10.0 - 2.0 / 16.0)) < 1e-14);
        QVERIFY(std::abs(properties.inertia(0, 1) + (1.0 / 20.0 - 1.0 / 16.0)) < 1e-14);
    }

    void turnedBodyTurnsItsInertia() {
        TriangleMesh mesh = shapes::makeL();
        const MassProperties before = calcMassProperties(mesh, 1000.0);
        const base::Quaternion turn(Eigen::AngleAxisd(0.7, base::Vec3(1, 2, 3).normalized()));
        shapes::transform(mesh, {turn, {0.1, -0.2, 0.3}});
        const MassProperties after = calcMassProperties(mesh, 1000.0);
        const base::Mat3 expected =
            turn.toRotationMatrix() * before.inertia * turn.toRotationMatrix().transpose();
        QVERIFY((after.inertia - expected).norm() < 1e-10 * before.inertia.norm());
        QVERIFY((after.centre - (turn * before.centre + base::Vec3(0.1, -0.2, 0.3))).norm() < 1e-12);
    }

    void fineCylinderNearsTheRoundOne() {
        const double radius = 0.003;
        const double height = 0.01;
        const MassProperties properties =
            calcMassProperties(shapes::makePrism(shapes::makeCircle(2000, radius), height), 8500.0);
        const double mass = 8500.0 * base::kPi * radius * radius * height;
        QVERIFY(std::abs(properties.mass / mass - 1.0) < 1e-5);
        QVERIFY((properties.centre - base::Vec3(0, 0, 0.5 * height)).norm() < 1e-9);
        QVERIFY(std::abs(properties.inertia(2, 2) / (0.5 * mass * radius * radius) - 1.0) < 1e-5);
        const double across = mass * (3.0 * radius * radius + height * height) / 12.0;
        QVERIFY(std::abs(properties.inertia(0, 0) / across - 1.0) < 1e-5);
    }

    void insideOutIsNegativeAndEmptyIsNothing() {
        TriangleMesh mesh = shapes::makeBox(base::Vec3::Zero(), base::Vec3::Ones());
        shapes::turnInsideOut(mesh);
        QVERIFY(std::abs(calcMassProperties(mesh, 1.0).volume + 1.0) < 1e-14);
        QCOMPARE(calcMassProperties({}, 1.0).volume, 0.0);
    }
};

QTEST_APPLESS_MAIN(MassPropertiesTest)
#include "mass_properties_test.moc"
