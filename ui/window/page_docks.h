#pragma once

#include <QHash>
#include <QList>
#include <QObject>
#include <QWidget>

#include <vector>

class QAction;
class QDockWidget;
class QLabel;
class QMainWindow;
class QPoint;
class QStackedWidget;
class QTabBar;
class QToolButton;

namespace trapwright::pages {
class Page;
}

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

/// The docks around the scene: the inspector with the page that is shown, and one for each panel of a page.
/// Docks move, float and close; every page has an arrangement of its own, which is remembered between starts.
class PageDocks : public QObject {
    Q_OBJECT
 public:
    PageDocks(QMainWindow& window, const std::vector<pages::Page*>& pages);

    /// Puts the page into the inspector and its panels where they were when it was shown last.
    void show(std::size_t page);
    /// Brings a panel of the page before the others of its area, if that page is shown and the panel is open.
    void bringToFront(const pages::Page& page, const QString& panel);
    /// No docks at all, as long as no study is open.
    void hideAll();
    /// Writes the arrangement that is seen.
    void remember();
    /// The arrangement that the program comes with, of the page that is shown.
    void reset();
    /// Actions that show and hide the docks of the page that is shown.
    [[nodiscard]] QList<QAction*> toggles() const;

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    struct PanelDock {
        QDockWidget* dock;
        Qt::DockWidgetArea area;  // at first
    };

    void arrange();
    void tendTabsLater();
    void tendTabs();
    [[nodiscard]] QDockWidget* findDock(const QTabBar& bar, int tab) const;
    void showTabMenu(QTabBar& bar, const QPoint& place);
    [[nodiscard]] QString setting() const;

    static constexpr int kNoPage = -1;

    QMainWindow& window_;
    const std::vector<pages::Page*> pages_;
    QDockWidget* inspector_;
    QStackedWidget* stack_;
    std::vector<std::vector<PanelDock>> panels_;  // by page
    int shown_ = kNoPage;
    bool tending_ = false;  // to the tabs is on its way
};

}  // namespace trapwright::window
