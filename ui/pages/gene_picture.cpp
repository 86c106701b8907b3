#include "ui/pages/gene_picture.h"

#include <QPainter>
#include <algorithm>
#include <span>

namespace trapwright::pages {

namespace {

constexpr int kMostHeight = 60;  // of gene 1
constexpr int kLine = 6;
constexpr int kGap = 4;

void paintBits(QPainter& painter, const QRectF& area, std::span<const std::uint8_t> bits) {
    const double width = area.width() / static_cast<double>(bits.size());
    for (std::size_t i = 0; i < bits.size(); ++i) {
        if (bits[i] == 0) continue;
        const double left = area.left() + static_cast<double>(i) * width;
        painter.fillRect(QRectF(left, area.top(), width, area.height()), painter.brush());
    }
}

}  // namespace

GenePicture::GenePicture(QWidget* parent) : QWidget(parent) {
    setObjectName("evolve.genes");
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setToolTip(tr(
        "The genes, dark where a bit is 1: a line for each cross-section, then the segments' lengths, then "
        "the strategy values"));
}

void GenePicture::show(const evolution::Chromosome& chromosome, int sections) {
    chromosome_ = chromosome;
    sections_ = std::max(sections, 1);
    setAccessibleName(tr("Genes"));
    setAccessibleDescription(tr("%1 bits of points, %2 of lengths, %3 of strategy values")
                                 .arg(chromosome.points.size())
                                 .arg(chromosome.lengths.size())
                                 .arg(chromosome.strategy.size()));
    updateGeometry();
    update();
}

int GenePicture::pointsHeight() const {
    return std::min(sections_ * kLine, kMostHeight);
}

QSize GenePicture::sizeHint() const {
    return {240, pointsHeight() + 2 * (kGap + kLine)};
}

QSize GenePicture::minimumSizeHint() const {
    return {80, sizeHint().height()};
}

void GenePicture::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto sections = static_cast<std::size_t>(sections_);
    const std::span<const std::uint8_t> points(chromosome_.points);
    const std::size_t each = points.size() / sections;
    const double line = static_cast<double>(pointsHeight()) / sections_;
    const auto paintGene = [&](double top, double height, std::span<const std::uint8_t> bits) {
        if (bits.empty()) return;
        const QRectF area(0.0, top, width(), height);
        painter.fillRect(area, palette().color(QPalette::Midlight));
        painter.setBrush(palette().color(QPalette::WindowText));
        paintBits(painter, area, bits);
    };
    for (std::size_t i = 0; i < sections; ++i)
        paintGene(static_cast<double>(i) * line, line - (line > 3.0 ? 1.0 : 0.0),
                  points.subspan(i * each, each));
    paintGene(pointsHeight() + kGap, kLine, chromosome_.lengths);
    paintGene(pointsHeight() + 2 * kGap + kLine, kLine, chromosome_.strategy);
}

}  // namespace trapwright::pages
