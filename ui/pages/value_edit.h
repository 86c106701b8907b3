#pragma once

#include <QLineEdit>

class QLabel;

namespace trapwright::pages {

/// A field for one number with its unit in it. Any text can be typed, so that what is wrong can be shown where it
/// is wrong. Up and Down change the last digit that counts, Page Up and Page Down ten times as much; so does the
/// wheel in a field that has the focus.
class ValueEdit : public QLineEdit {
    Q_OBJECT
 public:
    /// `unit` for people ("mm"); `low` and `high` are where stepping ends.
    ValueEdit(const QString& unit, double low, double high, bool whole, QWidget* parent = nullptr);

    /// Marks the text as bad: a frame and a sign.
    void setBad(bool bad);
    [[nodiscard]] bool isBad() const { return bad_; }
    /// The text with a point as the decimal sign.
    [[nodiscard]] QString number() const;

 signals:
    /// The user stepped; the text has changed.
    void stepped();

 protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    void step(int steps);
    void colour();

    double low_;
    double high_;
    bool whole_;
    bool bad_ = false;
    QLabel* unit_;
};

}  // namespace trapwright::pages
