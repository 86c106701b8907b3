#include "ui/models/csv.h"

#include "ui/look/text.h"
#include "ui/models/roles.h"

namespace trapwright::models {

namespace {

QString fieldOf(const QVariant& value) {
    if (value.typeId() == QMetaType::Double) return look::csvNumber(value.toDouble());
    return look::csvField(value.toString());
}

}  // namespace

QString toCsv(const QAbstractItemModel& model) {
    const int columns = model.columnCount();
    QStringList titles;
    for (int column = 0; column < columns; ++column) {
        const QVariant list = model.headerData(column, Qt::Horizontal, CsvRole);
        if (list.isValid()) {
            for (const QString& title : list.toStringList())
                titles.append(look::csvField(title));
        } else {
            titles.append(look::csvField(model.headerData(column, Qt::Horizontal).toString()));
        }
    }
    QString text = titles.join(u',') + u'\n';
    for (int row = 0; row < model.rowCount(); ++row) {
        QStringList fields;
        for (int column = 0; column < columns; ++column) {
            const QModelIndex index = model.index(row, column);
            const QVariant list = index.data(CsvRole);
            if (list.isValid()) {
                for (const QVariant& value : list.toList())
                    fields.append(fieldOf(value));
            } else {
                fields.append(fieldOf(index.data(ValueRole)));
            }
        }
        text += fields.join(u',') + u'\n';
    }
    return text;
}

}  // namespace trapwright::models
