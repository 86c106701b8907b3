#include "ui/scene/light_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "ui/scene/surface_places.h"

namespace trapwright::scene {

namespace {

using base::Vec2;
using base::Vec3;

constexpr double kTexel = 0.7e-3;  // [m]
constexpr int kMostColumns = 768;
constexpr int kDirections = 12;
constexpr float kNothing = -1e3F;   // height where there is no surface [mm]
constexpr float kPenumbra = 0.35F;  // in tangents of the light's elevation
// Distances at which the horizon is looked for, in texels.
constexpr std::array<double, 11> kReach = {1.0, 2.0, 3.0, 4.5, 6.5, 9.0, 12.5, 17.0, 23.0, 31.0, 42.0};

/// Heights in millimetres on the map's grid.
class HeightGrid {
 public:
    explicit HeightGrid(const track::Track& track)
        : begin_(track.begin()),
          low_(-0.5 * track.width),
          length_(track.end() - track.begin()),
          width_(track.width) {
        columns = std::clamp(static_cast<int>(length_ / kTexel), 16, kMostColumns);
        rows = std::clamp(static_cast<int>(width_ / kTexel), 16, 192);
        heights_.assign(static_cast<std::size_t>(columns) * rows, kNothing);
        const std::vector<Vec3> places = surfaceInTrackCoordinates(track);
        for (std::size_t i = 0; i < track.surfaceTriangles; ++i) {
            const auto& triangle = track.solid.triangles[i];
            draw(places[triangle[0]], places[triangle[1]], places[triangle[2]]);
        }
    }

    [[nodiscard]] float at(int column, int row) const {
        if (column < 0 || row < 0 || column >= columns || row >= rows) return kNothing;
        return heights_[static_cast<std::size_t>(row) * columns + column];
    }
    [[nodiscard]] float texel() const { return static_cast<float>(length_ / columns * 1e3); }  // [mm]
    [[nodiscard]] double xOf(int column) const { return begin_ + (column + 0.5) * length_ / columns; }

    int columns = 0;
    int rows = 0;

 private:
    [[nodiscard]] Vec3 toGrid(const Vec3& place) const {
        return {(place.x() - begin_) / length_ * columns - 0.5, (place.y() - low_) / width_ * rows - 0.5,
                place.z() * 1e3};
    }

    void draw(const Vec3& first, const Vec3& second, const Vec3& third) {
        const Vec3 a = toGrid(first);
        const Vec3 b = toGrid(second);
        const Vec3 c = toGrid(third);
        const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
        if (std::abs(area) < 1e-9) return;
        constexpr double kOver = 1e-6;
        const int left = std::max(0, static_cast<int>(std::ceil(std::min({a.x(), b.x(), c.x()}) - kOver)));
        const int right =
            std::min(columns - 1, static_cast<int>(std::floor(std::max({a.x(), b.x(), c.x()}) + kOver)));
        const int bottom = std::max(0, static_cast<int>(std::ceil(std::min({a.y(), b.y(), c.y()}) - kOver)));
        const int top =
            std::min(rows - 1, static_cast<int>(std::floor(std::max({a.y(), b.y(), c.y()}) + kOver)));
        for (int row = bottom; row <= top; ++row) {
            for (int column = left; column <= right; ++column) {
                const double u =
                    ((column - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (row - a.y())) / area;
                const double v =
                    ((b.x() - a.x()) * (row - a.y()) - (column - a.x()) * (b.y() - a.y())) / area;
                if (u < -kOver || v < -kOver || u + v > 1.0 + kOver) continue;
                float& height = heights_[static_cast<std::size_t>(row) * columns + column];
                height =
                    std::max(height, static_cast<float>(a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z())));
            }
        }
    }

    double begin_;
    double low_;
    double length_;
    double width_;
    std::vector<float> heights_;
};

/// Where the horizon is looked for in one direction: texels near the distances, and how far they really are.
struct Look {
    int columns = 0;
    int rows = 0;
    float distance = 0.0F;  // [mm]
};
using Looks = std::array<Look, kReach.size()>;

Looks makeLooks(const Vec2& direction, float texel) {
    Looks looks;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        looks[i].columns = static_cast<int>(std::lround(kReach[i] * direction.x()));
        looks[i].rows = static_cast<int>(std::lround(kReach[i] * direction.y()));
        looks[i].distance = texel * static_cast<float>(std::hypot(looks[i].columns, looks[i].rows));
    }
    return looks;
}

/// The steepest rise seen from a texel, as a tangent; 0 if nothing rises.
float steepestRise(const HeightGrid& grid, int column, int row, const Looks& looks) {
    const float here = grid.at(column, row);
    float steepest = 0.0F;
    for (const Look& look : looks)
        steepest =
            std::max(steepest, (grid.at(column + look.columns, row + look.rows) - here) / look.distance);
    return steepest;
}

/// For a level surface under an even sky, the light lost to a horizon at angle h is the square of its sine.
float skySeen(const HeightGrid& grid, int column, int row, std::span<const Looks> directions) {
    float lost = 0.0F;
    for (const Looks& looks : directions) {
        const float rise = steepestRise(grid, column, row, looks);
        lost += rise * rise / (1.0F + rise * rise);
    }
    return 1.0F - lost / static_cast<float>(directions.size());
}

/// The key light's direction in track coordinates at x.
Vec3 keyLightAt(const track::Track& track, double x) {
    const Vec3 there = track.shape.toRoom({x, 0.0, 0.0});
    const Vec3 along = track.shape.toRoom({x + 1e-4, 0.0, 0.0}) - there;
    const Vec3 outward = track.shape.toRoom({x, 1e-4, 0.0}) - there;
    return {keyLight().dot(along.normalized()), keyLight().dot(outward.normalized()), keyLight().z()};
}

std::uint8_t toByte(float share) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(share, 0.0F, 1.0F)));
}

/// The mean over 3 x 3 texels, which hides the grid.
LightMap smoothed(const LightMap& map) {
    LightMap smooth = map;
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            for (int channel = 0; channel < 2; ++channel) {
                int sum = 0;
                for (int i = 0; i < 9; ++i) {
                    const int x = std::clamp(column + i % 3 - 1, 0, map.columns - 1);
                    const int y = std::clamp(row + i / 3 - 1, 0, map.rows - 1);
                    sum += map.values[2 * (static_cast<std::size_t>(y) * map.columns + x) + channel];
                }
                smooth.values[2 * (static_cast<std::size_t>(row) * map.columns + column) + channel] =
                    static_cast<std::uint8_t>((sum + 4) / 9);
            }
        }
    }
    return smooth;
}

}  // namespace

Vec3 keyLight() {
    return Vec3(-0.80, 0.34, 0.76).normalized();
}

LightMap calcLightMap(const track::Track& track) {
    const HeightGrid grid(track);
    LightMap map{grid.columns, grid.rows, {}};
    map.values.resize(static_cast<std::size_t>(grid.columns) * grid.rows * 2);
    std::array<Looks, kDirections> around;
    for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * base::kPi * (i + 0.5) / kDirections;
        around[static_cast<std::size_t>(i)] = makeLooks({std::cos(angle), std::sin(angle)}, grid.texel());
    }
    for (int column = 0; column < grid.columns; ++column) {
        const Vec3 light = keyLightAt(track, grid.xOf(column));
        const Vec2 level = light.head<2>();
        const auto elevation = static_cast<float>(light.z() / level.norm());
        const Looks towardsLight = makeLooks(level.normalized(), grid.texel());
        for (int row = 0; row < grid.rows; ++row) {
            std::uint8_t* texel = &map.values[2 * (static_cast<std::size_t>(row) * grid.columns + column)];
            if (grid.at(column, row) == kNothing) {
                texel[0] = texel[1] = 255;
                continue;
            }
            const float rise = steepestRise(grid, column, row, towardsLight);
            texel[0] = toByte(skySeen(grid, column, row, around));
            texel[1] = toByte((elevation - rise) / kPenumbra + 0.5F);
        }
    }
    return smoothed(map);
}

}  // namespace trapwright::scene
