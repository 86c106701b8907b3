#include "ui/pages/details_button.h"

#include <QEvent>
#include <QSettings>
#include <QTableView>

#include "ui/look/icon.h"

namespace trapwright::pages {

DetailsButton::DetailsButton(QTableView& view, int first, int last, QWidget* parent)
    : QToolButton(parent), view_(view), first_(first), last_(last) {
    setObjectName(view.objectName() + ".details");
    setText(tr("Details of the algorithm"));
    setToolTip(tr("Scores and strategy values, which learning works with"));
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    setAutoRaise(true);
    setCheckable(true);
    setFocusPolicy(Qt::TabFocus);
    const QString setting = "details/" + view.objectName();
    setChecked(QSettings().value(setting, false).toBool());
    showColumns(isChecked());
    connect(this, &QToolButton::toggled, this, [this, setting](bool shown) {
        showColumns(shown);
        QSettings().setValue(setting, shown);
    });
}

void DetailsButton::changeEvent(QEvent* event) {
    QToolButton::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) setIcon(look::icon(isChecked() ? "unfold" : "fold"));
}

void DetailsButton::showColumns(bool shown) {
    setIcon(look::icon(shown ? "unfold" : "fold"));
    for (int column = first_; column <= last_; ++column)
        view_.setColumnHidden(column, !shown);
    if (shown && view_.model()->rowCount() > 0) view_.resizeColumnsToContents();
}

}  // namespace trapwright::pages
