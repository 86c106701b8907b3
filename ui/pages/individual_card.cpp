#include "ui/pages/individual_card.h"

#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>
#include <algorithm>
#include <vector>

#include "core/study/track_design.h"
#include "ui/look/folding_group.h"
#include "ui/look/text.h"
#include "ui/models/number_columns.h"
#include "ui/models/numbers.h"
#include "ui/pages/design_picture.h"
#include "ui/pages/fact_list.h"

namespace trapwright::pages {

namespace {

constexpr std::size_t kFew = 12;  // numbers, to be read one by one

QString fixed(double value, int decimals) {
    return QLocale().toString(value, 'f', decimals);
}

}  // namespace

IndividualCard::IndividualCard(QWidget* parent)
    : QWidget(parent),
      empty_(new QLabel(
          tr("No track has been learned yet. The scene shows the flat track that learning starts from."),
          this)),
      contents_(new QWidget(this)),
      success_(new FactList(contents_)),
      numbers_(new FactList(contents_)),
      details_(new look::FoldingGroup("evolve.algorithm", tr("Details of the algorithm"), true, contents_)),
      scores_(new FactList(details_)),
      traits_(new FactList(details_)),
      lengths_(new QLabel(contents_)),
      design_(new DesignPicture(details_)) {
    success_->setObjectName("evolve.parts");
    numbers_->setObjectName("evolve.numbers");
    empty_->setWordWrap(true);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    scores_->setObjectName("evolve.scores");
    lengths_->setObjectName("evolve.lengths");
    lengths_->setWordWrap(true);
    lengths_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    lengths_->setForegroundRole(QPalette::PlaceholderText);
    auto* column = new QVBoxLayout(contents_);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(success_);
    column->addWidget(numbers_);
    column->addWidget(lengths_);
    column->addWidget(details_);
    for (QWidget* detail : std::initializer_list<QWidget*>{scores_, traits_, design_})
        details_->body()->addWidget(detail);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(empty_);
    layout->addWidget(contents_);
    clear();
}

void IndividualCard::clear() {
    empty_->show();
    contents_->hide();
}

void IndividualCard::show(const study::Settings& settings, const study::Individual& individual) {
    const study::IndividualRecord& record = individual.record;
    Facts facts{{tr("Success"), models::shareText(record.success())},
                {tr("Parts"), record.trials == 0 ? tr("not simulated: the track crosses itself")
                                                 : tr("%1 of %2 finished, %3 stuck, %4 fell")
                                                       .arg(record.finished)
                                                       .arg(record.trials)
                                                       .arg(record.stuck)
                                                       .arg(record.fellOff)}};
    for (const objectives::Objective* objective : models::scoredObjectives(false)) {
        const objectives::Score* score = objectives::findScore(record.fitness, objective->key);
        if (score == nullptr || record.trials == 0) continue;
        facts.emplace_back(look::fromUtf8(objective->name),
                           models::scoreText(*objective, score) + ' ' + look::fromUtf8(objective->unit));
    }
    success_->show(facts);
    success_->setToolTip(models::successHelp(record.success()));
    Facts scores{{tr("Fitness F"), fixed(record.fitness.total, 3)}};
    for (const objectives::Objective& objective : objectives::allObjectives()) {
        const objectives::Score* score = objectives::findScore(record.fitness, objective.key);
        if (!objective.isDetail ||
            (score == nullptr && (objective.applies != nullptr || objective.needsWanted)))
            continue;
        scores.emplace_back(look::fromUtf8(objective.name) + ' ' + look::fromUtf8(objective.symbol),
                            models::scoreText(objective, score) + ' ' + look::fromUtf8(objective.unit));
    }
    scores_->show(scores);
    Facts traits;
    for (const search::NumberInfo& info : study::describeSearch(settings.evolution).traits) {
        const QString name = QString::fromStdString(info.name);
        const auto value = search::findNumber(record.traits, info.key);
        traits.emplace_back(name.left(1).toUpper() + name.mid(1),
                            value ? fixed(*value, info.decimals) : QStringLiteral("–"));
    }
    traits_->show(traits);
    traits_->setVisible(!traits.empty());
    const search::DesignSpace space = study::designSpace(settings.track);
    design_->show(record.design, space);
    showNumbers(space, record.design);
    empty_->hide();
    contents_->show();
}

void IndividualCard::showNumbers(const search::DesignSpace& space, const search::Design& design) {
    Facts numbers;
    if (design.size() <= kFew && design.size() == space.dimensions.size()) {
        for (std::size_t i = 0; i < design.size(); ++i) {
            const search::Dimension& dimension = space.dimensions[i];
            const QString key = QString::fromStdString(dimension.key);
            const bool degrees = dimension.unit == "deg";
            numbers.emplace_back(
                key.left(1).toUpper() + key.mid(1),
                fixed(dimension.low + design[i] * (dimension.high - dimension.low), 1) +
                    (degrees ? QStringLiteral("°") : ' ' + QString::fromStdString(dimension.unit)));
        }
    }
    numbers_->show(numbers);
    numbers_->setVisible(!numbers.empty());
}

void IndividualCard::showTrack(const track::Track& track) {
    std::vector<double> lengths;  // [mm]
    for (int i = track.firstTrapSection; i < track.lastTrapSection; ++i) {
        const auto at = static_cast<std::size_t>(i);
        lengths.push_back(1e3 * (track.sections[at + 1].x - track.sections[at].x));
    }
    if (lengths.size() > kFew) {
        const auto [least, most] = std::ranges::minmax(lengths);
        lengths_->setText(
            tr("%1 segments of %2 to %3 mm")
                .arg(QString::number(lengths.size()), look::numberText(least), look::numberText(most)));
        return;
    }
    QStringList texts;
    for (const double length : lengths)
        texts << look::numberText(length);
    lengths_->setText(tr("Segments of %1 mm").arg(texts.join(", ")));
}

}  // namespace trapwright::pages
