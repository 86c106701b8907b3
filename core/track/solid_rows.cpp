#include "core/track/solid_rows.h"

#include <algorithm>
#include <cmath>

namespace trapwright::track {

std::vector<CrossSection> subdivideSections(const FeederShape& shape,
                                            std::span<const CrossSection> sections) {
    std::vector<CrossSection> rows;
    for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
        const CrossSection& from = sections[i];
        const CrossSection& to = sections[i + 1];
        int pieces = 1;
        if (shape.type == FeederType::bowl) {
            // Rounding must not add a piece to a segment of exactly so many steps.
            const double steps = (to.x - from.x) / (shape.bowlRadius * kLargestBowlStep);
            pieces = std::max(1, static_cast<int>(std::ceil(steps - 1e-9)));
        }
        rows.push_back(from);
        for (int k = 1; k < pieces; ++k) {
            const double t = static_cast<double>(k) / pieces;
            CrossSection between{from.x + t * (to.x - from.x), from.points};
            for (std::size_t j = 0; j < between.points.size(); ++j) {
                between.points[j] += t * (to.points[j] - from.points[j]);
            }
            rows.push_back(std::move(between));
        }
    }
    rows.push_back(sections.back());
    return rows;
}

std::vector<double> placeBase(const CrossSection& row) {
    const bool function = std::adjacent_find(row.points.begin(), row.points.end(),
                                             [](const base::Vec2& a, const base::Vec2& b) {
                                                 return a.x() >= b.x();
                                             }) == row.points.end();
    std::vector<double> places;
    places.reserve(row.points.size());
    for (std::size_t j = 0; j < row.points.size(); ++j) {
        const double t = static_cast<double>(j) / static_cast<double>(row.points.size() - 1);
        places.push_back(function ? row.points[j].x()
                                  : (1.0 - t) * row.points.front().x() + t * row.points.back().x());
    }
    return places;
}

}  // namespace trapwright::track
