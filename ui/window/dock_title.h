#pragma once

#include <QWidget>

class QDockWidget;
class QLabel;
class QToolButton;

namespace trapwright::window {

/// The title bar of a dock: drag it to move the dock, double-click it to float it; two buttons float and close it.
class DockTitle : public QWidget {
    Q_OBJECT
 public:
    explicit DockTitle(QDockWidget& dock);

 private:
    QToolButton* addButton(const QString& icon, const QString& text);
};

}  // namespace trapwright::window
