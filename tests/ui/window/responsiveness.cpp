// How quick the window is: time to its first frame, how late events are answered while it does nothing and
// while a study learns on every processor, also while the scene is turned, and the memory that it takes:
// responsiveness STUDY GENERATIONS.
// tests/studies/responsiveness.sh calls it.

#include <unistd.h>
#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <QTimer>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "sim/engines/registry.h"
#include "tests/ui/session/event_loop_probe.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_runs.h"
#include "ui/window/main_window.h"

namespace {

using namespace trapwright;

constexpr int kPatience = 60000;  // [ms]
constexpr int kLook = 10000;      // [ms]

/// Since the process was started, before it was loaded. [ms]
double processAge() {
    std::ifstream stat("/proc/self/stat");
    std::string text((std::istreambuf_iterator<char>(stat)), {});
    // proc(5): the 22nd field; the second, in brackets, may have spaces.
    std::istringstream rest(text.substr(text.rfind(')') + 2));
    constexpr int kFieldsBefore = 19;
    std::string skipped;
    for (int i = 0; i < kFieldsBefore; ++i)
        rest >> skipped;
    double ticks = 0.0;
    rest >> ticks;
    double uptime = 0.0;
    std::ifstream("/proc/uptime") >> uptime;
    return 1e3 * (uptime - ticks / static_cast<double>(::sysconf(_SC_CLK_TCK)));
}

/// [MiB]
double residentMemory() {
    double all = 0.0;
    double resident = 0.0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// Notes which of the window's events took the longest to handle.
class Application : public QApplication {
 public:
    using QApplication::QApplication;

    bool notify(QObject* receiver, QEvent* event) override {
        if (QThread::currentThread() != thread()) return QApplication::notify(receiver, event);
        const QString what = QString("%1 '%2' event %3")
                                 .arg(receiver->metaObject()->className(), receiver->objectName())
                                 .arg(event->type());
        QElapsedTimer clock;
        clock.start();
        const bool handled = QApplication::notify(receiver, event);
        if (clock.nsecsElapsed() > longest_) {
            longest_ = clock.nsecsElapsed();
            what_ = what;
        }
        return handled;
    }
    /// Since the last call.
    QString takeLongest() {
        return QString("%1 ms in %2")
            .arg(1e-6 * static_cast<double>(std::exchange(longest_, 0)), 0, 'f', 1)
            .arg(what_);
    }

 private:
    qint64 longest_ = 0;  // [ns]
    QString what_;
};

/// Counts how often a widget is painted.
class PaintCount : public QObject {
 public:
    explicit PaintCount(QWidget& widget) { widget.installEventFilter(this); }
    bool eventFilter(QObject* /*watched*/, QEvent* event) override {
        if (event->type() == QEvent::Paint) ++count_;
        return false;
    }
    int take() { return std::exchange(count_, 0); }

 private:
    int count_ = 0;
};

void watch(const char* what, int duration, const session::StudySession& session, PaintCount& scene) {
    (void)scene.take();
    static_cast<Application*>(qApp)->takeLongest();
    const session::EventDelays delays = session::watchEvents(duration);
    std::printf(
        "%-24s worst %6.1f ms, 99.9 %% %6.1f ms, %5d events, scene painted %4.1f times/s, %3zu generations, "
        "%5.0f MiB\n",
        what, delays.worst, delays.most, delays.events, 1e3 * scene.take() / duration,
        session.runs().summaries().size(), residentMemory());
    std::printf("    longest: %s\n", qPrintable(static_cast<Application*>(qApp)->takeLongest()));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const QTemporaryDir home;
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, home.path());
    qputenv("XDG_DATA_HOME", home.path().toLocal8Bit());
    const Application application(argc, argv);
    QCoreApplication::setOrganizationName("Trapwright");
    QCoreApplication::setApplicationName("responsiveness");
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.size() != 3) {
        std::fputs("responsiveness STUDY GENERATIONS\n", stderr);
        return 2;
    }
    const auto generations = static_cast<std::size_t>(arguments[2].toInt());

    window::MainWindow window({engines::registry(), "trapwright", {}});
    window.resize(1280, 720);
    window.show();
    if (!QTest::qWaitForWindowExposed(&window)) return 1;
    QCoreApplication::processEvents();
    std::printf("first frame after %.0f ms\n", processAge());

    window.openFile(arguments[1].toStdString());
    if (!QTest::qWaitFor([&] { return window.desk().session() != nullptr; }, kPatience)) return 1;
    session::StudySession& session = *window.desk().session();
    window.showPage("evolve");
    auto* scene = window.findChild<scene::SceneView*>("scene");
    PaintCount paints(*scene);
    constexpr int kSettle = 2000;  // [ms]
    QTest::qWait(kSettle);
    watch("idle", kLook / 2, session, paints);
    const std::size_t before = session.runs().summaries().size();
    session.runs().startLearning();
    QTimer turning;             // the scene, as with the mouse
    constexpr int kMouse = 16;  // [ms]
    turning.setInterval(kMouse);
    QObject::connect(&turning, &QTimer::timeout, scene, [scene] { QTest::keyClick(scene, Qt::Key_Right); });
    while (session.runs().summaries().size() < before + generations &&
           session.runs().state() == session::RunState::learning) {
        watch("learning", kLook, session, paints);
        turning.start();
        watch("learning, scene turns", kLook, session, paints);
        turning.stop();
    }
    session.runs().stopNow();
    (void)QTest::qWaitFor([&] { return session.runs().state() == session::RunState::idle; }, kPatience);
    watch("idle again", kLook / 2, session, paints);
    return 0;
}
