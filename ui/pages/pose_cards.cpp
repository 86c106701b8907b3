#include "ui/pages/pose_cards.h"

#include <QEvent>
#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QVBoxLayout>

#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/scene/when_ready.h"

namespace trapwright::pages {

namespace {

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

void PoseCards::show(std::shared_ptr<const part::Part> part) {
    if (part == part_) return;
    part_ = std::move(part);
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
    qDeleteAll(findChildren<QFrame*>("poseCard", Qt::FindDirectChildrenOnly));
    if (!part_) return;

    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    pictures_.setTheme(dark ? scene::SceneTheme::dark() : scene::SceneTheme::light());
    int index = 0;
    for (const part::StablePose& pose : part_->stablePoses) {
        auto* card = new QFrame(this);
        card->setObjectName("poseCard");
        card->setStyleSheet(
            "#poseCard { border: 1px solid palette(mid); border-radius: 6px; background: palette(base); }");
        auto* picture = new QLabel(card);
        picture->setFixedHeight(kPicture.height());
        picture->setAlignment(Qt::AlignCenter);
        scene::whenReady(pictures_.partPicture(part_, pose.rotation, kPicture, devicePixelRatioF()), picture,
                         [picture](const QImage& drawn) { picture->setPixmap(QPixmap::fromImage(drawn)); });
        auto* chance = new QLabel(tr("%1 %").arg(look::numberText(100.0 * pose.probability)), card);
        QFont bold = chance->font();
        bold.setBold(true);
        chance->setFont(bold);
        chance->setAlignment(Qt::AlignHCenter);
        card->setAccessibleName(tr("Stable pose %1: %2").arg(index + 1).arg(chance->text()));
        card->setToolTip(tr("A part dropped at random comes to rest in this pose in %1 of 100 cases.")
                             .arg(look::numberText(100.0 * pose.probability)));

        auto* layout = new QVBoxLayout(card);
        layout->setContentsMargins(4, 4, 4, 6);
        layout->setSpacing(0);
        layout->addWidget(picture);
        layout->addWidget(chance);
        grid_->addWidget(card, index / kColumns, index % kColumns);
        ++index;
    }
}

}  // namespace trapwright::pages
