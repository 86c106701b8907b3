#include "ui/models/csv.h"

#include <QLocale>

#include "ui/models/roles.h"

namespace trapwright::models {

namespace {

QString quoted(QString text) {
    const bool plain = !text.contains(u',') && !text.contains(u'"') && !text.contains(u'\n');
    if (plain) return text;
    text.replace(u'"', QStringLiteral("\"\""));
    return u'"' + text + u'"';
}

QString fieldOf(const QModelIndex& index) {
    const QVariant value = index.data(ValueRole);
    if (value.typeId() == QMetaType::Double)
        return QString::number(value.toDouble(), 'g', QLocale::FloatingPointShortest);
    return quoted(value.toString());
}

}  // namespace

QString toCsv(const QAbstractItemModel& model) {
    QString text;
    const int columns = model.columnCount();
    for (int column = 0; column < columns; ++column) {
        if (column > 0) text += u',';
        text += quoted(model.headerData(column, Qt::Horizontal).toString());
    }
    text += u'\n';
    for (int row = 0; row < model.rowCount(); ++row) {
        for (int column = 0; column < columns; ++column) {
            if (column > 0) text += u',';
            text += fieldOf(model.index(row, column));
        }
        text += u'\n';
    }
    return text;
}

}  // namespace trapwright::models
