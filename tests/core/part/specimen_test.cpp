#include "core/part/specimen.h"

#include <QtTest>
#include <cmath>

#include "core/geometry/mass_properties.h"
#include "core/part/bundled.h"
#include "core/part/part_builder.h"

using namespace trapwright;

class SpecimenTest : public QObject {
    Q_OBJECT

 private slots:
    // Mass and inertia of the closed form are those of the stretched mesh; planes go through their corners;
    // extents are as much larger as told, and the origin is the centre of mass as far off as told.
    void specimensAreSolids_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<double>("size");
        QTest::addColumn<double>("x");
        for (const char* name : {"cuboid", "wedge", "holed-bracket"}) {
            const auto row = [&](const char* what, double size, double x) {
                QTest::addRow("%s %s", name, what) << QString(name) << size << x;
            };
            row("larger", 0.1e-3, 0.0);
            row("smaller", -0.3e-3, 0.0);
            row("heavier on one side", 0.0, 0.2e-3);
            row("both", 0.2e-3, -0.1e-3);
        }
    }
    void specimensAreSolids() {
        QFETCH(const QString, name);
        QFETCH(const double, size);
        QFETCH(const double, x);
        const auto built = part::buildPart(part::makeBundledShape(name.toStdString()), {});
        QVERIFY(built.ok());
        const part::Part& drawn = built->part;
        const base::Vec3 centre(x, 0.5 * x, 0.0);
        const part::Part made = part::makeSpecimen(drawn, {size, centre});
        const base::Vec3 more = part::calcExtents(made) - part::calcExtents(drawn);
        QVERIFY((more.array() - size).abs().maxCoeff() < 1e-12);

        const geometry::MassProperties exact = geometry::calcMassProperties(made.mesh, drawn.density);
        const geometry::MassProperties& mass = made.massProperties;
        QVERIFY(std::abs(mass.mass / exact.mass - 1.0) < 1e-9);
        QVERIFY(std::abs(mass.volume / exact.volume - 1.0) < 1e-9);
        QVERIFY((mass.inertia - exact.inertia).norm() < 1e-9 * exact.inertia.norm());
        QVERIFY((exact.centre + centre).norm() < 1e-12);
        double farthest = 0.0;
        for (const base::Vec3& vertex : made.mesh.vertices)
            farthest = std::max(farthest, vertex.norm());
        QCOMPARE(made.boundingRadius, farthest);
        QCOMPARE(made.pieces.size(), drawn.pieces.size());
        const double off = 1e-9 + 2.0 * farthestCornerOffPlane(drawn);
        QVERIFY2(farthestCornerOffPlane(made) < off, qPrintable(QString::number(off)));
    }

    // What is as drawn has the same bits.
    void nothingChangesNothing() {
        const auto built = part::buildPart(part::makeBundledShape("wedge"), {});
        QVERIFY(built.ok());
        const part::Part made = part::makeSpecimen(built->part, {});
        QVERIFY(made.mesh.vertices == built->part.mesh.vertices);
        QVERIFY(made.massProperties.inertia == built->part.massProperties.inertia);
    }

 private:
    /// Of a corner off the plane of its face, which must be a unit normal's. [m]
    static double farthestCornerOffPlane(const part::Part& part) {
        double farthest = 0.0;
        for (const geometry::ConvexPolytope& piece : part.pieces) {
            for (const geometry::PolytopeFace& face : piece.faces) {
                if (std::abs(face.normal.norm() - 1.0) > 1e-12) return 1.0;
                for (const int corner : face.loop)
                    farthest = std::max(
                        farthest, std::abs(face.normal.dot(piece.vertices[static_cast<std::size_t>(corner)]) -
                                           face.offset));
            }
        }
        return farthest;
    }
};

QTEST_APPLESS_MAIN(SpecimenTest)
#include "specimen_test.moc"
