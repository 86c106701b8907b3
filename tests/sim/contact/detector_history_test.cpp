#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "detector_scenes.h"

using namespace trapwright;
using base::Quaternion;
using base::Vec3;
using contact::Contact;
using testing::DetectorScene;

namespace {

std::vector<Contact> sorted(std::vector<Contact> contacts) {
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& a, const Contact& b) { return a.feature < b.feature; });
    return contacts;
}

bool isSame(const Contact& a, const Contact& b) {
    return a.feature == b.feature && a.gap == b.gap && a.point == b.point && a.normal == b.normal;
}

Vec3 drawVector(base::Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Two pieces, so that their features are told apart: an L of cuboids.
std::shared_ptr<const part::Part> makeL() {
    auto part = std::make_shared<part::Part>(*verify::makePaperCuboid());
    geometry::ConvexPolytope arm = part->hull;
    const Vec3 shift(6e-3, 0.0, -4e-3);
    for (Vec3& vertex : arm.vertices)
        vertex += shift;
    for (geometry::PolytopeFace& face : arm.faces)
        face.offset += face.normal.dot(shift);
    part->pieces.push_back(arm);
    return part;
}

}  // namespace

class DetectorHistoryTest : public QObject {
    Q_OBJECT

 private slots:
    void historyDoesNotMatter_data() {
        QTest::addColumn<double>("pace");
        QTest::addColumn<bool>("twoPieces");
        QTest::newRow("creeping") << 2e-6 << false;
        QTest::newRow("0.1 m/s") << 20e-6 << false;
        QTest::newRow("1 m/s") << 200e-6 << false;
        QTest::newRow("10 m/s") << 2e-3 << false;
        QTest::newRow("1 m/s, two pieces") << 200e-6 << true;
    }
    // Along paths that hover over the rough track and dip into it, a detector that knows only how far the
    // part has moved since finds exactly what one finds that looks for the first time.
    void historyDoesNotMatter() {
        QFETCH(double, pace);
        QFETCH(bool, twoPieces);
        const DetectorScene scene(verify::makeRough(), twoPieces ? makeL() : verify::makePaperCuboid());
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        int touching = 0;
        for (int path = 0; path < 8; ++path) {
            base::Pose pose = testing::drawPose(scene, random, 1e-4);
            contact::Detector detector(scene.contactTrack, scene.contactBody);
            std::vector<Contact> contacts;
            double moved = 0.0;
            for (int step = 0; step < 150; ++step) {
                const double margin = step % 7 == 0 ? random.uniform(0.0, 1e-3) : 10e-6;
                detector.findContacts(pose, {}, moved, margin, contacts);
                const auto got = sorted(contacts);
                const auto expected = sorted(scene.findAfresh(pose, margin));
                QCOMPARE(got.size(), expected.size());
                for (std::size_t i = 0; i < got.size(); ++i)
                    QVERIFY(isSame(got[i], expected[i]));
                touching += got.empty() ? 0 : 1;

                // Walk, and turn back where it flies off or sinks in.
                base::Pose next;
                const Vec3 turn = drawVector(random, pace / scene.contactBody.radius);
                next.rotation =
                    (Quaternion(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * pose.rotation)
                        .normalized();
                next.position = pose.position + drawVector(random, pace);
                const double clearance = testing::findClearance(scene, next);
                if (clearance > 2e-3) next.position.z() -= pace;
                if (clearance < -0.3e-3) next.position.z() += pace;
                moved = (next.position - pose.position).norm() +
                        next.rotation.angularDistance(pose.rotation) * scene.contactBody.radius + 1e-9;
                pose = next;
            }
        }
        QVERIFY2(touching > 100, qPrintable(QString::number(touching)));
    }

    // Turning track and part about the vertical turns the contacts along.
    void contactsTurnWithTheScene() {
        const DetectorScene scene(verify::makeRough(), verify::makePaperCuboid());
        base::Random random({2, 0, 0, 0, base::Purpose::test});
        int found = 0;
        for (int i = 0; i < 40; ++i) {
            const base::Pose turn{
                Quaternion(Eigen::AngleAxisd(random.uniform(0.0, 2.0 * base::kPi), Vec3::UnitZ())),
                Vec3::Zero()};
            auto turnedTrack = std::make_shared<track::Track>(*scene.track);
            for (Vec3& vertex : turnedTrack->solid.vertices)
                vertex = turn.apply(vertex);
            const DetectorScene turned(turnedTrack, scene.part);
            for (int k = 0; k < 10; ++k) {
                const base::Pose pose = testing::drawPose(scene, random, -20e-6);
                const base::Pose turnedPose{turn.rotation * pose.rotation, turn.apply(pose.position)};
                const auto expected = sorted(scene.findAfresh(pose, 50e-6));
                const auto got = sorted(turned.findAfresh(turnedPose, 50e-6));
                QCOMPARE(got.size(), expected.size());
                for (std::size_t c = 0; c < got.size(); ++c) {
                    QCOMPARE(got[c].feature, expected[c].feature);
                    QVERIFY(std::abs(got[c].gap - expected[c].gap) < 1e-12);
                    QVERIFY((got[c].point - turn.apply(expected[c].point)).norm() < 1e-12);
                    QVERIFY((got[c].normal - turn.rotation * expected[c].normal).norm() < 1e-9);
                    ++found;
                }
            }
        }
        QVERIFY(found > 300);
    }
};

QTEST_APPLESS_MAIN(DetectorHistoryTest)
#include "detector_history_test.moc"
