#pragma once

#include <QObject>
#include <QPointer>
#include <QTimer>
#include <functional>
#include <vector>

class QDialog;
class QLabel;

namespace trapwright::pages {
class Page;
}

namespace trapwright::window {

/// Before a study or the window goes: has the pages end what must not be cut short (a drive that must come to
/// rest) while the window lives on. What takes more than a moment is told by a dialog, beside which nothing
/// new can be begun. What ended badly is told by another that is closed by hand, also once the study is gone.
class Farewell : public QObject {
    Q_OBJECT
 public:
    Farewell(const std::vector<pages::Page*>& pages, QWidget* window);

    /// Calls `afterwards` when the pages have let go: at once where there is nothing to wait for. Who asks
    /// meanwhile is called in turn.
    void whenReleased(const std::function<void()>& afterwards);

 private:
    void goOn(const QString& what, const QString& message);
    [[nodiscard]] bool askPages() const;
    void tell(const QString& what, const QString& state);
    void showDialog();
    void warn(const QString& what, const QString& message);

    const std::vector<pages::Page*> pages_;
    QWidget* window_;
    std::vector<std::function<void()>> waiting_;
    QTimer patience_;
    QPointer<QDialog> dialog_;
    QLabel* what_ = nullptr;   // the dialog's,
    QLabel* state_ = nullptr;  // while it is shown
    QString whatText_;
    QString stateText_;
};

}  // namespace trapwright::window
