#include "ui/look/wheel_focus.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QLineEdit>
#include <QScrollBar>
#include <QSlider>
#include <QTabBar>

namespace trapwright::look {

namespace {

/// Whether the wheel would change a value or a choice of it.
bool turnsWithTheWheel(const QWidget& widget) {
    // A scroll bar is a slider, too; it only shows another place.
    if (qobject_cast<const QScrollBar*>(&widget) != nullptr) return false;
    return qobject_cast<const QComboBox*>(&widget) != nullptr ||
           qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr ||
           qobject_cast<const QLineEdit*>(&widget) != nullptr ||
           qobject_cast<const QAbstractSlider*>(&widget) != nullptr ||
           qobject_cast<const QTabBar*>(&widget) != nullptr;
}

/// Also if it is its field of text that has it.
bool hasFocus(const QWidget& widget) {
    const QWidget* focus = QApplication::focusWidget();
    return focus != nullptr && (widget.hasFocus() || widget.isAncestorOf(focus));
}

}  // namespace

WheelFocus::WheelFocus(QObject* parent) : QObject(parent) {
    qApp->installEventFilter(this);
}

bool WheelFocus::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::Wheel && event->type() != QEvent::Polish) return false;
    auto* widget = qobject_cast<QWidget*>(watched);
    if (widget == nullptr) return false;
    if (event->type() == QEvent::Polish) {
        if (widget->focusPolicy() == Qt::WheelFocus) widget->setFocusPolicy(Qt::StrongFocus);
        return false;
    }
    if (!turnsWithTheWheel(*widget) || hasFocus(*widget)) return false;
    // Not accepted, it is offered to the widget around it.
    event->ignore();
    return true;
}

}  // namespace trapwright::look
