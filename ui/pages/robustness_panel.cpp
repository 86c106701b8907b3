#include "ui/pages/robustness_panel.h"

#include "core/stats/binomial.h"
#include "ui/charts/robustness_chart.h"
#include "ui/models/numbers.h"
#include "ui/pages/panel_head.h"

namespace trapwright::pages {

namespace {

constexpr std::size_t kShownCorners = 2;
/// Of a corner of more conditions only one has room.
constexpr std::size_t kFewConditions = 4;

/// "<a>95.2 %</a> (94.5 … 95.8)".
QString linkOf(std::size_t link, const study::PlaceResult& result) {
    const trial::Tally& tally = result.tally;
    const stats::Interval bounds = stats::calcClopperPearson(tally.success, tally.trials());
    return QString("<a href=\"%1\"><b>%2 %</b></a> (%3 … %4)")
        .arg(link)
        .arg(models::percent(tally.success, tally.trials()))
        .arg(100.0 * bounds.low, 0, 'f', 1)
        .arg(100.0 * bounds.high, 0, 'f', 1);
}

}  // namespace

RobustnessPanel::RobustnessPanel()
    : chart_(new charts::RobustnessChart(this)),
      head_(new PanelHead("review.robustness.head", this, chart_)) {
    setObjectName("review.robustnessPanel");
    setAccessibleName(tr("Robustness"));
    chart_->setEmptyText(
        tr("How this track does with other friction, restitution, stroke and size of the parts is not known "
           "yet. Measure its robustness to see it."));
    connect(head_, &QLabel::linkActivated, this,
            [this](const QString& link) { goTo(links_[link.toUInt()].trials); });
    connect(chart_, &charts::RobustnessChart::picked, this, &RobustnessPanel::goTo);
    connect(chart_, &charts::ChartPanel::failed, this, &RobustnessPanel::failed);
    setMeasured(nullptr, {});
}

void RobustnessPanel::setMeasured(const study::RobustnessRecord* measured, const study::Settings& settings) {
    measured_.reset();
    settings_ = settings;
    if (measured != nullptr) {
        measured_ = *measured;
        settings_.box = measured->box;
    }
    head_->setVisible(measured_.has_value());
    if (measured_) {
        chart_->setRobustness(settings_, measured_->robustness);
        showHead();
    } else {
        chart_->clear();
    }
}

void RobustnessPanel::showHead() {
    const study::Robustness& robustness = measured_->robustness;
    links_ = {robustness.nominal, robustness.overBox};
    QString text = tr("Success as set %1, all over the operating box %2. ")
                       .arg(linkOf(0, links_[0]), linkOf(1, links_[1]));
    QStringList corners;
    for (const study::PlaceResult& corner : robustness.corners) {
        // The saved numbers have all of them; more would take the room of the curves.
        const std::size_t shown = robustness.sweeps.size() > kFewConditions ? 1 : kShownCorners;
        if (static_cast<std::size_t>(corners.size()) == shown) break;
        corners << linkOf(links_.size(), corner) + u' ' + nameOf(corner.trials).toHtmlEscaped();
        links_.push_back(corner);
    }
    text += (corners.size() > 1 ? tr("Worst corners: ") : tr("Worst corner: ")) + corners.join("; ") +
            tr(". Simulated by %1; choose a number, a point or a cell to see its trials.")
                .arg(QString::fromStdString(measured_->engine));
    head_->setText(text);
}

QString RobustnessPanel::nameOf(const study::PlaceTrials& trials) const {
    if (!trials.place) return tr("All over the operating box");
    return QString::fromStdString(study::describePlace(settings_, *trials.place)).replace(" deg", "°");
}

void RobustnessPanel::goTo(const study::PlaceTrials& trials) {
    const auto hasFailures = [&](const study::PlaceResult& result) {
        return result.trials == trials && result.tally.success < result.tally.trials();
    };
    const study::Robustness& robustness = measured_->robustness;
    bool fails = hasFailures(robustness.nominal) || hasFailures(robustness.overBox);
    for (const study::ConditionSweep& sweep : robustness.sweeps)
        for (const study::PlaceResult& point : sweep.points)
            fails = fails || hasFailures(point);
    for (const study::PlaceResult& corner : robustness.corners)
        fails = fails || hasFailures(corner);
    if (robustness.worstPair)
        for (const study::PlaceResult& place : robustness.worstPair->places)
            fails = fails || hasFailures(place);
    std::set<trial::Verdict> verdicts = {trial::Verdict::wrongOrientation, trial::Verdict::stuck,
                                         trial::Verdict::fellOff};
    if (!fails) verdicts.insert(trial::Verdict::success);
    emit trialsWanted({trials, measured_->box, robustness.goal, measured_->engine}, nameOf(trials), verdicts);
}

}  // namespace trapwright::pages
