#include "ui/pages/print_row.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/look/icon.h"
#include "ui/look/theme.h"
#include "ui/pages/value_edit.h"

namespace trapwright::pages {

namespace {

constexpr int kEditorWidth = 128;
constexpr int kResetSize = 20;
// Long enough not to take "1" for the value while "15" is typed.
constexpr int kTypingPause = 250;  // [ms]

QString textOf(double value) {
    return QString::number(value, 'g', 6);
}

}  // namespace

PrintRow::PrintRow(PrintField field, QWidget* parent)
    : QWidget(parent),
      field_(std::move(field)),
      edit_(new ValueEdit(field_.unit, field_.low, field_.high, false, this)),
      reset_(new QToolButton(this)),
      reason_(new QLabel(this)),
      typing_(new QTimer(this)) {
    setObjectName("row.print." + field_.key);
    auto* label = new QLabel(field_.label, this);
    label->setToolTip(field_.help);
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    label->setBuddy(edit_);
    edit_->setObjectName("field.print." + field_.key);
    edit_->setFixedWidth(kEditorWidth);
    edit_->setAccessibleName(field_.label + ", " + field_.unit);
    edit_->setAccessibleDescription(field_.help);
    edit_->installEventFilter(this);
    reset_->setObjectName("reset.print." + field_.key);
    reset_->setIcon(look::icon("reset"));
    reset_->setIconSize({14, 14});
    reset_->setFixedSize(kResetSize, kResetSize);
    reset_->setAutoRaise(true);
    reset_->setAccessibleName(tr("Reset %1").arg(field_.label));
    QSizePolicy keepsRoom = reset_->sizePolicy();
    keepsRoom.setRetainSizeWhenHidden(true);
    reset_->setSizePolicy(keepsRoom);
    reason_->setObjectName("reason.print." + field_.key);
    reason_->setWordWrap(true);
    reason_->setTextFormat(Qt::PlainText);
    reason_->hide();
    typing_->setSingleShot(true);
    typing_->setInterval(kTypingPause);

    connect(typing_, &QTimer::timeout, this, &PrintRow::commit);
    connect(edit_, &QLineEdit::textEdited, typing_, qOverload<>(&QTimer::start));
    connect(edit_, &ValueEdit::stepped, this, &PrintRow::commit);
    connect(edit_, &QLineEdit::editingFinished, this, [this] {
        commit();
        // What could not be read gives way to the value in force.
        edit_->setText(textOf(value_));
        showReason();
    });
    connect(reset_, &QToolButton::clicked, this, [this] { emit edited(fallback_); });

    auto* line = new QHBoxLayout;
    line->setSpacing(6);
    line->addWidget(label, 1);
    line->addWidget(reset_);
    line->addWidget(edit_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    layout->addLayout(line);
    layout->addWidget(reason_);
}

void PrintRow::show(double value, double fallback) {
    value_ = value;
    fallback_ = fallback;
    reset_->setVisible(textOf(value) != textOf(fallback));
    reset_->setToolTip(tr("Back to %1 %2").arg(textOf(fallback), field_.unit));
    bool isNumber = false;
    const double typed = edit_->number().toDouble(&isNumber);
    if (!edit_->hasFocus() || !isNumber || textOf(typed) != textOf(value)) edit_->setText(textOf(value));
}

void PrintRow::setProblem(const QString& reason) {
    problem_ = reason;
    showReason();
}

bool PrintRow::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::FocusIn) emit attended(field_.label, field_.help);
    return QWidget::eventFilter(watched, event);
}

void PrintRow::enterEvent(QEnterEvent* event) {
    QWidget::enterEvent(event);
    emit attended(field_.label, field_.help);
}

void PrintRow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) showReason();
}

void PrintRow::commit() {
    typing_->stop();
    bool isNumber = false;
    const double value = edit_->number().toDouble(&isNumber);
    if (isNumber && textOf(value) != textOf(value_)) emit edited(value);
    showReason();
}

void PrintRow::showReason() {
    bool isNumber = false;
    edit_->number().toDouble(&isNumber);
    const QString reason = isNumber ? problem_ : tr("This is not a number.");
    edit_->setBad(!reason.isEmpty());
    reason_->setVisible(!reason.isEmpty());
    reason_->setText(reason);
    look::colourText(*reason_, look::Tone::bad);
    edit_->setAccessibleDescription(reason.isEmpty() ? field_.help : reason + " " + field_.help);
}

}  // namespace trapwright::pages
