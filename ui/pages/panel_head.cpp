#include "ui/pages/panel_head.h"

#include <QVBoxLayout>

namespace trapwright::pages {

PanelHead::PanelHead(const QString& name, QWidget* panel, QWidget* chart) : QLabel(panel) {
    setObjectName(name);
    setTextFormat(Qt::RichText);
    setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
    setWordWrap(true);
    // It must not widen the window's middle.
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    setContentsMargins(8, 6, 8, 0);
    panel->setAutoFillBackground(true);
    panel->setBackgroundRole(QPalette::Base);
    auto* column = new QVBoxLayout(panel);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(this);
    column->addWidget(chart, 1);
}

}  // namespace trapwright::pages
