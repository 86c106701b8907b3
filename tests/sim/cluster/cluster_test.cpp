#include <QtTest>
#include <algorithm>
#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/parallel.h"
#include "sim/cluster/coordinator.h"
#include "sim/engines/registry.h"
#include "tests/sim/cluster/memory_network.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using namespace std::chrono_literals;
using cluster::Coordinator;
using cluster::Hello;

namespace {

using Outcomes = std::vector<std::vector<trial::Outcome>>;

/// Short, so that tests are.
constexpr cluster::Patience kPatience{0.05, 2.0, 20.0, 2.0};

Hello introduce(int rank) {
    return {"trapwright test", "machine" + std::to_string(rank), 1, "FMA", {"AVX2", "SSE4"}};
}

/// Takes 10 ms a trial; its outcomes tell which trial it was. The trial of stream 13 fails.
class SlowEngine : public trial::Engine {
 public:
    explicit SlowEngine(bool fails) : fails_(fails) {}

    [[nodiscard]] std::string name() const override { return "slow"; }
    [[nodiscard]] double step() const override { return 1e-3; }
    [[nodiscard]] base::Result<Outcomes> run(std::span<const trial::TrialBatch> batches,
                                             base::RunControl control) const override {
        Outcomes outcomes;
        for (const trial::TrialBatch& batch : batches) {
            outcomes.emplace_back();
            for (const trial::TrialSpec& spec : batch.trials) {
                if (!control.mayGoOn()) return base::Error{"The simulation was cancelled."};
                if (fails_ && spec.stream.trial == 13) return base::Error{"Trial 13 is unlucky."};
                std::this_thread::sleep_for(10ms);
                trial::Outcome& outcome = outcomes.back().emplace_back();
                outcome.parts.resize(1);
                outcome.parts[0].time = spec.stream.trial;
                control.advance(1);
            }
        }
        return outcomes;
    }
    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& /*batch*/,
                                                         std::size_t /*index*/, double /*interval*/,
                                                         base::RunControl /*control*/) const override {
        return base::Error{"It has no replay."};
    }

 private:
    bool fails_;
};

trial::EngineRegistry makeSlow(bool fails = false) {
    const auto make = [fails](const trial::EngineOptions&) { return std::make_unique<SlowEngine>(fails); };
    return trial::EngineRegistry({{"slow", make, "Slow", trial::EngineRole::quick},
                                  {"reference", make, "Reference", trial::EngineRole::reference}});
}

/// A job whose ranks are threads.
class Job {
 public:
    Job(int ranks, const trial::EngineRegistry& engines, std::vector<Hello> members = {})
        : network(ranks), engines_(engines) {
        for (int rank = static_cast<int>(members.size()); rank < ranks; ++rank)
            members.push_back(introduce(rank));
        for (int rank = 1; rank < ranks; ++rank) {
            workers_.push_back(std::async(std::launch::async, [this, rank, self = members[rank]] {
                const auto channel = network.makeChannel(rank);
                return cluster::work(*channel, engines_, self, use(), kPatience);
            }));
        }
        auto started = Coordinator::start(network.makeChannel(0), engines_, members[0], use(), kPatience);
        if (started) {
            coordinator = std::move(*started);
        } else {
            problem = started.error().message;
        }
    }
    ~Job() {
        coordinator.reset();
        for (auto& worker : workers_)
            if (worker.valid()) worker.wait();
    }

    /// Ends the job; true if all workers took it well.
    bool end() {
        coordinator.reset();
        return std::ranges::all_of(workers_, [](auto& worker) { return worker.get().ok(); });
    }

    std::shared_ptr<const trial::Engine> makeEngine(const std::string& name, unsigned threads = 0) {
        return cluster::spread(engines_, *coordinator).find(name)->make({threads, 0.0});
    }

    testing::MemoryNetwork network;
    std::unique_ptr<Coordinator> coordinator;
    std::string problem;

    /// The instruction sets that its ranks were told to use.
    std::vector<std::string> takenSets() {
        const std::lock_guard lock(mutex_);
        return taken_;
    }

 private:
    cluster::UseInstructionSet use() {
        return [this](const std::string& set) {
            const std::lock_guard lock(mutex_);
            taken_.push_back(set);
            return base::success();
        };
    }

    std::mutex mutex_;
    std::vector<std::string> taken_;
    const trial::EngineRegistry& engines_;
    std::vector<std::future<base::Status>> workers_;
};

/// Batches of this engine's trials: two tracks, two kinds of parts.
std::vector<trial::TrialBatch> makeBatches(int trials) {
    const auto cuboid = verify::makePaperCuboid();
    std::vector<trial::TrialBatch> batches = {testing::makeRoughBatch(cuboid, 1, trials, 0.4),
                                              testing::makeRoughBatch(cuboid, 2, trials / 2, 0.4)};
    // A second part among those of the first batch.
    batches[0].parts.push_back(std::make_shared<const part::Part>(*cuboid));
    for (std::size_t i = 0; i < batches[0].trials.size(); i += 3)
        batches[0].trials[i].parts[0].part = 1;
    batches[1].track = verify::makeFlat();
    return batches;
}

/// One trial after the other, numbered.
trial::TrialBatch makeCounted(int trials) {
    return testing::makeRoughBatch(verify::makePaperCuboid(), 1, trials, 0.4);
}

bool isInOrder(const Outcomes& outcomes) {
    for (std::size_t i = 0; i < outcomes.front().size(); ++i)
        if (outcomes.front()[i].parts.front().time != static_cast<double>(i)) return false;
    return true;
}

template <class Condition>
bool waitFor(const Condition& condition) {
    for (int i = 0; i < 500; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(10ms);
    }
    return false;
}

}  // namespace

class ClusterTest : public QObject {
    Q_OBJECT

 private slots:
    void sameBits_data() {
        QTest::addColumn<QString>("engine");
        QTest::addColumn<int>("ranks");
        for (const QString engine : {"native", "simbody"})
            for (const int ranks : {1, 2, 5})
                QTest::newRow(qPrintable(QString("%1 on %2 ranks").arg(engine).arg(ranks)))
                    << engine << ranks;
    }
    void sameBits() {
        QFETCH(QString, engine);
        QFETCH(int, ranks);
        const std::vector<trial::TrialBatch> batches = makeBatches(40);
        const trial::EngineKind& kind = *engines::registry().find(engine.toStdString());
        base::RunControl control;
        const auto here = kind.make({1, 0.0})->run(batches, control);
        QVERIFY(here.ok());
        Job job(ranks, engines::registry());
        QVERIFY2(job.coordinator, job.problem.c_str());
        const auto spread = job.makeEngine(kind.name);
        QCOMPARE(spread->name(), kind.name);
        // A second time the ranks know the parts and each other's speed.
        for (int round = 0; round < 2; ++round) {
            base::RunControl watch;
            const auto there = spread->run(batches, watch);
            QVERIFY2(there.ok(), there.ok() ? "" : there.error().message.c_str());
            QVERIFY(*there == *here);
            QCOMPARE(watch.done(), std::int64_t{60});
        }
        QVERIFY(job.end());
    }

    // Another step than the engine's own goes with the task.
    void stepOfTheOptions() {
        const std::vector<trial::TrialBatch> batches = makeBatches(12);
        Job job(2, engines::registry());
        const auto make = cluster::spread(engines::registry(), *job.coordinator).find("native")->make;
        const auto there = make({1, 1e-4})->run(batches, {});
        const auto here = engines::registry().find("native")->make({1, 1e-4})->run(batches, {});
        const auto other = engines::registry().find("native")->make({1, 0.0})->run(batches, {});
        QVERIFY(there.ok() && here.ok() && other.ok());
        QVERIFY(*there == *here);
        QVERIFY(*there != *other);
    }

    void severalRunsAtOnce() {
        const trial::EngineRegistry slow = makeSlow();
        Job job(3, slow);
        std::vector<std::future<bool>> runs;
        runs.reserve(4);
        for (int i = 0; i < 4; ++i) {
            runs.push_back(std::async(std::launch::async, [&job, i] {
                if (i % 2 == 1) base::lowerPriority();
                const trial::TrialBatch batch = makeCounted(20);
                const auto made = job.makeEngine("slow")->run({&batch, 1}, {});
                return made.ok() && isInOrder(*made);
            }));
        }
        for (auto& run : runs)
            QVERIFY(run.get());
    }

    // What is of the lowest priority goes on beside what is not, and does not wait for it.
    void asideDoesNotWait() {
        const trial::EngineRegistry slow = makeSlow();
        Job job(1, slow);
        base::RunControl learning;
        auto first = std::async(std::launch::async, [&] {
            const trial::TrialBatch batch = makeCounted(10000);
            return job.makeEngine("slow")->run({&batch, 1}, learning).ok();
        });
        auto aside = std::async(std::launch::async, [&job] {
            base::lowerPriority();
            const trial::TrialBatch batch = makeCounted(3);
            return job.makeEngine("slow")->run({&batch, 1}, {}).ok();
        });
        QVERIFY(aside.get());
        QVERIFY(first.wait_for(0s) == std::future_status::timeout);
        learning.cancel();
        QVERIFY(!first.get());
    }

    void progressComesBeforeTheAnswer() {
        const trial::EngineRegistry slow = makeSlow();
        Job job(2, slow);
        base::RunControl control;
        auto run = std::async(std::launch::async, [&] {
            const trial::TrialBatch batch = makeCounted(4000);
            return job.makeEngine("slow")->run({&batch, 1}, control).ok();
        });
        QVERIFY(waitFor([&] { return control.done() > 20; }));
        QCOMPARE(job.coordinator->traffic().tasks, std::int64_t{2});
        control.cancel();
        QVERIFY(!run.get());
    }

    void pausesEverywhere() {
        const trial::EngineRegistry slow = makeSlow();
        Job job(3, slow);
        base::RunControl control;
        auto run = std::async(std::launch::async, [&] {
            const trial::TrialBatch batch = makeCounted(600);
            const auto made = job.makeEngine("slow")->run({&batch, 1}, control);
            return made.ok() && isInOrder(*made);
        });
        QVERIFY(waitFor([&] { return control.done() > 0; }));
        control.pause();
        std::this_thread::sleep_for(800ms);
        const std::int64_t done = control.done();
        std::this_thread::sleep_for(300ms);
        QCOMPARE(control.done(), done);
        QVERIFY(done < 600);
        control.resume();
        QVERIFY(run.get());
        QCOMPARE(control.done(), std::int64_t{600});
    }

    // At once, not when all is done, half a minute later; and the ranks are free for what comes next.
    void cancelsEverywhere() {
        const trial::EngineRegistry slow = makeSlow();
        Job job(3, slow);
        base::RunControl control;
        std::thread canceller([control]() mutable {
            std::this_thread::sleep_for(100ms);
            control.cancel();
        });
        const trial::TrialBatch batch = makeCounted(10000);
        const auto begin = std::chrono::steady_clock::now();
        const auto cancelled = job.makeEngine("slow")->run({&batch, 1}, control);
        QVERIFY(std::chrono::steady_clock::now() - begin < 10s);
        canceller.join();
        QVERIFY(!cancelled.ok());
        const trial::TrialBatch next = makeCounted(6);
        const auto made = job.makeEngine("slow")->run({&next, 1}, {});
        QVERIFY(made.ok() && isInOrder(*made));
    }

    void saysWhatAnEngineCannot() {
        const trial::EngineRegistry fails = makeSlow(true);
        Job job(3, fails);
        const trial::TrialBatch batch = makeCounted(30);
        const auto made = job.makeEngine("slow")->run({&batch, 1}, {});
        QVERIFY(!made.ok());
        QCOMPARE(made.error().message, std::string("Trial 13 is unlucky."));
        QVERIFY(!job.coordinator->failure());
        // What no engine can simulate is told before anything is sent.
        trial::TrialBatch bad = batch;
        bad.track = nullptr;
        QVERIFY(!job.makeEngine("slow")->run({&bad, 1}, {}).ok());
    }

    // The control is cancelled, so that nobody takes what is missing for an outcome.
    void noticesASilentRank() {
        const trial::EngineRegistry slow = makeSlow();
        Job job(3, slow);
        base::RunControl control;
        auto run = std::async(std::launch::async, [&] {
            const trial::TrialBatch batch = makeCounted(10000);
            return job.makeEngine("slow")->run({&batch, 1}, control).ok();
        });
        QVERIFY(waitFor([&] { return control.done() > 0; }));
        job.network.cutOff(2);
        QVERIFY(run.wait_for(10s) == std::future_status::ready);
        QVERIFY(!run.get());
        QVERIFY(control.cancelled());
        const auto failure = job.coordinator->failure();
        QVERIFY(failure.has_value());
        QVERIFY2(QString::fromStdString(*failure).startsWith("Rank 2 on machine2 has not answered for"),
                 failure->c_str());
        // Nor does anything begin any more.
        base::RunControl next;
        const trial::TrialBatch batch = makeCounted(3);
        QVERIFY(!job.makeEngine("slow")->run({&batch, 1}, next).ok());
        QVERIFY(next.cancelled());
        job.network.cutOff(-1);
    }

    void agreesOnInstructions() {
        std::vector<Hello> members = {introduce(0), introduce(1), introduce(2)};
        members[0].instructionSets = {"AVX3", "AVX2", "SSE4"};
        members[2].instructionSets = {"SSE4"};
        {
            Job job(3, engines::registry(), members);
            QVERIFY2(job.coordinator, job.problem.c_str());
            QCOMPARE(job.coordinator->instructionSet(), std::string("SSE4"));
            QVERIFY(waitFor([&] { return job.takenSets().size() == 3; }));
            QVERIFY(job.takenSets() == std::vector<std::string>(3, "SSE4"));
        }
        members[2].instructionSets = {"SVE"};
        Job job(3, engines::registry(), members);
        QVERIFY(!job.coordinator);
        QVERIFY2(job.problem.find("no instruction set") != std::string::npos, job.problem.c_str());
    }

    void refusesWhatDoesNotFit() {
        std::vector<Hello> members = {introduce(0), introduce(1)};
        members[1].program = "trapwright of yesterday";
        {
            Job job(2, engines::registry(), members);
            QVERIFY(!job.coordinator);
            QVERIFY2(job.problem.starts_with("Rank 1 on machine1 runs another build"), job.problem.c_str());
        }
        members[1].program = members[0].program;
        members[1].mathInstructions = "SSE2";
        {
            Job job(2, engines::registry(), members);
            QVERIFY(!job.coordinator);
            QVERIFY2(job.problem.find("takes SSE2, that of rank 0 on machine0 FMA") != std::string::npos,
                     job.problem.c_str());
        }
        // One that never comes.
        testing::MemoryNetwork network(2);
        const auto alone = Coordinator::start(
            network.makeChannel(0), engines::registry(), introduce(0),
            [](const std::string&) { return base::success(); }, kPatience);
        QVERIFY(!alone.ok());
        QVERIFY2(alone.error().message.starts_with("Rank 1 did not report"), alone.error().message.c_str());
    }

    // Who hears nothing of rank 0 ends by itself.
    void anOrphanEnds() {
        testing::MemoryNetwork network(2);
        const auto channel = network.makeChannel(1);
        const auto ended =
            cluster::work(*channel, engines::registry(), introduce(1),
                          [](const std::string&) { return base::success(); }, {0.05, 0.5, 0.3, 2.0});
        QVERIFY(!ended.ok());
        QVERIFY2(ended.error().message.find("has heard nothing of rank 0") != std::string::npos,
                 ended.error().message.c_str());
    }

    void messagesComeBackWhole() {
        const cluster::Task task{7, 3, "native", 2, 1e-4, true, {{5, {1, 2}, "batch"}}};
        const std::string bytes = cluster::encode(task);
        const auto message = cluster::decode(bytes);
        QVERIFY(message.ok());
        const auto* back = std::get_if<cluster::Task>(&*message);
        QVERIFY(back != nullptr);
        QCOMPARE(back->engine, std::string("native"));
        QCOMPARE(back->pieces.front().parts.size(), std::size_t{2});
        QVERIFY(back->isAside);
        QCOMPARE(cluster::encode(*message), bytes);
        // Cut off anywhere, or longer, or of no kind that there is.
        for (std::size_t size = 0; size < bytes.size(); ++size)
            QVERIFY(!cluster::decode(bytes.substr(0, size)).ok());
        QVERIFY(!cluster::decode(bytes + "x").ok());
        std::string unknown = bytes;
        unknown[8] = 100;
        QVERIFY(!cluster::decode(unknown).ok());
        // What is no message at all ends a worker with an error.
        testing::MemoryNetwork network(2);
        network.makeChannel(0)->send(1, "nonsense");
        const auto channel = network.makeChannel(1);
        QVERIFY(!cluster::work(
                     *channel, engines::registry(), introduce(1),
                     [](const std::string&) { return base::success(); }, kPatience)
                     .ok());
    }

    void sharesShrink() {
        // Alone: half of what is left each time, until it is not worth it.
        QCOMPARE(cluster::chooseShare(1000, 100.0, 100.0, true), std::size_t{500});
        QCOMPARE(cluster::chooseShare(500, 100.0, 100.0, true), std::size_t{250});
        QCOMPARE(cluster::chooseShare(20, 100.0, 100.0, true), std::size_t{15});
        QCOMPARE(cluster::chooseShare(1, 100.0, 100.0, true), std::size_t{1});
        // By speed among others.
        QCOMPARE(cluster::chooseShare(1000, 50.0, 400.0, true), std::size_t{63});
        // Of slow engines single trials; more ranks than trials.
        QCOMPARE(cluster::chooseShare(10, 0.1, 100.0, true), std::size_t{1});
        QCOMPARE(cluster::chooseShare(10, 1.0, 6400.0, false), std::size_t{1});
    }
};

QTEST_GUILESS_MAIN(ClusterTest)
#include "cluster_test.moc"
