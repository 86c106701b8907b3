#include "ui/window/page_docks.h"

#include <QAction>
#include <QDockWidget>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QScrollArea>
#include <QSettings>
#include <QStackedWidget>
#include <QTabBar>
#include <QToolButton>

#include <algorithm>
#include <utility>

#include "ui/look/icon.h"
#include "ui/pages/page.h"

namespace trapwright::window {

namespace {

// Raised when docks are added or renamed, so that an old arrangement is not laid over them.
constexpr int kLayoutVersion = 4;
constexpr int kInspectorWidth = 368;
constexpr int kPanelHeight = 240;
constexpr int kPanelWidth = 312;

QScrollArea* scrolled(pages::Page* page) {
    auto* area = new QScrollArea;
    area->setWidget(page);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);
    return area;
}

}  // namespace

DockTitle::DockTitle(QDockWidget& dock) : QWidget(&dock), bar_(new QWidget(this)) {
    bar_->setObjectName("dockTitle");
    bar_->setAttribute(Qt::WA_StyledBackground);
    bar_->setStyleSheet("#dockTitle { border-bottom: 1px solid palette(mid); }");
    auto* title = new QLabel(dock.windowTitle(), bar_);
    title->setForegroundRole(QPalette::PlaceholderText);
    auto* layout = new QHBoxLayout(bar_);
    layout->setContentsMargins(12, 3, 4, 3);
    layout->setSpacing(0);
    layout->addWidget(title, 1);
    const QToolButton* floating = addButton("float", tr("Float or dock this panel"));
    const QToolButton* closing = addButton("close", tr("Close this panel; View > Panels shows it again"));
    auto* around = new QHBoxLayout(this);
    around->setContentsMargins(0, 0, 0, 0);
    around->addWidget(bar_);
    connect(&dock, &QDockWidget::windowTitleChanged, title, &QLabel::setText);
    connect(floating, &QToolButton::clicked, &dock, [&dock] { dock.setFloating(!dock.isFloating()); });
    connect(closing, &QToolButton::clicked, &dock, &QDockWidget::close);
}

void DockTitle::setTabbed(bool tabbed) {
    if (tabbed == tabbed_) return;
    tabbed_ = tabbed;
    bar_->setVisible(!tabbed);
    updateGeometry();
}

QSize DockTitle::sizeHint() const {
    return tabbed_ ? QSize(0, 0) : bar_->sizeHint();
}

QSize DockTitle::minimumSizeHint() const {
    return tabbed_ ? QSize(0, 0) : bar_->minimumSizeHint();
}

QToolButton* DockTitle::addButton(const QString& icon, const QString& text) {
    auto* button = new QToolButton(bar_);
    button->setIcon(look::icon(icon));
    button->setIconSize({14, 14});
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::TabFocus);
    button->setToolTip(text);
    button->setAccessibleName(text);
    bar_->layout()->addWidget(button);
    return button;
}

PageDocks::PageDocks(QMainWindow& window, const std::vector<pages::Page*>& pages)
    : QObject(&window),
      window_(window),
      pages_(pages),
      inspector_(new QDockWidget(tr("Inspector"), &window)),
      stack_(new QStackedWidget(inspector_)) {
    window.installEventFilter(this);
    window.setDockNestingEnabled(true);
    window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    inspector_->setObjectName("dock.inspector");
    inspector_->setTitleBarWidget(new DockTitle(*inspector_));
    inspector_->setWidget(stack_);
    inspector_->toggleViewAction()->setText(tr("Inspector"));
    window.addDockWidget(Qt::RightDockWidgetArea, inspector_);
    for (pages::Page* page : pages_) {
        stack_->addWidget(scrolled(page));
        std::vector<PanelDock> docks;
        for (const pages::Panel& panel : page->panels()) {
            auto* dock = new QDockWidget(panel.title, &window);
            dock->setObjectName("dock." + page->face().name + "." + panel.name);
            dock->setTitleBarWidget(new DockTitle(*dock));
            dock->setWidget(panel.widget);
            window.addDockWidget(panel.area, dock);
            connect(dock, &QDockWidget::visibilityChanged, this, &PageDocks::tendTabsLater);
            connect(dock, &QDockWidget::topLevelChanged, this, &PageDocks::tendTabsLater);
            docks.push_back({dock, panel.area});
        }
        panels_.push_back(std::move(docks));
    }
    hideAll();
}

void PageDocks::show(std::size_t page) {
    if (shown_ == static_cast<int>(page)) return;
    remember();
    shown_ = static_cast<int>(page);
    inspector_->setWindowTitle(pages_[page]->face().title);
    stack_->setCurrentIndex(shown_);
    if (!window_.restoreState(QSettings().value(setting()).toByteArray(), kLayoutVersion)) arrange();
}

void PageDocks::bringToFront(const pages::Page& page, const QString& panel) {
    if (shown_ == kNoPage || pages_[static_cast<std::size_t>(shown_)] != &page) return;
    auto* dock = window_.findChild<QDockWidget*>("dock." + page.face().name + "." + panel);
    // One that was closed stays so.
    if (dock != nullptr && !dock->isHidden()) dock->raise();
}

void PageDocks::hideAll() {
    remember();
    shown_ = kNoPage;
    inspector_->hide();
    for (const auto& docks : panels_)
        for (const PanelDock& panel : docks)
            panel.dock->hide();
}

void PageDocks::remember() {
    if (shown_ != kNoPage) QSettings().setValue(setting(), window_.saveState(kLayoutVersion));
}

void PageDocks::reset() {
    if (shown_ == kNoPage) return;
    QSettings().remove(setting());
    arrange();
}

QList<QAction*> PageDocks::toggles() const {
    QList<QAction*> toggles;
    if (shown_ == kNoPage) return toggles;
    toggles.push_back(inspector_->toggleViewAction());
    for (const PanelDock& panel : panels_[static_cast<std::size_t>(shown_)])
        toggles.push_back(panel.dock->toggleViewAction());
    return toggles;
}

bool PageDocks::eventFilter(QObject* watched, QEvent* event) {
    // After the window has handled it.
    if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::ChildPolished) tendTabsLater();
    return QObject::eventFilter(watched, event);
}

/// Bars of tabs are made after the docks are shown.
void PageDocks::tendTabsLater() {
    if (!std::exchange(tending_, true))
        QMetaObject::invokeMethod(this, &PageDocks::tendTabs, Qt::QueuedConnection);
}

/// The window keeps bars of tabs that it has no use for, and does not hide each of them. Hidden by us they
/// would stay so when it needs them again; below everything else they are neither seen nor clicked.
void PageDocks::tendTabs() {
    tending_ = false;
    for (QTabBar* bar : window_.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
        bar->setDrawBase(bar->count() > 0);
        if (bar->count() == 0) bar->lower();
        if (bar->contextMenuPolicy() == Qt::CustomContextMenu) continue;
        // What the title bar would offer, which a dock with a tab has not.
        bar->setContextMenuPolicy(Qt::CustomContextMenu);
        connect(bar, &QTabBar::customContextMenuRequested, this,
                [this, bar](const QPoint& place) { showTabMenu(*bar, place); });
        connect(bar, &QTabBar::tabBarDoubleClicked, this, [this, bar](int tab) {
            if (QDockWidget* dock = findDock(*bar, tab)) dock->setFloating(true);
        });
    }
    for (QDockWidget* dock : window_.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
        const QList<QDockWidget*> others = window_.tabifiedDockWidgets(dock);
        const bool tabbed =
            !dock->isFloating() && std::any_of(others.begin(), others.end(), [](const auto* other) {
                return !other->isHidden() && !other->isFloating();
            });
        if (auto* title = qobject_cast<DockTitle*>(dock->titleBarWidget())) title->setTabbed(tabbed);
    }
}

QDockWidget* PageDocks::findDock(const QTabBar& bar, int tab) const {
    if (tab < 0 || shown_ == kNoPage) return nullptr;
    for (const PanelDock& panel : panels_[static_cast<std::size_t>(shown_)])
        if (panel.dock->windowTitle() == bar.tabText(tab)) return panel.dock;
    return inspector_->windowTitle() == bar.tabText(tab) ? inspector_ : nullptr;
}

void PageDocks::showTabMenu(QTabBar& bar, const QPoint& place) {
    QDockWidget* dock = findDock(bar, bar.tabAt(place));
    if (dock == nullptr) return;
    auto* menu = new QMenu(&bar);
    menu->setObjectName("panelMenu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addAction(look::icon("float"), tr("Float this panel"), dock, [dock] { dock->setFloating(true); });
    menu->addAction(look::icon("close"), tr("Close this panel"), dock, &QDockWidget::close);
    menu->popup(bar.mapToGlobal(place));
}

void PageDocks::arrange() {
    inspector_->setFloating(false);
    window_.addDockWidget(Qt::RightDockWidgetArea, inspector_);
    inspector_->show();
    for (const auto& docks : panels_)
        for (const PanelDock& panel : docks)
            panel.dock->hide();
    // Placed before they are shown: side by side for a moment they would widen the window, which stays so.
    QHash<Qt::DockWidgetArea, QDockWidget*> front;  // of each area's tabs
    for (const auto& [dock, area] : panels_[static_cast<std::size_t>(shown_)]) {
        dock->setFloating(false);
        if (QDockWidget* first = front.value(area)) {
            window_.tabifyDockWidget(first, dock);
        } else {
            window_.addDockWidget(area, dock);
            front.insert(area, dock);
        }
    }
    for (const PanelDock& panel : panels_[static_cast<std::size_t>(shown_)])
        panel.dock->show();
    QList<QDockWidget*> beside = {inspector_};
    QList<int> widths = {kInspectorWidth};
    for (auto first = front.cbegin(); first != front.cend(); ++first) {
        first.value()->raise();
        const bool wide = first.key() == Qt::BottomDockWidgetArea || first.key() == Qt::TopDockWidgetArea;
        if (wide) window_.resizeDocks({first.value()}, {kPanelHeight}, Qt::Vertical);
        if (first.key() == Qt::LeftDockWidgetArea) {
            beside.push_back(first.value());
            widths.push_back(kPanelWidth);
        }
    }
    // In one call: one after the other they would take room from each other.
    window_.resizeDocks(beside, widths, Qt::Horizontal);
}

QString PageDocks::setting() const {
    return "layout/" + pages_[static_cast<std::size_t>(shown_)]->face().name;
}

}  // namespace trapwright::window
