#pragma once

#include <QPushButton>
#include <optional>

#include "ui/window/study_covers.h"

class QLabel;
class QToolButton;

namespace trapwright::window {

/// A study that was open before, on the start page: picture, success, age. One whose file is gone says so and
/// can be taken off the list.
class StudyCard : public QPushButton {
    Q_OBJECT
 public:
    static constexpr QSize kSize{216, 164};
    static constexpr QSize kPicture{212, 88};

    /// `draft`: never given a file of its own; it is not taken off.
    StudyCard(const QString& study, bool draft, QWidget* parent);

    [[nodiscard]] const QString& study() const { return study_; }
    [[nodiscard]] bool isMissing() const { return missing_; }
    void setCover(const StudyCover& cover);

 signals:
    void openWanted(const QString& study);
    void removeWanted(const QString& study);

 protected:
    void keyPressEvent(QKeyEvent* event) override;

 private:
    QString study_;
    bool missing_;
    bool draft_;
    QLabel* picture_;
    QLabel* success_;
    QToolButton* remove_ = nullptr;
};

/// "2 hours ago", "yesterday", "3 weeks ago".
QString ageText(const QDateTime& then, const QDateTime& now);

}  // namespace trapwright::window
