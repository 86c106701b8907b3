#pragma once

#include <QAbstractItemModel>
#include <QString>

namespace trapwright::models {

/// A table as CSV (RFC 4180, lines end with \n): the headings, then each row in the model's order, numbers in
/// full with a point as decimal sign.
QString toCsv(const QAbstractItemModel& model);

}  // namespace trapwright::models
