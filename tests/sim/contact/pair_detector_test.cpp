#include "sim/contact/pair_detector.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/geometry/contact_shape.h"
#include "core/geometry/convex_separation.h"
#include "core/part/bundled.h"
#include "core/verify/scenes.h"

using namespace trapwright;
using base::kMillimetre;
using base::Pose;
using base::Quaternion;
using base::Vec3;
using contact::Contact;
using contact::ContactBody;
using contact::PairDetector;

namespace {

ContactBody makeBlock(const Vec3& size) {
    return contact::prepareBody(verify::makeCuboid(size * kMillimetre, 1000.0)->pieces);
}

std::vector<Contact> findAfresh(const ContactBody& a, const Pose& poseA, const ContactBody& b,
                                const Pose& poseB, double margin) {
    std::vector<Contact> contacts;
    PairDetector(a, b).findContacts(poseA, poseB, 0.0, margin, contacts);
    return contacts;
}

Quaternion turn(double degrees, const Vec3& axis) {
    return Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, axis));
}

std::vector<Contact> sorted(std::vector<Contact> contacts) {
    std::ranges::sort(contacts, {}, &Contact::feature);
    return contacts;
}

constexpr double kMargin = 20e-6;

}  // namespace

class PairDetectorTest : public QObject {
    Q_OBJECT

 private slots:
    // A block on a block: held at both ends of every direction, all normals up, whichever way it is turned.
    void aFaceOnAFace_data() {
        QTest::addColumn<double>("heading");
        QTest::addColumn<double>("gap");
        for (const double heading : {0.0, 1e-7, 0.5, 30.0, 45.0, 90.0})
            for (const double gap : {-2e-6, 0.0, 3e-6})
                QTest::addRow("%g deg, %g um", heading, gap * 1e6) << heading << gap;
    }
    void aFaceOnAFace() {
        QFETCH(double, heading);
        QFETCH(double, gap);
        const ContactBody block = makeBlock(Vec3(10, 6, 4));
        const Pose anyhow{turn(25.0, Vec3(1, 2, 3).normalized()), Vec3(0.1, 0.2, 0.3)};
        const Pose on{turn(heading, Vec3::UnitZ()), Vec3(0, 0, 4 * kMillimetre + gap)};
        const Pose poseB{anyhow.rotation * on.rotation, anyhow.apply(on.position)};
        const std::vector<Contact> contacts = findAfresh(block, anyhow, block, poseB, kMargin);
        Vec3 least = Vec3::Constant(1.0);
        Vec3 most = Vec3::Constant(-1.0);
        for (const Contact& contact : contacts) {
            QVERIFY((contact.normal - Vec3::UnitZ()).norm() < 1e-6);
            QVERIFY(std::abs(contact.gap - gap) < 1e-9);
            least = least.cwiseMin(contact.point);
            most = most.cwiseMax(contact.point);
        }
        QVERIFY2(contacts.size() >= 4, qPrintable(QString::number(contacts.size())));
        // What they have in common reaches over both middles by the lesser half width at least.
        QVERIFY(least.x() < -2.9 * kMillimetre && most.x() > 2.9 * kMillimetre);
        QVERIFY(least.y() < -2.9 * kMillimetre && most.y() > 2.9 * kMillimetre);
    }

    // Side by side on the same floor, pressed a micrometre into each other or not: apart along the line.
    void likePartsInLine() {
        const ContactBody block = makeBlock(Vec3(10, 6, 4));
        base::Random random({.seed = 5});
        for (int i = 0; i < 200; ++i) {
            const auto noise = [&](double size) { return random.uniform(-size, size); };
            const Pose b{turn(noise(0.01), random.rotation() * Vec3::UnitX()),
                         Vec3(10 * kMillimetre + noise(1e-6), noise(0.5e-6), noise(0.5e-6))};
            const std::vector<Contact> contacts = findAfresh(block, {}, block, b, kMargin);
            int along = 0;
            for (const Contact& contact : contacts) {
                QVERIFY2(contact.normal.x() > 0.99 || contact.gap > -1e-6,
                         qPrintable(QString("%1: %2").arg(i).arg(contact.normal.x())));
                along += contact.normal.x() > 0.99 ? 1 : 0;
            }
            QVERIFY2(along >= 3, qPrintable(QString("%1: %2").arg(i).arg(along)));
        }
    }

    void anEdgeAcrossAnEdge() {
        const ContactBody block = makeBlock(Vec3(4, 4, 20));
        const double reach = 2.0 * std::sqrt(2.0) * kMillimetre;
        const Pose a{turn(45.0, Vec3::UnitZ()), Vec3::Zero()};
        for (const double gap : {-5e-6, 8e-6}) {
            const Pose b{turn(90.0, Vec3::UnitX()) * turn(45.0, Vec3::UnitZ()),
                         Vec3(2.0 * reach + gap, 0, 0)};
            const std::vector<Contact> contacts = findAfresh(block, a, block, b, kMargin);
            QCOMPARE(contacts.size(), std::size_t{1});
            QVERIFY((a.rotation * contacts[0].normal - Vec3::UnitX()).norm() < 1e-9);
            QVERIFY(std::abs(contacts[0].gap - gap) < 1e-9);
            QVERIFY((a.apply(contacts[0].point) - Vec3(reach + gap, 0, 0)).norm() < 1e-9);
        }
    }

    void aCornerOnAFace() {
        const ContactBody block = makeBlock(Vec3(8, 8, 8));
        const Quaternion onCorner = Quaternion::FromTwoVectors(Vec3(-1, -1, -1), -Vec3::UnitZ());
        const double reach = 4.0 * std::sqrt(3.0) * kMillimetre;
        for (const bool swapped : {false, true}) {
            const Pose low;
            const Pose high{onCorner, Vec3(1e-3, -2e-3, 4 * kMillimetre + reach - 1e-6)};
            const std::vector<Contact> contacts = swapped ? findAfresh(block, high, block, low, kMargin)
                                                          : findAfresh(block, low, block, high, kMargin);
            QCOMPARE(contacts.size(), std::size_t{1});
            const Vec3 normal = (swapped ? high : low).rotation * contacts[0].normal;
            QVERIFY((normal - (swapped ? -1.0 : 1.0) * Vec3::UnitZ()).norm() < 1e-9);
            QVERIFY(std::abs(contacts[0].gap + 1e-6) < 1e-9);
        }
    }

    // What is told step after step, with bounds, is what a look from nothing tells.
    void nothingIsMissed_data() {
        QTest::addColumn<QString>("name");
        for (const char* name : {"cuboid", "cone", "bracket", "bolt"})
            QTest::newRow(name) << QString(name);
    }
    void nothingIsMissed() {
        QFETCH(QString, name);
        const auto shape = geometry::computeContactShape(part::makeBundledShape(name.toStdString()));
        QVERIFY2(shape.ok(), shape.ok() ? "" : shape.error().message.c_str());
        const ContactBody body = contact::prepareBody(shape->pieces);
        base::Random random({.seed = 7});
        std::size_t found = 0;
        for (int run = 0; run < 6; ++run) {
            Pose a{random.rotation(), Vec3::Zero()};
            Pose b{random.rotation(), random.rotation() * Vec3(2.2 * body.radius, 0, 0)};
            for (int k = 0; k < 4000 && geometry::areApart(shape->pieces, a, shape->pieces, b, 50e-6); ++k)
                b.position *= 1.0 - 1e-3;
            PairDetector detector(body, body);
            double moved = 0.0;
            for (int step = 0; step < 400; ++step) {
                std::vector<Contact> contacts;
                detector.findContacts(a, b, moved, kMargin, contacts);
                const std::vector<Contact> fresh = sorted(findAfresh(body, a, body, b, kMargin));
                contacts = sorted(contacts);
                QCOMPARE(contacts.size(), fresh.size());
                for (std::size_t i = 0; i < fresh.size(); ++i) {
                    QCOMPARE(contacts[i].feature, fresh[i].feature);
                    QCOMPARE(contacts[i].gap, fresh[i].gap);
                }
                found += fresh.size();
                // Towards each other until they touch, then along each other.
                const bool apart =
                    geometry::areApart(shape->pieces, a, shape->pieces, b, 2e-6) || step % 7 == 0;
                const Vec3 way = apart ? Vec3(-(b.position - a.position).normalized() * 15e-6)
                                       : Vec3((b.position - a.position).normalized() * 10e-6 +
                                              random.rotation() * Vec3(10e-6, 0, 0));
                const double angle = random.uniform(0.0, 2e-3);
                b.position += way;
                b.rotation =
                    Quaternion(Eigen::AngleAxisd(angle, random.rotation() * Vec3::UnitX())) * b.rotation;
                moved = way.norm() + angle * body.radius;
            }
        }
        QVERIFY2(found > 50, qPrintable(QString::number(found)));
    }

    // Where parts overlap a little, some contact says so.
    void overlapIsSeen() {
        const auto part = verify::makePaperCuboid();
        const ContactBody body = contact::prepareBody(part->pieces);
        base::Random random({.seed = 9});
        int seen = 0;
        for (int i = 0; i < 500; ++i) {
            const Pose a{random.rotation(), Vec3::Zero()};
            Pose b{random.rotation(), random.rotation() * Vec3(15e-3, 0, 0)};
            const Vec3 towards = -b.position.normalized();
            for (int k = 0; k < 4000; ++k) {
                const double apart = geometry::calcSeparation(part->hull, a, part->hull, b);
                if (apart < -1e-6) break;
                b.position += std::max(apart, 2e-6) * towards;
            }
            double deepest = 0.0;
            for (const Contact& contact : findAfresh(body, a, body, b, kMargin))
                deepest = std::min(deepest, contact.gap);
            seen += deepest < -0.9e-6 ? 1 : 0;
        }
        QVERIFY2(seen >= 498, qPrintable(QString::number(seen)));
    }
};

QTEST_APPLESS_MAIN(PairDetectorTest)
#include "pair_detector_test.moc"
