#include "ui/pages/pose_cards.h"

#include <QEvent>
#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"
#include "ui/scene/when_ready.h"

namespace trapwright::pages {

namespace {

constexpr double kPercent = 100.0;
constexpr int kColumns = 3;
constexpr QSize kPicture(92, 76);

}  // namespace

PoseCards::PoseCards(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
    setObjectName("poseCards");
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setSpacing(8);
    for (int column = 0; column < kColumns; ++column)
        grid_->setColumnStretch(column, 1);
}

void PoseCards::show(std::shared_ptr<const part::Part> part, const std::optional<study::DropRecord>& drops,
                     study::PoseWeights weights) {
    if (part == part_ && drops == drops_ && weights == weights_) return;
    if (part != part_) open_.clear();
    part_ = std::move(part);
    drops_ = drops;
    weights_ = weights;
    rebuild();
}

void PoseCards::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) rebuild();
}

void PoseCards::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) rebuild();
}

void PoseCards::rebuild() {
    // Pictures cost some milliseconds each: drawn only when they are seen.
    stale_ = !isVisible();
    if (stale_) return;
    openers_.clear();
    for (const char* name : {"poseCard", "singlePoseCard"})
        qDeleteAll(findChildren<QFrame*>(name, Qt::FindDirectChildrenOnly));
    if (!part_) return;

    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    pictures_.setTheme(dark ? scene::SceneTheme::dark() : scene::SceneTheme::light());
    place_ = 0;
    for (const part::PoseGroup& group : part::findPoseGroups(*part_)) {
        QFrame* card = addCard("poseCard", group.poses, group.probability);
        if (group.poses.size() < 2) continue;
        addOpener(*card, group);
        if (!open_.contains(group.poses)) continue;
        for (const int pose : group.poses) {
            const double probability = part_->stablePoses[static_cast<std::size_t>(pose)].probability;
            QFrame* single = addCard("singlePoseCard", {pose}, probability);
            auto* number = new QLabel(tr("Pose %1").arg(pose + 1), single);
            number->setAlignment(Qt::AlignHCenter);
            number->setForegroundRole(QPalette::PlaceholderText);
            single->layout()->addWidget(number);
            single->setToolTip(tr("One of %1 poses that look the same.").arg(group.poses.size()) + ' ' +
                               single->toolTip());
        }
    }
}

QFrame* PoseCards::addCard(const QString& name, const std::vector<int>& poses, double probability) {
    auto* card = new QFrame(this);
    card->setObjectName(name);
    card->setStyleSheet(
        "#poseCard { border: 1px solid palette(mid); border-radius: 6px; background: palette(base); }"
        "#singlePoseCard { border: 1px dashed palette(mid); border-radius: 6px; }");
    auto* picture = new QLabel(card);
    picture->setFixedHeight(kPicture.height());
    picture->setAlignment(Qt::AlignCenter);
    const base::Quaternion& rotation = part_->stablePoses[static_cast<std::size_t>(poses.front())].rotation;
    scene::whenReady(pictures_.partPicture(part_, rotation, kPicture, devicePixelRatioF()), picture,
                     [picture](const QImage& drawn) { picture->setPixmap(QPixmap::fromImage(drawn)); });
    auto* layout = new QVBoxLayout(card);
    layout->setContentsMargins(4, 4, 4, 6);
    layout->setSpacing(0);
    layout->addWidget(picture);
    addChances(*card, poses, probability, models::poseName(poses));
    grid_->addWidget(card, place_ / kColumns, place_ % kColumns, Qt::AlignTop);
    ++place_;
    return card;
}

void PoseCards::addChances(QFrame& card, const std::vector<int>& poses, double probability,
                           const QString& name) {
    const auto add = [&](const char* object, const QString& text, bool counts) {
        auto* label = new QLabel(text, &card);
        label->setObjectName(object);
        label->setAlignment(Qt::AlignHCenter);
        QFont font = label->font();
        font.setBold(counts);
        label->setFont(font);
        if (!counts) label->setForegroundRole(QPalette::PlaceholderText);
        card.layout()->addWidget(label);
    };
    const QString estimate = look::numberText(kPercent * probability);
    QString told = tr("Estimated from its shape (quasi-static), a part dropped at random comes to rest like "
                      "this in %1 of "
                      "100 cases.")
                       .arg(estimate);
    if (!drops_) {
        add("pose.estimate", tr("%1 %").arg(estimate), true);
    } else {
        int count = 0;
        for (const int pose : poses)
            count += drops_->result.counts[static_cast<std::size_t>(pose)];
        const int drops = drops_->result.drops();
        const stats::Interval bounds = stats::calcClopperPearson(count, drops);
        const bool dropped = weights_ == study::PoseWeights::dropped;
        const QString share = look::numberText(kPercent * count / drops);
        const QString low = look::numberText(kPercent * bounds.low, 2);
        const QString high = look::numberText(kPercent * bounds.high, 2);
        add("pose.estimate", tr("%1 % est.").arg(estimate), !dropped);
        add("pose.dropped", tr("%1 % dropped").arg(share), dropped);
        add("pose.bounds", tr("%1 to %2 %").arg(low, high), false);
        told += ' ' +
                tr("Dropped, it came to rest like this %1 times of %2: %3 %, between %4 and %5 % (95 % "
                   "Clopper-Pearson).")
                    .arg(QString::number(count), QString::number(drops), share, low, high) +
                ' ' + (dropped ? tr("The drop test counts.") : tr("The estimate counts."));
    }
    card.setToolTip(told);
    card.setAccessibleName(tr("Stable %1: %2").arg(name, told));
}

void PoseCards::addOpener(QFrame& card, const part::PoseGroup& group) {
    const bool open = open_.contains(group.poses);
    auto* opener = new QToolButton(&card);
    opener->setObjectName("poseCard.open");
    opener->setText(tr("%1 alike").arg(group.poses.size()));
    opener->setIcon(look::icon(open ? "unfold" : "fold"));
    opener->setIconSize({12, 12});
    opener->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    opener->setAutoRaise(true);
    opener->setCheckable(true);
    opener->setChecked(open);
    opener->setToolTip(
        tr("%1 poses that look the same, because the part is symmetric: show each").arg(group.poses.size()));
    opener->setAccessibleName(opener->toolTip());
    card.layout()->addWidget(opener);
    card.layout()->setAlignment(opener, Qt::AlignHCenter);
    connect(opener, &QToolButton::clicked, this, [this, poses = group.poses] {
        if (open_.erase(poses) == 0) open_.insert(poses);
        // The button that was pressed is built anew.
        QMetaObject::invokeMethod(
            this,
            [this, poses] {
                rebuild();
                focusOpener(poses);
            },
            Qt::QueuedConnection);
    });
    openers_[group.poses] = opener;
}

/// A keyboard goes on where it was.
void PoseCards::focusOpener(const std::vector<int>& poses) {
    if (const auto found = openers_.find(poses); found != openers_.end()) found->second->setFocus();
}

}  // namespace trapwright::pages
