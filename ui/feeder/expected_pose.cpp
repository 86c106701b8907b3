#include "ui/feeder/expected_pose.h"

#include <QCoreApplication>
#include <QEvent>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QVBoxLayout>

#include "core/trial/finish.h"
#include "ui/look/theme.h"
#include "ui/scene/when_ready.h"

namespace trapwright::feeder {

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(ExpectedPose)
};

constexpr int kLeastHeight = 96;  // of the picture
constexpr double kRound = 6.0;

QString symmetryText(const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return Texts::tr("The part is round: any orientation is right.");
    if (symmetry.continuous) {
        return symmetry.flip ? Texts::tr(
                                   "Turned about its axis or end for end, the part is alike: that is right "
                                   "as well.")
                             : Texts::tr("Turned about its axis the part is alike: that is right as well.");
    }
    const auto alike = symmetry.rotations.size();
    if (alike < 2) return {};
    return Texts::tr("The part looks the same in %1 orientations: each of them is right.").arg(alike);
}

}  // namespace

QString alikeText(const part::SymmetryGroup& symmetry, const trial::Goal& goal) {
    QStringList sentences;
    if (goal.orientations.front().anyHeading)
        sentences += Texts::tr("In any heading, turned about the vertical, it is right as well.");
    if (const double lean = goal.orientations.front().lean; lean > 0.0)
        sentences += Texts::tr("It may lean across the track by up to %1°, as the track's end does.")
                         .arg(lean / base::kDegree, 0, 'g', 3);
    if (goal.orientations.size() > 1)
        sentences += Texts::tr("This is one of %1 poses that are right.").arg(goal.orientations.size());
    if (const QString alike = symmetryText(symmetry); !alike.isEmpty()) sentences += alike;
    return sentences.join(' ');
}

QFuture<QImage> expectedPicture(scene::PictureMaker& maker, const ExpectedExit& exit, QSize size,
                                double pixelRatio) {
    if (!exit.known()) return QtFuture::makeReadyFuture(QImage());
    const base::Pose pose = trial::findFinishPose(*exit.track, *exit.part, exit.goal->shown());
    return maker.exitPicture(exit.track, exit.part, pose, size, pixelRatio);
}

ExpectedPose::ExpectedPose(const QString& name, QWidget* parent)
    : QWidget(parent),
      title_(new QLabel(tr("Success looks like this"), this)),
      text_(new QLabel(this)),
      place_(new QWidget(this)) {
    setObjectName(name);
    setAccessibleName(tr("Success looks like this"));
    title_->setObjectName(name + ".title");
    QFont bold = title_->font();
    bold.setBold(true);
    title_->setFont(bold);
    text_->setObjectName(name + ".text");
    text_->setWordWrap(true);
    place_->setMinimumHeight(kLeastHeight);
    place_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addWidget(title_);
    column->addWidget(place_, 1);
    column->addWidget(text_);
    refresh();
}

void ExpectedPose::show(const ExpectedExit& exit) {
    if (exit == exit_) return;
    exit_ = exit;
    picture_ = {};
    refresh();
}

void ExpectedPose::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) refresh();
}

void ExpectedPose::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    refresh();
}

void ExpectedPose::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) refresh();
}

void ExpectedPose::refresh() {
    title_->setVisible(exit_.part != nullptr);
    QString text;
    if (exit_.part && !exit_.goal) {
        text =
            tr("What success looks like is known once this track has been validated in simulation, on the "
               "page Review.");
    } else if (exit_.part) {
        const QString alike = alikeText(exit_.part->symmetry, *exit_.goal);
        text = alike.isEmpty() ? tr("The arrow tells the conveying direction.") : alike;
    }
    text_->setText(text);
    text_->setVisible(!text.isEmpty());
    stale_ = !isVisible();
    ++request_;
    if (stale_ || !exit_.known()) return update();
    layout()->activate();
    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    maker_.setTheme(dark ? scene::SceneTheme::dark() : scene::SceneTheme::light());
    const QSize size = place_->size();
    if (size.isEmpty()) return;
    scene::whenReady(expectedPicture(maker_, exit_, size, devicePixelRatioF()), this,
                     [this, request = request_](const QImage& drawn) {
                         if (request != request_) return;
                         picture_ = drawn;
                         update();
                     });
}

QRect ExpectedPose::pictureArea() const {
    return place_->geometry();
}

void ExpectedPose::paintEvent(QPaintEvent* event) {
    QWidget::paintEvent(event);
    if (!exit_.part) return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QRectF area = QRectF(pictureArea()).adjusted(0.5, 0.5, -0.5, -0.5);
    QPainterPath frame;
    frame.addRoundedRect(area, kRound, kRound);
    if (!picture_.isNull()) {
        painter.setClipPath(frame);
        painter.drawImage(pictureArea(), picture_);
        painter.setClipping(false);
    } else {
        painter.setPen(palette().placeholderText().color());
        painter.drawText(area, Qt::AlignCenter | Qt::TextWordWrap,
                         exit_.goal ? tr("Drawing...") : tr("Not known yet"));
    }
    painter.setPen(QPen(palette().mid().color(), 1.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(frame);
}

}  // namespace trapwright::feeder
