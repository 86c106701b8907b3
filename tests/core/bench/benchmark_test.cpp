#include "core/bench/benchmark.h"

#include <QtTest>
#include <cmath>

#include "core/verify/scenes.h"

using namespace trapwright;

namespace {

/// Ends every second trial at the finish after a simulated second, the others after half of one, stuck.
class HalfEngine : public trial::Engine {
 public:
    HalfEngine(std::string name, trial::EngineOptions options, std::vector<std::string>& calls)
        : name_(std::move(name)), options_(std::move(options)), calls_(calls) {}

    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] double step() const override { return options_.step > 0.0 ? options_.step : 2e-3; }

    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override {
        calls_.push_back(name_ + (options_.costs ? " for shares" : ""));
        if (name_ == "picky") return base::Error{"It only does spheres."};
        std::vector<std::vector<trial::Outcome>> outcomes(1);
        for (std::size_t i = 0; i < batches[0].trials.size(); ++i) {
            trial::PartOutcome& outcome = outcomes[0].emplace_back().parts.emplace_back();
            outcome.ending = i % 2 == 0 ? trial::Ending::finished : trial::Ending::stuck;
            outcome.time = i % 2 == 0 ? 1.0 : 0.5;
            control.advance(1);
        }
        if (options_.costs) options_.costs->add({1.0, 2.0, 5.0});
        return outcomes;
    }

    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch&, std::size_t, double,
                                                         base::RunControl) const override {
        return base::Error{"not asked for"};
    }

 private:
    std::string name_;
    trial::EngineOptions options_;
    std::vector<std::string>& calls_;
};

}  // namespace

class BenchmarkTest : public QObject {
    Q_OBJECT

 private slots:
    void init() { calls_.clear(); }

    void enginesTakeTurns() {
        const auto measured = run({"a", "b"}, {4, 2, 0.0});
        QVERIFY(measured.ok());
        const std::vector<std::string> expected = {"a", "b", "a", "b", "a for shares", "b for shares"};
        QVERIFY(calls_ == expected);
        QCOMPARE(control_.done(), bench::countAllTrials({4, 2, 0.0}, 2));
    }

    void whatIsCountedIsCounted() {
        const auto measured = run({"a", "b"}, {4, 3, 0.0});
        QVERIFY(measured.ok());
        QCOMPARE(measured->size(), 2U);
        for (const bench::Measurement& one : *measured) {
            QCOMPARE(one.counts.tally.trials(), 4);
            QCOMPARE(one.counts.tally.finished(), 2);
            QCOMPARE(one.cpuSeconds.size(), 3U);
            // 0.75 s in the mean, in steps of 2 ms.
            QVERIFY(std::abs(one.stepsPerTrial() - 375.0) < 1e-9);
            QVERIFY(std::abs(one.secondsPerStep() * 375.0 / one.secondsPerTrial() - 1.0) < 1e-12);
            QVERIFY(one.costs.detection == 1.0 && one.costs.law == 2.0 && one.costs.integration == 5.0);
            QVERIFY(one.ratio > 0.0);
        }
        QCOMPARE(measured->front().ratio, 1.0);
    }

    void theStepAskedForCounts() {
        const auto measured = run({"a"}, {4, 1, 1e-3});
        QVERIFY(measured.ok());
        QCOMPARE(measured->front().step, 1e-3);
        QVERIFY(std::abs(measured->front().stepsPerTrial() - 750.0) < 1e-9);
    }

    void oneThatCannotDoesNotKeepTheOthers() {
        const auto measured = run({"picky", "a"}, {4, 2, 0.0});
        QVERIFY(measured.ok());
        QCOMPARE((*measured)[0].problem, std::string("It only does spheres."));
        QVERIFY((*measured)[1].problem.empty());
        QCOMPARE((*measured)[1].cpuSeconds.size(), 2U);
        QCOMPARE(std::count(calls_.begin(), calls_.end(), "picky"), 1);
    }

    void cancelledIsAnError() {
        control_ = {};
        control_.cancel();
        QVERIFY(!bench::runScene(scene(), contenders({"a"}), {4, 1, 0.0}, control_).ok());
        QVERIFY(calls_.empty());
    }

 private:
    static bench::Scene scene() {
        return {"flat", verify::makeFlat(), verify::makePaperCuboid(), {}, 0.0, {}};
    }

    std::vector<trial::EngineKind> contenders(const std::vector<std::string>& names) {
        std::vector<trial::EngineKind> list;
        list.reserve(names.size());
        for (const std::string& name : names) {
            list.push_back({name, [this, name](const trial::EngineOptions& options) {
                                return std::make_unique<HalfEngine>(name, options, calls_);
                            }});
        }
        return list;
    }

    base::Result<std::vector<bench::Measurement>> run(const std::vector<std::string>& names,
                                                      const bench::Plan& plan) {
        control_ = {};
        return bench::runScene(scene(), contenders(names), plan, control_);
    }

    std::vector<std::string> calls_;
    base::RunControl control_;
};

QTEST_APPLESS_MAIN(BenchmarkTest)
#include "benchmark_test.moc"
