#include "ui/scene/picture_maker.h"

#include <QApplication>
#include <QTest>

#include "tests/ui/scene/scene_samples.h"
#include "ui/scene/scene_view.h"

using namespace trapwright;
using scene::PictureMaker;

class PictureMakerTest : public QObject {
    Q_OBJECT

 private slots:
    void filmStripShowsWhichTrackIsWhich() {
        PictureMaker maker;
        const QSize size(192, 108);
        const QImage cuboid = maker.trackPicture(samples::loadTrack("cuboid_track.json"), size);
        const QImage cone = maker.trackPicture(samples::loadTrack("cone_track.json"), size);
        QCOMPARE(cuboid.size(), size);
        QVERIFY(samples::shareChanged(cuboid, cone) > 0.05);
        QCOMPARE(maker.trackPicture(samples::loadTrack("cuboid_track.json"), size), cuboid);
    }

    void cardsShowTheOrientation() {
        PictureMaker maker;
        const auto part = samples::loadPart("cuboid");
        QVERIFY(part->stablePoses.size() > 2);
        const QImage flat = maker.partPicture(part, part->stablePoses.front().rotation, {128, 128});
        const QImage upright = maker.partPicture(part, part->stablePoses.back().rotation, {128, 128});
        const QColor warm = scene::SceneTheme::light().part;
        QVERIFY(samples::shareOfHue(flat, warm) > 0.1);
        QVERIFY(samples::shareChanged(flat, upright) > 0.1);
    }

    void themeIsKept() {
        PictureMaker maker;
        const auto track = samples::loadTrack("cone_track.json");
        const double light = samples::meanLightness(maker.trackPicture(track, {96, 54}));
        maker.setTheme(scene::SceneTheme::dark());
        QVERIFY(samples::meanLightness(maker.trackPicture(track, {96, 54})) < light - 0.3);
    }

    void nothingGivesNoFailure() {
        PictureMaker maker;
        QVERIFY(maker.trackPicture(samples::loadTrack("cone_track.json"), {}).isNull());
        QVERIFY(!maker.trackPicture(nullptr, {96, 54}).isNull());
    }
};

int main(int argc, char** argv) {
    scene::SceneView::prepareApplication();
    QApplication application(argc, argv);
    PictureMakerTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "picture_maker_test.moc"
