#include "ui/scene/picture_maker.h"

#include <QImage>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"
#include "ui/scene/pose_row.h"
#include "ui/scene/subject.h"

namespace trapwright::scene {

namespace {

/// How the operator sees a part that leaves the track. He stands where a hand reaches the track: beside a
/// linear feeder on its inner side, from where parts go to the right, or outside a bowl.
struct ExitView {
    Camera camera;
    std::array<base::Vec3, 7> arrow;  // outline of the conveying arrow beside the part, in the room [m]
};

/// From as low as home, higher where the track would hide more of the part. `size` is logical.
ExitView makeExitView(const track::Track& track, const part::Part& part, const base::Pose& pose, QSizeF size);

/// Over a picture of this view.
void paintArrow(QImage& picture, const ExitView& view, const SceneTheme& theme);

constexpr double kMargin = 0.06;  // a share of the picture on every side

using base::Vec3;

constexpr double kAhead = 26.0 * base::kDegree;  // of the eye, in conveying direction, from straight beside
constexpr std::array kElevations = {38.0 * base::kDegree, 50.0 * base::kDegree, 62.0 * base::kDegree,
                                    75.0 * base::kDegree};
constexpr double kNearlyAll = 0.9;    // of what can be seen at best
constexpr double kExitMargin = 0.04;  // a share of the picture on every side
// In radii of the part.
constexpr double kAround = 0.1;
constexpr double kReach = 10.0;  // of what can hide the part
constexpr double kArrowAside = 1.45;
constexpr double kArrowHalf = 1.1;   // length
constexpr double kArrowNeck = 0.35;  // from the middle
constexpr double kShaft = 0.11;
constexpr double kHead = 0.3;

Vec3 operatorsSide(const track::Track& track, const Vec3& place) {
    if (track.shape.type == track::FeederType::linear) return -Vec3::UnitY();
    return Vec3(place.x(), place.y(), 0.0).normalized();
}

/// Whether a triangle is between the two points.
bool isBetween(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& to) {
    // Moeller and Trumbore (1997)
    const Vec3 way = to - from;
    const Vec3 edge1 = b - a;
    const Vec3 edge2 = c - a;
    const Vec3 p = way.cross(edge2);
    const double determinant = edge1.dot(p);
    if (std::abs(determinant) < 1e-18) return false;
    const Vec3 t = from - a;
    const double u = t.dot(p) / determinant;
    if (u < 0.0 || u > 1.0) return false;
    const Vec3 q = t.cross(edge1);
    const double v = way.dot(q) / determinant;
    if (v < 0.0 || u + v > 1.0) return false;
    const double at = edge2.dot(q) / determinant;
    return at > 1e-6 && at < 1.0;
}

/// The triangles of the track that can hide something at this place.
std::vector<std::array<Vec3, 3>> trianglesNear(const track::Track& track, const Vec3& place, double reach) {
    std::vector<std::array<Vec3, 3>> near;
    for (const geometry::Triangle& triangle : track.solid.triangles) {
        std::array<Vec3, 3> corners;
        for (std::size_t i = 0; i < corners.size(); ++i)
            corners[i] = track.solid.vertices[static_cast<std::size_t>(triangle[i])];
        if (std::any_of(corners.begin(), corners.end(),
                        [&](const Vec3& corner) { return (corner - place).norm() < reach; }))
            near.push_back(corners);
    }
    return near;
}

/// The share of these corners that no triangle hides.
double shareSeen(const std::vector<std::array<Vec3, 3>>& triangles, const std::vector<Vec3>& corners,
                 const Vec3& eye) {
    const auto seen = std::count_if(corners.begin(), corners.end(), [&](const Vec3& corner) {
        return std::none_of(triangles.begin(), triangles.end(), [&](const std::array<Vec3, 3>& triangle) {
            return isBetween(triangle[0], triangle[1], triangle[2], corner, eye);
        });
    });
    return static_cast<double>(seen) / static_cast<double>(std::max<std::size_t>(corners.size(), 1));
}

/// Some of the hull's corners, a little inside it: those that touch the track are not hidden by that.
std::vector<Vec3> cornersOf(const part::Part& part, const base::Pose& pose) {
    constexpr std::size_t kMost = 24;
    constexpr double kInside = 0.9;
    std::vector<Vec3> corners;
    const std::vector<Vec3>& vertices = part.hull.vertices;
    const std::size_t step = std::max<std::size_t>(1, vertices.size() / kMost);
    for (std::size_t i = 0; i < vertices.size(); i += step)
        corners.push_back(pose.apply(kInside * vertices[i]));
    return corners;
}

ExitView makeExitView(const track::Track& track, const part::Part& part, const base::Pose& pose,
                      QSizeF size) {
    const double radius = part.boundingRadius;
    const Vec3 ahead = track.shape.tangentFrame(track.finish).col(0);
    const Vec3 side = operatorsSide(track, pose.position);
    const Vec3 towards = std::cos(kAhead) * side + std::sin(kAhead) * ahead;

    geometry::Box box = boxOf(part, pose);
    ExitView view;
    const Vec3 middle(pose.position.x() + kArrowAside * radius * side.x(),
                      pose.position.y() + kArrowAside * radius * side.y(), box.low.z());
    const auto arrowPoint = [&](double along, double across) {
        return Vec3(middle + radius * along * ahead + radius * across * side);
    };
    view.arrow = {arrowPoint(-kArrowHalf, kShaft), arrowPoint(kArrowNeck, kShaft),
                  arrowPoint(kArrowNeck, kHead),   arrowPoint(kArrowHalf, 0.0),
                  arrowPoint(kArrowNeck, -kHead),  arrowPoint(kArrowNeck, -kShaft),
                  arrowPoint(-kArrowHalf, -kShaft)};
    box.low -= Vec3::Constant(kAround * radius);
    box.high += Vec3::Constant(kAround * radius);
    for (const Vec3& point : view.arrow)
        box.include(point);

    if (track.shape.type == track::FeederType::linear) view.camera.tilt = track.shape.slope;
    view.camera.azimuth = std::atan2(towards.y(), towards.x());
    const std::vector<Vec3> corners = cornersOf(part, pose);
    const auto triangles = trianglesNear(track, pose.position, std::max(kReach * radius, track.width));
    double best = 0.0;
    std::array<double, kElevations.size()> seen{};
    std::array<Camera, kElevations.size()> cameras;
    for (std::size_t i = 0; i < kElevations.size(); ++i) {
        cameras[i] = view.camera;
        cameras[i].elevation = kElevations[i];
        cameras[i] = fitted(cameras[i], box, size, kExitMargin);
        seen[i] = shareSeen(triangles, corners, cameras[i].eye());
        best = std::max(best, seen[i]);
    }
    std::size_t chosen = 0;
    while (seen[chosen] < kNearlyAll * best)
        ++chosen;
    view.camera = cameras[chosen];
    return view;
}

void paintArrow(QImage& picture, const ExitView& view, const SceneTheme& theme) {
    const QSizeF size = picture.deviceIndependentSize();
    QPolygonF outline;
    for (const Vec3& point : view.arrow)
        if (const auto place = view.camera.project(point, size)) outline << *place;
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(theme.backgroundTop, 1.5));
    painter.setBrush(theme.accent);
    painter.drawPolygon(outline);
}

}  // namespace

QFuture<QImage> PictureMaker::trackPicture(std::shared_ptr<const track::Track> track, QSize size,
                                           double pixelRatio) {
    auto contents = std::make_shared<SceneContents>();
    contents->track = std::move(track);
    return draw(std::move(contents), size, pixelRatio);
}

QFuture<QImage> PictureMaker::partPicture(std::shared_ptr<const part::Part> part,
                                          const base::Quaternion& rotation, QSize size, double pixelRatio) {
    auto contents = std::make_shared<SceneContents>();
    contents->parts = {{std::move(part), {rotation, base::Vec3::Zero()}}};
    return draw(std::move(contents), size, pixelRatio);
}

QFuture<QImage> PictureMaker::exitPicture(std::shared_ptr<const track::Track> track,
                                          std::shared_ptr<const part::Part> part, const base::Pose& pose,
                                          QSize size, double pixelRatio) {
    const ExitView view = makeExitView(*track, *part, pose, size);
    auto contents = std::make_shared<SceneContents>();
    contents->theme = theme_;
    contents->marks = TrackMarks::none();
    contents->marks.finishLine = true;
    contents->track = std::move(track);
    contents->parts = {{std::move(part), pose}};
    return renderer_.render({std::move(contents), view.camera, size * pixelRatio, pixelRatio})
        .then([view, theme = theme_](const Rendering& made) {
            QImage image = made.image;
            if (!image.isNull()) paintArrow(image, view, theme);
            return image;
        });
}

QFuture<QImage> PictureMaker::draw(std::shared_ptr<SceneContents> contents, QSize size, double pixelRatio) {
    contents->theme = theme_;
    contents->marks = TrackMarks::none();
    const Camera camera = fitted(homeCamera(*contents), boxOf(*contents), size, kMargin);
    return renderer_.render({std::move(contents), camera, size * pixelRatio, pixelRatio})
        .then([](const Rendering& made) { return made.image; });
}

}  // namespace trapwright::scene
