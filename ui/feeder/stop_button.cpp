#include "ui/feeder/stop_button.h"

#include <QAction>
#include <QApplication>
#include <QCoreApplication>
#include <QKeyEvent>
#include <QPushButton>
#include <QWidget>

#include "ui/feeder/drive_link.h"

namespace trapwright::feeder {

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(StopButton)
};

constexpr int kHeight = 52;
// White on it has a contrast of 6.5:1.
constexpr auto kStyle =
    "QPushButton { background: #b3261e; color: #ffffff; border: 2px solid #7d1914; border-radius: 6px; "
    "font-weight: 700; padding: 4px 10px; }"
    "QPushButton:hover { background: #c5352c; }"
    "QPushButton:pressed { background: #7d1914; }"
    "QPushButton:focus { border-color: palette(window-text); }"
    "QPushButton:disabled { background: transparent; color: palette(placeholder-text); border-color: "
    "palette(mid); }";

}  // namespace

QPushButton* makeStopButton(QAction& action, QWidget* parent) {
    auto* button = new QPushButton(Texts::tr("Stop (Esc) - this is no emergency stop"), parent);
    button->setObjectName(action.objectName() + ".button");
    button->setStyleSheet(kStyle);
    button->setMinimumHeight(kHeight);
    button->setToolTip(action.toolTip());
    button->setAutoDefault(false);
    QObject::connect(button, &QPushButton::clicked, &action, &QAction::trigger);
    QObject::connect(&action, &QAction::changed, button,
                     [button, &action] { button->setEnabled(action.isEnabled()); });
    button->setEnabled(action.isEnabled());
    return button;
}

StopKey::StopKey(DriveLink& link, QWidget* inside) : QObject(inside), link_(link), inside_(inside) {
    connect(&link_, &DriveLink::linkChanged, this, [this] {
        qApp->removeEventFilter(this);
        if (link_.linked()) qApp->installEventFilter(this);
    });
}

bool StopKey::eventFilter(QObject* watched, QEvent* event) {
    switch (event->type()) {
        // The first comes before any shortcut; the second also where something has grabbed the keys.
        case QEvent::ShortcutOverride:
        case QEvent::KeyPress:
            if (static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) link_.stop();
            break;
        case QEvent::Close:
            if (watched == window()) link_.stop();
            break;
        case QEvent::Hide:
            // A spontaneous one is a window that is minimised.
            if (watched == window() && !event->spontaneous()) link_.disconnectDrive();
            break;
        default:
            break;
    }
    return false;
}

QObject* StopKey::window() const {
    // The inspector may float: its own window is not the one.
    QWidget* window = inside_;
    while (window->parentWidget() != nullptr)
        window = window->parentWidget();
    return window;
}

}  // namespace trapwright::feeder
