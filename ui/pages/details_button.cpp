#include "ui/pages/details_button.h"

#include <QEvent>
#include <QSettings>
#include <QTableView>

#include "ui/look/icon.h"

namespace trapwright::pages {

DetailsButton::DetailsButton(QTableView& view, int first, QWidget* parent)
    : QToolButton(parent), view_(view), first_(first) {
    setObjectName(view.objectName() + ".details");
    setText(tr("Details of the algorithm"));
    setToolTip(tr("Scores and what the search tells of itself, which learning works with"));
    setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    setAutoRaise(true);
    setCheckable(true);
    setFocusPolicy(Qt::TabFocus);
    const QString setting = "details/" + view.objectName();
    setChecked(QSettings().value(setting, false).toBool());
    showColumns(isChecked());
    // Another study may have other columns.
    connect(view.model(), &QAbstractItemModel::modelReset, this, [this] { hideColumns(!isChecked()); });
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
    hideColumns(!shown);
    if (shown && view_.model()->rowCount() > 0) view_.resizeColumnsToContents();
}

void DetailsButton::hideColumns(bool hidden) {
    for (int column = first_; column < view_.model()->columnCount(); ++column)
        view_.setColumnHidden(column, hidden);
}

}  // namespace trapwright::pages
