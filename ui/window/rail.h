#pragma once

#include <QToolBar>
#include <vector>

class QAction;
class QActionGroup;

namespace trapwright::pages {
class Page;
class RunActions;
}  // namespace trapwright::pages
namespace trapwright::session {
struct Environment;
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

/// The pages of the studio in the order of the rail. The window takes them.
std::vector<pages::Page*> makePages(pages::RunActions& run, const session::Environment& environment);

}  // namespace trapwright::window
