#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QOpenGLContext>
#include <QSignalSpy>
#include <QTest>

#include "tests/ui/scene/scene_samples.h"
#include "ui/scene/scene_view.h"

using namespace trapwright;
using scene::SceneView;

/// Runs twice: with shared OpenGL contexts, as the studio has them, and without. With them Qt keeps the
/// view's context when it moves to another window; without them the context goes, and everything in it.
class UndockingTest : public QObject {
    Q_OBJECT

 private slots:
    void pictureSurvivesTheMoveToAnotherWindow() {
        const auto cuboidTrack = samples::loadTrack("cuboid_track.json");
        const auto coneTrack = samples::loadTrack("cone_track.json");
        QMainWindow window;
        window.resize(900, 700);
        auto* dock = new QDockWidget(&window);
        auto* view = new SceneView;
        view->setAlwaysSmooth(true);
        view->setFixedSize(600, 300);
        dock->setWidget(view);
        window.setCentralWidget(new QWidget);
        window.addDockWidget(Qt::BottomDockWidgetArea, dock);
        window.show();
        QVERIFY(QTest::qWaitForWindowExposed(&window));
        view->showTrack(cuboidTrack);
        QTest::qWait(50);
        const QImage docked = view->grabFramebuffer();
        for (int round = 0; round < 3; ++round) {
            QSignalSpy lost(view->context(), &QOpenGLContext::aboutToBeDestroyed);
            dock->setFloating(true);
            QTest::qWait(50);
            QCOMPARE(lost.isEmpty(), QCoreApplication::testAttribute(Qt::AA_ShareOpenGLContexts));
            QVERIFY(samples::shareChanged(docked, view->grabFramebuffer()) < 0.002);
            view->showTrack(coneTrack);
            QVERIFY(samples::shareChanged(docked, view->grabFramebuffer()) > 0.05);
            view->showTrack(cuboidTrack);
            dock->setFloating(false);
            QTest::qWait(50);
            QVERIFY(samples::shareChanged(docked, view->grabFramebuffer()) < 0.002);
        }
        view->setParent(nullptr);
        view->show();
        QVERIFY(QTest::qWaitForWindowExposed(view));
        QVERIFY(samples::shareChanged(docked, view->grabFramebuffer()) < 0.002);
        delete view;
    }
};

int main(int argc, char** argv) {
    SceneView::prepareApplication();
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts,
                                   !qEnvironmentVariableIsSet("UNSHARED_CONTEXTS"));
    QApplication application(argc, argv);
    UndockingTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "undocking_test.moc"
