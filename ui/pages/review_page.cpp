#include "ui/pages/review_page.h"

#include <QAbstractButton>
#include <QApplication>
#include <QKeyEvent>
#include <QTableView>
#include <QVBoxLayout>

#include "core/study/pose_weights.h"
#include "ui/charts/orientation_chart.h"
#include "ui/look/folding_group.h"
#include "ui/look/text.h"
#include "ui/pages/details_button.h"
#include "ui/pages/judging_card.h"
#include "ui/pages/playback_bar.h"
#include "ui/pages/replay_files.h"
#include "ui/pages/result_table.h"
#include "ui/pages/robustness_panel.h"
#include "ui/pages/stream_panel.h"
#include "ui/pages/track_choice.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using models::ValidationModel;
using session::StudyDesign;
using session::StudyRuns;
using session::StudySession;

namespace {

QString fromText(const std::string& text) {
    return QString::fromStdString(text);
}

}  // namespace

ReviewPage::ReviewPage(QWidget* parent)
    : Page({"review", tr("Review"), "review",
            tr("Compare the winners, validate the best one, replay its trials")},
           parent),
      review_(this),
      choice_(new TrackChoice(this)),
      judging_(new JudgingCard(this)),
      files_(new ReplayFiles(review_.player(), this)),
      selectionTable_(std::make_unique<ResultTable>("review.comparison", tr("Comparison"), selection_)),
      validationTable_(std::make_unique<ResultTable>("review.validation", tr("Validation"), validation_)),
      robustness_(std::make_unique<RobustnessPanel>()),
      streams_(std::make_unique<StreamPanel>()),
      shownSelection_(selectionTable_.get()),
      shownValidation_(validationTable_.get()),
      shownRobustness_(robustness_.get()),
      shownStreams_(streams_.get()) {
    addInspector();
    addTables();
    addKeys();
    connect(choice_, &TrackChoice::winnerChanged, this, &ReviewPage::showWinner);
    connect(choice_, &TrackChoice::failed, this, &Page::failed);
    connect(files_, &ReplayFiles::failed, this, &Page::failed);
    connect(judging_, &JudgingCard::failed, this, &Page::failed);
    connect(&review_, &TrialReview::failed, this, &Page::failed);
    ReviewPage::setSession(nullptr);
}

ReviewPage::~ReviewPage() = default;

void ReviewPage::addInspector() {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(12, 12, 12, 12);
    column->setSpacing(8);
    const auto addGroup = [&](const QString& name, const QString& title, QWidget* contents) {
        auto* group = new look::FoldingGroup(name, title, false, this);
        group->body()->addWidget(contents);
        column->addWidget(group);
    };
    addGroup("review.track", tr("Track"), choice_);
    addGroup("review.judging", tr("Simulate it again"), judging_);
    addGroup("review.files", tr("Picture and film"), files_);
    column->addStretch(1);
}

void ReviewPage::addTables() {
    selectionTable_->view().setSelectionBehavior(QAbstractItemView::SelectRows);
    auto* details = new DetailsButton(selectionTable_->view(), models::SelectionModel::firstDetail(),
                                      selectionTable_.get());
    selectionTable_->headRow().insertWidget(1, details);
    connect(selectionTable_.get(), &ResultTable::cellChosen, this, [this](const QModelIndex& index) {
        choice_->setWinner(
            {index.data(models::GenerationRole).toInt(), index.data(models::IndividualRole).toInt()});
    });
    validationTable_->setLinkColumns({ValidationModel::Failures, ValidationModel::WrongOrientation,
                                      ValidationModel::Stuck, ValidationModel::FellOff});
    connect(validationTable_.get(), &ResultTable::cellChosen, this, &ReviewPage::goToFailures);
    for (ResultTable* table : {selectionTable_.get(), validationTable_.get()})
        connect(table, &ResultTable::failed, this, &Page::failed);
    connect(robustness_.get(), &RobustnessPanel::failed, this, &Page::failed);
    connect(robustness_.get(), &RobustnessPanel::trialsWanted, &review_, &TrialReview::goToRobustness);
    connect(streams_.get(), &StreamPanel::failed, this, &Page::failed);
    connect(streams_.get(), &StreamPanel::filmWanted, &review_, &TrialReview::goToStream);
}

void ReviewPage::addKeys() {
    addAction(judging_->compareAction());
    addAction(judging_->validateAction());
    addAction(judging_->robustnessAction());
    addAction(judging_->allRobustnessAction());
    addAction(judging_->streamAction());
    addActions(review_.bar()->actions());
}

std::vector<Panel> ReviewPage::panels() {
    return {{"trials", tr("Trials"), review_.list(), Qt::LeftDockWidgetArea},
            {"validation", tr("Validation"), validationTable_.release(), Qt::BottomDockWidgetArea},
            {"comparison", tr("Comparison"), selectionTable_.release(), Qt::BottomDockWidgetArea},
            {"robustness", tr("Robustness"), robustness_.release(), Qt::BottomDockWidgetArea},
            {"stream", tr("Stream"), streams_.release(), Qt::BottomDockWidgetArea},
            {"orientation", tr("Orientation"), review_.orientation(), Qt::BottomDockWidgetArea}};
}

QWidget* ReviewPage::sceneBar() {
    return review_.bar();
}

void ReviewPage::setSession(StudySession* session) {
    if (session_) session_->leave(this);
    session_ = session;
    replays_ = session != nullptr ? &session->replays() : nullptr;
    sliced_ = -1;
    review_.setReplays(session != nullptr ? &session->replays() : nullptr);
    judging_->setRuns(session != nullptr ? &session->runs() : nullptr);
    choice_->setRuns(session != nullptr ? &session->runs() : nullptr);
    showSelection();
    if (!session_) return;
    connect(session_, &StudySession::failed, this, [this] { review_.endWaiting(); });
    connect(&session_->runs(), &StudyRuns::generationSaved, this, [this] {
        if (isVisible()) choice_->refresh();  // otherwise when the page is activated
    });
    connect(&session_->runs(), &StudyRuns::selectionSaved, this, [this] {
        choice_->refresh();
        showSelection();
        review_.refreshSources();
        // The best of them is what one wants to see now.
        const study::SelectionRecord& last = session_->runs().selections().back();
        if (!last.entries.empty()) choice_->setWinner(last.entries.front());
        emit panelWanted("comparison");
    });
    // What totals are weighted by.
    connect(&session_->design(), &StudyDesign::settingsChanged, this, &ReviewPage::showValidation);
    connect(&session_->runs(), &StudyRuns::validationSaved, this, [this] {
        choice_->refresh();
        showValidation();
        review_.refreshSources();
        emit panelWanted("validation");
    });
    connect(&session_->replays(), &session::StudyReplays::sliced, this,
            [this](const workflow::TrialsRequest& request,
                   const std::vector<study::SlicedCondition>& conditions) {
                const bool shown = choice_->winner() && isSameIndividual(*choice_->winner(), request.winner);
                // It may have been validated anew since, as set.
                if (!shown || sliced_ < 0 ||
                    !session_->runs().validations()[static_cast<std::size_t>(sliced_)].box)
                    return;
                validation_.setConditions(conditions);
                shownValidation_->setPinned(validation_.totals());
            });
    connect(&session_->runs(), &StudyRuns::robustnessMeasured, this, [this](int tracks) {
        showSelection();
        showRobustness();
        emit panelWanted(tracks > 1 ? "comparison" : "robustness");
    });
    connect(&session_->runs(), &StudyRuns::streamsMeasured, this, [this] {
        showStreams();
        emit panelWanted("stream");
    });
}

void ReviewPage::showStreams() {
    if (!shownStreams_) return;
    shownStreams_->setStreams(session_ && choice_->winner() ? session_->runs().findStreams(*choice_->winner())
                                                            : nullptr);
}

void ReviewPage::activate(scene::SceneView& scene) {
    choice_->refresh();
    review_.setScene(&scene);
    files_->setScene(&scene);
    qApp->installEventFilter(this);
}

void ReviewPage::deactivate() {
    qApp->removeEventFilter(this);
    files_->setScene(nullptr);
    review_.setScene(nullptr);
}

bool ReviewPage::eventFilter(QObject* watched, QEvent* event) {
    // A button that has the focus is pressed by the space bar; everywhere else that plays.
    if (event->type() == QEvent::ShortcutOverride && qobject_cast<QAbstractButton*>(watched) != nullptr &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Space) {
        event->accept();
        return true;
    }
    return Page::eventFilter(watched, event);
}

void ReviewPage::showWinner() {
    judging_->setWinner(choice_->winner());
    review_.setWinner(choice_->winner());
    if (session_ && choice_->winner())
        files_->setName(
            QString("%1-%2").arg(choice_->winner()->generation).arg(choice_->winner()->individual));
    showValidation();
    showRobustness();
    showStreams();
}

void ReviewPage::showRobustness() {
    if (!shownRobustness_) return;
    const bool isOpen = session_ && choice_->winner();
    shownRobustness_->setMeasured(isOpen ? session_->runs().findRobustness(*choice_->winner()) : nullptr,
                                  isOpen ? session_->design().settings() : study::Settings());
}

void ReviewPage::showSelection() {
    if (!shownSelection_) return;
    shownSelection_->setEmptyText(
        session_ && !session_->runs().winners().empty()
            ? tr("The winners were not compared yet. Compare them to find the best one.")
            : tr("Learn a track first: then the winners can be compared."));
    if (!session_ || session_->runs().selections().empty()) {
        shownSelection_->setHead({});
        return selection_.clear();
    }
    const study::SelectionRecord& last = session_->runs().selections().back();
    shownSelection_->setHead(
        tr("Simulated by %1. Choose a row to look at its track.").arg(fromText(last.engine)));
    selection_.setSelection(last, session_->runs().robustness());
    shownSelection_->view().setColumnHidden(
        models::SelectionModel::Worst,
        std::ranges::none_of(selection_.rows(),
                             [](const models::SelectionRow& row) { return row.worst.has_value(); }));
    shownSelection_->view().setColumnHidden(
        models::SelectionModel::Corners,
        std::ranges::all_of(last.entries,
                            [](const study::SelectionEntry& entry) { return entry.corners.trials == 0; }));
}

void ReviewPage::showValidation() {
    if (!shownValidation_) return;
    const std::optional<study::Individual>& winner = choice_->winner();
    shownValidation_->setEmptyText(
        winner ? tr("This track was not validated yet. Validate it to see how often it fails.")
               : tr("Learn a track first: then it can be validated."));
    const study::ValidationRecord* found = nullptr;
    int number = -1;
    if (session_ && winner) {
        const std::vector<study::ValidationRecord>& all = session_->runs().validations();
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!isSameIndividual(all[i], *winner)) continue;
            found = &all[i];
            number = static_cast<int>(i);
        }
    }
    if (number != sliced_) validation_.setConditions({});
    if (found == nullptr) {
        sliced_ = -1;
        shownValidation_->setHead({});
        return validation_.clear();
    }
    const QString what =
        found->box
            ? tr("Simulated by %1 over the operating box, success within %2°. Choose a number of failures to "
                 "see them. Alike poses open to each of them, a condition's worst quarter to all four.")
            : tr("Simulated by %1, success within %2°. Choose a number of failures to see them; a row of "
                 "several "
                 "poses that look the same opens to each of them.");
    shownValidation_->setHead(
        what.arg(fromText(found->engine), look::numberText(found->tolerance / base::kDegree)));
    const study::ValidationTable table = study::tabulate(
        *found, study::weighPoseGroups(*session_->design().part(), session_->design().settings()));
    validation_.setValidation(table);
    if (number != sliced_) askForSlices(*found, number);
    shownValidation_->setPinned(validation_.totals());
}

void ReviewPage::askForSlices(const study::ValidationRecord& record, int number) {
    sliced_ = number;
    if (!record.box) return;
    workflow::TrialsRequest request{workflow::TrialKind::validation, *choice_->winner(), {}};
    for (const study::ValidationRow& row : record.rows)
        request.poses.push_back(row.pose);
    replays_->requestSlices(request);
}

void ReviewPage::goToFailures(const QModelIndex& cell) {
    if (cell.column() == ValidationModel::Pose) return validation_.toggle(cell.row());
    if (cell.data(models::ValueRole).toInt() == 0) return;
    std::set<trial::Verdict> verdicts;
    if (cell.data(models::VerdictRole).toInt() >= 0) {
        verdicts = {static_cast<trial::Verdict>(cell.data(models::VerdictRole).toInt())};
    } else if (cell.column() == ValidationModel::Failures) {
        verdicts = {trial::Verdict::wrongOrientation, trial::Verdict::stuck, trial::Verdict::fellOff};
    } else {
        return;
    }
    const models::ValidationTableRow& row = validation_.rows()[static_cast<std::size_t>(cell.row())];
    if (row.slice)
        return review_.goToSlice(QString("%1 %2").arg(row.condition, row.range), *row.slice,
                                 row.row.tally.trials(), verdicts);
    // Of the total: the first poses that have such failures.
    std::vector<int> poses = row.poses;
    for (int other = 0; poses.empty() && other < validation_.rowCount(); ++other) {
        const QModelIndex same = validation_.index(other, cell.column());
        if (same.data(models::ValueRole).toInt() > 0)
            poses = validation_.rows()[static_cast<std::size_t>(other)].poses;
    }
    review_.goToTrials(poses, verdicts);
}

}  // namespace trapwright::pages
