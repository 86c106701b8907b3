#include "sim/contact/detector.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "detector_scenes.h"
#include "nearest_features.h"
#include "sim/contact/formulas/scalar.h"
#include "sunken_scenes.h"

using namespace trapwright;
using base::kMillimetre;
using base::Quaternion;
using base::Vec3;
using contact::Contact;
using testing::DetectorScene;
using testing::lyingAlong;

namespace {

constexpr double kMargin = 10e-6;

/// Level but for x = 0.1, where it rises to `top` over flanks of `run`.
std::shared_ptr<const track::Track> makeRidge(double run, double top) {
    return verify::makeSurface({0.0, 0.1 - run, 0.1, 0.1 + run, 0.3}, {-0.03, -0.01, 0.01, 0.03},
                               [=](double x, double) { return x == 0.1 ? top : 15.0 * kMillimetre; });
}

bool isNear(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    return (a - b).norm() < tolerance;
}

}  // namespace

class DetectorTest : public QObject {
    Q_OBJECT

 private slots:
    // The nearest points of two segments: crossing, beside each other, end to end, parallel.
    void segmentsAreAsFarApartAsTheirNearestPoints() {
        base::Random random({7, 0, 0, 0, base::Purpose::test});
        const auto any = [&] {
            return Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        };
        const auto toTriple = [](const Vec3& v) { return contact::scalar::Triple{v.x(), v.y(), v.z()}; };
        for (int i = 0; i < 2000; ++i) {
            const Vec3 a = any();
            const Vec3 c = any();
            const Vec3 along = any().normalized();
            const Vec3 other = i % 10 == 0 ? along : any().normalized();
            const double first = random.uniform(0.1, 1.0);
            const double second = random.uniform(0.1, 1.0);
            const contact::scalar::Triple between = contact::scalar::findBetween(
                {toTriple(a), toTriple(along), first}, {toTriple(c), toTriple(other), second});
            const double expected = testing::calcSegmentDistance(a, a + first * along, c, c + second * other);
            QVERIFY(std::abs(Vec3(between.x, between.y, between.z).norm() - expected) < 1e-9);
        }
    }

    void aCuboidRestsOnItsFourCorners() {
        const DetectorScene scene(verify::makeFlat(), verify::makePaperCuboid());
        for (const double gap : {3e-6, 0.0, -7e-6, -100e-6}) {
            const base::Pose pose{lyingAlong(), Vec3(0.1013, 0.0021, 17.0 * kMillimetre + gap)};
            const auto contacts = scene.findAfresh(pose, kMargin);
            QCOMPARE(contacts.size(), 4U);
            for (const double x : {-6e-3, 6e-3}) {
                for (const double y : {-4e-3, 4e-3}) {
                    const Vec3 corner = pose.position + Vec3(x, y, -2e-3);
                    QCOMPARE(std::count_if(contacts.begin(), contacts.end(),
                                           [&](const Contact& c) { return isNear(c.point, corner); }),
                             1);
                }
            }
            for (const Contact& contact : contacts) {
                QVERIFY(isNear(contact.normal, Vec3::UnitZ()));
                QVERIFY(std::abs(contact.gap - gap) < 1e-12);
            }
        }
    }

    // Whatever its pieces are: cuts in the faces that they lie on touch nothing.
    void aPartOfPiecesRestsOnTheCornersOfItsFace_data() {
        QTest::addColumn<QByteArray>("name");
        QTest::addColumn<std::size_t>("corners");
        QTest::newRow("triangular plate with a hole") << QByteArray("plate") << std::size_t{3};
        QTest::newRow("box open above") << QByteArray("housing") << std::size_t{4};
        QTest::newRow("ring of 32 facets") << QByteArray("washer") << std::size_t{32};
    }
    void aPartOfPiecesRestsOnTheCornersOfItsFace() {
        QFETCH(QByteArray, name);
        QFETCH(std::size_t, corners);
        auto built =
            part::buildPart(part::makeBundledShape(name.constData()), {.name = name.toStdString()}).value();
        const DetectorScene scene(verify::makeFlat(), std::make_shared<part::Part>(std::move(built.part)));
        const part::StablePose& rest = scene.part->stablePoses.front();
        const auto contacts = scene.findAfresh(
            {rest.rotation, Vec3(0.1013, 0.0021, 15.0 * kMillimetre + rest.height)}, kMargin);
        QCOMPARE(contacts.size(), corners);
        for (const Contact& contact : contacts)
            QVERIFY(isNear(contact.normal, Vec3::UnitZ()) && std::abs(contact.gap) < 1e-9);
    }

    void whatIsFartherThanTheMarginIsNoContact() {
        const DetectorScene scene(verify::makeFlat(), verify::makePaperCuboid());
        const auto found = [&](double gap) {
            return scene.findAfresh({lyingAlong(), Vec3(0.1013, 0.0021, 17.0 * kMillimetre + gap)}, kMargin)
                .size();
        };
        QCOMPARE(found(0.99 * kMargin), 4U);
        QCOMPARE(found(1.01 * kMargin), 0U);
        // Deeper than the deepest overlap the part is elsewhere.
        QCOMPARE(found(-1.01 * contact::kDeepest), 0U);
    }

    void aCornerTouchesAPlane() {
        const DetectorScene scene(verify::makeFlat(), verify::makePaperCuboid());
        const Vec3 corner(2e-3, 4e-3, 6e-3);
        const Quaternion onCorner = Quaternion::FromTwoVectors(corner, -Vec3::UnitZ());
        const base::Pose pose{onCorner, Vec3(0.1013, 0.0021, 15.0 * kMillimetre + corner.norm() + 2e-6)};
        const auto contacts = scene.findAfresh(pose, kMargin);
        QCOMPARE(contacts.size(), 1U);
        QVERIFY(isNear(contacts[0].point, pose.apply(corner)));
        QVERIFY(isNear(contacts[0].normal, Vec3::UnitZ()));
        QVERIFY(std::abs(contacts[0].gap - 2e-6) < 1e-12);
    }

    // A face lying across a ridge is held at its two borders, whether level or leaning a little.
    void aFaceAcrossARidgeIsHeldAtItsBorders_data() {
        QTest::addColumn<double>("gap");
        QTest::addColumn<double>("lean");
        QTest::newRow("just above") << 1e-6 << 0.0;
        QTest::newRow("touching") << -1e-9 << 0.0;
        QTest::newRow("20 um deep") << -20e-6 << 0.0;
        QTest::newRow("leaning 1 deg") << 1e-6 << 1.0;
        QTest::newRow("leaning 2 deg, deep") << -20e-6 << -2.0;
    }
    void aFaceAcrossARidgeIsHeldAtItsBorders() {
        QFETCH(double, gap);
        QFETCH(double, lean);
        const DetectorScene scene(makeRidge(10.0 * kMillimetre, 20.0 * kMillimetre),
                                  verify::makePaperCuboid());
        const Quaternion turn(Eigen::AngleAxisd(lean * base::kDegree, Vec3::UnitY()));
        const Vec3 up = turn * Vec3::UnitZ();
        const base::Pose pose{turn * lyingAlong(),
                              Vec3(0.1, 0.001, 20.0 * kMillimetre) + (2.0 * kMillimetre + gap) * up};
        const auto contacts = scene.findAfresh(pose, kMargin);
        QCOMPARE(contacts.size(), 2U);
        for (const Contact& contact : contacts) {
            QVERIFY(isNear(contact.normal, up));
            QVERIFY(std::abs(contact.gap - gap) < 1e-12);
            QVERIFY(std::abs(contact.point.x() - 0.1) < 1e-6 + std::abs(gap));
        }
        const double y[2] = {contacts[0].point.y(), contacts[1].point.y()};
        QVERIFY(std::abs(std::min(y[0], y[1]) + 3e-3) < 1e-9);
        QVERIFY(std::abs(std::max(y[0], y[1]) - 5e-3) < 1e-9);
    }

    void aTrackVertexTouchesAFace() {
        // A peak of 5 mm on a plain.
        const auto peak =
            verify::makeSurface({0.0, 0.09, 0.1, 0.11, 0.3}, {-0.03, -0.01, 0.0, 0.01, 0.03},
                                [](double x, double y) { return x == 0.1 && y == 0.0 ? 20e-3 : 15e-3; });
        const DetectorScene scene(peak, verify::makePaperCuboid());
        for (const double gap : {2e-6, -10e-6}) {
            const auto contacts =
                scene.findAfresh({lyingAlong(), Vec3(0.101, 0.001, 22.0 * kMillimetre + gap)}, kMargin);
            QCOMPARE(contacts.size(), 1U);
            QVERIFY(isNear(contacts[0].point, Vec3(0.1, 0.0, 20e-3)));
            QVERIFY(isNear(contacts[0].normal, Vec3::UnitZ()));
            QVERIFY(std::abs(contacts[0].gap - gap) < 1e-12);
        }
    }

    // A crest across a valley of 120 degrees: a part's edge that lies along the valley's bottom is beyond the
    // ends of both halves of the crest as soon as it is a little too deep.
    void anEdgeDoesNotSlipBetweenTheHalvesOfACrest() {
        const double flank = std::tan(60.0 * base::kDegree);
        const auto saddle = verify::makeSurface(
            {0.0, 0.09, 0.1, 0.11, 0.3}, {-0.03, 0.0, 0.03},
            [&](double x, double y) { return (x == 0.1 ? 20e-3 : 15e-3) + std::max(0.0, -y * flank); });
        const DetectorScene scene(saddle, verify::makePaperCuboid());
        // An edge of 12 mm down, along x.
        const Quaternion turn(Eigen::AngleAxisd(50.0 * base::kDegree, Vec3::UnitX()));
        const Quaternion rotation = turn * lyingAlong();
        Vec3 lowest = Vec3::UnitZ();
        for (const Vec3& vertex : scene.part->hull.vertices) {
            const Vec3 corner = rotation * vertex;
            if (corner.z() < lowest.z()) lowest = corner;
        }
        for (const double y : {-3e-6, -1e-6, 0.0, 1e-6, 3e-6}) {
            for (const double depth : {0.0, 2e-6, 5e-6, 15e-6}) {
                const Vec3 edge(0.1, y, 20e-3 - depth);
                const auto contacts =
                    scene.findAfresh({rotation, edge - Vec3(0.0, lowest.y(), lowest.z())}, kMargin);
                const bool held = std::ranges::any_of(
                    contacts, [](const Contact& contact) { return contact.normal.z() > 0.4; });
                QVERIFY2(held, qPrintable(QString("y %1 um, %2 um deep").arg(1e6 * y).arg(1e6 * depth)));
            }
        }
    }

    // A bracket hangs on the track's border, by the end of its inner corner, which lies askew to the border:
    // the border comes into the corner of two of its edges, the flange's below and the leg's inside.
    void anEdgeDoesNotSlipIntoAnInnerCorner() {
        auto built = part::buildPart(part::makeBundledShape("bracket"), {.name = "bracket"}).value();
        const DetectorScene scene(verify::makeFlat(), std::make_shared<part::Part>(std::move(built.part)));
        Vec3 low = Vec3::Constant(1.0);
        Vec3 high = Vec3::Constant(-1.0);
        for (const Vec3& vertex : scene.part->mesh.vertices) {
            low = low.cwiseMin(vertex);
            high = high.cwiseMax(vertex);
        }
        base::Mat3 hanging;
        hanging.col(0) = Vec3::UnitY();   // the flange lies on the track
        hanging.col(1) = -Vec3::UnitZ();  // the leg hangs down beside it
        hanging.col(2) = -Vec3::UnitX();
        constexpr double kThick = 2.5e-3;
        for (const bool atFirst : {true, false}) {
            const Vec3 corner(low.x() + kThick, low.y() + kThick, atFirst ? low.z() : high.z());
            const Eigen::AngleAxisd askew((atFirst ? 4.0 : -4.0) * base::kDegree, Vec3::UnitZ());
            const Quaternion rotation(askew.toRotationMatrix() * hanging);
            for (const double beside : {2e-6, 17e-6, 50e-6}) {
                for (const double depth : {2e-6, 17e-6, 50e-6}) {
                    const Vec3 there(0.1013, -30e-3 + beside, 15e-3 - depth);
                    const auto contacts = scene.findAfresh({rotation, there - rotation * corner}, kMargin);
                    const auto pushes = [&](const Vec3& way) {
                        return std::ranges::any_of(contacts, [&](const Contact& contact) {
                            return contact.normal.dot(way) > 0.9 && (contact.point - there).norm() < 1e-3;
                        });
                    };
                    const auto about = QString("end %1, %2 um beside, %3 um deep")
                                           .arg(atFirst ? 1 : 2)
                                           .arg(1e6 * beside)
                                           .arg(1e6 * depth);
                    QVERIFY2(pushes(Vec3::UnitZ()), qPrintable(about));
                    QVERIFY2(pushes(-Vec3::UnitY()), qPrintable(about));
                }
            }
        }
    }

    // A bracket hangs over the corner at the track's end, which comes into the corner of flange and leg in
    // the middle: both hold it, though the cut between the two is nearer than the leg's face.
    void aCornerInAnInnerCornerIsHeldByBothFaces() {
        auto built = part::buildPart(part::makeBundledShape("bracket"), {.name = "bracket"}).value();
        const DetectorScene scene(verify::makeFlat(), std::make_shared<part::Part>(std::move(built.part)));
        Vec3 low = Vec3::Constant(1.0);
        Vec3 end = Vec3::Constant(-1.0);
        for (const Vec3& vertex : scene.part->mesh.vertices)
            low = low.cwiseMin(vertex);
        for (const Vec3& vertex : scene.track->solid.vertices)
            end = end.cwiseMax(vertex);
        base::Mat3 hanging;
        hanging.col(0) = Vec3::UnitY();
        hanging.col(1) = -Vec3::UnitZ();
        hanging.col(2) = -Vec3::UnitX();
        constexpr double kThick = 2.5e-3;
        const Vec3 inner(low.x() + kThick, low.y() + kThick, 0.0);
        const Eigen::AngleAxisd askew(30.0 * base::kDegree, Vec3::UnitZ());
        const Quaternion rotation(askew.toRotationMatrix() * hanging);
        const Vec3 away = askew * -Vec3::UnitY();
        const Vec3 corner(end.x(), -30e-3, 15e-3);
        for (const double beside : {2e-6, 10e-6, 25e-6}) {
            for (const double depth : {-5e-6, 2e-6, 17e-6}) {
                const Vec3 there = corner - beside * away - depth * Vec3::UnitZ();
                const auto contacts = scene.findAfresh({rotation, there - rotation * inner}, kMargin);
                const auto pushes = [&](const Vec3& way) {
                    return std::ranges::any_of(contacts, [&](const Contact& contact) {
                        return contact.normal.dot(way) > 0.99 && (contact.point - corner).norm() < 0.5e-3;
                    });
                };
                const auto about = QString("%1 um beside, %2 um deep").arg(1e6 * beside).arg(1e6 * depth);
                QVERIFY2(pushes(Vec3::UnitZ()), qPrintable(about));
                QVERIFY2(pushes(away), qPrintable(about));
            }
        }
    }

    // Parts at a blade 0.1 mm thick at its foot and 15 mm high, at all heights, on either side: pushed to
    // their own side by every contact.
    void aThinWallPushesToBothSides() {
        const DetectorScene scene(makeRidge(0.05 * kMillimetre, 30.0 * kMillimetre),
                                  verify::makePaperCuboid());
        const double lean = std::atan2(0.05, 15.0);
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 400; ++i) {
            const double side = i % 2 == 0 ? -1.0 : 1.0;
            const Vec3 outward = Vec3(side * std::cos(lean), 0.0, std::sin(lean));
            const Quaternion rotation = random.rotation();
            // The part clear of the ground, its nearest point 1 um away from the wall's flank.
            base::Pose pose{rotation, Vec3(0.1, 0.0, random.uniform(0.0235, 0.03))};
            double nearest = 1e300;
            for (const Vec3& vertex : scene.part->hull.vertices)
                nearest = std::min(nearest, outward.dot(pose.apply(vertex) - Vec3(0.1, 0.0, 0.03)));
            pose.position += (1e-6 - nearest) * outward;
            double lowest = 1.0;
            Vec3 touching = Vec3::Zero();
            for (const Vec3& vertex : scene.part->hull.vertices) {
                const Vec3 corner = pose.apply(vertex);
                if (outward.dot(corner - Vec3(0.1, 0.0, 0.03)) < 2e-6) touching = corner;
                lowest = std::min(lowest, corner.z());
            }
            if (touching.z() > 29.9e-3) continue;  // over the crest
            QVERIFY(lowest > 15.5e-3);
            const auto contacts = scene.findAfresh(pose, kMargin);
            QVERIFY(!contacts.empty());
            for (const Contact& contact : contacts)
                QVERIFY2(contact.normal.dot(outward) > 0.5, qPrintable(QString("at height %1 mm, gap %2 um")
                                                                           .arg(contact.point.z() * 1e3)
                                                                           .arg(contact.gap * 1e6)));
        }
    }

    // A part that slides level over the border of a face or past a vertex in a ridge is not stopped by it:
    // whatever touches pushes upward, wherever the part is and whether it comes or goes.
    void aLevelFaceSlidesOverBorders_data() {
        QTest::addColumn<double>("gap");
        QTest::newRow("just above") << 1e-9;
        QTest::newRow("just below") << -1e-9;
        QTest::newRow("20 um deep") << -20e-6;
    }
    void aLevelFaceSlidesOverBorders() {
        QFETCH(double, gap);
        // A table between two slopes, with vertices in its borders.
        const auto table = verify::makeSurface(
            {0.0, 0.05, 0.08, 0.12, 0.15, 0.3}, {-0.03, -0.02, -0.012, 0.0, 0.012, 0.02, 0.03},
            [](double x, double) { return x < 0.07 || x > 0.13 ? 10e-3 : 15e-3; });
        const DetectorScene scene(table, verify::makePaperCuboid());
        base::Random random({3, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 2000; ++i) {
            const Quaternion heading(
                Eigen::AngleAxisd(i % 4 == 0 ? 0.0 : random.uniform(0.0, 2.0 * base::kPi), Vec3::UnitZ()));
            const base::Pose pose{heading * lyingAlong(), Vec3(random.uniform(0.079, 0.121),
                                                               random.uniform(-0.028, 0.028), 17e-3 + gap)};
            for (const Contact& contact : scene.findAfresh(pose, 100e-6)) {
                QVERIFY2(contact.normal.z() > 0.98, qPrintable(QString("pose %1 %2, kind %3, gap %4 um")
                                                                   .arg(pose.position.x())
                                                                   .arg(pose.position.y())
                                                                   .arg(contact.feature >> 62U)
                                                                   .arg(contact.gap * 1e6)));
            }
        }
    }

    // The rear corners are just ahead of a crest that comes after them: as low as it is they slide over it, a
    // little lower they meet its flank.
    void whatSlidesOverACrestIsNotCaughtByItsFlank() {
        constexpr double kTop = 20.0 * kMillimetre;
        const DetectorScene scene(makeRidge(1.0 * kMillimetre, kTop), verify::makePaperCuboid());
        const auto countPushes = [&](double lower) {
            const base::Pose pose{
                lyingAlong(), Vec3(0.1 + 6.0 * kMillimetre + 20e-6, 0.0, kTop + 2.0 * kMillimetre - lower)};
            contact::Detector detector(scene.contactTrack, scene.contactBody);
            std::vector<Contact> contacts;
            detector.findContacts(pose, {Vec3(-40e-6, 0.0, 0.0), Vec3::Zero()}, 0.0, 50e-6, contacts);
            return std::ranges::count_if(contacts,
                                         [](const Contact& contact) { return contact.normal.x() > 0.5; });
        };
        for (const double lower : {0.0, 1e-9, 0.1e-6})
            QCOMPARE(countPushes(lower), 0);
        QVERIFY(countPushes(50e-6) >= 2);
    }

    // A peak under a face, near to the face's border: less deep beneath the side above that border than
    // beneath the face, but it is the face that it carries. Within the border's last micrometres it carries
    // what has sunk onto it.
    void aPeakNearABorderCarriesTheFaceAboveIt() {
        constexpr double kTop = 20.0 * kMillimetre;
        const auto track =
            verify::makeSurface({0.0, 0.09, 0.1, 0.11, 0.3}, {-0.03, -0.01, 0.0, 0.01, 0.03},
                                [=](double x, double y) { return x == 0.1 && y == 0.0 ? kTop : 18e-3; });
        const DetectorScene scene(track, verify::makePaperCuboid());
        const auto countCarrying = [&](double depth, double inside) {
            const base::Pose pose{lyingAlong(),
                                  Vec3(0.1, 4.0 * kMillimetre - inside, kTop + 2.0 * kMillimetre - depth)};
            const auto contacts = scene.findAfresh(pose, kMargin);
            return std::ranges::count_if(contacts, [&](const Contact& contact) {
                return isNear(contact.point, Vec3(0.1, 0.0, kTop)) &&
                       isNear(contact.normal, Vec3::UnitZ(), 1e-9) && std::abs(contact.gap + depth) < 1e-9;
            });
        };
        QCOMPARE(countCarrying(8e-6, 50e-6), 1);
        QCOMPARE(countCarrying(80e-6, 50e-6), 1);
        QCOMPARE(countCarrying(8e-6, 3e-6), 1);
        QCOMPARE(countCarrying(3e-6, 3e-6), 0);   // the border's ridges do
        QCOMPARE(countCarrying(8e-6, -3e-6), 0);  // it is beside the part
    }

    // What of the track rises beside a part is not above its face, nor what leaves the part through another.
    void aValleysEndCarriesWhatHasSunkOntoIt() {
        for (const testing::SunkenScene& sunken :
             {testing::makeSunkenBesideRise(), testing::makeSunkenInValley()}) {
            const DetectorScene scene(sunken.track, verify::makePaperCuboid());
            QVERIFY(std::ranges::any_of(scene.findAfresh(sunken.pose, kMargin), [&](const Contact& contact) {
                return isNear(contact.point, sunken.vertex) && isNear(contact.normal, sunken.normal, 1e-9) &&
                       std::abs(contact.gap + sunken.depth) < 1e-9;
            }));
        }
    }

    // Where part and track are a few micrometres apart the nearest contact is as far away as plain geometry
    // over all features says.
    void theNearestContactIsTheDistance() {
        const DetectorScene scene(verify::makeRough(), verify::makePaperCuboid());
        base::Random random({2, 0, 0, 0, base::Purpose::test});
        int compared = 0;
        int same = 0;
        for (int i = 0; i < 150; ++i) {
            base::Pose pose = testing::drawPose(scene, random, 1e-3);
            const double wanted = random.uniform(1e-6, 50e-6);
            double distance = 0.0;
            for (int k = 0; k < 200; ++k) {
                distance = testing::calcDistance(scene.part->hull, pose, scene.track->solid);
                if (distance - wanted < 1e-7) break;
                pose.position.z() -= distance - wanted;
            }
            if (distance - wanted >= 1e-7) continue;
            const auto contacts = scene.findAfresh(pose, 100e-6);
            double nearest = 1e300;
            for (const Contact& contact : contacts)
                nearest = std::min(nearest, contact.gap);
            ++compared;
            same += std::abs(nearest - distance) < 1e-9 ? 1 : 0;
        }
        QVERIFY(compared > 100);
        // Edges that are nearly flat or nearly parallel to the part's do not act; elsewhere it is exact.
        QVERIFY2(same > compared * 95 / 100, qPrintable(QString("%1 of %2").arg(same).arg(compared)));
    }
};

QTEST_APPLESS_MAIN(DetectorTest)
#include "detector_test.moc"
