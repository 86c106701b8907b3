#include <QApplication>
#include <QSignalSpy>
#include <QTest>

#include "tests/ui/scene/scene_samples.h"
#include "ui/scene/picture_maker.h"

using namespace trapwright;

/// A display without OpenGL.
class WithoutOpenglTest : public QObject {
    Q_OBJECT

 private slots:
    void theSceneTellsOnceAndGoesOn() {
        const auto track = samples::loadTrack("cuboid_track.json");
        scene::SceneView view;
        QSignalSpy failures(&view, &scene::SceneView::failed);
        view.resize(320, 200);
        view.showTrack(track);
        view.show();
        QTRY_COMPARE(failures.size(), 1);
        const QString message = failures.first().first().toString();
        QVERIFY2(message.contains("OpenGL") && message.contains("driver"), qPrintable(message));
        view.setHeightShading(true);
        QTest::qWait(200);
        QCOMPARE(failures.size(), 1);
        QVERIFY(view.isSettled());
        QVERIFY(view.picture({320, 200}).result().isNull());
        // In the theme's colours.
        QVERIFY(samples::meanLightness(view.grab().toImage()) > 0.7);
    }

    void smallPicturesAreNull() {
        scene::PictureMaker maker;
        QVERIFY(maker.trackPicture(samples::loadTrack("cone_track.json"), {96, 54}).result().isNull());
    }
};

int main(int argc, char** argv) {
    qputenv("QT_XCB_GL_INTEGRATION", "none");
    QApplication application(argc, argv);
    WithoutOpenglTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "without_opengl_test.moc"
