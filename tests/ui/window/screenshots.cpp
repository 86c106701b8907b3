// Takes a picture of every page of a study, of the welcome, the tour, the help and the dialogs, in the
// window's own process: screenshots OUT STUDY WIDTHxHEIGHT THEME NAME. packaging/screenshots.sh calls it for
// each size and theme.

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPixmap>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>

#include "sim/engines/registry.h"
#include "ui/look/message_bar.h"
#include "ui/pages/page.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/window/main_window.h"

namespace {

using namespace trapwright;

constexpr int kSettle = 2500;  // [ms] for what a page loads in the background

class Camera {
 public:
    Camera(QString folder, QString name) : folder_(std::move(folder)), name_(std::move(name)) {}

    void take(QWidget& window, const QString& subject) {
        QTest::qWait(kSettle);
        const QString file = QString("%1/%2-%3.png").arg(folder_, subject, name_);
        // From the screen: what is drawn over the 3D scene and what is open above the window belongs to it.
        const QPixmap picture = window.screen()->grabWindow(window.winId());
        failed_ = !picture.save(file) || failed_;
        std::puts(qPrintable(file));
    }
    [[nodiscard]] bool failed() const { return failed_; }

 private:
    QString folder_;
    QString name_;
    bool failed_ = false;
};

}  // namespace

int main(int argc, char** argv) {
    QTemporaryDir home;
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, home.path());
    qputenv("XDG_DATA_HOME", home.path().toLocal8Bit());
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName("Trapwright");
    QCoreApplication::setApplicationName("screenshots");
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.size() != 6) {
        std::fputs("screenshots OUT STUDY WIDTHxHEIGHT THEME NAME\n", stderr);
        return 2;
    }
    const QStringList size = arguments[3].split('x');
    QSettings().setValue("theme", arguments[4]);
    Camera camera(arguments[1], arguments[5]);

    window::MainWindow window({engines::registry(), "trapwright", {}});
    window.resize(size.at(0).toInt(), size.at(1).toInt());
    window.show();
    if (!QTest::qWaitForWindowExposed(&window)) {
        std::fputs("screenshots: the window was not shown\n", stderr);
        return 1;
    }
    camera.take(window, "welcome");

    window.openFile(arguments[2].toStdString());
    if (!QTest::qWaitFor([&] { return window.desk().session() != nullptr; }, 30000)) {
        std::fprintf(stderr, "screenshots: %s was not opened: %s\n", qPrintable(arguments[2]),
                     qPrintable(window.findChild<look::MessageBar*>()->text()));
        return 1;
    }
    for (const pages::Page* page : window.findChildren<pages::Page*>()) {
        window.showPage(page->face().name);
        camera.take(window, page->face().name);
    }
    window.showPage("review");
    auto* robustness = window.findChild<QAction*>("review.robustness");
    if (robustness->isEnabled()) {
        robustness->trigger();
        auto* head = window.findChild<QLabel*>("review.robustness.head");
        if (!QTest::qWaitFor([&] { return !head->isHidden(); }, 600000))
            std::fputs("screenshots: robustness is not known after ten minutes\n", stderr);
        camera.take(window, "review-robustness");
    }
    // A bed that is too small for the track, and the track in pieces for it.
    window.showPage("export");
    auto* printers = window.findChild<QComboBox*>("print.printer");
    printers->setCurrentIndex(printers->findData("prusa-mini"));
    emit printers->activated(printers->currentIndex());
    camera.take(window, "export-too-large");
    auto* split = window.findChild<QComboBox*>("print.split");
    split->setCurrentIndex(1);
    emit split->activated(1);
    camera.take(window, "export-pieces");
    window.findChild<QCheckBox*>("print.apart")->click();
    camera.take(window, "export-apart");
    window.findChild<QAction*>("help.tour")->trigger();
    for (int step = 1; auto* next = window.findChild<QPushButton*>("tour.next"); ++step) {
        camera.take(window, QString("tour-%1").arg(step));
        next->click();
        QTest::qWait(1);
    }
    window.showPage("track");
    window.findChild<QAction*>("help.open")->trigger();
    camera.take(*window.findChild<QWidget*>("window.help"), "help");
    window.findChild<QWidget*>("window.help")->close();
    if (!window.desk().session()->design().locked()) {
        window.showPage("track");
        study::Settings settings = window.desk().session()->design().settings();
        settings.track.crossSections = 0;
        settings.track.shape.type = track::FeederType::bowl;
        settings.track.leadInLength = 70e-3;
        window.desk().session()->design().changeSettings(settings, "Mistakes");
        camera.take(window, "mistakes");
        settings.track.crossSections = 5;
        window.desk().session()->design().changeSettings(settings, "Bowl");
        window.findChild<QAction*>(arguments[4] == "dark" ? "theme.light" : "theme.dark")->trigger();
        camera.take(window, "bowl");
    }
    window.findChild<QAction*>("help.shortcuts")->trigger();
    camera.take(*QApplication::activeModalWidget(), "shortcuts");
    QApplication::activeModalWidget()->close();
    window.desk().close(true);
    camera.take(window, "recent");
    return camera.failed() ? 1 : 0;
}
