#include "ui/pages/trade_off_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "ui/charts/trade_off_chart.h"
#include "ui/look/text.h"
#include "ui/pages/panel_head.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using session::StudyRuns;

namespace {

const objectives::Objective* chosen(const QComboBox& box) {
    return objectives::findObjective(box.currentData().toString().toStdString());
}

/// "89.7 %"
QString shownText(const objectives::Objective& objective, double value) {
    const QString number = QString::fromStdString(objectives::shown(objective, value));
    return objective.unit.empty() ? number
                                  : QStringLiteral("%1 %2").arg(number, look::fromUtf8(objective.unit));
}

/// What is asked for first: what the settings trade, or else what most want to know of such a study.
std::pair<std::string_view, std::string_view> proposePair(const study::EvolutionSettings& settings,
                                                          const objectives::Fitness& measured) {
    if (const auto traded = study::tradedObjectives(settings); !traded.empty())
        return {traded[0]->key, traded[1]->key};
    if (objectives::findScore(measured, objectives::kPurity) != nullptr)
        return {objectives::kPurity, objectives::kSuccess};
    return {"conveying_speed", objectives::kSuccess};
}

/// What the last selection made of its candidates.
std::vector<study::ScorePair> measuredAnew(const StudyRuns& runs, const objectives::Objective& across,
                                           const objectives::Objective& up) {
    std::vector<study::ScorePair> measured;
    if (runs.selections().empty()) return measured;
    for (const study::SelectionEntry& entry : runs.selections().back().entries) {
        const objectives::Score* first = objectives::findScore(entry.fitness, across.key);
        const objectives::Score* second = objectives::findScore(entry.fitness, up.key);
        if (first != nullptr && second != nullptr)
            measured.push_back(
                {{entry.generation, entry.individual}, entry.trials, first->value, second->value});
    }
    return measured;
}

}  // namespace

TradeOffPanel::TradeOffPanel()
    : chart_(new charts::TradeOffChart(this)), head_(new PanelHead("evolve.tradeOff.head", this, chart_)) {
    setObjectName("evolve.tradeOffPanel");
    setAccessibleName(tr("Trade-off"));
    auto* column = static_cast<QVBoxLayout*>(layout());
    column->removeWidget(head_);
    column->insertWidget(0, makeChoice());
    connect(head_, &QLabel::linkActivated, this, [this](const QString& link) {
        const QStringList numbers = link.split(u'/');
        pick({numbers.value(0).toInt(), numbers.value(1).toInt()});
    });
    connect(chart_, &charts::TradeOffChart::trackPicked, this, &TradeOffPanel::pick);
    connect(chart_, &charts::ChartPanel::failed, this, &TradeOffPanel::failed);
    head_->setToolTip(
        tr("For these tracks no other does better in both ways, of those with all their trials. As counted "
           "while learning; what Select measured anew is in the chart, too"));
    showTracks();
}

QWidget* TradeOffPanel::makeChoice() {
    auto* row = new QWidget(this);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(8, 4, 0, 0);
    layout->setSpacing(8);
    const auto add = [&](const char* name, const QString& text, const QString& accessible) {
        auto* box = new QComboBox(row);
        box->setObjectName(name);
        box->setAccessibleName(accessible);
        auto* label = new QLabel(text, row);
        label->setBuddy(box);
        layout->addWidget(label);
        layout->addWidget(box);
        connect(box, &QComboBox::currentIndexChanged, this, &TradeOffPanel::load);
        return box;
    };
    across_ = add("evolve.tradeOff.across", tr("Across"), tr("Objective across"));
    up_ = add("evolve.tradeOff.up", tr("Up"), tr("Objective up"));
    // Beside them, not below: the chart needs the height.
    layout->addWidget(head_, 1);
    return row;
}

void TradeOffPanel::setSession(const session::StudySession* session) {
    if (session_) session_->leave(this);
    session_ = session;
    reading_.cancel();
    tracks_.clear();
    shown_.reset();
    across_->clear();
    up_->clear();
    offerObjectives();
    // Nothing of the study before may be seen, or picked, until this one is read.
    showTracks();
    load();
    if (!session_) return;
    connect(&session_->runs(), &StudyRuns::generationSaved, this, [this] {
        offerObjectives();
        load();
    });
    connect(&session_->runs(), &StudyRuns::selectionSaved, this, &TradeOffPanel::showTracks);
}

void TradeOffPanel::setShown(const std::optional<study::IndividualId>& track) {
    if (shown_ == track) return;
    shown_ = track;
    showTracks();
}

void TradeOffPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (isStale_) load();
}

void TradeOffPanel::offerObjectives() {
    if (!session_ || session_->runs().summaries().empty() || across_->count() > 0) return;
    const objectives::Fitness& measured = session_->runs().summaries().back().statistics.best;
    const auto [across, up] = proposePair(session_->design().settings().evolution, measured);
    for (const auto& [box, key] : {std::pair(across_, across), std::pair(up_, up)}) {
        const QSignalBlocker quiet(box);
        for (const objectives::Objective& objective : objectives::allObjectives())
            if (objectives::findScore(measured, objective.key) != nullptr)
                box->addItem(look::fromUtf8(objective.name), look::fromUtf8(objective.key));
        box->setCurrentIndex(std::max(0, box->findData(look::fromUtf8(key))));
    }
}

void TradeOffPanel::load() {
    isStale_ = true;
    if (!isVisible()) return;
    isStale_ = false;
    reading_.cancel();
    const objectives::Objective* across = chosen(*across_);
    const objectives::Objective* up = chosen(*up_);
    if (!session_ || across == nullptr || up == nullptr) {
        tracks_.clear();
        return showTracks();
    }
    reading_.start([this, path = session_->path(), across, up]() -> session::NewestTask::Deliver {
        const auto file = store::StudyFile::openReadOnly(path);
        const auto tracks = file ? file->loadScorePairs(std::string(across->key), std::string(up->key))
                                 : base::Result<std::vector<study::ScorePair>>(file.error());
        if (!tracks) {
            return [this, message = tracks.error().message] {
                emit failed(tr("The scores could not be read"), QString::fromStdString(message));
            };
        }
        return [this, across, up, tracks = *tracks] {
            tracks_ = tracks;
            readAcross_ = across;
            readUp_ = up;
            showTracks();
        };
    });
}

void TradeOffPanel::showTracks() {
    const objectives::Objective* across = readAcross_;
    const objectives::Objective* up = readUp_;
    const bool isKnown = session_ && across != nullptr && up != nullptr && !tracks_.empty();
    across_->parentWidget()->setVisible(across_->count() > 0);
    head_->setVisible(isKnown);
    if (!isKnown) return chart_->setTradeOff({});
    const int least = session_->design().settings().evolution.trialsPerEvaluation;
    charts::TradeOff tradeOff{across,
                              up,
                              tracks_,
                              study::findParetoFront(tracks_, *across, *up, least),
                              measuredAnew(session_->runs(), *across, *up),
                              shown_};
    QStringList links;
    for (const std::size_t i : tradeOff.front) {
        const study::ScorePair& track = tracks_[i];
        links << tr("<a href=\"%1/%2\">%3 with %4</a>")
                     .arg(track.generation)
                     .arg(track.individual)
                     .arg(shownText(*across, track.first), shownText(*up, track.second));
    }
    constexpr qsizetype kTold = 3;
    const qsizetype count = links.size();
    // The two ends and the middle tell what there is to choose from.
    if (count > kTold) links = {links.front(), links[count / 2], links.back()};
    head_->setText(across == up ? tr("Choose two different objectives.")
                                : tr("<b>%1 of %2 tracks</b> on the Pareto front: %3")
                                      .arg(count)
                                      .arg(tracks_.size())
                                      .arg(links.join(count > kTold ? " ... " : ", ")));
    chart_->setTradeOff(std::move(tradeOff));
}

void TradeOffPanel::pick(const study::IndividualId& track) {
    if (!session_) return;
    const auto generation = session_->runs().loadGeneration(track.generation);
    if (!generation) {
        emit failed(tr("The track cannot be shown"), QString::fromStdString(generation.error().message));
        return;
    }
    const auto place = static_cast<std::size_t>(track.individual);
    if (place < generation->individuals.size()) emit picked({track, generation->individuals[place]});
}

}  // namespace trapwright::pages
