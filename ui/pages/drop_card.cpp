#include "ui/pages/drop_card.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>
#include <limits>

#include "core/study/presets.h"
#include "ui/look/text.h"
#include "ui/session/study_design.h"

namespace trapwright::pages {

using look::numberText;
using session::StudyDesign;

namespace {

constexpr int kUsualDrops = 200;
// What the surface's box has beside pairs.
constexpr int kTrack = -1;
constexpr int kOwn = -2;

bool sameContact(const trial::ContactParameters& a, const trial::ContactParameters& b) {
    // As far as the boxes tell: two digits.
    const auto same = [](double x, double y) { return qAbs(x - y) < 0.005; };
    return same(a.staticFriction, b.staticFriction) && same(a.kineticFriction, b.kineticFriction) &&
           same(a.restitution, b.restitution);
}

QString describe(const study::DropRecord& record) {
    const study::DropSettings& settings = record.settings;
    const QLocale locale;
    const int drops = record.result.drops();
    QString text =
        DropCard::tr(
            "%1 dropped from %2 mm; friction %3 static, %4 kinetic; restitution %5; seed "
            "%6; %7.")
            .arg(locale.toString(drops), numberText(settings.height * 1e3),
                 numberText(settings.contact.staticFriction), numberText(settings.contact.kineticFriction),
                 numberText(settings.contact.restitution), QString::number(settings.seed),
                 QString::fromStdString(record.engine));
    if (record.result.unsettled > 0) {
        text += ' ' + DropCard::tr("%1 of them (%2 %) came to rest in no pose.")
                          .arg(locale.toString(record.result.unsettled),
                               numberText(100.0 * record.result.unsettled / drops));
    }
    return text;
}

}  // namespace

DropCard::DropCard(QWidget* parent)
    : QWidget(parent),
      height_(makeNumber("drop.height", tr("Drop height"), study::kGreatestDropHeight * 1e3, 1)),
      surface_(new QComboBox(this)),
      static_(makeNumber("drop.static", tr("Static friction"), 2.0, 2)),
      kinetic_(makeNumber("drop.kinetic", tr("Kinetic friction"), 2.0, 2)),
      restitution_(makeNumber("drop.restitution", tr("Restitution"), 1.0, 2)),
      drops_(new QSpinBox(this)),
      seed_(new QSpinBox(this)),
      start_(new QPushButton(tr("Drop the part"), this)),
      busy_(new QWidget(this)),
      busyText_(new QLabel(busy_)),
      bar_(new QProgressBar(busy_)),
      last_(new QLabel(this)) {
    height_->setSuffix(" mm");
    height_->setToolTip(tr("Of the part's lowest point above a level plane"));
    surface_->setObjectName("drop.surface");
    surface_->setAccessibleName(tr("Surface"));
    surface_->setToolTip(tr("What the part falls on: its friction and restitution"));
    surface_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    surface_->setMinimumContentsLength(12);
    drops_->setObjectName("drop.drops");
    drops_->setAccessibleName(tr("Drops"));
    drops_->setRange(1, study::kMostDrops);
    drops_->setGroupSeparatorShown(true);
    drops_->setToolTip(tr("More of them make the bounds of the shares narrower"));
    seed_->setObjectName("drop.seed");
    seed_->setAccessibleName(tr("Seed"));
    seed_->setRange(0, std::numeric_limits<int>::max());
    seed_->setToolTip(tr("The same seed drops the part in the same orientations"));
    start_->setObjectName("drop.start");
    last_->setObjectName("drop.last");
    last_->setWordWrap(true);
    last_->setForegroundRole(QPalette::PlaceholderText);

    auto* form = new QFormLayout;
    form->setContentsMargins(0, 0, 0, 0);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->addRow(tr("Drop height"), height_);
    form->addRow(tr("Surface"), surface_);
    form->addRow(tr("Static friction"), static_);
    form->addRow(tr("Kinetic friction"), kinetic_);
    form->addRow(tr("Restitution"), restitution_);
    form->addRow(tr("Drops"), drops_);
    form->addRow(tr("Seed"), seed_);

    busyText_->setObjectName("drop.progress");
    bar_->setObjectName("drop.bar");
    bar_->setTextVisible(false);
    bar_->setFixedHeight(6);
    auto* cancel = new QPushButton(tr("Cancel"), busy_);
    cancel->setObjectName("drop.cancel");
    connect(cancel, &QPushButton::clicked, this, [this] {
        if (design_) design_->cancelDrops();
    });
    auto* busyRow = new QHBoxLayout;
    busyRow->addWidget(busyText_, 1);
    busyRow->addWidget(cancel);
    auto* busyLayout = new QVBoxLayout(busy_);
    busyLayout->setContentsMargins(0, 0, 0, 0);
    busyLayout->setSpacing(4);
    busyLayout->addLayout(busyRow);
    busyLayout->addWidget(bar_);

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addLayout(form);
    column->addWidget(start_, 0, Qt::AlignRight);
    column->addWidget(busy_);
    column->addWidget(last_);

    showSettings([] {
        study::DropSettings usual;
        usual.drops = kUsualDrops;
        return usual;
    }());
    connect(surface_, &QComboBox::activated, this, &DropCard::takeSurface);
    const auto touched = [this] {
        touched_ = true;
        showSurface();
        showState();
    };
    for (QDoubleSpinBox* box : {height_, static_, kinetic_, restitution_})
        connect(box, &QDoubleSpinBox::valueChanged, this, touched);
    for (QSpinBox* box : {drops_, seed_})
        connect(box, &QSpinBox::valueChanged, this, touched);
    connect(start_, &QPushButton::clicked, this, [this] {
        if (design_) design_->startDrops(settings());
    });
    showState();
}

QDoubleSpinBox* DropCard::makeNumber(const QString& name, const QString& title, double high, int decimals) {
    auto* box = new QDoubleSpinBox(this);
    box->setObjectName(name);
    box->setAccessibleName(title);
    box->setRange(0.0, high);
    box->setDecimals(decimals);
    box->setSingleStep(decimals == 1 ? 5.0 : 0.05);
    return box;
}

void DropCard::setDesign(StudyDesign* design) {
    if (design_) design_->disconnect(this);
    design_ = design;
    touched_ = false;
    if (design_) connect(design_, &StudyDesign::dropsChanged, this, &DropCard::showState);
    showState();
}

void DropCard::refresh(const part::MaterialLibrary& library) {
    if (!design_) return;
    listSurfaces(library);
    if (!touched_) {
        study::DropSettings shown = settings();
        if (const auto last = design_->dropTest()) {
            shown = last->settings;
        } else {
            shown.contact = design_->settings().simulation.contact;
        }
        showSettings(shown);
    }
    showSurface();
    showState();
}

void DropCard::listSurfaces(const part::MaterialLibrary& library) {
    const QSignalBlocker blocker(surface_);
    surface_->clear();
    pairs_.clear();
    surface_->addItem(tr("As on the track"), kTrack);
    if (const part::Material* material = study::findUsedMaterial(library, design_->settings().part)) {
        for (const part::MaterialPair& pair : library.pairs) {
            if (pair.material != material->name) continue;
            surface_->addItem(QString::fromStdString(pair.surface), static_cast<int>(pairs_.size()));
            surface_->setItemData(surface_->count() - 1, QString::fromStdString(part::describeSources(pair)),
                                  Qt::ToolTipRole);
            pairs_.push_back(pair);
        }
    }
    surface_->addItem(tr("Own values"), kOwn);
}

void DropCard::takeSurface() {
    const int chosen = surface_->currentData().toInt();
    if (chosen == kOwn || !design_) return static_->setFocus();
    study::DropSettings taken = settings();
    taken.contact = chosen == kTrack ? design_->settings().simulation.contact
                                     : study::contactOf(pairs_[static_cast<std::size_t>(chosen)]);
    showSettings(taken);
    touched_ = true;
}

void DropCard::showSettings(const study::DropSettings& settings) {
    const QSignalBlocker blockers[] = {QSignalBlocker(height_),  QSignalBlocker(static_),
                                       QSignalBlocker(kinetic_), QSignalBlocker(restitution_),
                                       QSignalBlocker(drops_),   QSignalBlocker(seed_)};
    height_->setValue(settings.height * 1e3);
    static_->setValue(settings.contact.staticFriction);
    kinetic_->setValue(settings.contact.kineticFriction);
    restitution_->setValue(settings.contact.restitution);
    drops_->setValue(settings.drops);
    seed_->setValue(
        static_cast<int>(std::min<std::uint64_t>(settings.seed, std::numeric_limits<int>::max())));
}

void DropCard::showSurface() {
    if (!design_) return;
    const trial::ContactParameters contact = settings().contact;
    const QVariant present = surface_->currentData();
    const auto fits = [&](const QVariant& item) {
        const int index = item.toInt();
        if (!item.isValid() || index == kOwn) return false;
        return sameContact(contact, index == kTrack
                                        ? design_->settings().simulation.contact
                                        : study::contactOf(pairs_[static_cast<std::size_t>(index)]));
    };
    // What was chosen stays, where several have the same numbers.
    if (fits(present)) return;
    int index = surface_->findData(kOwn);
    for (int i = surface_->count() - 1; i >= 0; --i)
        if (fits(surface_->itemData(i))) index = i;
    const QSignalBlocker blocker(surface_);
    surface_->setCurrentIndex(index);
}

study::DropSettings DropCard::settings() const {
    study::DropSettings settings;
    settings.drops = drops_->value();
    settings.height = height_->value() * 1e-3;
    settings.contact = {static_->value(), kinetic_->value(), restitution_->value()};
    settings.seed = static_cast<std::uint64_t>(seed_->value());
    if (!design_) return settings;
    const study::SimulationSettings& simulation = design_->settings().simulation;
    settings.gravity = simulation.gravity;
    // The boxes show two digits; the track's numbers have them all.
    if (sameContact(settings.contact, simulation.contact)) settings.contact = simulation.contact;
    return settings;
}

void DropCard::showState() {
    const auto drops = design_ ? design_->drops() : std::nullopt;
    busy_->setVisible(drops.has_value());
    start_->setVisible(!drops);
    const bool frictions = kinetic_->value() <= static_->value();
    start_->setEnabled(design_ != nullptr && frictions);
    start_->setToolTip(frictions ? QString()
                                 : tr("The kinetic friction must not be above the static friction"));
    if (drops) {
        const int done = drops->sofar.drops();
        const QLocale locale;
        busyText_->setText(
            tr("Dropped %1 of %2").arg(locale.toString(done), locale.toString(drops->settings.drops)));
        bar_->setRange(0, drops->settings.drops);
        bar_->setValue(done);
    }
    const auto last = design_ ? design_->dropTest() : std::nullopt;
    last_->setVisible(!drops);
    const bool counts = design_ && design_->settings().part.poseWeights == study::PoseWeights::dropped;
    last_->setText(last     ? describe(*last)
                   : counts ? tr("Not dropped yet; until then the estimate counts.")
                            : tr("Not dropped yet."));
}

}  // namespace trapwright::pages
