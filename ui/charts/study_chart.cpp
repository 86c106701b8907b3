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

void StudyChart::setEmptyTexts(const QString& before, const QString& without) {
    before_ = before;
    without_ = without;
    update();
}

void StudyChart::update() {
    const bool begun = !studies_.empty() && !studies_.front().summaries.empty();
    if (!before_.isEmpty()) setEmptyText(begun ? without_ : before_);
    setSheet(make_(studies_));
}

SuccessChart::SuccessChart(QWidget* parent) : StudyChart("success", tr("Success"), &successSheet, parent) {
    setEmptyTexts(tr("The learning curve begins when the first generation is complete."),
                  tr("These generations were learned by an older Trapwright, which did not count success."));
}

FitnessChart::FitnessChart(QWidget* parent) : StudyChart("fitness", tr("Fitness"), &fitnessSheet, parent) {
    setEmptyText(tr("The learning curves begin when the first generation is complete."));
}

SearchChart::SearchChart(QWidget* parent) : StudyChart("search", tr("Search"), &searchSheet, parent) {
    setEmptyText(tr("What the search tells of itself appears when the first generation is complete."));
}

SpeedChart::SpeedChart(QWidget* parent) : StudyChart("speed", tr("Speed"), &speedSheet, parent) {
    setEmptyText(tr("The speed appears when the first generation is complete."));
}

EngineChart::EngineChart(QWidget* parent) : StudyChart("engines", tr("Engines"), &engineSheet, parent) {
    setEmptyText(
        tr("With the engine \"hybrid\" each generation's winner is simulated again by the reference engine; "
           "what came out appears here."));
}

}  // namespace trapwright::charts
