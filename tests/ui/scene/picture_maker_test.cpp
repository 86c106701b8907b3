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
        const QImage cuboid = maker.trackPicture(samples::loadTrack("cuboid_track.json"), size).result();
        const QImage cone = maker.trackPicture(samples::loadTrack("cone_track.json"), size).result();
        QCOMPARE(cuboid.size(), size);
        QVERIFY(samples::shareChanged(cuboid, cone) > 0.05);
        QCOMPARE(maker.trackPicture(samples::loadTrack("cuboid_track.json"), size).result(), cuboid);
    }

    void cardsShowTheOrientation() {
        PictureMaker maker;
        const auto part = samples::loadPart("cuboid");
        QVERIFY(part->stablePoses.size() > 2);
        const QImage flat = maker.partPicture(part, part->stablePoses.front().rotation, {128, 128}).result();
        const QImage upright =
            maker.partPicture(part, part->stablePoses.back().rotation, {128, 128}).result();
        const QColor warm = scene::SceneTheme::light().part;
        QVERIFY(samples::shareOfHue(flat, warm) > 0.1);
        QVERIFY(samples::shareChanged(flat, upright) > 0.1);
    }

    void themeIsKept() {
        PictureMaker maker;
        const auto track = samples::loadTrack("cone_track.json");
        const double light = samples::meanLightness(maker.trackPicture(track, {96, 54}).result());
        maker.setTheme(scene::SceneTheme::dark());
        QVERIFY(samples::meanLightness(maker.trackPicture(track, {96, 54}).result()) < light - 0.3);
    }

    /// Who goes while a picture is being drawn leaves an end to those who wait for it.
    void everyPictureEnds() {
        QList<QFuture<QImage>> pictures;
        {
            PictureMaker maker;
            const auto track = samples::loadTrack("cone_track.json");
            for (int i = 0; i < 20; ++i)
                pictures << maker.trackPicture(track, {640, 360});
        }
        for (const QFuture<QImage>& picture : pictures)
            QVERIFY(picture.isFinished());
        QVERIFY(pictures.last().result().isNull());
    }

    void nothingGivesNoFailure() {
        PictureMaker maker;
        QVERIFY(maker.trackPicture(samples::loadTrack("cone_track.json"), {}).result().isNull());
        QVERIFY(!maker.trackPicture(nullptr, {96, 54}).result().isNull());
    }
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    PictureMakerTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "picture_maker_test.moc"
