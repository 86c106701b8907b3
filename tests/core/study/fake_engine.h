#pragma once

#include <QtTest>
#include <cmath>
#include <functional>
#include <mutex>

#include "core/base/parallel.h"
#include "core/study/evaluator.h"
#include "core/study/presets.h"
#include "core/trial/engine_registry.h"

/// QVERIFY for a Result, with its message.
#define VERIFY_OK(result)                                                                                 \
    do {                                                                                                  \
        const auto& verifiedResult = (result);                                                            \
        QVERIFY2(verifiedResult.ok(), verifiedResult.ok() ? "" : verifiedResult.error().message.c_str()); \
    } while (false)

namespace trapwright::fake {

template <class T>
QString messageOf(const base::Result<T>& result) {
    return QString::fromStdString(result.ok() ? std::string("(no error)") : result.error().message);
}

using Law = std::function<trial::PartOutcome(const trial::TrialBatch&, const trial::TrialSpec&)>;

/// Judges trials by a law instead of mechanics, and keeps the rules of an engine.
class FakeEngine : public trial::Engine {
 public:
    explicit FakeEngine(Law law, unsigned threads = 1) : law_(std::move(law)), threads_(threads) {}

    /// Called after each trial, from any thread.
    std::function<void()> afterTrial;
    /// Judges trials that are not of one part; without it each part is judged by itself.
    std::function<trial::Outcome(const trial::TrialBatch&, const trial::TrialSpec&)> streamLaw;
    std::string title = "fake";

    [[nodiscard]] std::string name() const override { return title; }
    [[nodiscard]] double step() const override { return 1e-3; }

    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override {
        std::vector<std::vector<trial::Outcome>> outcomes(batches.size());
        std::vector<std::pair<std::size_t, std::size_t>> jobs;
        for (std::size_t b = 0; b < batches.size(); ++b) {
            outcomes[b].resize(batches[b].trials.size());
            for (std::size_t i = 0; i < batches[b].trials.size(); ++i)
                jobs.emplace_back(b, i);
        }
        base::parallelFor(jobs.size(), threads_, [&](std::size_t job, unsigned) {
            if (!control.mayGoOn()) return;
            const auto [b, i] = jobs[job];
            const trial::TrialSpec& spec = batches[b].trials[i];
            if (streamLaw && !isOfOnePart(batches[b], spec)) {
                outcomes[b][i] = streamLaw(batches[b], spec);
            } else {
                trial::TrialSpec one = spec;
                for (const trial::PartStart& start : spec.parts) {
                    one.parts = {start};
                    outcomes[b][i].parts.push_back(law_(batches[b], one));
                    ++one.stream.trial;
                }
            }
            control.advance(1);
            if (afterTrial) afterTrial();
        });
        if (control.cancelled()) return base::Error{"cancelled"};
        return outcomes;
    }

    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double, base::RunControl) const override {
        return trial::Trajectory{{}, {{law_(batch, batch.trials[index])}, {}}};
    }

 private:
    Law law_;
    unsigned threads_;
};

/// How far the trap is from a wavy shape: the mean of |z - wanted| over its points, in heights.
inline double distanceFromWave(const track::Track& track) {
    double sum = 0.0;
    int count = 0;
    for (int s = track.firstTrapSection + 1; s <= track.lastTrapSection; ++s) {
        const std::vector<base::Vec2>& points = track.sections[static_cast<std::size_t>(s)].points;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double wanted = 0.5 + 0.3 * std::sin(1.0 + 0.7 * static_cast<double>(j) + 0.9 * s);
            sum += std::abs(points[j].y() / track.height - wanted);
            ++count;
        }
    }
    return sum / count;
}

/// The nearer the trap is to the wave, the farther parts come and the more alike they end.
inline trial::PartOutcome waveLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    const track::Track& track = *batch.track;
    const double distance = distanceFromWave(track);
    base::Random random(spec.stream);
    trial::PartOutcome outcome;
    outcome.initial = {spec.parts[0].pose.rotation, {track.start, 0.0, 0.0}};
    const double reach = std::clamp(1.3 - 2.0 * distance + 0.05 * random.normal(), 0.0, 1.0);
    outcome.farthest.position = {track.start + reach * (track.finish - track.start), 0.0, 0.0};
    outcome.farthest.rotation = Eigen::AngleAxisd(4.0 * distance * random.normal(), base::Vec3::UnitZ());
    outcome.ending = reach == 1.0 ? trial::Ending::finished
                                  : (random.boolean() ? trial::Ending::stuck : trial::Ending::fellOff);
    outcome.time = random.uniform(1.0, 2.0);
    return outcome;
}

/// The engines "native", the quick one, and "simbody", the reference, both made like this.
template <class Make>
trial::EngineRegistry enginesMadeBy(Make make) {
    const auto kind = [&](const std::string& name, const std::string& title, trial::EngineRole role) {
        return trial::EngineKind{
            name, [make, name](const trial::EngineOptions& options) { return make(name, options); }, title,
            role};
    };
    return trial::EngineRegistry({kind("native", "Native", trial::EngineRole::quick),
                                  kind("simbody", "Simbody", trial::EngineRole::reference)});
}

/// Both judge by the law.
inline trial::EngineRegistry lawEngines(const Law& law = waveLaw,
                                        const std::function<void()>& afterTrial = {}) {
    return enginesMadeBy([=](const std::string& name, const trial::EngineOptions& options) {
        auto engine = std::make_unique<FakeEngine>(law, options.threads);
        engine->title = name;
        engine->afterTrial = afterTrial;
        return engine;
    });
}

/// The 4 x 8 x 12 mm block, as far as these tests need it.
inline std::shared_ptr<const part::Part> block() {
    part::Part part;
    part.name = "block";
    for (const double x : {-2e-3, 2e-3}) {
        for (const double y : {-4e-3, 4e-3}) {
            for (const double z : {-6e-3, 6e-3})
                part.hull.vertices.emplace_back(x, y, z);
        }
    }
    part.pieces = {part.hull};
    part.boundingRadius = std::sqrt(56.0) * 1e-3;
    part.symmetry.name = "D2";
    for (const base::Vec3 axis : {base::Vec3::UnitX(), base::Vec3::UnitY(), base::Vec3::UnitZ()}) {
        part.symmetry.rotations.emplace_back(Eigen::AngleAxisd(base::kPi, axis));
    }
    const auto pose = [](const base::Vec3& axis, double height, double probability) {
        return part::StablePose{base::Quaternion(Eigen::AngleAxisd(base::kPi / 2, axis)), height, probability,
                                2};
    };
    part.stablePoses = {pose(base::Vec3::UnitY(), 2e-3, 0.645),
                        pose(base::Vec3::UnitX(), 4e-3, 0.243),
                        {base::Quaternion::Identity(), 6e-3, 0.112, 2}};
    return std::make_shared<const part::Part>(std::move(part));
}

/// A small study on the wave.
inline study::StudyInputs waveInputs(unsigned threads = 1) {
    study::StudyInputs inputs;
    inputs.settings = study::presetSettings("cuboid").value();
    inputs.settings.evolution.populationSize = 24;
    inputs.settings.evolution.trialsPerEvaluation = 6;
    inputs.settings.evolution.generations = 5;
    inputs.settings.evolution.seed = 2024;
    inputs.settings.simulation.engine = "fake";
    inputs.part = block();
    inputs.engine = std::make_shared<FakeEngine>(waveLaw, threads);
    inputs.threads = threads;
    return inputs;
}

}  // namespace trapwright::fake
