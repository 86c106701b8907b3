#include "ui/pages/evolve_page.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QThread>
#include <QVBoxLayout>

#include "core/study/selection.h"
#include "ui/look/file_dialog.h"
#include "ui/look/folding_group.h"
#include "ui/look/icon.h"
#include "ui/pages/comparison_table.h"
#include "ui/pages/event_log.h"
#include "ui/pages/evolve_summary.h"
#include "ui/pages/film_strip.h"
#include "ui/pages/generation_table.h"
#include "ui/pages/individual_card.h"
#include "ui/pages/individual_table.h"
#include "ui/pages/learning_charts.h"
#include "ui/pages/run_actions.h"
#include "ui/pages/run_card.h"
#include "ui/pages/settings_form.h"
#include "ui/pages/track_in_scene.h"
#include "ui/pages/trade_off_panel.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using session::StudyDesign;
using session::StudyRuns;
using session::StudySession;

namespace {

constexpr auto kThreadsSetting = "threads";

}  // namespace

EvolvePage::EvolvePage(RunActions& run, QWidget* parent)
    : Page({"evolve", tr("Evolve"), "evolve", tr("Learn tracks, watch, stop, and look at what was learned")},
           parent),
      followAction_(new QAction(look::icon("to-end"), tr("Follow the best"), this)),
      card_(new RunCard(run, this)),
      form_(new SettingsForm({{"evolve.run", tr("Run"), {"evolution.generations", "simulation.engine"}}}, {},
                             this)),
      individualGroup_(new look::FoldingGroup("evolve.individual", tr("In the scene"), false, this)),
      individual_(new IndividualCard(individualGroup_)),
      charts_(new LearningCharts(this)),
      generations_(new GenerationTable),
      individuals_(new IndividualTable),
      tradeOff_(new TradeOffPanel),
      log_(new EventLog),
      strip_(new FilmStrip) {
    auto* settingsGroup = new look::FoldingGroup("evolve.settings", tr("Settings"), false, this);
    summary_ = new EvolveSummary(settingsGroup);
    settingsGroup->body()->addWidget(summary_);
    individualGroup_->body()->addWidget(individual_);
    form_->addToGroup("evolve.run", makeThreads(form_));

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 12, 12, 12);
    layout->setSpacing(8);
    layout->addWidget(card_);
    layout->addWidget(form_);
    layout->addWidget(individualGroup_);
    layout->addWidget(settingsGroup);
    layout->addWidget(makeComparison());
    layout->addStretch(1);

    connect(&build_, &session::TrackBuild::built, this,
            [this](const std::shared_ptr<const track::Track>& track) {
                track_ = track;
                individual_->showTrack(*track);
                showScene();
            });
    connect(&build_, &session::TrackBuild::failed, this,
            [this](const QString& message) { emit failed(tr("The track cannot be shown"), message); });
    addActions();
    connectViews();
    refresh();
}

QWidget* EvolvePage::makeThreads(QWidget* parent) {
    auto* row = new QWidget(parent);
    threads_ = new QSpinBox(row);
    threads_->setObjectName("evolve.threads");
    const int processors = std::max(QThread::idealThreadCount(), 1);
    threads_->setRange(0, processors);
    threads_->setSpecialValueText(tr("all %1").arg(processors));
    threads_->setToolTip(
        tr("How many processors learning keeps busy, from the next start on. The results are the same."));
    threads_->setAccessibleName(tr("Threads"));
    threads_->setMinimumWidth(128);
    threads_->setValue(QSettings().value(kThreadsSetting, 0).toInt());
    auto* label = new QLabel(tr("Threads"), row);
    label->setBuddy(threads_);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(label, 1);
    layout->addWidget(threads_);
    connect(threads_, &QSpinBox::valueChanged, this, [this](int threads) {
        QSettings().setValue(kThreadsSetting, threads);
        if (session_) session_->runs().setThreads(static_cast<unsigned>(threads));
    });
    return row;
}

QWidget* EvolvePage::makeComparison() {
    auto* group = new look::FoldingGroup("evolve.comparison", tr("Comparison"), false, this);
    compared_ = new QLabel(group);
    compared_->setObjectName("evolve.compared");
    compared_->setWordWrap(true);
    compare_ = new QPushButton(tr("Compare with..."), group);
    compare_->setObjectName("evolve.compare");
    compare_->setToolTip(
        tr("Shows the curves of another study in the same charts, or of several, as of one "
           "task with many seeds, their median and quartiles"));
    endComparison_ = new QPushButton(tr("End"), group);
    endComparison_->setObjectName("evolve.endComparison");
    endComparison_->setAccessibleName(tr("End the comparison"));
    auto* buttons = new QHBoxLayout;
    buttons->addStretch(1);
    buttons->addWidget(endComparison_);
    buttons->addWidget(compare_);
    group->body()->addWidget(compared_);
    comparison_ = new ComparisonTable(group);
    group->body()->addWidget(comparison_);
    group->body()->addLayout(buttons);
    connect(compare_, &QPushButton::clicked, this, &EvolvePage::askForComparison);
    connect(endComparison_, &QPushButton::clicked, charts_, &LearningCharts::endComparison);
    connect(charts_, &LearningCharts::comparisonChanged, this, &EvolvePage::showComparison);
    showComparison();
    return group;
}

void EvolvePage::addActions() {
    const auto add = [this](QAction* action, const QString& name, const QKeySequence& key, auto act) {
        action->setObjectName(name);
        action->setShortcut(key);
        connect(action, &QAction::triggered, this, act);
        addAction(action);
    };
    add(followAction_, "evolve.follow", Qt::Key_Escape, &EvolvePage::follow);
    add(new QAction(tr("Winner of the generation before"), this), "evolve.previous",
        QKeySequence(Qt::ALT | Qt::Key_Left), [this] { stepWinner(-1); });
    add(new QAction(tr("Winner of the next generation"), this), "evolve.next",
        QKeySequence(Qt::ALT | Qt::Key_Right), [this] { stepWinner(1); });
    add(new QAction(look::icon("add"), tr("Compare with other studies..."), this), "evolve.compareWith",
        QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_K), &EvolvePage::askForComparison);
}

void EvolvePage::connectViews() {
    connect(card_, &RunCard::settingsWanted, this, [this] { emit pageWanted("track"); });
    connect(form_, &SettingsForm::edited, this, [this](const study::Settings& settings, const QString& what) {
        if (session_) session_->design().changeSettings(settings, what);
    });
    connect(summary_, &EvolveSummary::changeWanted, this, &EvolvePage::changeSettings);
    connect(strip_, &FilmStrip::picked, this, &EvolvePage::pickWinner);
    connect(strip_, &FilmStrip::followWanted, this, &EvolvePage::follow);
    connect(generations_, &GenerationTable::picked, this, &EvolvePage::pickWinner);
    connect(individuals_, &IndividualTable::picked, this, &EvolvePage::pick);
    connect(individuals_, &IndividualTable::generationPicked, this, &EvolvePage::pickWinner);
    connect(charts_, &LearningCharts::picked, this, &EvolvePage::pickWinner);
    connect(charts_, &LearningCharts::failed, this, &Page::failed);
    connect(tradeOff_, &TradeOffPanel::picked, this, &EvolvePage::pick);
    connect(tradeOff_, &TradeOffPanel::failed, this, &Page::failed);
    connect(generations_, &GenerationTable::failed, this, &Page::failed);
    connect(individuals_, &IndividualTable::failed, this, &Page::failed);
}

std::vector<Panel> EvolvePage::panels() {
    std::vector<Panel> panels = charts_->panels();  // success first
    panels.insert(panels.begin() + 1, {{"generations", tr("Generations"), generations_},
                                       {"individuals", tr("Individuals"), individuals_},
                                       {"tradeOff", tr("Trade-off"), tradeOff_},
                                       {"log", tr("Log"), log_}});
    return panels;
}

QWidget* EvolvePage::sceneBar() {
    return strip_;
}

void EvolvePage::setSession(StudySession* session) {
    if (session_) session_->leave(this);
    session_ = session;
    build_.cancel();
    blueprint_.reset();
    track_.reset();
    picked_.reset();
    const session::StudyRuns* runs = session != nullptr ? &session->runs() : nullptr;
    card_->setRuns(runs);
    charts_->setSession(session);
    generations_->setRuns(runs);
    individuals_->setRuns(runs);
    tradeOff_->setSession(session);
    log_->setRuns(runs);
    strip_->setRuns(runs);
    if (session_) {
        connect(session_, &StudySession::failed, this,
                [this](const QString& what, const QString& message) { log_->tellFailure(what, message); });
        form_->offer("simulation.engine", engineChoices(session_->design().engines()));
        session_->runs().setThreads(static_cast<unsigned>(threads_->value()));
        connect(&session_->design(), &StudyDesign::settingsChanged, this, &EvolvePage::refresh);
        connect(&session_->design(), &StudyDesign::partChanged, this, &EvolvePage::refresh);
        connect(&session_->runs(), &StudyRuns::stateChanged, this, &EvolvePage::refresh);
        connect(&session_->runs(), &StudyRuns::generationSaved, this, [this] {
            if (!picked_) showPicked();
            showComparison();
        });
        connect(&session_->runs(), &StudyRuns::selectionSaved, this, &EvolvePage::showComparison);
    }
    refresh();
}

void EvolvePage::activate(scene::SceneView& scene) {
    scene_ = &scene;
    showPicked();
}

void EvolvePage::deactivate() {
    scene_ = nullptr;
}

void EvolvePage::refresh() {
    for (QWidget* widget : std::initializer_list<QWidget*>{form_, summary_})
        widget->setVisible(session_ != nullptr);
    compare_->setEnabled(session_ != nullptr);
    if (session_) {
        const bool locked = session_->design().locked();
        form_->show(session_->design().settings());
        form_->setLocked(
            [locked](const std::string& key) { return !locked || key == "evolution.generations"; });
        form_->setProblems(session_->design().problems(), session_->design().recommendations());
        summary_->show(session_->design().settings(), *session_->design().part(), locked);
    }
    showPicked();
}

void EvolvePage::askForComparison() {
    if (!session_) return;
    look::askForFiles(
        this, {"study", tr("Compare with studies"), tr("Compare"), tr("Studies (*.trap)"), {}, {}},
        [this](const std::vector<std::filesystem::path>& studies) { charts_->compareWith(studies); });
}

void EvolvePage::showComparison() {
    const std::vector<study::ComparedStudy> others = charts_->others();
    const bool isOne = others.size() == 1;
    compared_->setText(
        others.empty() ? tr("No other study is in the charts.")
        : isOne        ? tr("The charts also show <b>%1</b>.")
                      .arg(QString::fromStdString(others.front().name).toHtmlEscaped())
                : tr("The charts also show the median of these %1 studies, with the area between their "
                     "quartiles.")
                      .arg(others.size() + 1));
    endComparison_->setVisible(!others.empty());
    comparison_->setVisible(!others.empty());
    if (others.empty()) return;
    std::vector<study::ComparedStudy> all{charts_->own()};
    all.insert(all.end(), others.begin(), others.end());
    comparison_->show(all);
}

void EvolvePage::changeSettings() {
    if (!session_) return;
    const bool locked = session_->design().locked();
    emit pageWanted("track");
    if (locked) emit forkWanted(session::Fork::settingsAlone);
}

void EvolvePage::follow() {
    picked_.reset();
    showPicked();
}

void EvolvePage::pick(const study::Individual& individual) {
    picked_ = individual;
    showPicked();
}

void EvolvePage::pickWinner(int generation) {
    if (!session_) return;
    const std::vector<study::Individual>& winners = session_->runs().winners();
    if (generation >= 0 && generation < static_cast<int>(winners.size()))
        pick(winners[static_cast<std::size_t>(generation)]);
}

void EvolvePage::stepWinner(int step) {
    if (const study::Individual* winner = shown()) pickWinner(winner->generation + step);
}

const study::Individual* EvolvePage::shown() const {
    if (picked_) return &*picked_;
    return session_ ? session_->runs().bestWinner() : nullptr;
}

void EvolvePage::showPicked() {
    const study::Individual* individual = shown();
    const int generation = individual != nullptr ? individual->generation : -1;
    const QString caption = individual != nullptr ? captionOf(*individual) : QString();
    followAction_->setEnabled(picked_.has_value());
    strip_->setCurrent(generation, caption, !picked_);
    generations_->setCurrent(generation);
    individuals_->setCurrent(generation, individual != nullptr ? individual->individual : -1);
    tradeOff_->setShown(individual != nullptr ? std::optional<study::IndividualId>(*individual)
                                              : std::nullopt);
    individualGroup_->setSummary(caption);
    if (individual == nullptr) {
        individual_->clear();
    } else {
        individual_->show(session_->design().settings(), *individual);
        if (track_) individual_->showTrack(*track_);
    }
    if (session_ && scene_ != nullptr) buildTrack(individual);
}

void EvolvePage::buildTrack(const study::Individual* individual) {
    const study::TrackSettings& settings = session_->design().settings().track;
    Blueprint blueprint{settings, individual != nullptr ? individual->record.design : search::Design()};
    if (blueprint_ && *blueprint_ == blueprint) return showScene();
    blueprint_ = std::move(blueprint);
    if (individual == nullptr) {
        build_.buildLayout(settings);
    } else {
        build_.buildIndividual(settings, individual->record.design);
    }
}

QString EvolvePage::captionOf(const study::Individual& individual) const {
    const auto& winners = session_->runs().winners();
    const auto generation = static_cast<std::size_t>(individual.generation);
    const bool winner =
        generation < winners.size() && winners[generation].individual == individual.individual;
    const study::Individual* best = session_->runs().bestWinner();
    if (winner && best != nullptr && best->generation == individual.generation)
        return tr("Generation %1, best so far").arg(individual.generation);
    return winner ? tr("Generation %1, winner").arg(individual.generation)
                  : tr("Generation %1, individual %2").arg(individual.generation).arg(individual.individual);
}

void EvolvePage::showScene() {
    if (scene_ != nullptr && session_) showTrackWithPart(*scene_, track_, session_->design().part());
}

}  // namespace trapwright::pages
