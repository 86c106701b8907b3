#include "ui/pages/value_edit.h"

#include <QKeyEvent>
#include <QLabel>
#include <QTimer>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"

namespace trapwright::pages {

namespace {

constexpr int kUnitGap = 6;

}  // namespace

ValueEdit::ValueEdit(const QString& unit, double low, double high, bool whole, QWidget* parent)
    : QLineEdit(parent), low_(low), high_(high), whole_(whole), unit_(new QLabel(unit, this)) {
    setAlignment(Qt::AlignRight);
    unit_->setForegroundRole(QPalette::PlaceholderText);
    unit_->setAttribute(Qt::WA_TransparentForMouseEvents);
    unit_->adjustSize();
    const int room = unit.isEmpty() ? 0 : unit_->sizeHint().width() + kUnitGap;
    setTextMargins(2, 0, room, 0);
    colour();
}

void ValueEdit::setBad(bool bad) {
    if (bad == bad_) return;
    bad_ = bad;
    colour();
}

QString ValueEdit::number() const {
    return text().trimmed().replace(',', '.');
}

bool ValueEdit::event(QEvent* event) {
    // Undo is of settings, not of letters: it is left to the window.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& key = static_cast<QKeyEvent&>(*event);
        if (key.matches(QKeySequence::Undo) || key.matches(QKeySequence::Redo)) {
            event->ignore();
            return true;
        }
    }
    return QLineEdit::event(event);
}

void ValueEdit::keyPressEvent(QKeyEvent* event) {
    constexpr int kPage = 10;
    switch (event->key()) {
        case Qt::Key_Up:
            return step(1);
        case Qt::Key_Down:
            return step(-1);
        case Qt::Key_PageUp:
            return step(kPage);
        case Qt::Key_PageDown:
            return step(-kPage);
        default:
            QLineEdit::keyPressEvent(event);
    }
}

void ValueEdit::wheelEvent(QWheelEvent* event) {
    // Only with the focus does it come here (look::WheelFocus).
    if (isReadOnly()) return event->ignore();
    step(event->angleDelta().y() > 0 ? 1 : -1);
    event->accept();
}

void ValueEdit::resizeEvent(QResizeEvent* event) {
    QLineEdit::resizeEvent(event);
    const QSize size = unit_->sizeHint();
    unit_->setGeometry(width() - size.width() - kUnitGap, (height() - size.height()) / 2, size.width(),
                       size.height());
}

void ValueEdit::focusInEvent(QFocusEvent* event) {
    QLineEdit::focusInEvent(event);
    // By mouse, too: the click that follows would take the selection away.
    if (event->reason() != Qt::PopupFocusReason) QTimer::singleShot(0, this, &QLineEdit::selectAll);
}

void ValueEdit::changeEvent(QEvent* event) {
    QLineEdit::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) colour();
}

void ValueEdit::step(int steps) {
    bool isNumber = false;
    const double value = number().toDouble(&isNumber);
    if (!isNumber || isReadOnly()) return;
    // The second digit that counts: 60 -> 61, 0.8 -> 0.81, 175 -> 185.
    const double magnitude = value == 0.0 ? 0.0 : std::floor(std::log10(std::abs(value)) + 1e-9);
    const double digit = whole_ ? std::max(0.0, magnitude - 1.0) : magnitude - 1.0;
    const double unit = std::pow(10.0, digit);
    const double next = std::clamp((std::round(value / unit) + steps) * unit, low_, high_);
    const int decimals = std::max(0, static_cast<int>(-digit) + 1);
    QString text = QString::number(next, 'f', whole_ ? 0 : decimals);
    if (text.contains('.')) {
        while (text.endsWith('0'))
            text.chop(1);
        if (text.endsWith('.')) text.chop(1);
    }
    setText(text);
    emit stepped();
}

void ValueEdit::colour() {
    const QString style =
        bad_ ? QString("QLineEdit { border: 2px solid %1; border-radius: 3px; background: palette(base); }")
                   .arg(look::toneColour(look::Tone::bad, QPalette()).name())
             : QString();
    if (style != styleSheet()) setStyleSheet(style);
}

}  // namespace trapwright::pages
