#include "sim/cluster/workbench.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <utility>

#include "core/base/parallel.h"

namespace trapwright::cluster {

Workbench::Workbench(trial::EngineRegistry engines, unsigned threads)
    : engines_(std::move(engines)), threads_(threads) {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
        lanes_[i].thread = std::jthread([this, i] { work(lanes_[i], i == 1); });
}

Workbench::~Workbench() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
        for (Active& one : active_)
            one.control.cancel();
    }
    wake_.notify_all();
    for (Lane& lane : lanes_)
        lane.thread.join();
}

void Workbench::add(Job job) {
    {
        const std::lock_guard lock(mutex_);
        Waiting waiting{std::move(job), {}};
        active_.push_back({waiting.job.task, waiting.job.run, waiting.control});
        lanes_[waiting.job.isAside ? 1 : 0].waiting.push_back(std::move(waiting));
    }
    wake_.notify_all();
}

std::vector<FinishedJob> Workbench::takeFinished() {
    const std::lock_guard lock(mutex_);
    return std::exchange(finished_, {});
}

std::vector<Progress> Workbench::progress() const {
    const std::lock_guard lock(mutex_);
    std::vector<Progress> progress;
    progress.reserve(active_.size());
    for (const Active& one : active_)
        progress.push_back({one.task, one.control.done()});
    return progress;
}

void Workbench::steer(std::uint64_t run, RunState state) {
    const std::lock_guard lock(mutex_);
    for (Active& one : active_) {
        if (one.run != run) continue;
        if (state == RunState::running) one.control.resume();
        if (state == RunState::paused) one.control.pause();
        if (state == RunState::over) one.control.cancel();
    }
}

void Workbench::work(Lane& lane, bool isAside) {
    if (isAside) base::lowerPriority();
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [&] { return over_ || !lane.waiting.empty(); });
        if (over_) return;
        const Waiting waiting = std::move(lane.waiting.front());
        lane.waiting.pop_front();
        lock.unlock();
        FinishedJob finished = perform(waiting);
        lock.lock();
        std::erase_if(active_, [&](const Active& one) { return one.task == finished.task; });
        finished_.push_back(std::move(finished));
    }
}

FinishedJob Workbench::perform(const Waiting& waiting) {
    const Job& job = waiting.job;
    FinishedJob finished;
    finished.task = job.task;
    const auto begin = std::chrono::steady_clock::now();
    const trial::EngineKind* kind = engines_.find(job.engine);
    if (kind == nullptr) {
        finished.problem = engines_.describeUnknown(job.engine).message;
        return finished;
    }
    const auto engine = kind->make({job.threads == 0 ? threads_ : job.threads, job.step});
    auto made = engine->run(job.batches, waiting.control);
    finished.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!made) {
        finished.problem = made.error().message;
        return finished;
    }
    for (std::vector<trial::Outcome>& ofBatch : *made)
        std::ranges::move(ofBatch, std::back_inserter(finished.outcomes));
    return finished;
}

}  // namespace trapwright::cluster
