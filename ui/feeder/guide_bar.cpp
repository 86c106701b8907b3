#include "ui/feeder/guide_bar.h"

#include <QAction>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/stats/binomial.h"
#include "ui/feeder/expected_pose.h"
#include "ui/feeder/guide_actions.h"
#include "ui/feeder/trial_guide.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"

namespace trapwright::feeder {

namespace {

constexpr int kTick = 100;         // [ms]
constexpr double kSentence = 2.0;  // times the font of the window
constexpr double kTime = 2.2;
constexpr int kLargeIcon = 26;
// Of the picture of a success: a part of it is judged from a metre away.
constexpr double kExpectedShare = 0.34;
constexpr int kLeastExpected = 200;
constexpr int kMostExpected = 400;

void enlarge(QLabel& label, double factor) {
    QFont font = label.font();
    font.setPointSizeF(font.pointSizeF() * factor);
    font.setBold(true);
    label.setFont(font);
}

/// More room for more words.
int stretchFor(const QAction& action) {
    constexpr int kEach = 5;  // gaps
    return kEach + static_cast<int>(action.iconText().size() + action.shortcut().toString().size());
}

int countSuccesses(const study::PhysicalValidation& validation) {
    return static_cast<int>(std::count_if(
        validation.trials.begin(), validation.trials.end(),
        [](const study::PhysicalTrial& trial) { return trial.outcome == trial::Verdict::success; }));
}

}  // namespace

GuideBar::GuideBar(TrialGuide& guide, GuideActions& actions)
    : guide_(guide),
      expected_(new ExpectedPose("guide.expected", this)),
      sentence_(new QLabel(this)),
      progress_(new QLabel(this)),
      time_(new QLabel(this)),
      trouble_(new QLabel(this)),
      noteLabel_(new QLabel),
      noteEdit_(new QLineEdit),
      noteRow_(makeNote()) {
    setObjectName("guide");
    setAccessibleName(tr("Trial"));
    setAttribute(Qt::WA_StyledBackground);
    setStyleSheet("#guide { border-top: 1px solid palette(mid); }");
    setFocusPolicy(Qt::ClickFocus);
    sentence_->setObjectName("guide.sentence");
    sentence_->setWordWrap(true);
    enlarge(*sentence_, kSentence);
    // It must not widen the window's middle.
    sentence_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    progress_->setObjectName("guide.progress");
    progress_->setWordWrap(true);
    progress_->setToolTip(tr("Confidence interval of Clopper and Pearson, 95 %"));
    progress_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    time_->setObjectName("guide.time");
    time_->setAccessibleName(tr("Time of the trial"));
    time_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    enlarge(*time_, kTime);
    trouble_->setObjectName("guide.trouble");
    trouble_->setWordWrap(true);
    trouble_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    enlarge(*trouble_, 1.0);

    auto* head = new QHBoxLayout;
    auto* texts = new QVBoxLayout;
    texts->setSpacing(2);
    texts->addWidget(sentence_);
    texts->addWidget(trouble_);
    texts->addWidget(progress_);
    head->addLayout(texts, 1);
    head->addWidget(time_, 0, Qt::AlignTop);
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(12, 8, 12, 8);
    whole->setSpacing(6);
    auto* row = new QHBoxLayout;
    row->setSpacing(12);
    whole->addLayout(row, 1);
    whole->addLayout(makeOthers(actions));
    auto* column = new QVBoxLayout;
    column->setSpacing(6);
    column->addLayout(head);
    column->addWidget(noteRow_);
    column->addStretch(1);
    addKeys(*column, actions);
    row->addWidget(expected_);
    row->addLayout(column, 1);

    connect(actions.note(), &QAction::triggered, this, &GuideBar::askForNote);
    connect(&guide_, &TrialGuide::changed, this, &GuideBar::refresh);
    tick_.setInterval(kTick);
    connect(&tick_, &QTimer::timeout, this, &GuideBar::showTime);
    refresh();
}

QToolButton* GuideBar::makeButton(QAction* action, bool large) {
    auto* button = new QToolButton(this);
    button->setObjectName(action->objectName() + ".button");
    button->setDefaultAction(action);
    look::drawAsButton(*button);
    // In a small window there is room for the icons of the large ones only.
    button->setToolButtonStyle(large ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonTextOnly);
    if (large) button->setIconSize({kLargeIcon, kLargeIcon});
    // They must not widen the window's middle.
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    button->setFocusPolicy(Qt::TabFocus);
    const auto follow = [button, action] {
        button->setText(QString("%1 (%2)").arg(action->iconText(),
                                               action->shortcut().toString(QKeySequence::NativeText)));
        button->setAccessibleName(action->text());
    };
    // After the button's own: that takes the text without the key.
    connect(action, &QAction::changed, button, follow, Qt::QueuedConnection);
    follow();
    return button;
}

QWidget* GuideBar::makeNote() {
    auto* row = new QWidget(this);
    noteEdit_->setObjectName("guide.note");
    noteEdit_->setAccessibleName(tr("Note"));
    noteEdit_->setPlaceholderText(tr("Enter keeps it"));
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(noteLabel_);
    layout->addWidget(noteEdit_, 1);
    connect(noteEdit_, &QLineEdit::returnPressed, this, &GuideBar::takeNote);
    row->hide();
    return row;
}

void GuideBar::addKeys(QBoxLayout& column, GuideActions& actions) {
    // Two by two: beside the picture there is room for whole words.
    auto* outcomes = new QGridLayout;
    outcomes->setSpacing(6);
    int place = 0;
    for (QAction* outcome : actions.outcomes()) {
        outcomes->addWidget(makeButton(outcome, true), place / 2, place % 2);
        ++place;
    }
    column.addLayout(outcomes);
}

QHBoxLayout* GuideBar::makeOthers(GuideActions& actions) {
    auto* others = new QHBoxLayout;
    others->setSpacing(6);
    for (QAction* action : {actions.start(), actions.undo(), actions.note(), actions.pause(), actions.stop()})
        others->addWidget(makeButton(action, false), stretchFor(*action));
    return others;
}

void GuideBar::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) refresh();
}

void GuideBar::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    claimHeight();
}

void GuideBar::claimHeight() {
    const int wide = std::clamp(static_cast<int>(kExpectedShare * width()), kLeastExpected, kMostExpected);
    if (expected_->width() != wide) expected_->setFixedWidth(wide);
    // With its words; a wide bar would else be a low one.
    expected_->setMinimumHeight(3 * wide / 4);
    // The window's layout asks for no height for a width, and would cut the words.
    setMinimumHeight(layout()->heightForWidth(width()));
}

void GuideBar::refresh() {
    sentence_->setText(sentence());
    progress_->setText(progress());
    progress_->setVisible(!progress_->text().isEmpty() && guide_.trouble().isEmpty());
    trouble_->setText(guide_.trouble());
    trouble_->setVisible(!guide_.trouble().isEmpty());
    look::colourText(*trouble_, look::Tone::bad);
    const bool running = guide_.stage() == Stage::running;
    time_->setVisible(running);
    if (running) {
        tick_.start();
    } else {
        tick_.stop();
    }
    showTime();
    claimHeight();
}

void GuideBar::showTime() {
    time_->setText(tr("%1 s").arg(QLocale().toString(guide_.seconds(), 'f', 1)));
}

QString GuideBar::sentence() const {
    const int next = guide_.made() + 1;
    const int total = guide_.total();
    const std::vector<int> poses = guide_.alikePoses();
    const QString pose =
        poses.size() > 1
            ? tr("pose %1 (poses %2 look the same)").arg(poses.front() + 1).arg(models::poseNumbers(poses))
            : models::poseName(poses);
    switch (guide_.stage()) {
        case Stage::none:
            return tr("Plan a validation at the left.");
        case Stage::placing:
            return tr("Trial %1 of %2. Place the part like this: %3.").arg(next).arg(total).arg(pose);
        case Stage::running:
            return tr("Trial %1 of %2 runs. How does it end?").arg(next).arg(total);
        case Stage::paused:
            return tr("Paused. Next is trial %1 of %2: %3.").arg(next).arg(total).arg(pose);
        case Stage::done:
            return tr("All %1 trials are done.").arg(total);
    }
    return {};
}

QString GuideBar::progress() const {
    const study::PhysicalValidation* validation = guide_.validation();
    if (validation == nullptr || validation->trials.empty()) return {};
    const int successes = countSuccesses(*validation);
    const int trials = guide_.made();
    return tr("%1 of %2 succeeded: %3 %, with 95 % confidence %4 %")
        .arg(successes)
        .arg(trials)
        .arg(models::percent(successes, trials),
             models::boundsText(stats::calcClopperPearson(successes, trials), trials));
}

void GuideBar::askForNote() {
    const bool running = guide_.stage() == Stage::running;
    noteLabel_->setText(tr("Note on trial %1").arg(guide_.made() + (running ? 1 : 0)));
    noteEdit_->setText(guide_.note());
    noteRow_->show();
    claimHeight();
    noteEdit_->setFocus();
    noteEdit_->selectAll();
}

void GuideBar::takeNote() {
    guide_.setNote(noteEdit_->text().trimmed());
    noteRow_->hide();
    claimHeight();
    setFocus();
}

}  // namespace trapwright::feeder
