#include "ui/window/welcome.h"

#include <QEvent>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/look/icon.h"
#include "ui/look/theme.h"
#include "ui/window/study_card.h"
#include "ui/window/study_covers.h"

namespace trapwright::window {

namespace {

constexpr int kChoiceWidth = 216;
constexpr int kChoiceHeight = 152;
constexpr int kChoiceIcon = 40;
constexpr int kGap = 16;
constexpr int kColumns = 4;
constexpr int kRecentShown = 8;

/// A large button with a picture, a title and a sentence.
class Choice : public QPushButton {
 public:
    Choice(const QString& iconName, const QString& title, const QString& text, QWidget* parent)
        : QPushButton(parent), icon_(new QLabel(this)), iconName_(iconName) {
        setAccessibleName(title);
        setAccessibleDescription(text);
        setFixedSize(kChoiceWidth, kChoiceHeight);
        setCursor(Qt::PointingHandCursor);
        setStyleSheet(
            "QPushButton { border: 1px solid palette(mid); border-radius: 8px; background: palette(base); }"
            "QPushButton:hover, QPushButton:focus { border: 2px solid palette(highlight); }"
            "QPushButton:pressed { background: palette(window); }");
        auto* titleLabel = new QLabel(title, this);
        QFont font = titleLabel->font();
        font.setPointSizeF(font.pointSizeF() * 1.25);
        font.setBold(true);
        titleLabel->setFont(font);
        auto* textLabel = new QLabel(text, this);
        textLabel->setWordWrap(true);
        textLabel->setAlignment(Qt::AlignHCenter | Qt::AlignTop);
        textLabel->setForegroundRole(QPalette::PlaceholderText);

        auto* layout = new QVBoxLayout(this);
        layout->setContentsMargins(14, 16, 14, 10);
        layout->setSpacing(6);
        layout->addWidget(icon_, 0, Qt::AlignHCenter);
        layout->addWidget(titleLabel, 0, Qt::AlignHCenter);
        layout->addWidget(textLabel, 1);
        for (QLabel* label : {icon_, titleLabel, textLabel})
            label->setAttribute(Qt::WA_TransparentForMouseEvents);
        draw();
    }

 protected:
    void changeEvent(QEvent* event) override {
        QPushButton::changeEvent(event);
        if (event->type() == QEvent::PaletteChange) draw();
    }

 private:
    void draw() {
        icon_->setPixmap(look::icon(iconName_).pixmap({kChoiceIcon, kChoiceIcon}, devicePixelRatioF()));
    }

    QLabel* icon_;
    QString iconName_;
};

}  // namespace

Welcome::Welcome(QWidget* parent)
    : QWidget(parent),
      area_(new QScrollArea(this)),
      choices_(new QWidget),
      recent_(new QWidget),
      recentGrid_(new QGridLayout),
      covers_(new StudyCovers(StudyCard::kPicture, this)) {
    setObjectName("welcome");
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Window);
    setFocusPolicy(Qt::StrongFocus);

    auto* title = new QLabel(tr("A track for your part"), this);
    QFont font = title->font();
    font.setPointSizeF(font.pointSizeF() * 2.0);
    font.setWeight(QFont::DemiBold);
    title->setFont(font);

    choiceGrid_ = new QGridLayout(choices_);
    choiceGrid_->setContentsMargins(0, 0, 0, 0);
    choiceGrid_->setSpacing(kGap);
    QPushButton* example =
        addChoice("example", "example", tr("Watch an example"), tr("A 4 × 8 × 12 mm cuboid; learns at once"));
    QPushButton* draft = addChoice("draft", "draft", tr("Draft in 10 minutes"),
                                   tr("Your part, quick learning; its time is told before it starts"));
    QPushButton* import =
        addChoice("import", "import", tr("Import a part"), tr("STL, STEP, 3MF, OBJ, PLY, glTF or IGES"));
    QPushButton* open =
        addChoice("open", "open", tr("Open a study"), tr("Go on with learning, look at tracks, export"));
    connect(example, &QPushButton::clicked, this, &Welcome::exampleWanted);
    connect(draft, &QPushButton::clicked, this, &Welcome::draftWanted);
    connect(import, &QPushButton::clicked, this, &Welcome::importWanted);
    connect(open, &QPushButton::clicked, this, &Welcome::openWanted);
    auto* heading = new QLabel(tr("Recent"), recent_);
    QFont bold = heading->font();
    bold.setBold(true);
    heading->setFont(bold);
    recentGrid_->setSpacing(kGap);
    recentGrid_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    auto* recentLayout = new QVBoxLayout(recent_);
    recentLayout->setContentsMargins(0, 0, 0, 0);
    recentLayout->setSpacing(8);
    recentLayout->addWidget(heading);
    recentLayout->addLayout(recentGrid_);
    auto* contents = new QWidget(area_);
    auto* layout = new QVBoxLayout(contents);
    layout->setContentsMargins(kGap, kGap, kGap, kGap);
    layout->setSpacing(kGap);
    layout->addStretch(2);
    layout->addWidget(title, 0, Qt::AlignHCenter);
    layout->addWidget(choices_, 0, Qt::AlignHCenter);
    layout->addWidget(makeNotes(), 0, Qt::AlignHCenter);
    layout->addWidget(recent_, 0, Qt::AlignHCenter);
    layout->addStretch(3);
    area_->setWidget(contents);
    area_->setWidgetResizable(true);
    area_->setFrameShape(QFrame::NoFrame);
    area_->setFocusPolicy(Qt::NoFocus);
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->addWidget(area_);
    connect(covers_, &StudyCovers::ready, this, &Welcome::showCovers);
    arrange(kColumns);
}

QPushButton* Welcome::addChoice(const QString& name, const QString& icon, const QString& title,
                                const QString& text) {
    auto* button = new Choice(icon, title, text, choices_);
    button->setObjectName("welcome." + name);
    button->installEventFilter(this);
    choiceCards_.push_back(button);
    return button;
}

QWidget* Welcome::makeNotes() {
    auto* notes =
        new QLabel(tr("Drop a part or a study anywhere in this window. New here? <a href=\"tour\">Take the "
                      "tour</a> or read the <a href=\"help\">help</a> (F1)."),
                   this);
    notes->setObjectName("welcome.notes");
    notes->setForegroundRole(QPalette::PlaceholderText);
    notes->setTextInteractionFlags(Qt::TextBrowserInteraction);
    notes->setFocusPolicy(Qt::TabFocus);
    connect(notes, &QLabel::linkActivated, this, [this](const QString& link) {
        if (link == "tour") {
            emit tourWanted();
        } else {
            emit helpWanted();
        }
    });
    return notes;
}

void Welcome::setRecent(const QStringList& studies, const QStringList& drafts) {
    const QWidget* focus = window()->focusWidget();
    const bool hadFocus = isVisible() && (focus == nullptr || focus == this || isAncestorOf(focus));
    for (StudyCard* card : recentCards_) {
        card->hide();
        card->setObjectName({});
        card->deleteLater();
    }
    recentCards_.clear();
    const auto add = [this](const QString& study, bool draft) {
        if (static_cast<int>(recentCards_.size()) == kRecentShown) return;
        auto* card = new StudyCard(study, draft, recent_);
        card->installEventFilter(this);
        connect(card, &StudyCard::openWanted, this, &Welcome::studyWanted);
        connect(card, &StudyCard::removeWanted, this, &Welcome::forgetWanted, Qt::QueuedConnection);
        recentCards_.push_back(card);
    };
    for (const QString& draft : drafts)
        add(draft, true);
    for (const QString& study : studies)
        add(study, false);
    arrange(columns_);
    for (StudyCard* card : recentCards_)
        card->show();  // at once, so that one can have the focus
    recent_->setVisible(!recentCards_.empty());
    if (isVisible()) askForCovers();
    if (hadFocus) focusLater();
}

/// All cards in so many columns: fewer where a page stands beside them, as while a part is read.
void Welcome::arrange(int columns) {
    columns_ = columns;
    const auto fill = [columns](QGridLayout* grid, const auto& all) {
        int place = 0;
        for (QWidget* card : all) {
            grid->addWidget(card, place / columns, place % columns);
            ++place;
        }
    };
    fill(choiceGrid_, choiceCards_);
    fill(recentGrid_, recentCards_);
    recent_->setFixedWidth(columns * kChoiceWidth + (columns - 1) * kGap);
}

void Welcome::askForCovers() {
    covers_->setLook(look::schemeOf(palette()) == look::Scheme::dark, devicePixelRatioF());
    QStringList studies;
    for (const StudyCard* card : recentCards_)
        studies << card->study();
    covers_->want(studies);
    showCovers();
}

void Welcome::showCovers() {
    for (StudyCard* card : recentCards_)
        if (const auto cover = covers_->find(card->study())) card->setCover(*cover);
}

std::vector<QPushButton*> Welcome::cards() const {
    std::vector<QPushButton*> all = choiceCards_;
    all.insert(all.end(), recentCards_.begin(), recentCards_.end());
    return all;
}

/// To the next card in the direction of the key. Rows are as wide as each other, the last may be shorter.
void Welcome::goTo(QPushButton* from, int key) {
    const std::vector<QPushButton*> all = cards();
    const auto place = static_cast<int>(std::find(all.begin(), all.end(), from) - all.begin());
    const auto last = static_cast<int>(all.size()) - 1;
    int next = place;
    if (key == Qt::Key_Left) next = place - 1;
    if (key == Qt::Key_Right) next = place + 1;
    if (key == Qt::Key_Up) next = place - columns_;
    if (key == Qt::Key_Down)
        next = place / columns_ < last / columns_ ? std::min(place + columns_, last) : place;
    if (next < 0 || next > last) return;
    all[static_cast<std::size_t>(next)]->setFocus(Qt::TabFocusReason);
    area_->ensureWidgetVisible(all[static_cast<std::size_t>(next)]);
}

/// Once what is about to be shown and hidden is.
void Welcome::focusLater() {
    QMetaObject::invokeMethod(this, &Welcome::focusFirst, Qt::QueuedConnection);
}

/// The study that was open last, else the first way to begin.
void Welcome::focusFirst() {
    QPushButton* first = recentCards_.empty() ? choiceCards_.front() : recentCards_.front();
    first->setFocus(Qt::OtherFocusReason);
}

bool Welcome::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
    auto* card = qobject_cast<QPushButton*>(watched);
    const auto* press = static_cast<QKeyEvent*>(event);
    if (card == nullptr || (press->modifiers() & ~Qt::KeypadModifier) != Qt::NoModifier)
        return QWidget::eventFilter(watched, event);
    switch (press->key()) {
        case Qt::Key_Return:
        case Qt::Key_Enter:
            card->click();
            return true;
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
            goTo(card, press->key());
            return true;
        default:
            return QWidget::eventFilter(watched, event);
    }
}

void Welcome::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const int fitting = (width() - kGap) / (kChoiceWidth + kGap);
    // Three would leave one of the four ways to begin alone in its row.
    const int columns = fitting >= kColumns ? kColumns : std::clamp(fitting, 1, kColumns / 2);
    if (columns != columns_) arrange(columns);
}

void Welcome::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    askForCovers();
    focusLater();
}

void Welcome::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    focusFirst();
}

void Welcome::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && isVisible()) askForCovers();
}

}  // namespace trapwright::window
