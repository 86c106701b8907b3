#pragma once

#include <QWidget>

#include "core/study/field_text.h"
#include "ui/pages/field_texts.h"

class QComboBox;
class QLabel;
class QTimer;
class QToolButton;

namespace trapwright::pages {

class ValueEdit;

/// One setting: label, editor, a button that resets it, and below them what is wrong with it.
class SettingsRow : public QWidget {
    Q_OBJECT
 public:
    SettingsRow(study::FieldInfo field, QWidget* parent);

    [[nodiscard]] const study::FieldInfo& field() const { return field_; }
    [[nodiscard]] const FieldText& text() const { return text_; }

    /// What the setting, which is a text, can be. Its row has nothing to choose before.
    void offer(const std::vector<Choice>& choices);
    /// The value of these settings, and what reset goes back to. What is being typed stays if it means the
    /// same.
    void show(const study::Settings& settings, const study::Settings& defaults);
    /// What is wrong with the value, or advised; empty for nothing.
    void setProblem(const QString& reason, bool advice = false);
    [[nodiscard]] QString problem() const;
    void setLocked(bool locked);

 signals:
    /// The user wants this value, a text that study::setField takes.
    void edited(const QString& text);
    /// The user is at this row: its help is wanted.
    void attended();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    void addEditor();
    /// Tells of the text in the editor, if it can be read.
    void commit();
    /// The text in the editor as study::setField takes it.
    [[nodiscard]] QString editorText() const;
    void showReason();

    study::FieldInfo field_;
    FieldText text_;
    QString shown_;    // the value in force
    QString default_;  // the value that reset goes back to
    QString problem_;  // of the value in force
    bool advice_ = false;
    QLabel* label_;
    ValueEdit* edit_ = nullptr;   // of a number
    QComboBox* combo_ = nullptr;  // of anything else
    QToolButton* reset_;
    QLabel* reason_;
    QTimer* typing_;
};

}  // namespace trapwright::pages
