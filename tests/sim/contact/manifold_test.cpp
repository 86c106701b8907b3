#include "sim/contact/manifold.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;
using base::Vec3;

namespace {

using Points = std::vector<contact::ManifoldPoint>;

contact::ManifoldPoint makeContact(const Vec3& arm, const Vec3& normal, double gap) {
    return {arm, normal, gap};
}

std::vector<int> reduceManifold(const Points& contacts, int most) {
    std::vector<int> kept(most);
    kept.resize(contact::reduceManifold(contacts, kept));
    return kept;
}

/// A ring of contacts of one plane, like a round part's rim on a flat track.
Points makeRing(int count, double radius) {
    Points contacts;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * base::kPi * i / count;
        contacts.push_back(
            makeContact({radius * std::cos(angle), radius * std::sin(angle), -2e-3}, Vec3::UnitZ(), 1e-6));
    }
    return contacts;
}

/// Largest angle between neighbouring contacts seen from the middle: below half a turn the part stands.
double findWidestOpening(const Points& contacts, const std::vector<int>& kept) {
    std::vector<double> angles;
    angles.reserve(kept.size());
    for (const int i : kept)
        angles.push_back(std::atan2(contacts[i].arm.y(), contacts[i].arm.x()));
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2.0 * base::kPi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i)
        widest = std::max(widest, angles[i] - angles[i - 1]);
    return widest;
}

}  // namespace

class ManifoldTest : public QObject {
    Q_OBJECT

 private slots:
    void fewAreAllKept() {
        for (int count = 0; count <= 12; ++count) {
            const std::vector<int> kept = reduceManifold(makeRing(count, 5e-3), 12);
            QCOMPARE(static_cast<int>(kept.size()), count);
            for (int i = 0; i < count; ++i)
                QCOMPARE(kept[i], i);
        }
    }

    void aRingIsSpannedAllRound() {
        const auto contacts = makeRing(64, 5e-3);
        const std::vector<int> kept = reduceManifold(contacts, 12);
        QVERIFY(kept.size() <= 12 && kept.size() >= 3);
        QVERIFY(findWidestOpening(contacts, kept) < 0.3 * base::kPi);
        QVERIFY(std::is_sorted(kept.begin(), kept.end()));
        QVERIFY(std::adjacent_find(kept.begin(), kept.end()) == kept.end());
    }

    void theLowestOfAPlaneIsKept() {
        auto contacts = makeRing(40, 5e-3);
        for (const int lowest : {0, 17, 39}) {
            contacts[lowest].gap = -3e-6;
            const std::vector<int> kept = reduceManifold(contacts, 12);
            QVERIFY(std::find(kept.begin(), kept.end(), lowest) != kept.end());
            contacts[lowest].gap = 1e-6;
        }
    }

    void everyPlaneKeepsItsShare() {
        auto contacts = makeRing(30, 5e-3);
        const Vec3 aslant = Vec3(1.0, 0.0, 1.0).normalized();
        contacts.push_back(makeContact({5e-3, 0.0, 0.0}, aslant, 0.0));
        contacts.push_back(makeContact({5e-3, 2e-3, 0.0}, aslant, 0.0));
        const std::vector<int> kept = reduceManifold(contacts, 12);
        QVERIFY(kept.size() <= 12);
        QVERIFY(std::find(kept.begin(), kept.end(), 30) != kept.end());
        QVERIFY(std::find(kept.begin(), kept.end(), 31) != kept.end());
    }

    // However many planes meet, the limit holds and the deepest contact of all is among the kept.
    void neverMoreThanAsked() {
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 300; ++i) {
            Points contacts;
            const auto planes = static_cast<int>(1 + random.below(30));
            for (int plane = 0; plane < planes; ++plane) {
                const Vec3 normal = random.rotation() * Vec3::UnitZ();
                const auto count = static_cast<int>(1 + random.below(6));
                for (int c = 0; c < count; ++c)
                    contacts.push_back(makeContact(random.rotation() * Vec3(5e-3, 0.0, 0.0), normal,
                                                   random.uniform(-1e-5, 1e-5)));
            }
            const std::vector<int> kept = reduceManifold(contacts, 12);
            QVERIFY(kept.size() <= 12);
            QVERIFY(contacts.size() > 12 || kept.size() == contacts.size());
            const auto deepest = std::min_element(contacts.begin(), contacts.end(),
                                                  [](const auto& a, const auto& b) { return a.gap < b.gap; });
            QVERIFY(std::find(kept.begin(), kept.end(), static_cast<int>(deepest - contacts.begin())) !=
                    kept.end());
        }
    }

    void contactsAtOnePlaceAreOneContact() {
        Points contacts(20, makeContact({1e-3, 0.0, 0.0}, Vec3::UnitZ(), 0.0));
        QCOMPARE(reduceManifold(contacts, 12).size(), 1U);
    }

    void theLowestOfOnePlaceStandsForIt() {
        const Points contacts = {makeContact({1e-3, 0.0, 0.0}, Vec3::UnitZ(), 2e-6),
                                 makeContact({1.05e-3, 0.0, 0.0}, Vec3::UnitZ(), 1e-6),
                                 makeContact({1e-3, 0.0, 0.0}, Vec3::UnitX(), 3e-6),
                                 makeContact({1.5e-3, 0.0, 0.0}, Vec3::UnitZ(), 4e-6)};
        QCOMPARE(reduceManifold(contacts, 12), (std::vector<int>{1, 2, 3}));
    }
};

QTEST_APPLESS_MAIN(ManifoldTest)
#include "manifold_test.moc"
