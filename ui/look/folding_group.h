#pragma once

#include <QWidget>

class QLabel;
class QToolButton;
class QVBoxLayout;

namespace trapwright::look {

/// A titled group of an inspector. A click or a key on its title folds it; whether it is folded is remembered
/// under its name.
class FoldingGroup : public QWidget {
    Q_OBJECT
 public:
    FoldingGroup(const QString& name, const QString& title, bool foldedAtFirst, QWidget* parent = nullptr);

    /// Where the group's contents go.
    QVBoxLayout* body() { return body_; }
    /// A few words at the right of the title, also seen when folded ("12 mm", "3 problems").
    void setSummary(const QString& text);
    void setFolded(bool folded);
    [[nodiscard]] bool isFolded() const;

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void applyFold(bool folded);

    QString name_;
    QToolButton* title_;
    QLabel* summary_;
    QWidget* contents_;
    QVBoxLayout* body_;
};

}  // namespace trapwright::look
