#include "ui/charts/sheet.h"

#include <map>

#include "ui/look/text.h"

namespace trapwright::charts {

using look::csvField;
using look::csvNumber;

QString toCsv(const ChartSheet& sheet) {
    QStringList heading{csvField(sheet.xColumn)};
    std::map<double, std::map<qsizetype, double>> lines;  // x -> column -> y
    qsizetype column = 0;
    for (const PlotSheet& plot : sheet.plots) {
        for (const Curve& curve : plot.curves) {
            heading.append(csvField(curve.column));
            for (const QPointF& point : curve.points)
                lines[point.x()][column] = point.y();
            ++column;
            if (curve.bandColumns.isEmpty()) continue;
            for (const QString& title : curve.bandColumns)
                heading.append(csvField(title));
            for (std::size_t i = 0; i < curve.band.size(); ++i) {
                lines[curve.points[i].x()][column] = curve.band[i].low;
                lines[curve.points[i].x()][column + 1] = curve.band[i].high;
            }
            column += curve.bandColumns.size();
        }
    }
    // A level has the same value everywhere.
    column = 0;
    for (const PlotSheet& plot : sheet.plots) {
        for (const Curve& curve : plot.curves) {
            if (curve.level) {
                for (auto& [x, fields] : lines)
                    fields[column] = *curve.level;
            }
            column += 1 + curve.bandColumns.size();
        }
    }
    QString text = heading.join(u',') + u'\n';
    for (const auto& [x, fields] : lines) {
        text += csvNumber(x);
        for (qsizetype i = 0; i < column; ++i) {
            text += u',';
            if (const auto found = fields.find(i); found != fields.end()) text += csvNumber(found->second);
        }
        text += u'\n';
    }
    return text;
}

}  // namespace trapwright::charts
