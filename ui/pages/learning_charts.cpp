#include "ui/pages/learning_charts.h"

#include <QTabWidget>
#include <algorithm>

#include "core/study/evaluator.h"
#include "core/study/selection.h"
#include "ui/charts/study_chart.h"
#include "ui/look/text.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using session::StudyDesign;
using session::StudyRuns;
using session::StudySession;

namespace {

std::vector<double> speedsOf(const std::vector<study::GenerationSummary>& summaries) {
    std::vector<double> speeds;
    speeds.reserve(summaries.size());
    for (const study::GenerationSummary& summary : summaries)
        speeds.push_back(summary.trialsPerSecond());
    return speeds;
}

}  // namespace

LearningCharts::LearningCharts(QObject* parent) : QObject(parent) {
    add(new charts::SuccessChart);
    add(new charts::EngineChart);
    add(new charts::SpeedChart);
    firstDetail_ = charts_.size();
    add(new charts::FitnessChart);
    add(new charts::SearchChart);
}

void LearningCharts::add(charts::StudyChart* chart) {
    charts_.push_back(chart);
    connect(chart, &charts::StudyChart::failed, this, &LearningCharts::failed);
    connect(chart, &charts::StudyChart::picked, this, &LearningCharts::picked);
}

std::vector<Panel> LearningCharts::panels() const {
    std::vector<Panel> panels;
    auto* details = new QTabWidget;
    details->setObjectName("algorithm");
    details->setDocumentMode(true);
    for (std::size_t i = 0; i < charts_.size(); ++i) {
        charts::StudyChart* chart = charts_[i];
        if (i < firstDetail_) {
            panels.push_back({chart->objectName(), chart->title(), chart});
        } else {
            details->addTab(chart, chart->title());
        }
    }
    panels.push_back({details->objectName(), tr("Details of the algorithm"), details});
    return panels;
}

void LearningCharts::setSession(const StudySession* session) {
    if (session_) session_->leave(this);
    session_ = session;
    reading_.cancel();
    const bool compared = !std::exchange(others_, {}).empty();
    showStudies();
    if (compared) emit comparisonChanged();
    if (!session_) return;
    connect(&session_->runs(), &StudyRuns::generationSaved, this, [this] {
        const study::GenerationSummary& summary = session_->runs().summaries().back();
        // The median of several has this study in it.
        if (others_.size() > 1) return showStudies();
        shown_->front().append(summary, summary.trialsPerSecond());
        for (charts::StudyChart* chart : charts_)
            chart->studiesChanged();
    });
    connect(&session_->runs(), &StudyRuns::checkSaved, this, [this] {
        shown_->front().checks.push_back(session_->runs().checks().back());
        for (charts::StudyChart* chart : charts_)
            chart->studiesChanged();
    });
    connect(&session_->design(), &StudyDesign::partChanged, this, &LearningCharts::showStudies);
    connect(&session_->design(), &StudyDesign::settingsChanged, this, &LearningCharts::showStudies);
    connect(session_, &StudySession::pathChanged, this, &LearningCharts::showStudies);
}

void LearningCharts::compareWith(const std::vector<std::filesystem::path>& studies) {
    if (!session_) return;
    std::vector<std::filesystem::path> others = studies;
    std::erase(others, session_->path());
    if (others.empty()) {
        emit failed(tr("There is nothing to compare"),
                    tr("It is the study that is open. Choose another one."));
        return;
    }
    reading_.start([this, others]() -> session::NewestTask::Deliver {
        std::vector<session::StoredCurves> read;
        for (const std::filesystem::path& study : others) {
            auto curves = session::loadCurves(study);
            QString message;
            if (!curves) {
                message = QString::fromStdString(curves.error().message);
            } else if (curves->study.generations.empty()) {
                message = tr("It has no generations yet. Choose a study that has learned.");
            }
            if (!message.isEmpty())
                return [this, message, name = look::toText(study.filename())] {
                    emit failed(tr("%1 cannot be compared").arg(name), message);
                };
            read.push_back(std::move(*curves));
        }
        return [this, read = std::move(read)] {
            others_ = read;
            showStudies();
            emit comparisonChanged();
        };
    });
}

void LearningCharts::endComparison() {
    reading_.cancel();
    others_.clear();
    showStudies();
    emit comparisonChanged();
}

std::vector<study::ComparedStudy> LearningCharts::others() const {
    std::vector<study::ComparedStudy> others;
    for (const session::StoredCurves& other : others_)
        others.push_back(other.study);
    return others;
}

study::ComparedStudy LearningCharts::own() const {
    const StudyRuns& runs = session_->runs();
    const study::EvolutionSettings& evolution = session_->design().settings().evolution;
    study::ComparedStudy own;
    own.name = session_->path().stem().string();
    own.part = session_->design().part()->name;
    own.seed = evolution.seed;
    own.fallsAreForgiven = study::forgivesFalls(evolution);
    own.generations = runs.summaries();
    if (const study::Individual* best = runs.bestWinner()) own.best = *best;
    if (!runs.selections().empty() && !runs.selections().back().entries.empty())
        own.selected = runs.selections().back().entries.front();
    return own;
}

charts::StudyCurves LearningCharts::ownCurves() const {
    const std::vector<study::GenerationSummary>& summaries = session_->runs().summaries();
    std::vector<std::string> summed;
    for (const objectives::Objective* objective :
         study::summedObjectives(session_->design().settings().evolution))
        summed.emplace_back(objective->key);
    return {look::toText(session_->path().stem()),
            summaries,
            session_->runs().checks(),
            speedsOf(summaries),
            session_->design().attainable(),
            summed,
            session::findLaterCorners(session_->design().settings().evolution)};
}

charts::StudyCurves LearningCharts::otherCurves() const {
    if (others_.size() == 1) {
        const session::StoredCurves& other = others_.front();
        return {QString::fromStdString(other.study.name),
                other.study.generations,
                other.checks,
                speedsOf(other.study.generations),
                other.attainable,
                {},
                other.cornersFrom};
    }
    charts::StudyCurves all;
    all.name = tr("median and quartiles of %1 studies").arg(others_.size() + 1);
    all.attainable = session_->design().attainable();
    all.members.push_back(session_->runs().summaries());
    for (const session::StoredCurves& other : others_)
        all.members.push_back(other.study.generations);
    return all;
}

void LearningCharts::showStudies() {
    shown_ = std::make_shared<std::vector<charts::StudyCurves>>();
    if (session_) {
        shown_->push_back(ownCurves());
        if (!others_.empty()) shown_->push_back(otherCurves());
    }
    for (charts::StudyChart* chart : charts_)
        chart->shareStudies(shown_);
}

}  // namespace trapwright::pages
