#include "ui/scene/orbit_cube.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>

namespace trapwright::scene {

namespace {

using base::Vec3;

constexpr double kSize = 136.0;     // of the area on a large screen
constexpr double kShare = 0.38;     // of a small one
constexpr double kSmallest = 0.65;  // of its size
constexpr double kMargin = 4.0;     // to the screen's corner
constexpr QPointF kCentre(0.5 * kSize, 0.5 * kSize);
constexpr double kHalfEdge = 27.0;

struct Face {
    StandardView view;
    Vec3 normal;
    Vec3 right;  // of its label
    const char* label;
};

const std::array<Face, 6>& faces() {
    static const std::array<Face, 6> kFaces = {{
        {StandardView::top, {0, 0, 1}, {1, 0, 0}, QT_TRANSLATE_NOOP("scene", "Top")},
        {StandardView::bottom, {0, 0, -1}, {1, 0, 0}, QT_TRANSLATE_NOOP("scene", "Bottom")},
        {StandardView::front, {0, -1, 0}, {1, 0, 0}, QT_TRANSLATE_NOOP("scene", "Front")},
        {StandardView::back, {0, 1, 0}, {-1, 0, 0}, QT_TRANSLATE_NOOP("scene", "Back")},
        {StandardView::left, {-1, 0, 0}, {0, -1, 0}, QT_TRANSLATE_NOOP("scene", "Left")},
        {StandardView::right, {1, 0, 0}, {0, 1, 0}, QT_TRANSLATE_NOOP("scene", "Right")},
    }};
    return kFaces;
}

QPointF onScreen(const Camera& camera, const QPointF& centre, const Vec3& point) {
    return centre + kHalfEdge * QPointF(point.dot(camera.right()), -point.dot(camera.up()));
}

QPolygonF cornersOf(const Face& face, const Camera& camera, const QPointF& centre) {
    const Vec3 up = face.normal.cross(face.right);
    QPolygonF corners;
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        corners << onScreen(camera, centre, face.normal + a * face.right + b * up);
    return corners;
}

bool isSeen(const Face& face, const Camera& camera) {
    return face.normal.dot(camera.forward()) < -1e-6;
}

QColor mixed(const QColor& from, const QColor& to, double share) {
    const auto mix = [share](float a, float b) { return static_cast<float>(a + share * (b - a)); };
    return QColor::fromRgbF(mix(from.redF(), to.redF()), mix(from.greenF(), to.greenF()),
                            mix(from.blueF(), to.blueF()));
}

/// The label lies in the face, as if printed on it.
void paintLabel(QPainter& painter, const Face& face, const Camera& camera, const QPointF& centre) {
    const Vec3 up = face.normal.cross(face.right);
    const QPointF middle = onScreen(camera, centre, face.normal);
    const QPointF right = onScreen(camera, centre, face.normal + face.right) - middle;
    const QPointF above = onScreen(camera, centre, face.normal + up) - middle;
    if (std::abs(right.x() * above.y() - right.y() * above.x()) < 0.12 * kHalfEdge * kHalfEdge) return;
    painter.save();
    painter.setTransform(QTransform(right.x() / kHalfEdge, right.y() / kHalfEdge, -above.x() / kHalfEdge,
                                    -above.y() / kHalfEdge, middle.x(), middle.y()),
                         true);
    const double room = 2.0 * kHalfEdge;
    painter.drawText(QRectF(-0.5 * room, -0.5 * room, room, room), Qt::AlignCenter,
                     QCoreApplication::translate("scene", face.label));
    painter.restore();
}

void paintAxes(QPainter& painter, const Camera& camera, const SceneTheme& theme, const QPointF& centre) {
    const std::array<std::pair<Vec3, QColor>, 3> axes = {{{Vec3::UnitX(), QColor(0xd55e00)},
                                                          {Vec3::UnitY(), QColor(0x009e73)},
                                                          {Vec3::UnitZ(), QColor(0x0072b2)}}};
    const Vec3 origin(-1.0, -1.0, -1.0);
    constexpr std::array<char, 3> kNames = {'x', 'y', 'z'};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const auto& [axis, colour] = axes[i];
        const QPointF from = onScreen(camera, centre, 1.12 * origin);
        const QPointF to = onScreen(camera, centre, 1.12 * origin + 2.5 * axis);
        painter.setPen(QPen(theme.backgroundTop.lightness() < 128 ? colour.lighter(150) : colour, 2.0,
                            Qt::SolidLine, Qt::RoundCap));
        if (std::hypot(to.x() - from.x(), to.y() - from.y()) < 8.0) continue;
        painter.drawLine(from, to);
        const QPointF beyond = onScreen(camera, centre, 1.12 * origin + 2.85 * axis);
        painter.drawText(QRectF(beyond.x() - 8, beyond.y() - 8, 16, 16), Qt::AlignCenter,
                         QString(QLatin1Char(kNames[i])));
    }
}

/// All else is laid out in an area of kSize.
double scaleOn(const QSizeF& screen) {
    return std::clamp(kShare * std::min(screen.width(), screen.height()) / kSize, kSmallest, 1.0);
}

}  // namespace

QRectF orbitCubeArea(const QSizeF& screen) {
    const double size = kSize * scaleOn(screen);
    return {screen.width() - size - kMargin, kMargin, size, size};
}

std::optional<StandardView> orbitCubeFaceAt(const Camera& camera, const QSizeF& screen,
                                            const QPointF& place) {
    const QPointF inside = (place - orbitCubeArea(screen).topLeft()) / scaleOn(screen);
    for (const Face& face : faces()) {
        if (isSeen(face, camera) && cornersOf(face, camera, kCentre).containsPoint(inside, Qt::WindingFill))
            return face.view;
    }
    return std::nullopt;
}

void paintOrbitCube(QPainter& painter, const Camera& camera, const SceneTheme& theme, const QSizeF& screen,
                    std::optional<StandardView> hovered) {
    painter.save();
    painter.translate(orbitCubeArea(screen).topLeft());
    painter.scale(scaleOn(screen), scaleOn(screen));
    painter.setRenderHint(QPainter::Antialiasing);
    QFont font = painter.font();
    font.setPixelSize(13);
    font.setWeight(QFont::DemiBold);
    painter.setFont(font);
    const bool fromBelow = camera.elevation < 0.0;
    if (!fromBelow) paintAxes(painter, camera, theme, kCentre);
    for (const Face& face : faces()) {
        if (!isSeen(face, camera)) continue;
        const double facing = -face.normal.dot(camera.forward());
        QColor fill = mixed(theme.side, theme.backgroundTop, 0.35 + 0.35 * facing);
        if (hovered == face.view) fill = mixed(fill, theme.accent, 0.45);
        painter.setBrush(fill);
        painter.setPen(
            QPen(mixed(theme.side, theme.text, 0.25), 1.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter.drawPolygon(cornersOf(face, camera, kCentre));
        painter.setPen(theme.text);
        font.setPixelSize(face.view == StandardView::bottom ? 12 : 13);
        painter.setFont(font);
        paintLabel(painter, face, camera, kCentre);
    }
    if (fromBelow) paintAxes(painter, camera, theme, kCentre);
    painter.restore();
}

}  // namespace trapwright::scene
