#include "sim/contact/roughness.h"

#include <QtTest>
#include <cmath>

#include "core/base/random.h"

using namespace trapwright;
using base::Vec3;

namespace {

constexpr double kRoughness = 6.0 * base::kDegree;

trial::ContactParameters roughLaw(std::uint64_t surface) {
    trial::ContactParameters law;
    law.roughness = kRoughness;
    law.surface = surface;
    return law;
}

double angleBetween(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

class RoughnessTest : public QObject {
    Q_OBJECT

 private slots:
    void aSmoothSurfaceKeepsItsNormalBitForBit() {
        const Vec3 normal = Vec3(0.1, -0.7, 0.3).normalized();
        QCOMPARE(contact::tiltNormal({}, {0.1, 0.2, 0.3}, normal), normal);
    }

    // Evenly over a disc: mean off by nothing, the mean square half that of its border; the share within a
    // radius is its square.
    void grainsLeanEvenly() {
        const Vec3 normal = Vec3(0.2, -0.3, 0.9).normalized();
        base::Random random({1, 0, 0, 0});
        constexpr int kGrains = 20000;
        Vec3 sum = Vec3::Zero();
        int within = 0;
        for (int i = 0; i < kGrains; ++i) {
            const Vec3 point(random.uniform(), random.uniform(), random.uniform());
            const Vec3 tilted = contact::tiltNormal(roughLaw(4), point, normal);
            QVERIFY(std::abs(tilted.norm() - 1.0) < 1e-12);
            const double angle = angleBetween(tilted, normal);
            QVERIFY(angle <= kRoughness * (1.0 + 1e-9));
            within += angle < 0.5 * kRoughness ? 1 : 0;
            sum += tilted;
        }
        // Four standard deviations each.
        QVERIFY(angleBetween(sum, normal) < 4.0 * kRoughness / std::sqrt(2.0 * kGrains));
        QVERIFY(std::abs(within / double(kGrains) - 0.25) < 4.0 * std::sqrt(0.25 * 0.75 / kGrains));
    }

    void aGrainIsOneAndSurfacesDiffer() {
        const Vec3 up = Vec3::UnitZ();
        const Vec3 middle(10 * contact::kGrain, -3 * contact::kGrain, 0.0);
        const Vec3 here = contact::tiltNormal(roughLaw(4), middle, up);
        for (const double off : {-0.49, 0.49})
            QCOMPARE(contact::tiltNormal(roughLaw(4), middle + off * contact::kGrain * Vec3::Ones(), up),
                     here);
        QVERIFY(contact::tiltNormal(roughLaw(4), middle + 0.51 * contact::kGrain * Vec3::UnitX(), up) !=
                here);
        QVERIFY(contact::tiltNormal(roughLaw(5), middle, up) != here);
    }
};

QTEST_APPLESS_MAIN(RoughnessTest)
#include "roughness_test.moc"
