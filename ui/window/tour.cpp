#include "ui/window/tour.h"

#include <QAccessible>
#include <QCoreApplication>
#include <QFrame>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <utility>

namespace trapwright::window {

namespace {

constexpr int kFollowing = 100;  // [ms]
constexpr int kAround = 6;       // of a widget that is pointed at
constexpr int kGap = 14;
constexpr int kBubbleWidth = 340;
constexpr int kCorner = 8;
constexpr QColor kShade(0, 0, 0, 150);

TourStep step(const char* page, const char* widget, const char* title, const char* text) {
    const auto tr = [](const char* one) {
        return QCoreApplication::translate("trapwright::window::Tour", one);
    };
    return {page, widget, tr(title), tr(text)};
}

}  // namespace

std::vector<TourStep> windowTour() {
    return {
        step("part", "rail", QT_TRANSLATE_NOOP("trapwright::window::Tour", "From top to bottom"),
             QT_TRANSLATE_NOOP(
                 "trapwright::window::Tour",
                 "The work goes down this rail: the part, its track, learning, looking at what was "
                 "learned, the solid to print, and the real feeder. Ctrl+1 to Ctrl+6 go there.")),
        step("part", "dock.inspector", QT_TRANSLATE_NOOP("trapwright::window::Tour", "Your part"),
             QT_TRANSLATE_NOOP(
                 "trapwright::window::Tour",
                 "Import a part here, or drop a file anywhere. The cards show how it comes to rest; "
                 "choose its material below.")),
        step("track", "track.starting", QT_TRANSLATE_NOOP("trapwright::window::Tour", "How long it takes"),
             QT_TRANSLATE_NOOP(
                 "trapwright::window::Tour",
                 "Trials of your part are timed on this machine, so that you know before you start. A "
                 "draft takes less than 10 minutes. Set your feeder's drive below first.")),
        step("evolve", "evolve.card", QT_TRANSLATE_NOOP("trapwright::window::Tour", "Learning"),
             QT_TRANSLATE_NOOP(
                 "trapwright::window::Tour",
                 "Learning is started, paused and stopped here. The scene shows the best track so far, "
                 "the strip below it all winners. Everything is saved as it happens.")),
        step("review", "dock.inspector", QT_TRANSLATE_NOOP("trapwright::window::Tour", "How good it is"),
             QT_TRANSLATE_NOOP(
                 "trapwright::window::Tour",
                 "Compare the best winners, validate one with many parts, replay what went wrong. Then "
                 "export and print it. F1 opens the help at the place where you are.")),
    };
}

Tour::Tour(QWidget& window, std::vector<TourStep> steps, std::function<void(const QString&)> showPage)
    : QWidget(&window),
      window_(window),
      steps_(std::move(steps)),
      showPage_(std::move(showPage)),
      following_(new QTimer(this)),
      bubble_(new QFrame(this)),
      title_(new QLabel(bubble_)),
      text_(new QLabel(bubble_)),
      away_(new QLabel(bubble_)),
      count_(new QLabel(bubble_)),
      skip_(new QPushButton(tr("Skip"), bubble_)),
      back_(new QPushButton(tr("Back"), bubble_)),
      next_(new QPushButton(tr("Next"), bubble_)) {
    setObjectName("tour");
    setAttribute(Qt::WA_DeleteOnClose);
    bubble_->setObjectName("tour.bubble");
    bubble_->setAutoFillBackground(true);
    bubble_->setStyleSheet(
        "#tour\\.bubble { background: palette(base); border: 1px solid palette(mid); border-radius: 8px; }");
    title_->setObjectName("tour.title");
    QFont font = title_->font();
    font.setPointSizeF(font.pointSizeF() * 1.3);
    font.setBold(true);
    title_->setFont(font);
    text_->setObjectName("tour.text");
    text_->setWordWrap(true);
    away_->setWordWrap(true);
    away_->setForegroundRole(QPalette::PlaceholderText);
    count_->setForegroundRole(QPalette::PlaceholderText);
    skip_->setObjectName("tour.skip");
    back_->setObjectName("tour.back");
    next_->setObjectName("tour.next");
    for (QPushButton* button : {skip_, back_, next_})
        button->installEventFilter(this);

    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(8);
    buttons->addWidget(count_);
    buttons->addStretch(1);
    buttons->addWidget(skip_);
    buttons->addWidget(back_);
    buttons->addWidget(next_);
    auto* layout = new QVBoxLayout(bubble_);
    layout->setContentsMargins(16, 14, 16, 14);
    layout->setSpacing(8);
    layout->addWidget(title_);
    layout->addWidget(text_);
    layout->addWidget(away_);
    layout->addLayout(buttons);
    bubble_->setFixedWidth(kBubbleWidth);

    connect(skip_, &QPushButton::clicked, this, &Tour::end);
    connect(back_, &QPushButton::clicked, this, [this] { go(step_ - 1); });
    connect(next_, &QPushButton::clicked, this, [this] { go(step_ + 1); });
    following_->setInterval(kFollowing);
    connect(following_, &QTimer::timeout, this, &Tour::follow);
}

void Tour::start() {
    before_ = window_.focusWidget();
    setGeometry(window_.rect());
    show();
    raise();
    following_->start();
    go(0);
}

void Tour::go(int step) {
    if (step < 0) return;
    if (step >= static_cast<int>(steps_.size())) return end();
    step_ = step;
    const TourStep& now = steps_[static_cast<std::size_t>(step)];
    showPage_(now.page);
    title_->setText(now.title);
    text_->setText(now.text);
    count_->setText(tr("%1 of %2").arg(step + 1).arg(steps_.size()));
    const bool last = step + 1 == static_cast<int>(steps_.size());
    back_->setEnabled(step > 0);
    skip_->setVisible(!last);
    next_->setText(last ? tr("Done") : tr("Next"));
    // What is pointed at may be scrolled out of an inspector.
    if (auto* target = window_.findChild<QWidget*>(now.widget)) {
        for (QWidget* above = target->parentWidget(); above != nullptr; above = above->parentWidget())
            if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(target);
    }
    spot_ = findSpot();
    away_->setVisible(false);
    placeBubble();
    next_->setFocus(Qt::OtherFocusReason);
    bubble_->setAccessibleName(now.title);
    bubble_->setAccessibleDescription(now.text);
    QAccessibleEvent told(bubble_, QAccessible::Alert);
    QAccessible::updateAccessibility(&told);
    update();
}

void Tour::end() {
    following_->stop();
    emit ended();
    close();
    if (before_) before_->setFocus(Qt::OtherFocusReason);
}

/// The window may have another size, the widget another place or none.
void Tour::follow() {
    if (geometry() != window_.rect()) setGeometry(window_.rect());
    raise();
    const QRect spot = findSpot();
    const bool away = spot.isEmpty();
    if (spot == spot_ && away == away_->isVisible() && rect().contains(bubble_->geometry())) return;
    spot_ = spot;
    away_->setVisible(away);
    away_->setText(tr("This is on another page. Next and Back go there."));
    placeBubble();
    update();
}

QRect Tour::findSpot() const {
    const auto* target = window_.findChild<QWidget*>(steps_[static_cast<std::size_t>(step_)].widget);
    if (target == nullptr || !target->isVisible() || target->window() != window_.window()) return {};
    // What is seen of it: an inspector may have scrolled it half away.
    QRect shown(target->mapTo(&window_, QPoint(0, 0)), target->size());
    for (const QWidget* above = target->parentWidget(); above != nullptr && above != &window_;
         above = above->parentWidget())
        shown &= QRect(above->mapTo(&window_, QPoint(0, 0)), above->size());
    return shown.isEmpty() ? QRect() : shown.adjusted(-kAround, -kAround, kAround, kAround) & rect();
}

void Tour::placeBubble() {
    bubble_->layout()->activate();
    bubble_->resize(kBubbleWidth, bubble_->layout()->hasHeightForWidth()
                                      ? bubble_->layout()->totalHeightForWidth(kBubbleWidth)
                                      : bubble_->sizeHint().height());
    QRect place = bubble_->rect();
    const QRect room = rect().adjusted(kGap, kGap, -kGap, -kGap);
    place.moveCenter(rect().center());
    if (!spot_.isEmpty()) {
        const int top =
            std::clamp(spot_.top(), room.top(), std::max(room.top(), room.bottom() - place.height()));
        const int left =
            std::clamp(spot_.left(), room.left(), std::max(room.left(), room.right() - place.width()));
        const std::array<QPoint, 4> corners = {
            QPoint(spot_.right() + kGap, top), QPoint(spot_.left() - kGap - place.width(), top),
            QPoint(left, spot_.bottom() + kGap), QPoint(left, spot_.top() - kGap - place.height())};
        for (const QPoint& corner : corners) {
            const QRect tried(corner, place.size());
            if (!room.contains(tried)) continue;
            place = tried;
            break;
        }
    }
    bubble_->move(place.topLeft());
}

bool Tour::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        // Keys without Ctrl and Alt are the tour's, not those of the page below it.
        const auto* key = static_cast<QKeyEvent*>(event);
        if ((key->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) == 0) event->accept();
        return true;
    }
    // Nothing below it is clicked by accident.
    if (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::Wheel) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void Tour::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QPainterPath shade;
    shade.addRect(rect());
    QPainterPath hole;
    if (!spot_.isEmpty()) hole.addRoundedRect(QRectF(spot_).adjusted(1, 1, -1, -1), kCorner, kCorner);
    painter.fillPath(shade.subtracted(hole), kShade);
    painter.strokePath(hole, QPen(palette().highlight().color(), 2.0));
}

/// Of the buttons: for them arrows would mean something else, and Return nothing.
bool Tour::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
    switch (static_cast<QKeyEvent*>(event)->key()) {
        case Qt::Key_Escape:
            end();
            return true;
        case Qt::Key_Right:
            go(step_ + 1);
            return true;
        case Qt::Key_Left:
            go(step_ - 1);
            return true;
        case Qt::Key_Return:
        case Qt::Key_Enter:
            qobject_cast<QPushButton*>(watched)->click();
            return true;
        default:
            return QWidget::eventFilter(watched, event);
    }
}

/// Tab stays within the bubble.
bool Tour::focusNextPrevChild(bool next) {
    std::vector<QPushButton*> buttons;
    for (QPushButton* button : {skip_, back_, next_})
        if (button->isEnabled() && button->isVisible()) buttons.push_back(button);
    const auto now =
        std::find_if(buttons.begin(), buttons.end(), [](auto* button) { return button->hasFocus(); });
    const auto count = static_cast<int>(buttons.size());
    if (count == 0) return QWidget::focusNextPrevChild(next);  // it is going
    const int place =
        now == buttons.end() ? 0 : static_cast<int>(now - buttons.begin()) + (next ? 1 : count - 1);
    buttons[static_cast<std::size_t>(place % count)]->setFocus(Qt::TabFocusReason);
    return true;
}

}  // namespace trapwright::window
