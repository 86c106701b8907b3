#include "core/bench/benchmark.h"

#include <time.h>

#include <algorithm>

#include "core/stats/samples.h"
#include "core/study/evaluator.h"

namespace trapwright::bench {

namespace {

/// A quarter is enough for shares.
int countShareTrials(const Plan& plan) {
    return (plan.trials + 3) / 4;
}

class SceneRun {
 public:
    SceneRun(const Scene& scene, std::span<const trial::EngineKind> contenders, const Plan& plan,
             base::RunControl control)
        : scene_(scene), plan_(plan), control_(std::move(control)), batch_(makeBatch(scene, plan.trials)) {
        for (const trial::EngineKind& contender : contenders) {
            engines_.push_back(contender.make({1, plan.step, nullptr}));
            Measurement& measured = measurements_.emplace_back();
            measured.engine = contender.name;
            measured.step = engines_.back()->step();
        }
    }

    void time() {
        for (int repeat = 0; repeat < plan_.repeats; ++repeat) {
            for (std::size_t e = 0; e < engines_.size(); ++e)
                timeOnce(*engines_[e], measurements_[e]);
        }
    }

    void measureShares(std::span<const trial::EngineKind> contenders) {
        trial::TrialBatch fewer = batch_;
        fewer.trials.resize(static_cast<std::size_t>(countShareTrials(plan_)));
        for (std::size_t e = 0; e < contenders.size(); ++e) {
            if (!measurements_[e].problem.empty() || control_.cancelled()) continue;
            const auto meter = std::make_shared<trial::CostMeter>();
            const auto engine = contenders[e].make({1, plan_.step, meter});
            if (study::runTrials(*engine, {&fewer, 1}, control_)) measurements_[e].costs = meter->read();
        }
    }

    std::vector<Measurement> finish() {
        const std::vector<double>& first = measurements_.front().cpuSeconds;
        for (Measurement& measured : measurements_) {
            std::vector<double> ratios;
            for (std::size_t r = 0; r < std::min(first.size(), measured.cpuSeconds.size()); ++r)
                ratios.push_back(first[r] / measured.cpuSeconds[r]);
            measured.ratio = ratios.empty() ? 0.0 : stats::medianOf(ratios);
        }
        return std::move(measurements_);
    }

 private:
    void timeOnce(const trial::Engine& engine, Measurement& measured) {
        if (!measured.problem.empty() || control_.cancelled()) return;
        const double begin = readCpuClock();
        const auto outcomes = study::runTrials(engine, {&batch_, 1}, control_);
        const double seconds = readCpuClock() - begin;
        if (!outcomes) {
            measured.problem = outcomes.error().message;
            measured.cpuSeconds.clear();
            return;
        }
        measured.cpuSeconds.push_back(seconds);
        if (measured.counts.tally.trials() > 0) return;
        measured.counts = study::countTrials(outcomes->front(), scene_.part->symmetry, scene_.expected,
                                             study::ValidationSettings{}.tolerance);
    }

    const Scene& scene_;
    const Plan& plan_;
    base::RunControl control_;
    trial::TrialBatch batch_;
    std::vector<std::unique_ptr<trial::Engine>> engines_;
    std::vector<Measurement> measurements_;
};

}  // namespace

double readCpuClock() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int countAllTrials(const Plan& plan, std::size_t contenders) {
    return static_cast<int>(contenders) * (plan.repeats * plan.trials + countShareTrials(plan));
}

double Measurement::secondsPerTrial() const {
    return stats::medianOf(cpuSeconds) / counts.tally.trials();
}

double Measurement::stepsPerTrial() const {
    return counts.simulatedTime / step / counts.tally.trials();
}

base::Result<std::vector<Measurement>> runScene(const Scene& scene,
                                                std::span<const trial::EngineKind> contenders,
                                                const Plan& plan, const base::RunControl& control) {
    SceneRun run(scene, contenders, plan, control);
    run.time();
    run.measureShares(contenders);
    if (control.cancelled()) return base::Error{"The benchmark was cancelled."};
    return run.finish();
}

}  // namespace trapwright::bench
