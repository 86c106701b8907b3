#include "core/traps/free_form.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>

namespace trapwright::traps {

namespace {

constexpr int kBits = 10;  // of each number (paper, section 4.2.1)
constexpr double kMillimetres = 1.0 / base::kMillimetre;

std::size_t countPointValues(const TrapParameters& parameters) {
    return 2 * static_cast<std::size_t>(parameters.crossSections) *
           static_cast<std::size_t>(parameters.pointsPerSection);
}

std::vector<search::Dimension> dimensionsOf(const TrapParameters& parameters) {
    std::vector<search::Dimension> dimensions;
    dimensions.reserve(countPointValues(parameters) + static_cast<std::size_t>(parameters.crossSections));
    for (int section = 0; section < parameters.crossSections; ++section) {
        for (int point = 0; point < parameters.pointsPerSection; ++point) {
            const std::string place =
                "section " + std::to_string(section + 1) + ", point " + std::to_string(point + 1);
            const Interval across = spanAcross(parameters, point);
            dimensions.push_back({place + ", y", "mm", kMillimetres * across.low,
                                  kMillimetres * (across.low + across.size), kBits, true, false, section});
            dimensions.push_back({place + ", z", "mm", 0.0, kMillimetres * parameters.segmentHeight, kBits,
                                  true, true, section});
        }
    }
    for (int section = 0; section < parameters.crossSections; ++section) {
        dimensions.push_back({"length of segment " + std::to_string(section + 1), "mm",
                              kMillimetres * parameters.minSegmentLength,
                              kMillimetres * parameters.maxSegmentLength, kBits, false, false,
                              parameters.crossSections});
    }
    return dimensions;
}

std::vector<track::CrossSection> buildFreeForm(const TrapParameters& parameters,
                                               const track::CrossSection& /*before*/,
                                               std::span<const double> numbers) {
    const std::size_t points = countPointValues(parameters);
    return decodeTrap(parameters, numbers.first(points), numbers.subspan(points));
}

std::vector<double> layOutFreeForm(const TrapParameters& parameters) {
    std::vector<double> places;
    for (int section = 1; section <= parameters.crossSections; ++section)
        places.push_back(section * (0.5 * (parameters.minSegmentLength + parameters.maxSegmentLength)));
    return places;
}

double longestFreeForm(const TrapParameters& parameters) {
    return parameters.crossSections * parameters.maxSegmentLength;
}

std::vector<double> smoothFreeForm(const TrapParameters& parameters, std::span<const double> numbers,
                                   double probability, base::Random& random) {
    std::vector<double> smoothed(numbers.begin(), numbers.end());
    const std::vector<double> points =
        smoothSurface(numbers.first(countPointValues(parameters)), parameters.crossSections,
                      parameters.pointsPerSection, probability, random);
    std::copy(points.begin(), points.end(), smoothed.begin());
    return smoothed;
}

// The grid of (y, z) values and which of them are known.
class Grid {
 public:
    Grid(std::span<const double> values, int rows, int columns)
        : rows_(rows),
          columns_(columns),
          values_(values.begin(), values.end()),
          known_(values.size() / 2, 1) {}

    void removePoints(double probability, base::Random& random) {
        for (int i = 0; i < rows_; ++i) {
            for (int j = 0; j < columns_; ++j) {
                const bool corner = (i == 0 || i == rows_ - 1) && (j == 0 || j == columns_ - 1);
                if (!corner && random.uniform() < probability) known_[index(i, j)] = 0;
            }
        }
    }

    void restoreBorder() {
        for (const int i : {0, rows_ - 1}) {
            for (int j = 1; j < columns_ - 1; ++j)
                restore(i, j, {{0, -1}, {0, 1}});
            markRow(i);
        }
        for (const int j : {0, columns_ - 1}) {
            for (int i = 1; i < rows_ - 1; ++i)
                restore(i, j, {{-1, 0}, {1, 0}});
        }
        for (int i = 1; i < rows_ - 1; ++i)
            known_[index(i, 0)] = known_[index(i, columns_ - 1)] = 1;
    }

    void restoreInterior() {
        for (int i = 1; i < rows_ - 1; ++i) {
            for (int j = 1; j < columns_ - 1; ++j)
                restore(i, j, {{0, -1}, {0, 1}, {-1, 0}, {1, 0}});
        }
    }

    std::vector<double> take() { return std::move(values_); }

 private:
    struct Direction {
        int di, dj;
    };

    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(j);
    }

    void markRow(int i) {
        for (int j = 0; j < columns_; ++j)
            known_[index(i, j)] = 1;
    }

    // Sets a removed point to the mean of the nearest known points in these directions, weighted by inverse
    // distance: for opposite neighbours this is linear interpolation. Restored points stay unknown until the
    // caller says otherwise, so the order of restoring does not matter.
    void restore(int i, int j, std::initializer_list<Direction> directions) {
        if (known_[index(i, j)] != 0) return;
        double weights = 0.0;
        double sums[2] = {0.0, 0.0};
        for (const auto& [di, dj] : directions) {
            int steps = 1;
            while (known_[index(i + steps * di, j + steps * dj)] == 0)
                ++steps;
            const double weight = 1.0 / steps;
            const std::size_t neighbour = 2 * index(i + steps * di, j + steps * dj);
            weights += weight;
            for (std::size_t k = 0; k < 2; ++k)
                sums[k] += weight * values_[neighbour + k];
        }
        for (std::size_t k = 0; k < 2; ++k)
            values_[2 * index(i, j) + k] = sums[k] / weights;
    }

    int rows_, columns_;
    std::vector<double> values_;
    std::vector<std::uint8_t> known_;  // per point
};

}  // namespace

TrapKind freeForm() {
    return {"free-form",
            "Free form",
            "A surface of hills and valleys through a grid of points, the paper's.",
            &dimensionsOf,
            &buildFreeForm,
            &layOutFreeForm,
            &longestFreeForm,
            &smoothFreeForm};
}

Interval spanAcross(const TrapParameters& parameters, int point) {
    if (parameters.encoding == PointEncoding::free)
        return {-0.5 * parameters.segmentWidth, parameters.segmentWidth};
    const double strip = parameters.segmentWidth / parameters.pointsPerSection;
    return {-0.5 * parameters.segmentWidth + strip * point, strip};
}

std::vector<track::CrossSection> decodeTrap(const TrapParameters& parameters, std::span<const double> points,
                                            std::span<const double> lengths) {
    assert(points.size() == countPointValues(parameters) &&
           lengths.size() == static_cast<std::size_t>(parameters.crossSections));
    std::vector<track::CrossSection> sections(lengths.size());
    double x = 0.0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        x += parameters.minSegmentLength +
             (parameters.maxSegmentLength - parameters.minSegmentLength) * lengths[i];
        sections[i].x = x;
        sections[i].points.reserve(static_cast<std::size_t>(parameters.pointsPerSection));
        for (int j = 0; j < parameters.pointsPerSection; ++j, next += 2) {
            const Interval interval = spanAcross(parameters, j);
            sections[i].points.emplace_back(interval.low + interval.size * points[next],
                                            parameters.segmentHeight * points[next + 1]);
        }
    }
    return sections;
}

std::vector<double> smoothSurface(std::span<const double> points, int sections, int pointsPerSection,
                                  double probability, base::Random& random) {
    assert(points.size() ==
           2 * static_cast<std::size_t>(sections) * static_cast<std::size_t>(pointsPerSection));
    Grid grid(points, sections, pointsPerSection);
    grid.removePoints(probability, random);
    grid.restoreBorder();
    grid.restoreInterior();
    return grid.take();
}

}  // namespace trapwright::traps
