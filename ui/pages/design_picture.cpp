#include "ui/pages/design_picture.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>

#include "ui/look/text.h"

namespace trapwright::pages {

namespace {

constexpr double kLine = 12.0;
constexpr double kMostHeight = 120.0;  // of all lines

QColor mixed(const QColor& from, const QColor& to, double share) {
    const auto mix = [share](int a, int b) { return static_cast<int>(a + share * (b - a)); };
    return {mix(from.red(), to.red()), mix(from.green(), to.green()), mix(from.blue(), to.blue())};
}

}  // namespace

DesignPicture::DesignPicture(QWidget* parent) : QWidget(parent) {
    setObjectName("evolve.design");
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Design"));
}

void DesignPicture::show(const search::Design& design, const search::DesignSpace& space) {
    design_ = design;
    dimensions_ = space.dimensions;
    lines_ = 1;
    for (const search::Dimension& dimension : dimensions_)
        lines_ = std::max(lines_, dimension.line + 1);
    setAccessibleDescription(tr("%1 numbers in %2 lines").arg(dimensions_.size()).arg(lines_));
    updateGeometry();
    update();
}

double DesignPicture::lineHeight() const {
    return std::min(kLine, kMostHeight / lines_);
}

QSize DesignPicture::sizeHint() const {
    return {240, static_cast<int>(lines_ * lineHeight())};
}

QSize DesignPicture::minimumSizeHint() const {
    return {80, sizeHint().height()};
}

std::vector<DesignPicture::Cell> DesignPicture::cells() const {
    std::vector<Cell> cells;
    if (design_.size() != dimensions_.size()) return cells;
    std::vector<int> counts(static_cast<std::size_t>(lines_), 0);
    for (const search::Dimension& dimension : dimensions_)
        ++counts[static_cast<std::size_t>(dimension.line)];
    std::vector<int> next(counts.size(), 0);
    for (std::size_t i = 0; i < dimensions_.size(); ++i) {
        const search::Dimension& dimension = dimensions_[i];
        const auto line = static_cast<std::size_t>(dimension.line);
        const double each = static_cast<double>(width()) / counts[line];
        const double physical = dimension.low + design_[i] * (dimension.high - dimension.low);
        cells.push_back({QRectF(next[line]++ * each, dimension.line * lineHeight(), each, lineHeight()),
                         design_[i],
                         tr("%1: %2 %3")
                             .arg(QString::fromStdString(dimension.key), look::numberText(physical),
                                  QString::fromStdString(dimension.unit))});
    }
    return cells;
}

bool DesignPicture::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QString text =
            tr("The numbers of the design, the larger the darker: a line for each cross-section, then "
               "the others");
        for (const Cell& cell : cells())
            if (cell.area.contains(help->pos())) text = cell.text;
        QToolTip::showText(help->globalPos(), text, this);
        return true;
    }
    return QWidget::event(event);
}

void DesignPicture::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const QColor light = palette().color(QPalette::Midlight);
    const QColor dark = palette().color(QPalette::Highlight);
    for (const Cell& cell : cells()) {
        const double gap = cell.area.height() > 4.0 ? 1.0 : 0.0;
        painter.fillRect(cell.area.adjusted(0.0, 0.0, cell.area.width() > 4.0 ? -1.0 : 0.0, -gap),
                         mixed(light, dark, cell.value));
    }
}

}  // namespace trapwright::pages
