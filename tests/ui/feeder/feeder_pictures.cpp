// Takes pictures of the page Validate in the middle of a validation: feeder_pictures OUT THEME [WIDTH
// HEIGHT]. The report is written there as well.

#include <QDockWidget>
#include <QScreen>
#include <cstdio>

#include "tests/ui/feeder/operator.h"
#include "ui/feeder/report_card.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::feeder;

namespace {

constexpr int kSettle = 1500;  // [ms] for what is drawn in the background

class Camera {
 public:
    Camera(QString folder, QString theme) : folder_(std::move(folder)), theme_(std::move(theme)) {}

    void take(window::MainWindow& window, const QString& subject) const {
        QTest::qWait(kSettle);
        const QString file = QString("%1/%2-%3.png").arg(folder_, subject, theme_);
        // From the screen: what is drawn over the 3D scene belongs to it.
        if (window.screen()->grabWindow(window.winId()).save(file)) std::puts(qPrintable(file));
    }

 private:
    QString folder_;
    QString theme_;
};

void makeTrials(Operator& user, int count) {
    const Qt::Key outcomes[] = {Qt::Key_S, Qt::Key_S, Qt::Key_S, Qt::Key_S, Qt::Key_1,
                                Qt::Key_S, Qt::Key_S, Qt::Key_2, Qt::Key_S};
    for (int i = 0; i < count; ++i) {
        user.press(Qt::Key_Space);
        QTest::qWait(30);
        user.press(outcomes[static_cast<std::size_t>(i) % std::size(outcomes)]);
    }
}

}  // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.size() != 3 && arguments.size() != 5) {
        std::fputs("feeder_pictures OUT THEME [WIDTH HEIGHT]\n", stderr);
        return 2;
    }
    pages::LearnedStudy study("feeder_pictures");
    if (!study.learn()) return 1;
    const Camera camera(arguments[1], arguments[2]);
    Bench bench;
    Operator user(bench, study.copy());
    if (arguments.size() == 5) user.window.resize(arguments[3].toInt(), arguments[4].toInt());
    user.find<QAction>("theme." + arguments[2])->trigger();
    camera.take(user.window, "validate-empty");
    user.click("plan.new");
    camera.take(user.window, "validate-plan");
    user.click("plan.cancel");
    const auto winner = user.session()->runs().chosen();
    user.session()->runs().startValidation(*winner);
    (void)QTest::qWaitFor([&] { return !user.session()->runs().validations().empty(); }, kPatience);
    if (!user.reach()) return 1;
    user.setSetPoint(60);
    user.plan(10, true);
    camera.take(user.window, "validate-placing");
    makeTrials(user, 16);
    user.press(Qt::Key_Space);
    camera.take(user.window, "validate-running");
    for (const char* panel : {"drive", "log", "calibrate"}) {
        user.find<QDockWidget>(QString("dock.validate.%1").arg(panel))->raise();
        camera.take(user.window, QString("validate-%1").arg(panel));
    }
    user.find<QDockWidget>("dock.validate.results")->raise();
    bench.feeder->setTrouble(transports::Trouble::fault);
    (void)QTest::qWaitFor([&] { return user.guide().stage() == Stage::placing; }, kPatience);
    camera.take(user.window, "validate-fault");
    bench.feeder->setTrouble(transports::Trouble::none);
    (void)QTest::qWaitFor(
        [&] {
            user.click("feeder.acknowledge");
            return user.page().link().snapshot().state == drive::State::idle;
        },
        kPatience);
    makeTrials(user, 44);
    camera.take(user.window, "validate-done");
    user.window.findChild<ReportCard*>()->write((arguments[1] + "/report.pdf").toStdString());
    return 0;
}
