#include "ui/window/dock_title.h"

#include <QDockWidget>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/look/icon.h"

namespace trapwright::window {

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

}  // namespace trapwright::window
