#include "core/traps/free_form.h"

#include <QtTest>
#include <algorithm>

#include "tests/core/track/track_scenes.h"

using namespace trapwright;

namespace {

constexpr int kRows = 5;
constexpr int kColumns = 8;

base::Random makeRandom(std::uint64_t seed) {
    return base::Random({seed, 0, 0, 0, base::Purpose::test});
}

std::vector<double> drawValues(std::uint64_t seed) {
    base::Random random = makeRandom(seed + 1000);
    std::vector<double> values(2 * kRows * kColumns);
    for (double& value : values)
        value = random.uniform();
    return values;
}

std::size_t at(int i, int j, int component) {
    const int index = 2 * (i * kColumns + j) + component;
    return static_cast<std::size_t>(index);
}

}  // namespace

class SmoothingTest : public QObject {
    Q_OBJECT

 private slots:
    void zeroChangesNothing() {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto values = drawValues(seed);
            base::Random random = makeRandom(seed);
            QCOMPARE(traps::smoothSurface(values, kRows, kColumns, 0.0, random), values);
        }
    }

    void oneGivesTheBilinearPatch() {
        const auto values = drawValues(1);
        base::Random random = makeRandom(1);
        const auto smooth = traps::smoothSurface(values, kRows, kColumns, 1.0, random);
        for (int i = 0; i < kRows; ++i) {
            for (int j = 0; j < kColumns; ++j) {
                const double s = i / (kRows - 1.0);
                const double t = j / (kColumns - 1.0);
                for (int k = 0; k < 2; ++k) {
                    const double expected =
                        (1 - s) * ((1 - t) * values[at(0, 0, k)] + t * values[at(0, kColumns - 1, k)]) +
                        s * ((1 - t) * values[at(kRows - 1, 0, k)] +
                             t * values[at(kRows - 1, kColumns - 1, k)]);
                    QVERIFY(std::abs(smooth[at(i, j, k)] - expected) < 1e-14);
                }
            }
        }
    }

    // The same stream tells which points go: those of a grid of zeros and ones that change are the removed
    // ones.
    void survivorsStay() {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto values = drawValues(seed);
            base::Random random = makeRandom(seed);
            const auto smooth = traps::smoothSurface(values, kRows, kColumns, 0.4, random);
            base::Random decisions = makeRandom(seed);
            for (int i = 0; i < kRows; ++i) {
                for (int j = 0; j < kColumns; ++j) {
                    const bool corner = (i == 0 || i == kRows - 1) && (j == 0 || j == kColumns - 1);
                    const bool removed = !corner && decisions.uniform() < 0.4;
                    for (int k = 0; k < 2; ++k) {
                        QCOMPARE(smooth[at(i, j, k)] != values[at(i, j, k)], removed);
                    }
                }
            }
        }
    }

    // Of 36 removable points 36 p go on average.
    void removesAtTheProbability() {
        int removed = 0;
        constexpr int kRuns = 2000;
        for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
            const auto values = drawValues(seed);
            base::Random random = makeRandom(seed);
            const auto smooth = traps::smoothSurface(values, kRows, kColumns, 0.3, random);
            for (std::size_t i = 0; i < values.size(); i += 2)
                removed += smooth[i] != values[i] ? 1 : 0;
        }
        const double trials = 36.0 * kRuns;
        const double deviation = std::sqrt(trials * 0.3 * 0.7);
        QVERIFY(std::abs(removed - 0.3 * trials) < 4.0 * deviation);
    }

    void affineDataStay_data() {
        QTest::addColumn<double>("probability");
        for (const double p : {0.1, 0.5, 0.9})
            QTest::addRow("p_s = %g", p) << p;
    }
    void affineDataStay() {
        QFETCH(double, probability);
        std::vector<double> values(2 * kRows * kColumns);
        for (int i = 0; i < kRows; ++i) {
            for (int j = 0; j < kColumns; ++j) {
                values[at(i, j, 0)] = 0.1 + 0.05 * i + 0.07 * j;
                values[at(i, j, 1)] = 0.9 - 0.11 * i + 0.02 * j;
            }
        }
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            base::Random random = makeRandom(seed);
            const auto smooth = traps::smoothSurface(values, kRows, kColumns, probability, random);
            for (std::size_t k = 0; k < values.size(); ++k)
                QVERIFY(std::abs(smooth[k] - values[k]) < 1e-14);
        }
    }

    void staysInRange() {
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            const auto values = drawValues(seed);
            base::Random random = makeRandom(seed);
            const auto smooth = traps::smoothSurface(values, kRows, kColumns, 0.6, random);
            const auto [low, high] = std::minmax_element(values.begin(), values.end());
            for (const double value : smooth)
                QVERIFY(value >= *low && value <= *high);
        }
    }

    // In strip encoding, smoothing gene values and smoothing the places that they stand for are the same.
    void stripValuesSmoothAsPlaces() {
        const traps::TrapParameters form;
        const std::vector<double> lengths(5, 0.5);
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto values = drawValues(seed);
            base::Random first = makeRandom(seed);
            const auto smoothValues = traps::smoothSurface(values, kRows, kColumns, 0.5, first);
            const auto decodedAfter = traps::decodeTrap(form, smoothValues, lengths);

            std::vector<double> places;
            for (const auto& section : traps::decodeTrap(form, values, lengths)) {
                for (const auto& point : section.points)
                    places.insert(places.end(), {point.x(), point.y()});
            }
            base::Random second = makeRandom(seed);
            const auto smoothPlaces = traps::smoothSurface(places, kRows, kColumns, 0.5, second);
            for (int i = 0; i < kRows; ++i) {
                for (int j = 0; j < kColumns; ++j) {
                    const base::Vec2& point =
                        decodedAfter[static_cast<std::size_t>(i)].points[static_cast<std::size_t>(j)];
                    QVERIFY(std::abs(point.x() - smoothPlaces[at(i, j, 0)]) < 1e-15);
                    QVERIFY(std::abs(point.y() - smoothPlaces[at(i, j, 1)]) < 1e-15);
                }
            }
        }
    }

    void smallGrids_data() {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::newRow("1 x 2: only corners") << 1 << 2;
        QTest::newRow("1 x 5") << 1 << 5;
        QTest::newRow("5 x 2") << 5 << 2;
        QTest::newRow("3 x 3") << 3 << 3;
    }
    void smallGrids() {
        QFETCH(int, rows);
        QFETCH(int, columns);
        std::vector<double> values(2 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<double>(i % 7);
        base::Random random = makeRandom(5);
        const auto smooth = traps::smoothSurface(values, rows, columns, 1.0, random);
        // The first section is a straight line between its corners.
        const auto last = static_cast<std::size_t>(columns) - 1;
        for (std::size_t j = 0; j <= last; ++j) {
            const double t = static_cast<double>(j) / static_cast<double>(last);
            const double expected = (1 - t) * values[0] + t * values[2 * last];
            QVERIFY(std::abs(smooth[2 * j] - expected) < 1e-14);
        }
    }
};

QTEST_APPLESS_MAIN(SmoothingTest)
#include "smoothing_test.moc"
