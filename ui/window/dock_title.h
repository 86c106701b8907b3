#pragma once

#include <QWidget>

class QDockWidget;
class QLabel;
class QToolButton;

namespace trapwright::window {

/// The title bar of a dock: drag it to move the dock, double-click it to float it; two buttons float and
/// close it. A dock that has a tab needs no title bar, and has none.
class DockTitle : public QWidget {
    Q_OBJECT
 public:
    explicit DockTitle(QDockWidget& dock);

    void setTabbed(bool tabbed);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

 private:
    QToolButton* addButton(const QString& icon, const QString& text);

    QWidget* bar_;
    bool tabbed_ = false;
};

}  // namespace trapwright::window
