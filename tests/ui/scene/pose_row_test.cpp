#include "ui/scene/pose_row.h"

#include <QTest>

#include "tests/ui/scene/scene_samples.h"

using namespace trapwright;

class PoseRowTest : public QObject {
    Q_OBJECT

 private slots:
    void partsStandOnTheFlatSideBySide_data() {
        QTest::addColumn<QString>("name");
        for (const part::BundledPart& entry : part::listBundledParts())
            QTest::newRow(entry.name.data()) << QString::fromUtf8(entry.name.data());
    }

    void partsStandOnTheFlatSideBySide() {
        QFETCH(QString, name);
        const auto part = samples::loadPart(qPrintable(name));
        const scene::PoseRow row = scene::makePoseRow(*part);
        QCOMPARE(row.poses.size(), part::findPoseGroups(*part).size());
        QCOMPARE(row.labels.size(), row.poses.size());
        double left = row.flat.low.x();
        for (std::size_t i = 0; i < row.poses.size(); ++i) {
            const geometry::Box box = scene::boxOf(*part, row.poses[i]);
            QVERIFY(std::abs(box.low.z()) < 1e-9);
            // The stable pose's own height, found another way.
            const auto stable = static_cast<std::size_t>(row.groups[i].poses.front());
            QVERIFY(std::abs(row.poses[i].position.z() - part->stablePoses[stable].height) < 1e-5);
            QVERIFY(box.low.x() > left);
            QVERIFY(box.low.y() > row.flat.low.y() && box.high.y() < row.flat.high.y());
            QVERIFY(row.labels[i].y() < box.low.y());
            left = box.high.x();
        }
        QVERIFY(left < row.flat.high.x());
    }

    void aPartWithoutStablePosesHasAnEmptyRow() { QVERIFY(scene::makePoseRow(part::Part()).poses.empty()); }
};

QTEST_APPLESS_MAIN(PoseRowTest)
#include "pose_row_test.moc"
