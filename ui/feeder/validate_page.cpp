#include "ui/feeder/validate_page.h"

#include <QFrame>
#include <QPushButton>
#include <QScrollArea>
#include <QTableView>
#include <QVBoxLayout>

#include "core/study/pose_weights.h"
#include "ui/feeder/calibrate_panel.h"
#include "ui/feeder/drive_chart.h"
#include "ui/feeder/drive_log.h"
#include "ui/feeder/drive_panel.h"
#include "ui/feeder/drive_texts.h"
#include "ui/feeder/expected_pose.h"
#include "ui/feeder/guide_bar.h"
#include "ui/feeder/plan_panel.h"
#include "ui/feeder/report_card.h"
#include "ui/feeder/stop_button.h"
#include "ui/look/folding_group.h"
#include "ui/pages/result_table.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::feeder {

using session::StudyDesign;
using session::StudyRuns;
using session::StudySession;

ValidatePage::ValidatePage(const session::Environment& environment, QWidget* parent)
    : Page({"validate", tr("Validate"), "validate",
            tr("Drive the real feeder, place parts on the printed track, count how the trials end")},
           parent),
      link_(environment.drives, this),
      guide_(link_, this),
      actions_(guide_, link_, this),
      placing_(this),
      drive_(new DrivePanel(link_, this)),
      bar_(new GuideBar(guide_, actions_)),
      plan_(new PlanPanel(guide_, link_, nullptr)),
      table_(new pages::ResultTable("validate.results", tr("Results"), model_)),
      chart_(new DriveChart(link_, nullptr)),
      log_(new DriveLog(link_, nullptr)),
      calibrate_(new CalibratePanel(link_, nullptr)) {
    new StopKey(link_, this);
    addInspector(environment);
    addPanels();
    // Below the scene the keys work even while the inspector is closed.
    addActions(actions_.all());
    bar_->addActions(actions_.all());
    connect(&guide_, &TrialGuide::changed, this, &ValidatePage::showTrial);
    connect(&guide_, &TrialGuide::chosen, this, &ValidatePage::showTrial);
    connect(&link_, &DriveLink::polled, this, &ValidatePage::tellFarewell);
    connect(&link_, &DriveLink::left, this, [this](const QString& warning) {
        emit released(warning.isEmpty() ? QString() : tr("The drive may still be moving"),
                      asSentence(warning));
    });
    connect(&placing_, &PlacingScene::failed, this, &Page::failed);
    connect(&placing_, &PlacingScene::built, this, &ValidatePage::showExpected);
    ValidatePage::setSession(nullptr);
}

ValidatePage::~ValidatePage() = default;

void ValidatePage::addInspector(const session::Environment& environment) {
    auto* contents = new QWidget(this);
    report_ = new ReportCard(guide_, placing_, environment.program, contents);
    auto* report = new look::FoldingGroup("feeder.report", tr("Report"), false, contents);
    report->body()->addWidget(report_);
    auto* groups = new QVBoxLayout(contents);
    groups->setContentsMargins(12, 4, 12, 12);
    groups->setSpacing(8);
    groups->addWidget(drive_);
    groups->addWidget(report);
    groups->addStretch(1);
    auto* scroll = new QScrollArea(this);
    scroll->setWidget(contents);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setFocusPolicy(Qt::NoFocus);
    auto* stop = new QVBoxLayout;
    stop->setContentsMargins(12, 12, 12, 4);
    stop->addWidget(makeStopButton(*actions_.stop(), this));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(stop);
    column->addWidget(scroll, 1);
    connect(drive_, &DrivePanel::failed, this, &Page::failed);
    connect(drive_, &DrivePanel::setPointGiven, this, [this] { bar_->setFocus(); });
    connect(report_, &ReportCard::failed, this, &Page::failed);
}

void ValidatePage::addPanels() {
    table_->setEmptyText(
        tr("Plan a validation at the left: its results appear here, beside the simulated ones."));
    connect(table_, &pages::ResultTable::failed, this, &Page::failed);
    connect(chart_, &DriveChart::failed, this, &Page::failed);
    connect(log_, &DriveLog::failed, this, &Page::failed);
    connect(calibrate_, &CalibratePanel::applyWanted, this, &ValidatePage::applyCalibration);
}

std::vector<pages::Panel> ValidatePage::panels() {
    return {{"plan", tr("Plan"), plan_, Qt::LeftDockWidgetArea},
            {"results", tr("Results"), table_, Qt::BottomDockWidgetArea},
            {"drive", tr("Drive"), chart_, Qt::BottomDockWidgetArea},
            {"log", tr("Drive log"), log_, Qt::BottomDockWidgetArea},
            {"calibrate", tr("Calibrate"), calibrate_, Qt::BottomDockWidgetArea}};
}

QWidget* ValidatePage::sceneBar() {
    return bar_;
}

void ValidatePage::setSession(StudySession* session) {
    if (session_) session_->leave(this);
    session_ = session;
    session::StudyFeeder* feeder = session != nullptr ? &session->feeder() : nullptr;
    link_.setFeeder(feeder);
    placing_.setRuns(session != nullptr ? &session->runs() : nullptr);
    drive_->setStudy(session != nullptr ? &session->design() : nullptr, feeder);
    plan_->setFeeder(feeder);
    log_->setFeeder(feeder);
    calibrate_->setFeeder(feeder);
    report_->setSession(session);
    guide_.setFeeder(feeder);
    if (session_) {
        connect(&session_->runs(), &StudyRuns::validationSaved, this, &ValidatePage::showTable);
        connect(&session_->runs(), &StudyRuns::validationSaved, this, &ValidatePage::showExpected);
        connect(&session_->runs(), &StudyRuns::selectionSaved, this, &ValidatePage::showExpected);
        connect(&session_->design(), &StudyDesign::partChanged, this, &ValidatePage::showTrial);
        connect(&session_->design(), &StudyDesign::settingsChanged, this, &ValidatePage::showTrial);
    }
    showTrial();
    goOnWithFork();
}

void ValidatePage::activate(scene::SceneView& scene) {
    takeSceneKeys(scene.viewActions());
    drive_->refresh();
    plan_->refresh();
    placing_.setScene(&scene);
    showTrial();
    bar_->setFocus();
}

void ValidatePage::deactivate() {
    placing_.setScene(nullptr);
    giveSceneKeysBack();
}

bool ValidatePage::release() {
    link_.leaveDrive();
    tellFarewell();
    return !link_.linked();
}

void ValidatePage::tellFarewell() {
    if (!link_.leaving()) return;
    const drive::Snapshot& now = link_.snapshot();
    const QString state = now.warning.empty() ? stateText(now.state) : QString::fromStdString(now.warning);
    emit releasing(
        tr("The drive is being stopped..."),
        tr("%1 This takes at most %2 s.").arg(asSentence(state)).arg(link_.longestFarewell(), 0, 'f', 1));
}

void ValidatePage::takeSceneKeys(const QList<QAction*>& actions) {
    giveSceneKeysBack();
    for (QAction* action : actions) {
        for (const QAction* own : actions_.all()) {
            if (action->shortcut() != own->shortcut()) continue;
            taken_.emplace_back(action, action->shortcut());
            action->setShortcut({});
            break;
        }
    }
}

void ValidatePage::giveSceneKeysBack() {
    for (const auto& [action, key] : taken_)
        if (action) action->setShortcut(key);
    taken_.clear();
}

void ValidatePage::showTrial() {
    placing_.show(guide_.validation());
    showExpected();
    showTable();
}

void ValidatePage::showExpected() {
    const ExpectedExit expected = placing_.expected();
    bar_->expected()->show(expected);
    plan_->expected()->show(expected);
}

void ValidatePage::showTable() {
    const study::PhysicalValidation* physical = guide_.validation();
    if (!session_ || physical == nullptr) {
        table_->setHead({});
        return model_.clear();
    }
    const study::PhysicalTable table = study::comparePhysical(
        study::findSimulated(session_->runs().validations(), *physical), *physical,
        study::weighPoseGroups(*session_->design().part(), session_->design().settings()));
    // Above the table there is room for a line or two; the whole of it is in the report.
    const QString notice = QString::fromStdString(table.feeders.mixed() ? table.notice : std::string());
    table_->setHead(QString("%1 %2").arg(notice, QString::fromStdString(table.summary)).trimmed(),
                    QString("%1 %2")
                        .arg(QString::fromStdString(table.notice), QString::fromStdString(table.verdict))
                        .trimmed());
    model_.setTable(table);
    table_->setPinned(PhysicalModel::kTotals);
}

void ValidatePage::applyCalibration() {
    if (!session_) return;
    const auto changes = session_->feeder().calibrationChanges(link_.target());
    if (changes.empty()) return;
    if (session_->design().locked()) {
        // The fork opens in place of this study, with its settings.
        calibrate_->carry(session_->feeder().calibratedSettings(changes));
        emit forkWanted(session::Fork::settingsAlone);
        return;
    }
    session_->design().changeSettings(session_->feeder().calibratedSettings(changes), tr("Calibration"));
}

void ValidatePage::goOnWithFork() {
    const auto carried = calibrate_->takeCarried();
    if (!session_ || !carried || session_->design().locked() || !session_->runs().summaries().empty()) return;
    session_->design().changeSettings(*carried, tr("Calibration"));
}

}  // namespace trapwright::feeder
