#include "ui/feeder/plan_cards.h"

#include <QCheckBox>
#include <QEvent>
#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"
#include "ui/scene/when_ready.h"

namespace trapwright::feeder {

namespace {

constexpr int kColumns = 2;
constexpr QSize kPicture(96, 72);
constexpr int kBar = 6;
constexpr auto kStyle =
    "#planCard { border: 1px solid palette(mid); border-radius: 6px; background: palette(base); }"
    "#planCard[current=\"true\"] { border: 3px solid palette(highlight); }";

QString titleOf(const std::vector<int>& poses) {
    return (poses.size() > 1 ? PlanCards::tr("Poses %1") : PlanCards::tr("Pose %1"))
        .arg(models::poseNumbers(poses));
}

QString alikeText(const std::vector<int>& poses) {
    if (poses.size() < 2) return {};
    return u'\n' + PlanCards::tr("%n poses that look the same: place the part in any of them.", nullptr,
                                 static_cast<int>(poses.size()));
}

}  // namespace

PlanCards::PlanCards(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
    setObjectName("planCards");
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setSpacing(8);
    for (int column = 0; column < kColumns; ++column)
        grid_->setColumnStretch(column, 1);
}

void PlanCards::setPart(std::shared_ptr<const part::Part> part, std::vector<part::PoseGroup> groups) {
    const auto same = [](const part::PoseGroup& a, const part::PoseGroup& b) {
        return a.poses == b.poses && a.probability == b.probability;
    };
    if (part == part_ && std::equal(groups.begin(), groups.end(), groups_.begin(), groups_.end(), same))
        return;
    part_ = std::move(part);
    groups_ = std::move(groups);
    rebuild();
}

void PlanCards::showProgress(const std::vector<PoseProgress>& progress, std::optional<int> current) {
    progress_ = progress;
    current_ = current;
    update();
}

void PlanCards::showChoice() {
    progress_.reset();
    current_.reset();
    for (const Card& card : cards_)
        card.box->setChecked(true);
    update();
}

std::vector<int> PlanCards::chosen() const {
    std::vector<int> poses;
    for (const Card& card : cards_)
        if (card.box->isChecked()) poses.push_back(card.poses.front());
    return poses;
}

void PlanCards::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) drawPictures();
}

void PlanCards::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) drawPictures();
}

void PlanCards::rebuild() {
    for (const Card& card : cards_)
        delete card.frame;
    cards_.clear();
    if (part_) {
        for (const part::PoseGroup& group : groups_)
            addCard(group);
    }
    drawPictures();
    update();
}

void PlanCards::addCard(const part::PoseGroup& group) {
    auto* frame = new QFrame(this);
    frame->setObjectName("planCard");
    frame->setStyleSheet(kStyle);
    auto* picture = new QLabel(frame);
    picture->setAlignment(Qt::AlignCenter);
    picture->setMinimumHeight(kPicture.height());
    auto* box = new QCheckBox(frame);
    box->setObjectName(QString("plan.pose.%1").arg(group.poses.front() + 1));
    box->setAccessibleName(titleOf(group.poses));
    box->setChecked(true);
    auto* title = new QLabel(titleOf(group.poses), frame);
    QFont bold = title->font();
    bold.setBold(true);
    title->setFont(bold);
    auto* count = new QLabel(frame);
    count->setAlignment(Qt::AlignRight);
    auto* bar = new QProgressBar(frame);
    bar->setTextVisible(false);
    bar->setFixedHeight(kBar);

    auto* words = new QHBoxLayout;
    words->setSpacing(4);
    words->addWidget(box);
    words->addWidget(title, 1);
    words->addWidget(count);
    auto* layout = new QVBoxLayout(frame);
    layout->setContentsMargins(6, 4, 6, 6);
    layout->setSpacing(3);
    layout->addWidget(picture);
    layout->addLayout(words);
    layout->addWidget(bar);
    connect(box, &QCheckBox::toggled, this, &PlanCards::choiceChanged);
    cards_.push_back({group.poses, group.probability, frame, picture, box, title, count, bar});
}

void PlanCards::drawPictures() {
    // Pictures cost some milliseconds each: drawn only when they are seen.
    stale_ = !isVisible();
    if (stale_ || !part_) return;
    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    pictures_.setTheme(dark ? scene::SceneTheme::dark() : scene::SceneTheme::light());
    for (const Card& card : cards_) {
        QLabel* const picture = card.picture;
        const part::StablePose& pose = part_->stablePoses[static_cast<std::size_t>(card.poses.front())];
        scene::whenReady(pictures_.partPicture(part_, pose.rotation, kPicture, devicePixelRatioF()), picture,
                         [picture](const QImage& drawn) { picture->setPixmap(QPixmap::fromImage(drawn)); });
    }
}

void PlanCards::update() {
    int place = 0;
    const auto isOf = [](const Card& card, int pose) {
        return std::find(card.poses.begin(), card.poses.end(), pose) != card.poses.end();
    };
    for (const Card& card : cards_) {
        const PoseProgress* found = nullptr;
        if (progress_) {
            for (const PoseProgress& one : *progress_)
                if (isOf(card, one.pose)) found = &one;
        }
        const bool seen = !progress_ || found != nullptr;
        card.frame->setVisible(seen);
        card.box->setVisible(!progress_);
        card.bar->setVisible(found != nullptr);
        if (!seen) continue;
        grid_->addWidget(card.frame, place / kColumns, place % kColumns);
        ++place;
        const bool current = current_ && isOf(card, *current_);
        if (card.frame->property("current").toBool() != current) {
            card.frame->setProperty("current", current);
            card.frame->setStyleSheet(kStyle);
        }
        if (found != nullptr) {
            card.count->setText(tr("%1 of %2").arg(found->made).arg(found->planned));
            card.bar->setRange(0, std::max(found->planned, 1));
            card.bar->setValue(found->made);
            card.frame->setToolTip(tr("%1 of %2 trials made, %3 of them failed")
                                       .arg(found->made)
                                       .arg(found->planned)
                                       .arg(found->failures) +
                                   alikeText(card.poses));
        } else {
            const QString chance = look::numberText(100.0 * card.probability);
            card.count->setText(tr("%1 %").arg(chance));
            card.frame->setToolTip(
                tr("A part dropped at random comes to rest like this in %1 of 100 cases.").arg(chance) +
                alikeText(card.poses));
        }
        card.frame->setAccessibleName(tr("%1: %2").arg(titleOf(card.poses), card.count->text()));
    }
}

}  // namespace trapwright::feeder
