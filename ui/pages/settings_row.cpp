#include "ui/pages/settings_row.h"

#include <QComboBox>
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

/// Of a setting of which it is known; a text is chosen from what the form offers.
std::vector<Choice> choicesOf(const study::FieldInfo& field, const FieldText& text) {
    const std::vector<std::string> names =
        field.kind == study::FieldKind::flag ? std::vector<std::string>{"false", "true"} : field.choices;
    std::vector<Choice> choices;
    for (std::size_t i = 0; i < names.size(); ++i)
        choices.push_back(
            {names[i], i < text.choices.size() ? text.choices[i] : QString::fromStdString(names[i])});
    return choices;
}

}  // namespace

SettingsRow::SettingsRow(study::FieldInfo field, QWidget* parent)
    : QWidget(parent),
      field_(std::move(field)),
      text_(findFieldText(field_.key)),
      label_(new QLabel(text_.label, this)),
      reset_(new QToolButton(this)),
      reason_(new QLabel(this)),
      typing_(new QTimer(this)) {
    const QString key = QString::fromStdString(field_.key);
    setObjectName("row." + key);
    label_->setToolTip(text_.help);
    label_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    reset_->setObjectName("reset." + key);
    reset_->setIcon(look::icon("reset"));
    reset_->setIconSize({14, 14});
    reset_->setFixedSize(kResetSize, kResetSize);
    reset_->setAutoRaise(true);
    reset_->setAccessibleName(tr("Reset %1").arg(text_.label));
    QSizePolicy keepsRoom = reset_->sizePolicy();
    keepsRoom.setRetainSizeWhenHidden(true);
    reset_->setSizePolicy(keepsRoom);
    reason_->setObjectName("reason." + key);
    reason_->setWordWrap(true);
    reason_->setTextFormat(Qt::PlainText);
    reason_->hide();
    typing_->setSingleShot(true);
    typing_->setInterval(kTypingPause);
    connect(typing_, &QTimer::timeout, this, &SettingsRow::commit);
    connect(reset_, &QToolButton::clicked, this, [this] { emit edited(default_); });

    auto* line = new QHBoxLayout;
    line->setSpacing(6);
    line->addWidget(label_, 1);
    addEditor();
    QWidget* editor = edit_ != nullptr ? static_cast<QWidget*>(edit_) : combo_;
    editor->setObjectName("field." + key);
    editor->setFixedWidth(kEditorWidth);
    editor->setAccessibleName(text_.label +
                              (unitOf(field_.key).isEmpty() ? QString() : ", " + unitOf(field_.key)));
    editor->setAccessibleDescription(text_.help);
    editor->installEventFilter(this);
    label_->setBuddy(editor);
    line->addWidget(reset_);
    line->addWidget(editor);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    layout->addLayout(line);
    layout->addWidget(reason_);
}

void SettingsRow::addEditor() {
    const std::vector<Choice> choices = choicesOf(field_, text_);
    if (choices.empty() && field_.kind != study::FieldKind::text) {
        const bool whole = field_.kind != study::FieldKind::number;
        const bool seed = field_.kind == study::FieldKind::seed;
        edit_ = new ValueEdit(unitOf(field_.key), field_.low, seed ? 1e15 : field_.high, whole, this);
        connect(edit_, &QLineEdit::textEdited, typing_, qOverload<>(&QTimer::start));
        connect(edit_, &ValueEdit::stepped, this, &SettingsRow::commit);
        connect(edit_, &QLineEdit::editingFinished, this, [this] {
            commit();
            // What could not be read gives way to the value in force.
            edit_->setText(shown_);
            showReason();
        });
        return;
    }
    combo_ = new QComboBox(this);
    offer(choices);
    connect(combo_, &QComboBox::activated, this, &SettingsRow::commit);
}

void SettingsRow::offer(const std::vector<Choice>& choices) {
    combo_->clear();
    for (const Choice& choice : choices)
        combo_->addItem(choice.label, QString::fromStdString(choice.value));
    combo_->setCurrentIndex(combo_->findData(shown_));
}

void SettingsRow::show(const study::Settings& settings, const study::Settings& defaults) {
    shown_ = QString::fromStdString(study::fieldText(settings, field_.key));
    default_ = QString::fromStdString(study::fieldText(defaults, field_.key));
    reset_->setVisible(shown_ != default_);
    if (combo_ != nullptr) {
        // A text may be other than what is offered: a longer chain of traps.
        if (field_.kind == study::FieldKind::text && combo_->findData(shown_) < 0)
            combo_->addItem(shown_, shown_);
        combo_->setCurrentIndex(combo_->findData(shown_));
        reset_->setToolTip(tr("Back to %1").arg(combo_->itemText(combo_->findData(default_))));
        return;
    }
    reset_->setToolTip(tr("Back to %1 %2").arg(default_, unitOf(field_.key)));
    study::Settings typed = settings;
    const bool same = edit_->hasFocus() &&
                      study::setField(typed, field_.key, editorText().toStdString()).ok() &&
                      study::fieldText(typed, field_.key) == shown_.toStdString();
    if (!same) edit_->setText(shown_);
}

void SettingsRow::setProblem(const QString& reason, bool advice) {
    problem_ = reason;
    advice_ = advice;
    showReason();
}

QString SettingsRow::problem() const {
    return reason_->isHidden() ? QString() : reason_->text();
}

void SettingsRow::setLocked(bool locked) {
    if (edit_ != nullptr) edit_->setReadOnly(locked);
    QWidget* editor = edit_ != nullptr ? static_cast<QWidget*>(edit_) : combo_;
    editor->setEnabled(!locked);
    reset_->setEnabled(!locked);
}

bool SettingsRow::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::FocusIn) emit attended();
    // A closed combo box would be changed by a wheel that is meant for the inspector.
    if (event->type() == QEvent::Wheel && watched == combo_ && !combo_->hasFocus()) {
        event->ignore();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void SettingsRow::enterEvent(QEnterEvent* event) {
    QWidget::enterEvent(event);
    emit attended();
}

void SettingsRow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) showReason();
}

void SettingsRow::commit() {
    typing_->stop();
    const QString text = editorText();
    if (text == shown_) return showReason();
    study::Settings trial;
    if (!study::setField(trial, field_.key, text.toStdString())) return showReason();
    emit edited(text);
}

QString SettingsRow::editorText() const {
    return combo_ != nullptr ? combo_->currentData().toString() : edit_->number();
}

void SettingsRow::showReason() {
    study::Settings trial;
    const bool readable = study::setField(trial, field_.key, editorText().toStdString()).ok();
    const bool whole = field_.kind == study::FieldKind::count || field_.kind == study::FieldKind::seed;
    const QString reason = readable ? problem_
                           : whole  ? tr("This is not a whole number.")
                                    : tr("This is not a number.");
    const bool bad = !reason.isEmpty() && !(readable && advice_);
    if (edit_ != nullptr) edit_->setBad(bad);
    reason_->setVisible(!reason.isEmpty());
    reason_->setText(reason);
    look::colourText(*reason_, bad ? look::Tone::bad : look::Tone::warning);
    QWidget* editor = edit_ != nullptr ? static_cast<QWidget*>(edit_) : combo_;
    editor->setAccessibleDescription(reason.isEmpty() ? text_.help : reason + " " + text_.help);
}

}  // namespace trapwright::pages
