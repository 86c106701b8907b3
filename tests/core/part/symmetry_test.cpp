#include "core/part/symmetry.h"

#include <QTest>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/base/random.h"
#include "core/part/bundled.h"
#include "core/part/rotation_group.h"
#include "core/part/shapes.h"
#include "tests/core/part/centred_solid.h"

using namespace trapwright;
using base::kMillimetre;
using base::Quaternion;
using base::Vec2;
using base::Vec3;
using geometry::TriangleMesh;
using part::CentredSolid;

Q_DECLARE_METATYPE(TriangleMesh)

namespace {

std::vector<Vec2> regularPolygon(int corners, double radius) {
    std::vector<Vec2> polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * base::kPi * i / corners;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return polygon;
}

TriangleMesh prism(int corners, double radius, double depth) {
    return part::makePrism(regularPolygon(corners, radius * kMillimetre), depth * kMillimetre);
}

TriangleMesh cylinder(double radius, double length, int facets) {
    const std::array<Vec2, 4> profile = {Vec2(0.0, 0.0), Vec2(radius, 0.0), Vec2(radius, length),
                                         Vec2(0.0, length)};
    return part::makeTurned(profile, facets);
}

TriangleMesh cone(double radius, double length, int facets) {
    const std::array<Vec2, 3> profile = {Vec2(0.0, 0.0), Vec2(radius, 0.0), Vec2(0.0, length)};
    return part::makeTurned(profile, facets);
}

TriangleMesh hullOf(const std::vector<Vec3>& points) {
    return geometry::toMesh(geometry::computeConvexHull(points).value());
}

std::vector<Vec3> icosahedron() {
    const double phi = 0.5 * (1.0 + std::sqrt(5.0));
    std::vector<Vec3> points;
    for (const double a : {-1.0, 1.0}) {
        for (const double b : {-phi, phi}) {
            points.emplace_back(0.0, a, b);
            points.emplace_back(a, b, 0.0);
            points.emplace_back(b, 0.0, a);
        }
    }
    return points;
}

/// Splits every triangle in four, `times` over; new vertices go to the sphere of the old ones if `onSphere`.
TriangleMesh subdivide(TriangleMesh mesh, int times, bool onSphere) {
    for (int round = 0; round < times; ++round) {
        TriangleMesh finer;
        finer.vertices = mesh.vertices;
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [entry, isNew] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                            static_cast<int>(finer.vertices.size()));
            if (isNew) {
                Vec3 point = 0.5 * (mesh.vertices[static_cast<std::size_t>(a)] +
                                    mesh.vertices[static_cast<std::size_t>(b)]);
                if (onSphere) point *= mesh.vertices.front().norm() / point.norm();
                finer.vertices.push_back(point);
            }
            return entry->second;
        };
        for (const auto& [a, b, c] : mesh.triangles) {
            const int ab = middle(a, b);
            const int bc = middle(b, c);
            const int ca = middle(c, a);
            finer.triangles.insert(finer.triangles.end(),
                                   {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh = finer;
    }
    return mesh;
}

TriangleMesh bracket(double legA, double legB) {
    const double t = 2.5 * kMillimetre;
    const double a = legA * kMillimetre;
    const double b = legB * kMillimetre;
    const std::array<Vec2, 6> profile = {Vec2(t, t),     Vec2(t, b),   Vec2(0.0, b),
                                         Vec2(0.0, 0.0), Vec2(a, 0.0), Vec2(a, t)};
    return part::makePrism(profile, 8.0 * kMillimetre);
}

TriangleMesh rotated(TriangleMesh mesh, const Quaternion& rotation) {
    for (Vec3& vertex : mesh.vertices)
        vertex = rotation * vertex;
    return mesh;
}

}  // namespace

class SymmetryTest : public QObject {
    Q_OBJECT

 private slots:
    void groupOfKnownSolid_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("order");
        const double mm = kMillimetre;
        QTest::newRow("cuboid 4 x 8 x 12") << part::makeBox(Vec3(4, 8, 12) * mm) << "D2" << 4;
        QTest::newRow("nearly square cuboid") << part::makeBox(Vec3(8, 8.3, 12) * mm) << "D2" << 4;
        QTest::newRow("square prism, long") << part::makeBox(Vec3(4, 4, 12) * mm) << "D4" << 8;
        QTest::newRow("square prism, flat") << part::makeBox(Vec3(9, 9, 3) * mm) << "D4" << 8;
        QTest::newRow("cube") << part::makeBox(Vec3(5, 5, 5) * mm) << "O" << 24;
        QTest::newRow("triangle prism") << prism(3, 5, 12) << "D3" << 6;
        QTest::newRow("hexagon prism") << prism(6, 5, 4) << "D6" << 12;
        QTest::newRow("hexagon prism, equal moments") << prism(6, 5, 5 * std::sqrt(2.5)) << "D6" << 12;
        QTest::newRow("twelve-sided prism") << prism(12, 5, 4) << "D12" << 24;
        QTest::newRow("hexagon pyramid") << cone(5 * mm, 9 * mm, 6) << "C6" << 6;
        QTest::newRow("twelve-sided pyramid") << cone(5 * mm, 9 * mm, 12) << "C12" << 12;
        QTest::newRow("bracket, unlike legs") << bracket(12, 10) << "C1" << 1;
        QTest::newRow("bracket, like legs") << bracket(12, 12) << "C2" << 2;
        QTest::newRow("scalene tetrahedron")
            << hullOf({Vec3(0, 0, 0), Vec3(7, 0, 0), Vec3(2, 5, 0), Vec3(1, 1, 9)}) << "C1" << 1;
        QTest::newRow("disphenoid") << hullOf(
                                           {Vec3(1, 2, 3), Vec3(-1, -2, 3), Vec3(-1, 2, -3), Vec3(1, -2, -3)})
                                    << "D2" << 4;
        QTest::newRow("regular tetrahedron")
            << hullOf({Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1)}) << "T" << 12;
        QTest::newRow("icosahedron") << hullOf(icosahedron()) << "I" << 60;
        QTest::newRow("cone part") << part::makeBundledShape("cone") << "Cinf" << 1;
        QTest::newRow("cone, 16 facets") << cone(5 * mm, 12 * mm, 16) << "Cinf" << 1;
        QTest::newRow("cylinder, 16 facets") << cylinder(3 * mm, 10 * mm, 16) << "Dinf" << 1;
        QTest::newRow("disc, 48 facets") << cylinder(6 * mm, 1 * mm, 48) << "Dinf" << 1;
        QTest::newRow("cylinder, equal moments")
            << cylinder(3 * mm, 3 * std::sqrt(3.0) * mm, 48) << "Dinf" << 1;
        QTest::newRow("pin") << part::makeBundledShape("pin") << "Cinf" << 1;
        QTest::newRow("cup") << part::makeBundledShape("cup") << "Cinf" << 1;
        QTest::newRow("icosphere") << subdivide(hullOf(icosahedron()), 3, true) << "SO3" << 1;
    }

    /// In the axes of the file and in others: the group does not depend on them.
    void groupOfKnownSolid() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(QString, name);
        QFETCH(int, order);
        base::Random random({.seed = 5});
        for (int i = 0; i < 3; ++i) {
            const CentredSolid solid(i == 0 ? mesh : rotated(mesh, random.rotation()));
            const part::SymmetryGroup group = solid.symmetry();
            QCOMPARE(QString::fromStdString(group.name), name);
            QCOMPARE(static_cast<int>(group.rotations.size()), order);
            QCOMPARE(group.continuous, name.endsWith("inf"));
            QCOMPARE(group.flip, name == "Dinf");
            QCOMPARE(group.sphere, name == "SO3");
        }
    }

    /// Each rotation maps the set of vertices of an untriangulated solid onto itself: a check that shares no
    /// code.
    void rotationsMapVertices() {
        const CentredSolid solid(part::makeBox(Vec3(6, 6, 6) * kMillimetre));
        for (const Quaternion& rotation : solid.symmetry().rotations) {
            for (const Vec3& vertex : solid.hull.vertices) {
                double nearest = 1.0;
                for (const Vec3& other : solid.hull.vertices) {
                    nearest = std::min(nearest, (rotation * vertex - other).norm());
                }
                QVERIFY(nearest < 1e-9);
            }
        }
    }

    void groupsAreClosed() {
        const std::vector<Quaternion> group = CentredSolid(hullOf(icosahedron())).symmetry().rotations;
        QCOMPARE(part::calcAngleBetween(group.front(), Quaternion::Identity()), 0.0);
        for (const Quaternion& a : group) {
            QVERIFY(part::hasRotation(group, a.conjugate(), 1e-6));
            for (const Quaternion& b : group)
                QVERIFY(part::hasRotation(group, a * b, 1e-6));
        }
    }

    /// One side of the cuboid in 64 times as many triangles as the others.
    void unevenTriangulationDoesNotMatter() {
        TriangleMesh box = part::makeBox(Vec3(4, 8, 12) * kMillimetre);
        TriangleMesh side;
        side.vertices = box.vertices;
        side.triangles = {box.triangles[0], box.triangles[1]};
        side = subdivide(side, 3, false);
        const int first = static_cast<int>(box.vertices.size());
        box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
        box.vertices.insert(box.vertices.end(), side.vertices.begin(), side.vertices.end());
        for (const auto& [a, b, c] : side.triangles)
            box.triangles.push_back({a + first, b + first, c + first});
        QCOMPARE(CentredSolid(box).symmetry().name, std::string("D2"));
    }

    void axisOfTurnedPart() {
        const Quaternion tilt(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
        const part::SymmetryGroup group =
            CentredSolid(rotated(part::makeBundledShape("cone"), tilt)).symmetry();
        QVERIFY(std::abs(group.axis.dot(tilt * Vec3::UnitZ())) > 1.0 - 1e-6);
    }

    /// The tolerance decides whether 8 x 8.3 mm counts as square.
    void toleranceIsHonoured() {
        const CentredSolid solid(part::makeBox(Vec3(8, 8.3, 12) * kMillimetre));
        QCOMPARE(solid.symmetry({.tolerance = 0.005}).name, std::string("D2"));
        QCOMPARE(solid.symmetry({.tolerance = 0.05}).name, std::string("D4"));
    }
};

QTEST_APPLESS_MAIN(SymmetryTest)
#include "symmetry_test.moc"
