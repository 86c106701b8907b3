#include "ui/window/welcome.h"

#include <QEvent>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/icon.h"
#include "ui/look/text.h"

namespace trapwright::window {

namespace {

constexpr int kChoiceWidth = 216;
constexpr int kChoiceHeight = 160;
constexpr int kChoiceIcon = 48;
constexpr int kRecentShown = 5;

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
        layout->setContentsMargins(16, 20, 16, 12);
        layout->setSpacing(8);
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
      choices_(new QWidget(this)),
      recent_(new QWidget(this)),
      recentList_(new QVBoxLayout(recent_)) {
    setObjectName("welcome");
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Window);

    auto* title = new QLabel(tr("A track for your part"), this);
    QFont font = title->font();
    font.setPointSizeF(font.pointSizeF() * 2.0);
    font.setWeight(QFont::DemiBold);
    title->setFont(font);
    auto* hint = new QLabel(tr("Or drop a part or a study anywhere in this window."), this);
    hint->setForegroundRole(QPalette::PlaceholderText);

    auto* row = new QHBoxLayout(choices_);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(16);
    QPushButton* import =
        addChoice("import", "import", tr("Import a part"), tr("STL, STEP, 3MF, OBJ, PLY, glTF or IGES"));
    QPushButton* open =
        addChoice("open", "open", tr("Open a study"), tr("Go on with learning, look at tracks, export"));
    QPushButton* example =
        addChoice("example", "example", tr("Watch an example"), tr("A 4 × 8 × 12 mm cuboid; learns at once"));
    connect(import, &QPushButton::clicked, this, &Welcome::importWanted);
    connect(open, &QPushButton::clicked, this, &Welcome::openWanted);
    connect(example, &QPushButton::clicked, this, &Welcome::exampleWanted);

    recentList_->setContentsMargins(0, 8, 0, 0);
    recentList_->setSpacing(2);
    recent_->setFixedWidth(3 * kChoiceWidth + 2 * 16);

    auto* layout = new QVBoxLayout(this);
    layout->setSpacing(20);
    layout->addStretch(2);
    layout->addWidget(title, 0, Qt::AlignHCenter);
    layout->addWidget(choices_, 0, Qt::AlignHCenter);
    layout->addWidget(hint, 0, Qt::AlignHCenter);
    layout->addWidget(recent_, 0, Qt::AlignHCenter);
    layout->addStretch(3);
}

QPushButton* Welcome::addChoice(const QString& name, const QString& icon, const QString& title,
                                const QString& text) {
    auto* button = new Choice(icon, title, text, choices_);
    button->setObjectName("welcome." + name);
    choices_->layout()->addWidget(button);
    return button;
}

void Welcome::setRecent(const QStringList& studies, const QStringList& drafts) {
    while (QLayoutItem* item = recentList_->takeAt(0)) {
        if (item->widget() != nullptr) item->widget()->deleteLater();
        delete item;
    }
    recent_->setVisible(!studies.isEmpty() || !drafts.isEmpty());
    if (recent_->isHidden()) return;

    auto* heading = new QLabel(tr("Lately"), recent_);
    QFont font = heading->font();
    font.setBold(true);
    heading->setFont(font);
    recentList_->addWidget(heading);
    const auto addLink = [&](const QString& path, const QString& place) {
        const QString name = QFileInfo(path).completeBaseName();
        auto* link = new QPushButton(recent_);
        link->setObjectName("welcome.recent");
        link->setFlat(true);
        link->setCursor(Qt::PointingHandCursor);
        link->setText(name + "    " + place);
        link->setAccessibleName(tr("Open %1").arg(name));
        link->setToolTip(path);
        link->setStyleSheet(
            "QPushButton { text-align: left; padding: 5px 6px; border: 1px solid transparent; border-radius: "
            "4px; }"
            "QPushButton:hover { background: palette(base); }"
            "QPushButton:focus { border-color: palette(highlight); }");
        connect(link, &QPushButton::clicked, this, [this, path] { emit studyWanted(path); });
        recentList_->addWidget(link);
    };
    for (const QString& draft : drafts)
        addLink(draft, tr("not saved yet"));
    for (const QString& study : studies.mid(0, kRecentShown))
        addLink(study, look::pathText(QFileInfo(study).absolutePath().toStdString()));
}

}  // namespace trapwright::window
