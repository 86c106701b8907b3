#pragma once

#include <QAbstractTableModel>
#include <QString>
#include <QVariant>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "ui/models/roles.h"

namespace trapwright::models {

/// A column of a table of records.
template <class Row>
struct Column {
    QString title;  // with the unit
    QString help;   // one sentence, the heading's tool tip
    std::function<QVariant(const Row&)> value;
    std::function<QString(const Row&)> text;
    // What it holds in CSV, where that is not the title and the value.
    QStringList (*csvTitles)() = nullptr;
    QVariantList (*csvValues)(const Row&) = nullptr;
};

/// A read-only table of immutable records, a row each. Numbers are right-aligned; ValueRole has them in full.
template <class Row>
class RecordModel : public QAbstractTableModel {
 public:
    RecordModel(std::vector<Column<Row>> columns, QObject* parent)
        : QAbstractTableModel(parent), columns_(std::move(columns)) {}

    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : static_cast<int>(rows_.size());
    }
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : static_cast<int>(columns_.size());
    }

    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override {
        if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
        const Row& row = rowAt(index);
        const Column<Row>& column = columns_[static_cast<std::size_t>(index.column())];
        switch (role) {
            case Qt::DisplayRole:
                return column.text(row);
            case ValueRole:
                return column.value(row);
            case Qt::TextAlignmentRole:
                return alignmentOf(column.value(row));
            case CsvRole:
                return column.csvValues != nullptr ? column.csvValues(row) : QVariantList{column.value(row)};
            default:
                return more(row, index.column(), role);
        }
    }

    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                      int role = Qt::DisplayRole) const override {
        if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
        const Column<Row>& column = columns_[static_cast<std::size_t>(section)];
        if (role == Qt::DisplayRole) return column.title;
        if (role == Qt::ToolTipRole) return column.help;
        if (role == CsvRole)
            return column.csvTitles != nullptr ? column.csvTitles() : QStringList{column.title};
        return {};
    }

 protected:
    /// What else there is to tell of a row; nothing for roles that are not known.
    [[nodiscard]] virtual QVariant more(const Row& row, int column, int role) const = 0;

    [[nodiscard]] const Row& rowAt(const QModelIndex& index) const {
        return rows_[static_cast<std::size_t>(index.row())];
    }

    void reset(std::vector<Row> rows) {
        beginResetModel();
        rows_ = std::move(rows);
        endResetModel();
    }

    /// With other columns.
    void reset(std::vector<Row> rows, std::vector<Column<Row>> columns) {
        beginResetModel();
        rows_ = std::move(rows);
        columns_ = std::move(columns);
        endResetModel();
    }

    void appendRow(Row row) {
        const int at = rowCount();
        beginInsertRows({}, at, at);
        rows_.push_back(std::move(row));
        endInsertRows();
    }

    void replaceRow(int at, Row row) {
        rows_[static_cast<std::size_t>(at)] = std::move(row);
        emit dataChanged(index(at, 0), index(at, columnCount() - 1));
    }

 private:
    static QVariant alignmentOf(const QVariant& value) {
        const bool isText = value.typeId() == QMetaType::QString;
        return static_cast<int>((isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }

    std::vector<Column<Row>> columns_;
    std::vector<Row> rows_;
};

}  // namespace trapwright::models
