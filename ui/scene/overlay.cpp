#include "ui/scene/overlay.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QGuiApplication>
#include <QImage>
#include <QLocale>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/scene/force_legend.h"
#include "ui/scene/orbit_cube.h"
#include "ui/scene/pose_row.h"
#include "ui/scene/subject.h"
#include "ui/scene/surface_places.h"
#include "ui/scene/theme.h"

namespace trapwright::scene {

namespace {

using base::Vec3;

constexpr double kMargin = 16.0;

QString inMillimetres(double length, int digits) {
    return QLocale().toString(length / base::kMillimetre, 'f', digits);
}

const QSizeF kPadding(6.0, 2.0);  // of labels

QSizeF sizeOf(const QStringList& lines) {
    const QFontMetricsF metrics(QGuiApplication::font());
    double width = 0.0;
    for (const QString& line : lines)
        width = std::max(width, metrics.horizontalAdvance(line));
    return QSizeF(width, metrics.height() * static_cast<double>(lines.size())) + 2.0 * kPadding;
}

/// A rounded field that keeps text readable over anything.
void paintField(QPainter& painter, const QRectF& area, const SceneTheme& theme) {
    QColor field = theme.backgroundTop;
    field.setAlphaF(0.82F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(field);
    painter.drawRoundedRect(area, 4.0, 4.0);
}

OverlayItem makeLabel(const QString& text, const QPointF& centre, const QColor& colour,
                      const SceneTheme& theme) {
    const QSizeF size = sizeOf({text});
    const QRectF area(std::round(centre.x() - 0.5 * size.width()),
                      std::round(centre.y() - 0.5 * size.height()), std::ceil(size.width()),
                      std::ceil(size.height()));
    return {area, [=](QPainter& painter) {
                paintField(painter, area, theme);
                painter.setPen(colour);
                painter.drawText(area, Qt::AlignCenter, text);
            }};
}

/// A heading and a fainter line below it, centred on a place. With a field behind it if it lies on a surface.
OverlayItem makeHeading(const QStringList& lines, const QPointF& centre, bool field,
                        const SceneTheme& theme) {
    const QSizeF size = sizeOf(lines);
    const QRectF area(std::round(centre.x() - 0.5 * size.width()),
                      std::round(centre.y() - 0.5 * size.height()), std::ceil(size.width()),
                      std::ceil(size.height()));
    return {area, [=](QPainter& painter) {
                if (field) paintField(painter, area, theme);
                const double height =
                    (area.height() - 2.0 * kPadding.height()) / static_cast<double>(lines.size());
                for (qsizetype i = 0; i < lines.size(); ++i) {
                    painter.setPen(i == 0 ? theme.text : theme.faintText);
                    painter.drawText(
                        QRectF(area.left(), area.top() + kPadding.height() + height * static_cast<double>(i),
                               area.width(), height),
                        Qt::AlignCenter, lines[i]);
                }
            }};
}

/// The place at which a label lies at the left of the area, where it would cover it.
QPointF moveBeside(const QPointF& centre, const QString& text, const QRectF& area) {
    const QSizeF size = sizeOf({text});
    const QRectF label(centre - QPointF(0.5 * size.width(), 0.5 * size.height()), size);
    if (!label.intersects(area)) return centre;
    return {area.left() - 0.5 * size.width() - 4.0, centre.y()};
}

/// `legend`: where the labels of marks must not lie.
void addTrackLabels(std::vector<OverlayItem>& items, const SceneContents& contents, const Camera& camera,
                    const QSizeF& screen, const QRectF& legend) {
    const track::Track& track = *contents.track;
    const SceneTheme& theme = contents.theme;
    const QFontMetricsF metrics(QGuiApplication::font());
    if (contents.marks.sectionNames) {
        for (const SectionSpan& span : sectionSpans(track, camera)) {
            const auto place = camera.project(span.middle, screen);
            const auto inside = camera.project(span.inside, screen);
            const auto from = camera.project(span.line.front(), screen);
            const auto to = camera.project(span.line.back(), screen);
            if (!place || !inside || !from || !to) continue;
            const QStringList lines = {span.name, inMillimetres(span.length, 0) + QStringLiteral(" mm")};
            // Too short on the screen for its name: rather none than one over the other.
            const double room = std::hypot(to->x() - from->x(), to->y() - from->y());
            if (room < metrics.horizontalAdvance(span.name) + 6.0) continue;
            // Away from the track, as far as the text is large in that direction.
            const QPointF away = *place - *inside;
            const double length = std::max(std::hypot(away.x(), away.y()), 1e-6);
            const QPointF direction = away / length;
            const QSizeF size = sizeOf(lines);
            const double reach =
                0.5 * (std::abs(direction.x()) * size.width() + std::abs(direction.y()) * size.height()) +
                5.0;
            items.push_back(makeHeading(lines, *place + reach * direction, false, theme));
        }
    }
    const auto addMark = [&](const QString& name, const Vec3& place, double above) {
        if (const auto at = camera.project(place, screen))
            items.push_back(
                makeLabel(name, moveBeside(*at - QPointF(0.0, above), name, legend), theme.accent, theme));
    };
    if (contents.marks.startPoint) {
        // Above the part that lies there.
        const double top = contents.parts.empty() ? 0.0 : 1.5 * contents.parts.front().part->boundingRadius;
        addMark(QCoreApplication::translate("scene", "Start"),
                surfacePoint(track, track.start, 0.0) + top * Vec3::UnitZ(), 1.6 * metrics.height());
    }
    if (contents.marks.finishLine) {
        const Vec3 inner = lineAcross(track, track.finish).front();
        const Vec3 outer = lineAcross(track, track.finish).back();
        const bool innerIsFar = inner.dot(camera.forward()) > outer.dot(camera.forward());
        addMark(QCoreApplication::translate("scene", "Finish"), innerIsFar ? inner : outer,
                1.1 * metrics.height());
    }
}

void addPoseLabels(std::vector<OverlayItem>& items, const SceneContents& contents, const Camera& camera,
                   const QSizeF& screen) {
    const PoseRow row = makePoseRow(*contents.stablePoses);
    for (std::size_t i = 0; i < row.labels.size(); ++i) {
        const auto place = camera.project(row.labels[i], screen);
        if (!place) continue;
        const bool given = i < contents.poseShares.size();
        const double percent = 100.0 * (given ? contents.poseShares[i] : row.groups[i].probability);
        const QString share = QLocale().toString(percent, 'f', percent < 9.95 ? 1 : 0) + QStringLiteral(" %");
        const QString name = QString::fromStdString(part::namePoses(row.groups[i].poses)).replace(u'-', u'–');
        items.push_back(makeHeading({name, share}, *place, true, contents.theme));
    }
}

/// A length of 1, 2 or 5 times a power of ten that is at most `longest`. [m]
double roundLength(double longest) {
    const double power = std::pow(10.0, std::floor(std::log10(longest)));
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= longest) return factor * power;
    }
    return power;
}

void addScaleBar(std::vector<OverlayItem>& items, const SceneContents& contents, const Camera& camera,
                 const QSizeF& screen) {
    const double scale = camera.metresPerPixel(screen);
    const double length = roundLength(140.0 * scale);
    const double pixels = length / scale;
    const int digits = length < 0.9e-3 ? static_cast<int>(std::ceil(-std::log10(length / 1e-3))) : 0;
    const QString text = inMillimetres(length, digits) + QStringLiteral(" mm");
    const double height = QFontMetricsF(QGuiApplication::font()).height();
    const QRectF area(kMargin - 2.0, screen.height() - kMargin - height - 8.0, std::max(pixels, 60.0) + 4.0,
                      height + 10.0);
    const SceneTheme theme = contents.theme;
    items.push_back({area, [=](QPainter& painter) {
                         const double left = kMargin;
                         const double bottom = std::round(area.bottom()) - 3.5;
                         painter.setPen(QPen(theme.text, 1.0));
                         painter.drawPolyline(
                             QPolygonF({QPointF(left + 0.5, bottom - 5.0), QPointF(left + 0.5, bottom),
                                        QPointF(left + std::round(pixels) + 0.5, bottom),
                                        QPointF(left + std::round(pixels) + 0.5, bottom - 5.0)}));
                         painter.drawText(QRectF(left, area.top(), std::max(pixels, 60.0), height),
                                          pixels < 60.0 ? Qt::AlignLeft : Qt::AlignHCenter, text);
                     }});
}

void addHeightLegend(std::vector<OverlayItem>& items, const SceneContents& contents, const QSizeF& screen) {
    const HeightRange range = heightRangeOf(contents);
    const QFontMetricsF metrics(QGuiApplication::font());
    const double barHeight = std::clamp(0.28 * screen.height(), 90.0, 220.0);
    const double barWidth = 14.0;
    const double title = metrics.height() + 6.0;
    const QString heading = QCoreApplication::translate("scene", "Height [mm]");
    const double numbers = barWidth + 12.0 + metrics.horizontalAdvance(QStringLiteral("-88.8"));
    const double boxWidth = std::max(numbers, metrics.horizontalAdvance(heading)) + 4.0;
    const QRectF area(std::floor(screen.width() - kMargin - boxWidth),
                      std::floor(screen.height() - kMargin - barHeight - title - 6.0), std::ceil(boxWidth),
                      std::ceil(barHeight + title + 8.0));
    const SceneTheme theme = contents.theme;
    items.push_back({area, [=](QPainter& painter) {
                         painter.setPen(theme.text);
                         painter.drawText(area.topLeft() + QPointF(0.0, metrics.ascent()), heading);
                         const QRectF bar(area.left(), area.top() + title, barWidth, barHeight);
                         QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
                         for (std::size_t i = 0; i < kHeightColours.size(); ++i)
                             gradient.setColorAt(static_cast<double>(i) / (kHeightColours.size() - 1),
                                                 QColor(kHeightColours[i]));
                         painter.setBrush(gradient);
                         painter.setPen(Qt::NoPen);
                         painter.drawRect(bar);
                         const double span = range.high - range.low;
                         const double step = roundLength(span / 2.5);
                         const auto first = static_cast<int>(std::ceil(range.low / step - 1e-6));
                         const auto last = static_cast<int>(std::floor(range.high / step + 1e-6));
                         for (int i = first; i <= last; ++i) {
                             const double z = i * step;
                             const double y =
                                 std::round(bar.bottom() - (z - range.low) / span * barHeight) + 0.5;
                             painter.setPen(QPen(theme.text, 1.0));
                             painter.drawLine(QPointF(bar.right(), y), QPointF(bar.right() + 5.0, y));
                             const QString text = inMillimetres(z, step < 0.9e-3 ? 1 : 0);
                             painter.drawText(QPointF(bar.right() + 9.0, y + 0.36 * metrics.ascent()), text);
                         }
                     }});
}

}  // namespace

std::vector<OverlayItem> overlayOf(const SceneContents& contents, const Camera& camera, const QSizeF& screen,
                                   std::optional<StandardView> hovered) {
    std::vector<OverlayItem> items;
    if (isEmpty(contents)) return items;
    if (isShadedByHeight(contents)) addHeightLegend(items, contents, screen);
    const QRectF legend = items.empty() ? QRectF() : items.front().area;
    if (contents.track) addTrackLabels(items, contents, camera, screen, legend);
    if (contents.stablePoses) addPoseLabels(items, contents, camera, screen);
    addScaleBar(items, contents, camera, screen);
    if (!contents.parts.empty() && contents.forceLegend)
        items.push_back(makeForceLegend(contents, camera, screen));
    items.push_back({orbitCubeArea(screen), [=, theme = contents.theme](QPainter& painter) {
                         paintOrbitCube(painter, camera, theme, screen, hovered);
                     }});
    return items;
}

void paintOverlay(QPainter& painter, const std::vector<OverlayItem>& items) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(QGuiApplication::font());
    for (const OverlayItem& item : items)
        item.paint(painter);
}

}  // namespace trapwright::scene
