#include "ui/pages/playback_bar.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyleOptionSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>
#include <cmath>

#include "ui/look/icon.h"
#include "ui/look/message_bar.h"
#include "ui/look/text.h"

namespace trapwright::pages {

namespace {

constexpr double kStep = 1e-3;  // [s]
constexpr std::array kSpeeds{ReplayPlayer::kSlowest, 0.1, 0.25, 0.5, 1.0, 2.0, ReplayPlayer::kFastest};
constexpr int kIcon = 18;

int toLine(double time) {
    return static_cast<int>(std::lround(time / kStep));
}

/// Goes to where its groove is clicked, as players do, instead of a page nearer; from there it can be
/// dragged.
class TimeLine : public QSlider {
 public:
    explicit TimeLine(QWidget* parent) : QSlider(Qt::Horizontal, parent) {}

 protected:
    void mousePressEvent(QMouseEvent* event) override {
        QStyleOptionSlider option;
        initStyleOption(&option);
        const QRect handle =
            style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this);
        if (event->button() == Qt::LeftButton && !handle.contains(event->position().toPoint())) {
            const QRect groove =
                style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, this);
            const int place = qRound(event->position().x()) - groove.left() - handle.width() / 2;
            setValue(QStyle::sliderValueFromPosition(minimum(), maximum(), place,
                                                     groove.width() - handle.width()));
        }
        QSlider::mousePressEvent(event);
    }
};

}  // namespace

PlaybackBar::PlaybackBar(ReplayPlayer& player)
    : player_(player),
      warning_(new look::MessageBar(this)),
      line_(new TimeLine(this)),
      time_(new QLabel(this)),
      speed_(new QComboBox(this)) {
    setObjectName("transport");
    setAccessibleName(tr("Replay"));
    setAttribute(Qt::WA_StyledBackground);
    setStyleSheet("#transport { border-top: 1px solid palette(mid); }");

    line_->setObjectName("transport.line");
    line_->setAccessibleName(tr("Time line"));
    line_->setToolTip(tr("Click or drag to any moment of the replay"));
    // The arrows step the replay wherever the focus is.
    line_->setSingleStep(toLine(kStep));
    connect(line_, &QSlider::valueChanged, this, [this](int value) { player_.setTime(kStep * value); });
    time_->setObjectName("transport.time");
    time_->setAccessibleName(tr("Time of the replay"));

    auto* row = new QHBoxLayout;
    row->setSpacing(2);
    addPlayerButtons(*row);
    row->addSpacing(8);
    addSpeed(*row);
    row->addSpacing(8);
    row->addWidget(time_, 1);
    trace_ = addSwitch(*row, "replay.trace", "trace", tr("Draw the path"), Qt::Key_T, true);
    forces_ = addSwitch(*row, "replay.forces", "contacts", tr("Draw contact forces"), Qt::Key_N, false);
    for (QAction* action : {trace_, forces_})
        connect(action, &QAction::toggled, this, [this] { emit viewChanged(view()); });

    auto* controls = new QVBoxLayout;
    controls->setContentsMargins(12, 6, 12, 6);
    controls->setSpacing(4);
    controls->addWidget(line_);
    controls->addLayout(row);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(warning_);
    column->addLayout(controls);

    connect(&player_, &ReplayPlayer::timeChanged, this, &PlaybackBar::showTime);
    connect(&player_, &ReplayPlayer::durationChanged, this, &PlaybackBar::showTime);
    connect(&player_, &ReplayPlayer::playingChanged, this, &PlaybackBar::showPlaying);
    showTime();
    showPlaying();
}

void PlaybackBar::setFrequency(double frequency) {
    frequency_ = frequency;
    showTime();
}

void PlaybackBar::setHint(const QString& hint) {
    hint_ = hint;
    showTime();
}

void PlaybackBar::setWarning(const QString& what, const QString& message) {
    if (what.isEmpty()) return warning_->clear();
    const QString text = what + ". " + message;
    if (warning_->text() != text) warning_->show(look::MessageKind::warning, what, message);
}

ReplayView PlaybackBar::view() const {
    return {trace_->isChecked(), forces_->isChecked()};
}

QAction* PlaybackBar::addButton(QHBoxLayout& row, const QString& name, const QString& icon,
                                const QString& text, const QKeySequence& key) {
    auto* action = new QAction(look::icon(icon), text, this);
    action->setObjectName(name);
    action->setShortcut(key);
    action->setToolTip(QString("%1 (%2)").arg(text, key.toString(QKeySequence::NativeText)));
    addAction(action);
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    button->setIconSize({kIcon, kIcon});
    button->setAccessibleName(text);
    button->setObjectName(name + ".button");
    row.addWidget(button);
    return action;
}

QAction* PlaybackBar::addSwitch(QHBoxLayout& row, const QString& name, const QString& icon,
                                const QString& text, const QKeySequence& key, bool on) {
    QAction* action = addButton(row, name, icon, text, key);
    action->setCheckable(true);
    action->setChecked(on);
    return action;
}

void PlaybackBar::addPlayerButtons(QHBoxLayout& row) {
    const auto connectTo = [this](QAction* action, auto act) {
        connect(action, &QAction::triggered, this, act);
    };
    connectTo(addButton(row, "replay.toStart", "to-start", tr("To the beginning"), Qt::Key_Home),
              [this] { player_.setTime(0.0); });
    connectTo(addButton(row, "replay.stepBack", "step-back", tr("Back by 1 ms"), Qt::Key_Left),
              [this] { player_.step(-kStep); });
    play_ = addButton(row, "replay.play", "start", tr("Play"), Qt::Key_Space);
    connectTo(play_, [this] { player_.toggle(); });
    connectTo(addButton(row, "replay.stepForward", "step-forward", tr("Forward by 1 ms"), Qt::Key_Right),
              [this] { player_.step(kStep); });
    connectTo(addButton(row, "replay.toEnd", "to-end", tr("To the end"), Qt::Key_End),
              [this] { player_.setTime(player_.duration()); });
    QAction* loop = addSwitch(row, "replay.loop", "loop", tr("Repeat"), Qt::Key_L, false);
    connect(loop, &QAction::toggled, &player_, &ReplayPlayer::setLoop);
    addKey("replay.cycleBack", tr("Back by one vibration cycle"), Qt::SHIFT | Qt::Key_Left, -1.0);
    addKey("replay.cycleForward", tr("Forward by one vibration cycle"), Qt::SHIFT | Qt::Key_Right, 1.0);
}

void PlaybackBar::addKey(const QString& name, const QString& text, const QKeySequence& key, double cycles) {
    auto* action = new QAction(text, this);
    action->setObjectName(name);
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, [this, cycles] { player_.step(cycles / frequency_); });
    addAction(action);
}

void PlaybackBar::addSpeed(QHBoxLayout& row) {
    speed_->setObjectName("transport.speed");
    speed_->setAccessibleName(tr("Speed"));
    speed_->setToolTip(tr("Speed of the replay; 1 × is real time"));
    for (const double speed : kSpeeds)
        speed_->addItem(tr("%1 ×").arg(QLocale().toString(speed, 'g', 3)), speed);
    const auto show = [this] { speed_->setCurrentIndex(speed_->findData(player_.speed())); };
    show();
    connect(speed_, &QComboBox::activated, this,
            [this](int index) { player_.setSpeed(speed_->itemData(index).toDouble()); });
    connect(&player_, &ReplayPlayer::speedChanged, this, show);
    row.addWidget(speed_);
    const auto addChange = [this](const QString& name, const QString& text, Qt::Key key, int by) {
        auto* action = new QAction(text, this);
        action->setObjectName(name);
        action->setShortcut(key);
        connect(action, &QAction::triggered, this, [this, by] { changeSpeed(by); });
        addAction(action);
    };
    addChange("replay.slower", tr("Slower"), Qt::Key_BracketLeft, -1);
    addChange("replay.faster", tr("Faster"), Qt::Key_BracketRight, 1);
}

void PlaybackBar::changeSpeed(int by) {
    const int index = speed_->currentIndex() + by;
    if (index >= 0 && index < speed_->count()) player_.setSpeed(speed_->itemData(index).toDouble());
}

void PlaybackBar::showTime() {
    const bool any = player_.duration() > 0.0;
    for (QAction* action : actions())
        action->setEnabled(any || action->isCheckable());
    line_->setEnabled(any);
    const QSignalBlocker blocker(line_);
    line_->setRange(0, toLine(player_.duration()));
    line_->setValue(toLine(player_.time()));
    const QLocale locale;
    time_->setText(any ? tr("%1 of %2 s · cycle %3")
                             .arg(locale.toString(player_.time(), 'f', 3),
                                  locale.toString(player_.duration(), 'f', 3),
                                  locale.toString(player_.time() * frequency_, 'f', 1))
                       : hint_);
    time_->setForegroundRole(any ? QPalette::WindowText : QPalette::PlaceholderText);
}

void PlaybackBar::showPlaying() {
    const QString text = player_.playing() ? tr("Pause") : tr("Play");
    play_->setIcon(look::icon(player_.playing() ? "pause" : "start"));
    play_->setText(text);
    play_->setToolTip(QString("%1 (%2)").arg(text, play_->shortcut().toString(QKeySequence::NativeText)));
}

}  // namespace trapwright::pages
