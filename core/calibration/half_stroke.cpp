#include "core/calibration/half_stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>

#include "core/base/math.h"

namespace trapwright::calibration {

namespace {

constexpr std::size_t kFewestSetPoints = 3;
constexpr double kNoise = 0.05;  // share of a speed

base::Status checkReading(const TimedRun& reading, std::size_t number) {
    if (reading.setPoint > 0.0 && reading.setPoint <= 1.0 && reading.distance > 0.0 && reading.time > 0.0)
        return base::success();
    return base::Error{fmt::format(
        "Reading {}: set-point {:g} %, {:g} mm in {:g} s cannot be. The set-point is above 0 and at most "
        "100 %, distance and time are above 0.",
        number, 100.0 * reading.setPoint, reading.distance / base::kMillimetre, reading.time)};
}

/// At the ends of an interval a speed may be outside the table; there its last row counts.
double findNearest(const SpeedTable& table, double speed) {
    return *findHalfStroke(table, std::clamp(speed, table.speeds.front(), table.speeds.back()));
}

}  // namespace

SpeedTable risingPart(const SpeedTable& table) {
    assert(table.halfStrokes.size() == table.speeds.size());
    SpeedTable rising;
    for (std::size_t i = 0; i < table.speeds.size(); ++i) {
        if (!rising.speeds.empty() && table.speeds[i] <= rising.speeds.back()) {
            if (rising.speeds.size() > 1) {
                if (table.speeds[i] < (1.0 - kNoise) * rising.speeds.back()) break;
                continue;
            }
            // The part still stands: the last row of those counts.
            rising = {};
        }
        rising.halfStrokes.push_back(table.halfStrokes[i]);
        rising.speeds.push_back(table.speeds[i]);
    }
    return rising;
}

base::Result<double> findHalfStroke(const SpeedTable& table, double speed) {
    if (table.speeds.size() < 2) return base::Error{"At no half-stroke is the part conveyed."};
    if (!(speed >= table.speeds.front() && speed <= table.speeds.back())) {
        return base::Error{fmt::format(
            "A speed of {:.1f} mm/s is outside what half-strokes from {:.2f} to {:.2f} mm give: {:.1f} to "
            "{:.1f} mm/s. Choose another set-point, or look at friction and vibration angle.",
            speed / base::kMillimetre, table.halfStrokes.front() / base::kMillimetre,
            table.halfStrokes.back() / base::kMillimetre, table.speeds.front() / base::kMillimetre,
            table.speeds.back() / base::kMillimetre)};
    }
    const auto above = std::upper_bound(table.speeds.begin(), table.speeds.end(), speed);
    if (above == table.speeds.end()) return table.halfStrokes.back();
    const auto i = static_cast<std::size_t>(above - table.speeds.begin());
    const double share = (speed - table.speeds[i - 1]) / (table.speeds[i] - table.speeds[i - 1]);
    return std::lerp(table.halfStrokes[i - 1], table.halfStrokes[i], share);
}

base::Result<StrokeEstimate> estimateHalfStroke(std::span<const TimedRun> readings, const SpeedTable& table) {
    std::map<double, std::vector<double>> speeds;  // at each set-point
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (const auto valid = checkReading(readings[i], i + 1); !valid) return valid.error();
        speeds[readings[i].setPoint].push_back(readings[i].distance / readings[i].time);
    }
    if (speeds.size() < kFewestSetPoints) {
        return base::Error{
            fmt::format("There are readings at {} set-points. Take some at three or more, so that it shows "
                        "whether the stroke is in proportion.",
                        speeds.size())};
    }
    StrokeEstimate estimate;
    std::vector<double> ratios;  // half-stroke over set-point [m]
    for (const auto& [setPoint, values] : speeds) {
        if (values.size() < 2) {
            return base::Error{fmt::format(
                "There is one reading at {:g} %. Take at least two at each set-point.", 100.0 * setPoint)};
        }
        const stats::MeanEstimate mean = stats::estimateMean(values);
        const auto halfStroke = findHalfStroke(table, mean.mean);
        if (!halfStroke) {
            return base::Error{
                fmt::format("Set-point {:g} %: {}", 100.0 * setPoint, halfStroke.error().message)};
        }
        estimate.setPoints.push_back(
            {setPoint,
             mean.count,
             {mean.mean, mean.interval.low, mean.interval.high},
             {*halfStroke, findNearest(table, mean.interval.low), findNearest(table, mean.interval.high)}});
        ratios.push_back(*halfStroke / setPoint);
    }
    const stats::MeanEstimate full = stats::estimateMean(ratios);
    estimate.fullHalfStroke = {full.mean, std::max(0.0, full.interval.low), full.interval.high};
    return estimate;
}

}  // namespace trapwright::calibration
