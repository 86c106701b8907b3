#include "ui/charts/study_chart.h"

#include <limits>

#include "ui/charts/study_sheets.h"

namespace trapwright::charts {

StudyChart::StudyChart(const QString& name, const QString& title, SheetMaker make, QWidget* parent)
    : CurveChart(name, title, parent), make_(make) {
    update();
}

void StudyChart::setStudies(std::vector<StudyCurves> studies) {
    studies_ = std::move(studies);
    update();
}

void StudyChart::appendGeneration(const study::GenerationSummary& summary, double trialsPerSecond) {
    if (studies_.empty()) studies_.emplace_back();
    StudyCurves& study = studies_.front();
    study.trialsPerSecond.resize(study.summaries.size(), std::numeric_limits<double>::quiet_NaN());
    study.trialsPerSecond.push_back(trialsPerSecond);
    study.summaries.push_back(summary);
    update();
}

void StudyChart::appendCheck(const study::CheckRecord& check) {
    if (studies_.empty()) studies_.emplace_back();
    studies_.front().checks.push_back(check);
    update();
}

void StudyChart::update() {
    setSheet(make_(studies_));
}

SuccessChart::SuccessChart(QWidget* parent) : StudyChart("success", tr("Success"), &successSheet, parent) {
    setEmptyText(tr(
        "The learning curve begins when the first generation is complete. Generations that were learned by a "
        "program that did not count success have none."));
}

FitnessChart::FitnessChart(QWidget* parent) : StudyChart("fitness", tr("Fitness"), &fitnessSheet, parent) {
    setEmptyText(tr("The learning curves begin when the first generation is complete."));
}

StrategyChart::StrategyChart(QWidget* parent)
    : StudyChart("strategy", tr("Strategy values"), &strategySheet, parent) {
    setEmptyText(tr("The strategy values appear when the first generation is complete."));
}

SpeedChart::SpeedChart(QWidget* parent) : StudyChart("speed", tr("Speed"), &speedSheet, parent) {
    setEmptyText(tr("The speed appears when the first generation is complete."));
}

EngineChart::EngineChart(QWidget* parent) : StudyChart("engines", tr("Engines"), &engineSheet, parent) {
    setEmptyText(
        tr("With the engine \"hybrid\" each generation's winner is simulated again by Simbody; what came out "
           "appears here."));
}

}  // namespace trapwright::charts
