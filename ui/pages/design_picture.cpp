#include "ui/pages/design_picture.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>

#include "ui/look/text.h"

namespace trapwright::pages {

namespace {

constexpr double kLine = 12.0;
constexpr double kMostHeight = 96.0;  // of the lines of points
constexpr double kGap = 4.0;

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

void DesignPicture::show(const search::Design& design, const search::DesignSpace& space, int sections) {
    design_ = design;
    dimensions_ = space.dimensions;
    sections_ = std::max(sections, 1);
    const auto ofPoints = std::count_if(dimensions_.begin(), dimensions_.end(),
                                        [](const search::Dimension& dimension) { return dimension.ofPoint; });
    setAccessibleDescription(tr("%1 numbers of points, %2 others")
                                 .arg(ofPoints)
                                 .arg(static_cast<qsizetype>(dimensions_.size()) - ofPoints));
    updateGeometry();
    update();
}

double DesignPicture::lineHeight() const {
    return std::min(kLine, kMostHeight / sections_);
}

QSize DesignPicture::sizeHint() const {
    return {240, static_cast<int>(sections_ * lineHeight() + kGap + kLine)};
}

QSize DesignPicture::minimumSizeHint() const {
    return {80, sizeHint().height()};
}

std::vector<DesignPicture::Cell> DesignPicture::cells() const {
    std::vector<Cell> cells;
    if (design_.size() != dimensions_.size()) return cells;
    const auto ofPoints =
        static_cast<int>(std::count_if(dimensions_.begin(), dimensions_.end(),
                                       [](const search::Dimension& dimension) { return dimension.ofPoint; }));
    const int perLine = std::max(1, (ofPoints + sections_ - 1) / sections_);
    const int others = static_cast<int>(dimensions_.size()) - ofPoints;
    int point = 0;
    int other = 0;
    for (std::size_t i = 0; i < dimensions_.size(); ++i) {
        const search::Dimension& dimension = dimensions_[i];
        const int column = dimension.ofPoint ? point % perLine : other;
        const double each = static_cast<double>(width()) / (dimension.ofPoint ? perLine : others);
        const double top =
            dimension.ofPoint ? (point / perLine) * lineHeight() : sections_ * lineHeight() + kGap;
        const double physical = dimension.low + design_[i] * (dimension.high - dimension.low);
        cells.push_back({QRectF(column * each, top, each, (dimension.ofPoint ? lineHeight() : kLine)),
                         design_[i],
                         tr("%1: %2 %3")
                             .arg(QString::fromStdString(dimension.key), look::numberText(physical),
                                  QString::fromStdString(dimension.unit))});
        ++(dimension.ofPoint ? point : other);
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
