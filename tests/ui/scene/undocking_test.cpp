#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QTest>

#include "tests/ui/scene/scene_samples.h"
#include "ui/scene/scene_view.h"

using namespace trapwright;
using scene::SceneView;

/// Moving the view to another window leaves its picture as it is.
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
        view->setFixedSize(600, 300);
        dock->setWidget(view);
        window.setCentralWidget(new QWidget);
        window.addDockWidget(Qt::BottomDockWidgetArea, dock);
        window.show();
        QVERIFY(QTest::qWaitForWindowExposed(&window));
        view->showTrack(cuboidTrack);
        QTest::qWait(50);
        const QImage docked = samples::grabSettled(*view);
        for (int round = 0; round < 3; ++round) {
            dock->setFloating(true);
            QTest::qWait(50);
            QVERIFY(samples::shareChanged(docked, samples::grabSettled(*view)) < 0.002);
            view->showTrack(coneTrack);
            QVERIFY(samples::shareChanged(docked, samples::grabSettled(*view)) > 0.05);
            view->showTrack(cuboidTrack);
            dock->setFloating(false);
            QTest::qWait(50);
            QVERIFY(samples::shareChanged(docked, samples::grabSettled(*view)) < 0.002);
        }
        view->setParent(nullptr);
        view->show();
        QVERIFY(QTest::qWaitForWindowExposed(view));
        QVERIFY(samples::shareChanged(docked, samples::grabSettled(*view)) < 0.002);
        delete view;
    }
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    UndockingTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "undocking_test.moc"
