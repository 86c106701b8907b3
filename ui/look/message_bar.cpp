#include "ui/look/message_bar.h"

#include <QAccessible>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include "ui/look/icon.h"
#include "ui/look/theme.h"

namespace trapwright::look {

namespace {

constexpr int kSign = 20;

QString signOf(MessageKind kind) {
    switch (kind) {
        case MessageKind::info:
            return "info";
        case MessageKind::warning:
            return "warning";
        case MessageKind::error:
            return "error";
    }
    return {};
}

}  // namespace

MessageBar::MessageBar(QWidget* parent)
    : QFrame(parent),
      sign_(new QLabel(this)),
      text_(new QLabel(this)),
      actions_(new QHBoxLayout),
      close_(new QToolButton(this)) {
    setObjectName("messageBar");
    setAccessibleName(tr("Message"));
    setAutoFillBackground(true);
    text_->setObjectName("messageBar.text");
    text_->setWordWrap(true);
    text_->setTextFormat(Qt::RichText);
    text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    close_->setIcon(icon("close"));
    close_->setAutoRaise(true);
    close_->setToolTip(tr("Close this message"));
    close_->setAccessibleName(tr("Close this message"));

    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(12, 8, 8, 8);
    layout->setSpacing(12);
    layout->addWidget(sign_, 0, Qt::AlignTop);
    layout->addWidget(text_, 1);
    layout->addLayout(actions_);
    layout->addWidget(close_, 0, Qt::AlignTop);
    connect(close_, &QToolButton::clicked, this, &MessageBar::clear);
    hide();
}

void MessageBar::show(MessageKind kind, const QString& what, const QString& message,
                      const std::vector<MessageAction>& actions) {
    clear();
    kind_ = kind;
    text_->setText("<b>" + what.toHtmlEscaped() + "</b><br>" + message.toHtmlEscaped().replace("\n", "<br>"));
    for (const MessageAction& action : actions) {
        auto* button = new QPushButton(action.text, this);
        connect(button, &QPushButton::clicked, this, [this, act = action.act] {
            clear();
            act();
        });
        actions_->addWidget(button);
    }
    setAccessibleDescription(what + ". " + message);
    colour();
    setVisible(true);
    QAccessibleEvent alert(this, QAccessible::Alert);
    QAccessible::updateAccessibility(&alert);
}

QString MessageBar::text() const {
    return isHidden() ? QString() : accessibleDescription();
}

void MessageBar::clear() {
    setVisible(false);
    while (QLayoutItem* item = actions_->takeAt(0)) {
        // The button that was clicked is still at work.
        if (item->widget() != nullptr) item->widget()->deleteLater();
        delete item;
    }
}

void MessageBar::changeEvent(QEvent* event) {
    QFrame::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && !isHidden()) colour();
}

void MessageBar::colour() {
    const QPalette system = QPalette();
    const QColor tone = kind_ == MessageKind::info
                            ? system.color(QPalette::Highlight)
                            : toneColour(kind_ == MessageKind::warning ? Tone::warning : Tone::bad, system);
    sign_->setPixmap(signPixmap(signOf(kind_), tone, kSign, devicePixelRatioF()));
    const QString style =
        QString("#messageBar { border: none; border-left: 4px solid %1; border-bottom: 1px solid %2; }")
            .arg(tone.name(), system.color(QPalette::Mid).name());
    if (style != styleSheet()) setStyleSheet(style);
}

}  // namespace trapwright::look
