#pragma once

#include <QFrame>
#include <functional>
#include <vector>

class QHBoxLayout;
class QLabel;
class QToolButton;

namespace trapwright::look {

enum class MessageKind { info, warning, error };

/// What the user can do about a message.
struct MessageAction {
    QString text;  // a verb: "Go on learning"
    std::function<void()> act;
};

/// A line above the scene that tells what went wrong or offers something, until it is closed, acted on, or
/// replaced. It takes no focus and stops nothing. Screen readers are told.
class MessageBar : public QFrame {
    Q_OBJECT
 public:
    explicit MessageBar(QWidget* parent = nullptr);

    void show(MessageKind kind, const QString& what, const QString& message,
              const std::vector<MessageAction>& actions = {});
    /// What is shown, for tests and for copying; empty if nothing is.
    [[nodiscard]] QString text() const;

 public slots:
    void clear();

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void colour();

    MessageKind kind_ = MessageKind::info;
    QLabel* sign_;
    QLabel* text_;
    QHBoxLayout* actions_;
    QToolButton* close_;
};

}  // namespace trapwright::look
