// The window for hours on end: memory while a study learns thousands of generations, while runs are started
// and stopped, and how quick a large study is to open and to look through. Called by tests/studies/soak.sh:
//     soak learn STUDY GENERATIONS | soak restart STUDY TIMES | soak open STUDY

#include <QAbstractItemView>
#include <QApplication>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QScrollBar>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "sim/engines/registry.h"
#include "tests/ui/footprint.h"
#include "ui/look/message_bar.h"
#include "ui/pages/page.h"
#include "ui/session/study_runs.h"
#include "ui/window/main_window.h"

namespace {

using namespace trapwright;
using session::RunState;

constexpr int kPatience = 60000;  // [ms]

void print(const char* what, int count) {
    const tests::Footprint now = tests::measureFootprint();
    std::printf("%-12s %6d   resident %7.1f MiB, heap in use %7.1f MiB, %3d threads, %3d open files\n", what,
                count, now.resident, now.used, now.threads, now.files);
    std::fflush(stdout);
}

int fail(const char* what, const window::MainWindow& window) {
    std::fprintf(stderr, "soak: %s: %s\n", what,
                 qPrintable(window.findChild<look::MessageBar*>("messageBar")->text()));
    return 1;
}

/// [ms] since the event loop got to rest after what was done.
template <class Do>
double timed(Do act) {
    QElapsedTimer clock;
    clock.start();
    act();
    QCoreApplication::sendPostedEvents();
    QCoreApplication::processEvents();
    return 1e-6 * static_cast<double>(clock.nsecsElapsed());
}

int learn(window::MainWindow& window, int generations) {
    session::StudySession& session = *window.desk().session();
    window.showPage("evolve");
    session.runs().startLearning();
    print("generations", static_cast<int>(session.runs().summaries().size()));
    const int step = std::max(1, generations / 20);
    for (int next = step; next <= generations; next += step) {
        while (static_cast<int>(session.runs().summaries().size()) < next &&
               session.runs().state() == RunState::learning)
            QTest::qWait(20);
        if (static_cast<int>(session.runs().summaries().size()) < next) return fail("learning ended", window);
        print("generations", static_cast<int>(session.runs().summaries().size()));
    }
    session.runs().stopNow();
    return QTest::qWaitFor([&] { return session.runs().state() == RunState::idle; }, kPatience) ? 0 : 1;
}

int restart(window::MainWindow& window, int times) {
    session::StudySession& session = *window.desk().session();
    window.showPage("evolve");
    print("starts", 0);
    for (int i = 1; i <= times; ++i) {
        session.runs().startLearning();
        if (session.runs().state() == RunState::idle) return fail("it did not start", window);
        // Now and then in the first moment, now and then some generations later.
        QTest::qWait(i % 10 * 5);
        session.runs().stopNow();
        if (!QTest::qWaitFor([&] { return session.runs().state() == RunState::idle; }, kPatience))
            return fail("it did not stop", window);
        if (i % std::max(1, times / 20) == 0) print("starts", i);
    }
    return 0;
}

/// Every list and table of every page, through it page by page and from end to end.
int scroll(window::MainWindow& window) {
    for (const pages::Page* page : window.findChildren<pages::Page*>()) {
        const QString name = page->face().name;
        std::printf("page %-9s shown after %6.1f ms\n", qPrintable(name),
                    timed([&] { window.showPage(name); }));
        QTest::qWait(1000);
        for (QAbstractItemView* view : window.findChildren<QAbstractItemView*>()) {
            if (view->model() == nullptr || view->model()->rowCount() < 100) continue;
            for (QWidget* parent = view; parent != nullptr; parent = parent->parentWidget())
                if (auto* dock = qobject_cast<QDockWidget*>(parent)) dock->raise();
            QTest::qWait(100);
            if (!view->isVisible()) continue;
            std::vector<double> steps;
            for (QScrollBar* bar : {view->verticalScrollBar(), view->horizontalScrollBar()}) {
                if (bar->maximum() == 0) continue;
                for (int i = 0; i < 50; ++i)
                    steps.push_back(timed([&] { bar->triggerAction(QAbstractSlider::SliderPageStepAdd); }));
                for (int i = 0; i <= 20; ++i)
                    steps.push_back(timed([&] { bar->setValue(bar->maximum() / 20 * i); }));
            }
            if (steps.empty()) continue;
            std::sort(steps.begin(), steps.end());
            std::printf("    %-28s %6d rows: a step %5.1f ms, the slowest %6.1f ms\n",
                        qPrintable(view->objectName()), view->model()->rowCount(), steps[steps.size() / 2],
                        steps.back());
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const QTemporaryDir home;
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, home.path());
    qputenv("XDG_DATA_HOME", home.path().toLocal8Bit());
    const QApplication application(argc, argv);
    QCoreApplication::setOrganizationName("Trapwright");
    QCoreApplication::setApplicationName("soak");
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.size() < 3) {
        std::fputs("soak learn STUDY GENERATIONS | soak restart STUDY TIMES | soak open STUDY\n", stderr);
        return 2;
    }
    window::MainWindow window({engines::registry(), "trapwright", home.filePath("running").toStdString()});
    window.resize(1280, 720);
    window.show();
    if (!QTest::qWaitForWindowExposed(&window)) return fail("the window was not shown", window);

    QElapsedTimer clock;
    clock.start();
    const std::clock_t processor = std::clock();
    window.openFile(arguments[2].toStdString());
    if (!QTest::qWaitFor([&] { return window.desk().session() != nullptr; }, kPatience))
        return fail("the study was not opened", window);
    QCoreApplication::processEvents();
    std::printf("opened after %.2f s, %.2f s of a processor: %zu generations\n",
                1e-3 * static_cast<double>(clock.elapsed()),
                static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC,
                window.desk().session()->runs().summaries().size());
    const int count = arguments.size() > 3 ? arguments[3].toInt() : 0;
    if (arguments[1] == "learn") return learn(window, count);
    if (arguments[1] == "restart") return restart(window, count);
    return scroll(window);
}
