#include "ui/pages/target_card.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/study/target.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"
#include "ui/pages/orientation_editor.h"
#include "ui/scene/when_ready.h"

namespace trapwright::pages {

namespace {

constexpr int kColumns = 3;
constexpr QSize kPicture(84, 68);
constexpr const char* kAnyHeading = "any";

/// Without the objectives that there are only where something is wanted; the paper's if nothing is left.
std::string withoutWanted(const std::string& objectives) {
    const auto list = objectives::readObjectives(objectives);
    if (!list) return objectives;
    std::string kept;
    bool isChanged = false;
    for (const objectives::Objective* objective : *list) {
        isChanged = isChanged || objective->needsWanted;
        if (!objective->needsWanted) kept += (kept.empty() ? "" : ", ") + std::string(objective->key);
    }
    if (!isChanged) return objectives;
    return kept.empty() ? std::string(objectives::kPaperObjectives) : kept;
}

bool isCounted(const study::EvolutionSettings& evolution) {
    const auto list = objectives::readObjectives(evolution.objectives);
    return list && std::ranges::any_of(*list, &objectives::Objective::usesTolerance);
}

}  // namespace

QString wantedText(const study::TargetSettings& target, const part::Part& part) {
    if (!target.isSet()) return TargetCard::tr("Any one way");
    if (target.orientation)
        return target.orientationTurns ? TargetCard::tr("An orientation set by hand, any heading")
                                       : TargetCard::tr("An orientation set by hand");
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    QStringList names;
    for (const int group : study::findWantedGroups(target, groups))
        names += models::poseNumbers(groups[static_cast<std::size_t>(group)].poses);
    if (names.empty()) names += QString::fromStdString(target.poses);
    const auto heading = study::readHeading(target.heading);
    return TargetCard::tr("Pose %1, %2")
        .arg(names.join(TargetCard::tr(" or ")),
             heading && *heading
                 ? TargetCard::tr("heading %1°").arg(look::numberText(**heading / base::kDegree))
                 : TargetCard::tr("any heading"));
}

TargetCard::TargetCard(QWidget* parent)
    : QWidget(parent),
      grid_(new QGridLayout),
      editor_(new OrientationEditor(this)),
      headingRow_(new QWidget(this)),
      anyHeading_(new QCheckBox(tr("Any heading"), headingRow_)),
      heading_(new QDoubleSpinBox(headingRow_)),
      told_(new QLabel(this)),
      proposal_(new QWidget(this)),
      proposalText_(new QLabel(proposal_)) {
    setObjectName("targetCard");
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setSpacing(8);
    for (int column = 0; column < kColumns; ++column)
        grid_->setColumnStretch(column, 1);

    anyHeading_->setObjectName("target.anyHeading");
    anyHeading_->setToolTip(tr("Which side is up counts, however the part is turned about the vertical."));
    heading_->setObjectName("target.heading");
    heading_->setAccessibleName(tr("Heading"));
    heading_->setRange(-360.0, 360.0);
    heading_->setDecimals(1);
    heading_->setSuffix(QStringLiteral("°"));
    heading_->setKeyboardTracking(false);
    heading_->setFocusPolicy(Qt::StrongFocus);
    heading_->setToolTip(
        tr("How far the part is turned about the vertical, anticlockwise seen from above, from how its "
           "pose is listed; the command track tells headings likewise."));
    auto* headingLayout = new QHBoxLayout(headingRow_);
    headingLayout->setContentsMargins(0, 0, 0, 0);
    headingLayout->addWidget(anyHeading_, 1);
    headingLayout->addWidget(heading_);
    connect(anyHeading_, &QCheckBox::clicked, this, &TargetCard::chooseHeading);
    connect(heading_, &QDoubleSpinBox::valueChanged, this, &TargetCard::chooseHeading);

    connect(editor_, &OrientationEditor::chosen, this, [this](const base::Quaternion& orientation) {
        study::TargetSettings target = settings_.target;
        target.poses.clear();
        target.orientation = orientation;
        choose(std::move(target), tr("Wanted: by hand"));
    });
    connect(editor_, &OrientationEditor::ended, this, [this] {
        refresh();
        emit sceneFreed();
    });

    told_->setObjectName("target.told");
    told_->setWordWrap(true);
    proposal_->setObjectName("target.proposal");
    proposalText_->setWordWrap(true);
    proposalText_->setText(
        tr("Learning does not look at it yet: what it maximises is content with any way. "
           "Recommended: %1.")
            .arg(QString::fromUtf8(objectives::kWantedObjectives.data(),
                                   static_cast<qsizetype>(objectives::kWantedObjectives.size()))));
    auto* count = new QPushButton(tr("Learn for it"), proposal_);
    count->setObjectName("target.count");
    connect(count, &QPushButton::clicked, this, &TargetCard::countIt);
    auto* proposalLayout = new QVBoxLayout(proposal_);
    proposalLayout->setContentsMargins(0, 4, 0, 4);
    proposalLayout->addWidget(proposalText_);
    proposalLayout->addWidget(count, 0, Qt::AlignRight);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addLayout(grid_);
    layout->addWidget(editor_);
    layout->addWidget(headingRow_);
    layout->addWidget(told_);
    layout->addWidget(proposal_);
}

void TargetCard::show(std::shared_ptr<const part::Part> part, const study::Settings& settings) {
    settings_ = settings;
    if (part != part_) {
        editor_->end();
        part_ = std::move(part);
        groups_ = part_ ? part::findPoseGroups(*part_) : std::vector<part::PoseGroup>();
        rebuild();
    }
    refresh();
}

void TargetCard::setLocked(bool locked) {
    if (locked) editor_->end();
    setEnabled(!locked);
}

void TargetCard::setScene(scene::SceneView* scene) {
    editor_->end();
    scene_ = scene;
}

bool TargetCard::hasScene() const {
    return editor_->hasBegun();
}

void TargetCard::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) {
        rebuild();
        refresh();
    }
}

void TargetCard::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (!stale_) return;
    rebuild();
    refresh();
}

void TargetCard::rebuild() {
    // Pictures cost some milliseconds each: drawn only when they are seen.
    stale_ = !isVisible();
    if (stale_) return;
    delete any_;
    any_ = nullptr;
    qDeleteAll(poses_);
    poses_.clear();
    delete byHand_;
    byHand_ = nullptr;
    drawnByHand_.reset();
    if (!part_) return;
    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    pictures_.setTheme(dark ? scene::SceneTheme::dark() : scene::SceneTheme::light());
    any_ = addButton("target.any", tr("Any one way"));
    any_->setToolTip(tr("Parts shall all end alike, in whatever way: as in the paper."));
    connect(any_, &QToolButton::clicked, this, &TargetCard::chooseAny);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const std::vector<int>& poses = groups_[g].poses;
        QToolButton* button =
            addButton(QString("target.pose%1").arg(poses.front() + 1), models::poseName(poses));
        button->setToolTip(tr("Parts that leave the track like this are right. Several can be chosen."));
        button->setAccessibleName(tr("Wanted: stable %1").arg(models::poseName(poses)));
        poses_.push_back(button);
        connect(button, &QToolButton::clicked, this, [this, g] { toggle(g); });
        drawPicture(*button, part_->stablePoses[static_cast<std::size_t>(poses.front())].rotation);
    }
    byHand_ = addButton("target.byHand", tr("By hand..."));
    byHand_->setToolTip(
        tr("Turn the part in the scene until it lies as it shall leave the track, its heading included if "
           "not any will do."));
    connect(byHand_, &QToolButton::clicked, this, &TargetCard::turnByHand);
}

void TargetCard::drawPicture(QToolButton& button, const base::Quaternion& rotation) {
    button.setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    button.setIconSize(kPicture);
    scene::whenReady(pictures_.partPicture(part_, rotation, kPicture, devicePixelRatioF()), &button,
                     [&button](const QImage& drawn) { button.setIcon(QPixmap::fromImage(drawn)); });
}

QToolButton* TargetCard::addButton(const QString& name, const QString& text) {
    auto* button = new QToolButton(this);
    button->setObjectName(name);
    button->setText(text);
    button->setCheckable(true);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    const int place = grid_->count();
    grid_->addWidget(button, place / kColumns, place % kColumns);
    return button;
}

void TargetCard::refresh() {
    if (!part_) return;
    const study::TargetSettings& target = settings_.target;
    const std::vector<int> wanted = study::findWantedGroups(target, groups_);
    if (any_ != nullptr) any_->setChecked(!target.isSet());
    for (std::size_t g = 0; g < poses_.size(); ++g)
        poses_[g]->setChecked(std::ranges::find(wanted, static_cast<int>(g)) != wanted.end());
    if (byHand_ != nullptr) {
        byHand_->setChecked(target.orientation.has_value() || editor_->hasBegun());
        if (!target.orientation) {
            byHand_->setIcon({});
            byHand_->setToolButtonStyle(Qt::ToolButtonTextOnly);
        } else if (!drawnByHand_ || drawnByHand_->coeffs() != target.orientation->coeffs()) {
            drawPicture(*byHand_, *target.orientation);
        }
        drawnByHand_ = target.orientation;
    }
    const auto heading = study::readHeading(target.heading);
    const bool isAny = target.orientation ? target.orientationTurns : !heading || !*heading;
    headingRow_->setVisible(target.isSet());
    heading_->setVisible(!target.orientation);
    anyHeading_->setChecked(isAny);
    heading_->setEnabled(!isAny);
    const QSignalBlocker quiet(heading_);
    heading_->setValue(heading && *heading ? **heading / base::kDegree : 0.0);

    QString told = wantedText(target, *part_) + '.';
    if (!target.isSet()) {
        told += ' ' + tr("Choose poses if parts shall leave the track so.");
    } else {
        told +=
            ' ' + tr("Success is the share of parts that end so, on every page; a perfect feeder has 100 %.");
        const double lean = study::findLean(settings_.track);
        if (!target.orientation && lean > 0.0)
            told += ' ' + tr("They may lean across the track by up to %1°, as its end does.")
                              .arg(look::numberText(lean / base::kDegree));
    }
    const std::vector<std::string> problems = study::findTargetPartProblems(target, *part_);
    if (!problems.empty())
        told = tr("The part has no such pose: %1.").arg(QString::fromStdString(target.poses));
    told_->setText(told);
    told_->setVisible(!editor_->hasBegun());
    proposal_->setVisible(target.isSet() && !isCounted(settings_.evolution));
}

void TargetCard::chooseAny() {
    choose({{}, settings_.target.heading, {}}, tr("Wanted: any one way"));
}

void TargetCard::turnByHand() {
    if (scene_ == nullptr || !part_ || part_->stablePoses.empty()) return refresh();
    const std::vector<int> wanted = study::findWantedGroups(settings_.target, groups_);
    base::Quaternion first = part_->stablePoses.front().rotation;
    if (settings_.target.orientation)
        first = *settings_.target.orientation;
    else if (!wanted.empty())
        first = part_
                    ->stablePoses[static_cast<std::size_t>(
                        groups_[static_cast<std::size_t>(wanted.front())].poses.front())]
                    .rotation;
    editor_->begin(*scene_, part_, first, settings_.validation.tolerance);
    refresh();
}

void TargetCard::toggle(std::size_t group) {
    study::TargetSettings target = settings_.target;
    target.orientation.reset();
    std::vector<int> poses;
    const std::vector<int> wanted = study::findWantedGroups(target, groups_);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const bool isWanted = std::ranges::find(wanted, static_cast<int>(g)) != wanted.end();
        if (isWanted != (g == group))
            poses.insert(poses.end(), groups_[g].poses.begin(), groups_[g].poses.end());
    }
    std::sort(poses.begin(), poses.end());
    target.poses = part::namePoses(poses);
    choose(std::move(target), tr("Wanted pose"));
}

void TargetCard::chooseHeading() {
    study::TargetSettings target = settings_.target;
    if (target.orientation)
        target.orientationTurns = anyHeading_->isChecked();
    else
        target.heading =
            anyHeading_->isChecked() ? kAnyHeading : QString::number(heading_->value()).toStdString();
    if (target == settings_.target) return;
    choose(std::move(target), tr("Wanted heading"));
}

void TargetCard::countIt() {
    study::Settings settings = settings_;
    settings.evolution.objectives = objectives::kWantedObjectives;
    emit edited(settings, tr("Objective"));
}

void TargetCard::choose(study::TargetSettings target, const QString& what) {
    study::Settings settings = settings_;
    settings.target = std::move(target);
    if (!settings.target.isSet())
        settings.evolution.objectives = withoutWanted(settings.evolution.objectives);
    refresh();
    if (settings != settings_) emit edited(settings, what);
}

}  // namespace trapwright::pages
