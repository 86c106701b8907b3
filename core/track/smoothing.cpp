#include "core/track/smoothing.h"

#include <cassert>
#include <cstdint>

namespace trapwright::track {

namespace {

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

}  // namespace trapwright::track
