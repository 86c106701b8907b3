#include "tests/peers/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "core/base/file.h"
#include "core/bench/benchmark.h"
#include "core/verify/known_motions.h"

namespace trapwright::peers {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// As many trials side by side as learning has, unless that takes longer. [s]
constexpr int kMostCopies = 256;
constexpr double kMostSeconds = 8.0;

struct Subject {
    std::string name;
    std::string title;
    bool relative;
    std::vector<verify::KnownMotion> motions;
};

std::vector<Subject> makeSubjects() {
    return {{"stick-slip", "Stick and slip: conveying speed", true, verify::makeStickSlip()},
            {"hopping", "Hopping: conveying speed", true, verify::makeHopping()},
            {"bounce", "Bounce: rebound over impact speed", false, verify::makeBounces()}};
}

base::Result<double> measureError(const trial::Engine& engine, const Subject& subject,
                                  const verify::KnownMotion& motion) {
    const auto trajectory = engine.replay(motion.batch, 0, motion.interval, {});
    if (!trajectory) return trajectory.error();
    const double error = std::abs(motion.measure(*trajectory) - motion.expected) /
                         (subject.relative ? std::abs(motion.expected) : 1.0);
    return std::isfinite(error) ? error : kInfinite;
}

/// So many of each motion, at phases of the drive spread evenly over a turn.
std::vector<trial::TrialBatch> copyMotions(const Subject& subject, int copies) {
    std::vector<trial::TrialBatch> batches;
    for (const verify::KnownMotion& motion : subject.motions) {
        trial::TrialBatch& batch = batches.emplace_back(motion.batch);
        batch.trials.resize(static_cast<std::size_t>(copies), motion.batch.trials.front());
        for (int i = 0; i < copies; ++i)
            batch.trials[static_cast<std::size_t>(i)].phase += 2.0 * base::kPi * i / copies;
    }
    return batches;
}

base::Result<double> measureCost(const trial::Engine& engine, const Subject& subject) {
    for (int copies = 1;; copies *= 4) {
        const auto batches = copyMotions(subject, copies);
        const double begin = bench::readCpuClock();
        const auto outcomes = engine.run(batches, {});
        const double seconds = bench::readCpuClock() - begin;
        if (!outcomes) return outcomes.error();
        double simulated = 0.0;
        for (const auto& batch : *outcomes)
            for (const trial::Outcome& outcome : batch)
                simulated += outcome.parts.front().time;
        if (copies == kMostCopies || 4.0 * seconds > kMostSeconds) return seconds / simulated;
    }
}

const PrecisionPoint* findCheapest(const std::vector<PrecisionPoint>& points, const std::string& engine,
                                   const std::string& subject, double largestError) {
    const PrecisionPoint* cheapest = nullptr;
    for (const PrecisionPoint& point : points) {
        if (point.engine != engine || point.subject != subject || !(point.largestError <= largestError))
            continue;
        if (cheapest == nullptr || point.cost < cheapest->cost) cheapest = &point;
    }
    return cheapest;
}

std::vector<std::string> listEngines(const std::vector<PrecisionPoint>& points) {
    std::vector<std::string> names;
    for (const PrecisionPoint& point : points)
        if (std::ranges::find(names, point.engine) == names.end()) names.push_back(point.engine);
    return names;
}

std::string writeTable(const std::vector<PrecisionPoint>& points) {
    std::string text = "engine,subject,step_ms,largest_error,rms_error,cpu_seconds_per_simulated_second\n";
    for (const PrecisionPoint& point : points) {
        text += fmt::format("{},{},{:g},{:.6g},{:.6g},{:.6g}\n", point.engine, point.subject,
                            1e3 * point.step, point.largestError, point.rmsError, point.cost);
    }
    return text;
}

// Told apart by people who see few colours as well, and by their marks (Okabe and Ito).
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr int kMarks[] = {7, 5, 9, 11, 13, 15};

/// In gnuplot's single quotes.
std::string quote(const std::filesystem::path& path) {
    std::string quoted = "'";
    for (const char c : path.string())
        quoted += c == '\'' ? "''" : std::string(1, c);
    return quoted + "'";
}

std::string writeScript(const std::vector<PrecisionPoint>& points, const std::filesystem::path& folder) {
    std::string script = fmt::format("set output {}\ndata = {}\n", quote(folder / "work-precision.svg"),
                                     quote(folder / "work-precision.csv"));
    script += R"(set terminal svg size 1320,580 font "DejaVu Sans,13" background "white"
set datafile separator ","
set datafile missing NaN
set logscale xy
set format x "10^{%L}"
set xrange [2e-4:3]
set yrange [0.01:1000]
set ytics ("0.01" 0.01, "0.1" 0.1, "1" 1, "10" 10, "100" 100, "1000" 1000)
set grid linecolor "#dddddd"
set border 3 linecolor "#555555"
set tics nomirror textcolor "#333333"
set xlabel "processor time per simulated second [s]"
set label "At each point: the step in ms" at screen 0.99,0.05 right textcolor "#555555"
set multiplot layout 1,3 margins 0.06,0.99,0.29,0.91 spacing 0.05
)";
    const std::vector<Subject> subjects = makeSubjects();
    const std::vector<std::string> engines = listEngines(points);
    for (std::size_t s = 0; s < subjects.size(); ++s) {
        script += fmt::format("set title \"{}\"\n", subjects[s].title);
        script += s == 0 ? "set ylabel \"largest error [%]\"\n" : "unset ylabel\n";
        script += s == 1 ? "set key at screen 0.5,0.02 center bottom horizontal samplen 2 width 2\n"
                         : "unset key\n";
        std::string plots;
        for (std::size_t e = 0; e < engines.size(); ++e) {
            const std::string chosen =
                fmt::format("(strcol(1) eq \"{}\" && strcol(2) eq \"{}\" ? $6 : NaN):(100*$4)", engines[e],
                            subjects[s].name);
            plots += fmt::format(
                "{}data every ::1 using {} with linespoints linecolor \"{}\" pointtype {} "
                "pointsize 0.7 linewidth 1.6 title \"{}\", \\\n"
                "  data every ::1 using {}:3 with labels left offset 0.5,0.4 font \",9\" textcolor \"{}\" "
                "notitle",
                plots.empty() ? "plot " : ", \\\n  ", chosen, kColours[e % std::size(kColours)],
                kMarks[e % std::size(kMarks)], engines[e], chosen, kColours[e % std::size(kColours)]);
        }
        script += plots + "\nunset label\n";
    }
    return script + "unset multiplot\n";
}

}  // namespace

base::Result<std::vector<PrecisionPoint>> measurePrecision(const trial::EngineKind& kind, double step) {
    const auto engine = kind.make({1, step, nullptr});
    std::vector<PrecisionPoint> points;
    for (const Subject& subject : makeSubjects()) {
        PrecisionPoint point = {kind.name, subject.name, step};
        double squares = 0.0;
        for (const verify::KnownMotion& motion : subject.motions) {
            const auto error = measureError(*engine, subject, motion);
            if (!error) return error.error();
            point.largestError = std::max(point.largestError, *error);
            squares += *error * *error;
        }
        point.rmsError = std::sqrt(squares / static_cast<double>(subject.motions.size()));
        const auto cost = measureCost(*engine, subject);
        if (!cost) return cost.error();
        point.cost = *cost;
        points.push_back(point);
    }
    return points;
}

std::string describePrecision(const std::vector<PrecisionPoint>& points) {
    std::string text;
    for (const PrecisionPoint& point : points) {
        text += fmt::format(
            "{:<12} {:<11} {:>8} {:>11} {:>9} {:>14}\n", point.engine, point.subject,
            fmt::format("{:g}", 1e3 * point.step), fmt::format("{:.2f} %", 100.0 * point.largestError),
            fmt::format("{:.2f} %", 100.0 * point.rmsError), fmt::format("{:.5f}", point.cost));
    }
    return text;
}

std::string compareAtPrecision(const std::vector<PrecisionPoint>& points, double largestError) {
    std::string text = fmt::format("Cheapest with a largest error of at most {:g} %\n", 100.0 * largestError);
    const std::vector<std::string> engines = listEngines(points);
    for (const Subject& subject : makeSubjects()) {
        const PrecisionPoint* first = findCheapest(points, engines.front(), subject.name, largestError);
        for (const std::string& engine : engines) {
            const PrecisionPoint* point = findCheapest(points, engine, subject.name, largestError);
            text += fmt::format("{:<11} {:<12} ", subject.name, engine);
            if (point == nullptr) {
                text += "at no step\n";
                continue;
            }
            text += fmt::format("{:g} ms, {:.5f} s", 1e3 * point->step, point->cost);
            text += first != nullptr ? fmt::format(", {:.1f} times the first\n", point->cost / first->cost)
                                     : "\n";
        }
    }
    return text;
}

base::Status writePrecisionChart(const std::vector<PrecisionPoint>& points,
                                 const std::filesystem::path& folder) {
    if (auto written = base::writeFile(folder / "work-precision.csv", writeTable(points)); !written)
        return written;
    std::FILE* gnuplot = ::popen("gnuplot", "w");
    const std::string script = writeScript(points, folder);
    const bool told =
        gnuplot != nullptr && std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
    if (gnuplot == nullptr || ::pclose(gnuplot) != 0 || !told)
        return base::Error{"gnuplot could not draw the chart. packaging/install.sh --peers installs it."};
    return base::success();
}

}  // namespace trapwright::peers
