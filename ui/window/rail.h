#pragma once

#include <QToolBar>
#include <vector>

class QAction;
class QActionGroup;

namespace trapwright::pages {
class Page;
}

namespace trapwright::window {

/// The steps of the work, top to bottom at the left edge. One of them is shown; Ctrl and its number shows it.
class Rail : public QToolBar {
    Q_OBJECT
 public:
    Rail(const std::vector<pages::Page*>& pages, QWidget* parent);

    /// One checkable action per page, in their order.
    [[nodiscard]] const std::vector<QAction*>& actions() const { return actions_; }
    void setCurrent(std::size_t page);

 signals:
    void chosen(std::size_t page);

 private:
    std::vector<QAction*> actions_;
};

}  // namespace trapwright::window
