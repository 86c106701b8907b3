#include "ui/charts/study_chart.h"

#include <utility>

#include "ui/charts/study_sheets.h"

namespace trapwright::charts {

StudyChart::StudyChart(const QString& name, const QString& title, SheetMaker make, QWidget* parent)
    : CurveChart(name, title, parent), make_(make) {
    setStudies({});
}

void StudyChart::setStudies(std::vector<StudyCurves> studies) {
    shareStudies(std::make_shared<const std::vector<StudyCurves>>(std::move(studies)));
}

void StudyChart::shareStudies(std::shared_ptr<const std::vector<StudyCurves>> studies) {
    studies_ = std::move(studies);
    studiesChanged();
}

void StudyChart::setEmptyTexts(const QString& before, const QString& without) {
    before_ = before;
    without_ = without;
    studiesChanged();
}

void StudyChart::studiesChanged() {
    const bool begun = !studies().empty() && !studies().front().summaries.empty();
    if (!before_.isEmpty()) setEmptyText(begun ? without_ : before_);
    setSheet(make_(studies()));
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
