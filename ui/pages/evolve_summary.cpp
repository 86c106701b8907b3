#include "ui/pages/evolve_summary.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>

#include "core/base/math.h"
#include "ui/look/text.h"
#include "ui/pages/fact_list.h"
#include "ui/pages/target_card.h"

namespace trapwright::pages {

namespace {

constexpr double kMillimetre = 1e-3;

QString millimetres(double metres) {
    return look::numberText(metres / kMillimetre);
}

QString objectiveText(const study::EvolutionSettings& evolution) {
    const auto list = objectives::readObjectives(evolution.objectives);
    return QString::fromStdString(list ? objectives::describeSum(*list) : evolution.objectives);
}

QString searchText(const study::EvolutionSettings& evolution) {
    switch (evolution.search) {
        case search::Method::genetic:
            return EvolveSummary::tr("genetic, tournaments of %1").arg(evolution.tournamentSize);
        case search::Method::random:
            return EvolveSummary::tr("random");
        case search::Method::exchange:
            return EvolveSummary::tr("exchanges in the best track");
    }
    return {};
}

QString stepText(const study::Settings& settings) {
    const QString text = EvolveSummary::tr("%1 ms while learning")
                             .arg(look::numberText(study::chooseLearningStep(settings) * 1e3));
    return settings.evolution.learningStep > 0.0 ? text : EvolveSummary::tr("%1 (automatic)").arg(text);
}

Facts factsOf(const study::Settings& settings, const part::Part& part) {
    const study::TrackSettings& track = settings.track;
    const study::EvolutionSettings& evolution = settings.evolution;
    const trial::Vibration& drive = settings.simulation.drive;
    const trial::ContactParameters& contact = settings.simulation.contact;
    QString feeder = track.shape.type == track::FeederType::bowl
                         ? EvolveSummary::tr("bowl of %1 mm radius").arg(millimetres(track.shape.bowlRadius))
                         : EvolveSummary::tr("linear");
    const QString slope = look::numberText(std::abs(track.shape.slope) / base::kDegree);
    if (track.shape.slope > 0.0) feeder = EvolveSummary::tr("%1, climbs by %2°").arg(feeder, slope);
    if (track.shape.slope < 0.0) feeder = EvolveSummary::tr("%1, falls by %2°").arg(feeder, slope);
    return {
        {EvolveSummary::tr("Wanted"), wantedText(settings.target, part)},
        {EvolveSummary::tr("Feeder"), feeder},
        {EvolveSummary::tr("Trap"), track.traps == "free-form" ? EvolveSummary::tr("%1 sections of %2 points")
                                                                     .arg(track.crossSections)
                                                                     .arg(track.pointsPerSection)
                                                               : QString::fromStdString(track.traps)},
        {EvolveSummary::tr("Segments"),
         EvolveSummary::tr("%1 to %2 mm long")
             .arg(millimetres(track.minSegmentLength), millimetres(track.maxSegmentLength))},
        {EvolveSummary::tr("Cross-section"),
         EvolveSummary::tr("%1 mm wide, %2 mm high")
             .arg(millimetres(track.segmentWidth), millimetres(track.segmentHeight))},
        {EvolveSummary::tr("Drive"),
         EvolveSummary::tr("%1 Hz, %2 mm half-stroke, %3°")
             .arg(look::numberText(drive.frequency), millimetres(drive.halfStroke),
                  look::numberText(drive.angle / base::kDegree))},
        {EvolveSummary::tr("Friction"),
         EvolveSummary::tr("%1 static, %2 kinetic")
             .arg(look::numberText(contact.staticFriction), look::numberText(contact.kineticFriction))},
        {EvolveSummary::tr("Population"), EvolveSummary::tr("%1, with %2 trials each")
                                              .arg(evolution.populationSize)
                                              .arg(evolution.trialsPerEvaluation)},
        {EvolveSummary::tr("Search"), searchText(evolution)},
        {EvolveSummary::tr("Objective"), objectiveText(evolution)},
        {EvolveSummary::tr("Step"), stepText(settings)},
        {EvolveSummary::tr("Seed"), QString::number(evolution.seed)},
    };
}

}  // namespace

EvolveSummary::EvolveSummary(QWidget* parent)
    : QWidget(parent), facts_(new FactList(this)), reason_(new QLabel(this)), change_(new QPushButton(this)) {
    setObjectName("evolve.summary");
    reason_->setWordWrap(true);
    reason_->setForegroundRole(QPalette::PlaceholderText);
    reason_->setText(
        tr("All tracks of a study are learned with the same settings, so a change makes a new study."));
    change_->setObjectName("evolve.change");
    connect(change_, &QPushButton::clicked, this, &EvolveSummary::changeWanted);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(facts_);
    layout->addWidget(reason_);
    layout->addWidget(change_, 0, Qt::AlignRight);
}

void EvolveSummary::show(const study::Settings& settings, const part::Part& part, bool locked) {
    facts_->show(factsOf(settings, part));
    reason_->setVisible(locked);
    change_->setText(locked ? tr("Change in a new study") : tr("Change"));
    change_->setToolTip(locked ? tr("A new study with the same part and settings, and no generations")
                               : tr("Opens the Track page"));
}

}  // namespace trapwright::pages
