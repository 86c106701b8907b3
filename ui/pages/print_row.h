#pragma once

#include <QString>
#include <QWidget>

class QLabel;
class QTimer;
class QToolButton;

namespace trapwright::pages {

class ValueEdit;

/// What people are told of a number that is typed.
struct PrintField {
    QString key;    // as in track::PrintOptions or geometry::PrintLimits
    QString label;  // "Wall height"
    QString unit;   // "mm"
    QString help;   // one sentence
    double low = 0.0;
    double high = 0.0;
};

/// One number of the print: label, editor with its unit, a button that resets it, and below them what is
/// wrong.
class PrintRow : public QWidget {
    Q_OBJECT
 public:
    PrintRow(PrintField field, QWidget* parent);

    [[nodiscard]] const PrintField& field() const { return field_; }

    /// The value in force and what reset goes back to, in the field's unit. What is being typed stays if it
    /// means the same.
    void show(double value, double fallback);
    /// What is wrong with the value; empty for nothing.
    void setProblem(const QString& reason);

 signals:
    /// The user wants this value, in the field's unit.
    void edited(double value);
    /// The user is at this row: its help is wanted.
    void attended(const QString& label, const QString& help);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    void commit();
    void showReason();

    PrintField field_;
    double value_ = 0.0;
    double fallback_ = 0.0;
    QString problem_;
    ValueEdit* edit_;
    QToolButton* reset_;
    QLabel* reason_;
    QTimer* typing_;
};

}  // namespace trapwright::pages
