#include "ui/pages/learning_charts.h"

#include <QTabWidget>
#include <algorithm>

#include "ui/charts/study_chart.h"
#include "ui/look/text.h"
#include "ui/session/study_curves.h"
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
    const bool compared = std::exchange(other_, std::nullopt).has_value();
    showStudies();
    if (compared) emit comparisonChanged();
    if (!session_) return;
    connect(&session_->runs(), &StudyRuns::generationSaved, this, [this] {
        const study::GenerationSummary& summary = session_->runs().summaries().back();
        for (charts::StudyChart* chart : charts_)
            chart->appendGeneration(summary, summary.trialsPerSecond());
    });
    connect(&session_->runs(), &StudyRuns::checkSaved, this, [this] {
        for (charts::StudyChart* chart : charts_)
            chart->appendCheck(session_->runs().checks().back());
    });
    connect(&session_->design(), &StudyDesign::partChanged, this, &LearningCharts::showStudies);
    connect(&session_->design(), &StudyDesign::settingsChanged, this, &LearningCharts::showStudies);
    connect(session_, &StudySession::pathChanged, this, &LearningCharts::showStudies);
}

void LearningCharts::compareWith(const std::filesystem::path& study) {
    if (!session_) return;
    const QString what = tr("%1 cannot be compared").arg(look::toText(study.filename()));
    if (study == session_->path()) {
        emit failed(what, tr("It is the study that is open. Choose another one."));
        return;
    }
    reading_.start([this, study, what]() -> session::NewestTask::Deliver {
        auto curves = session::loadCurves(study);
        if (!curves) {
            return [this, what, message = curves.error().message] {
                emit failed(what, QString::fromStdString(message));
            };
        }
        charts::StudyCurves other{
            QString::fromStdString(curves->name), std::move(curves->summaries), std::move(curves->checks), {},
            std::move(curves->attainable),        curves->cornersFrom};
        other.trialsPerSecond = speedsOf(other.summaries);
        return [this, what, other = std::move(other)] {
            if (other.summaries.empty()) {
                emit failed(what, tr("It has no generations yet. Choose a study that has learned."));
                return;
            }
            other_ = other;
            showStudies();
            emit comparisonChanged();
        };
    });
}

void LearningCharts::endComparison() {
    reading_.cancel();
    other_.reset();
    showStudies();
    emit comparisonChanged();
}

QString LearningCharts::comparedName() const {
    return other_ ? other_->name : QString();
}

void LearningCharts::showStudies() {
    std::vector<charts::StudyCurves> studies;
    if (session_) {
        const std::vector<study::GenerationSummary>& summaries = session_->runs().summaries();
        studies.push_back({look::toText(session_->path().stem()), summaries, session_->runs().checks(),
                           speedsOf(summaries), session_->design().attainable(),
                           session::findLaterCorners(session_->design().settings().evolution)});
        if (other_) studies.push_back(*other_);
    }
    for (charts::StudyChart* chart : charts_)
        chart->setStudies(studies);
}

}  // namespace trapwright::pages
