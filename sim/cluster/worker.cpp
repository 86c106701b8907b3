#include "sim/cluster/worker.h"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "core/trial/batch_codec.h"
#include "sim/cluster/workbench.h"

namespace trapwright::cluster {

namespace {

using Clock = std::chrono::steady_clock;

/// How long a rank sleeps that has heard nothing new.
constexpr auto kNap = std::chrono::milliseconds(1);

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

class Worker {
 public:
    Worker(Channel& channel, const trial::EngineRegistry& engines, unsigned threads,
           const UseInstructionSet& useInstructionSet)
        : channel_(&channel), useInstructionSet_(&useInstructionSet), bench_(engines, threads) {}

    void answer() {
        for (FinishedJob& job : bench_.takeFinished())
            channel_->send(0, encode(Answer{job.task, std::move(job.problem), trial::encode(job.outcomes),
                                            job.seconds}));
    }
    void giveSign() { channel_->send(0, encode(Pulse{bench_.progress()})); }

    // What rank 0 says.
    base::Status take(const Welcome& welcome) { return (*useInstructionSet_)(welcome.instructionSet); }
    base::Status take(const SentPart& sent) {
        auto part = trial::decodePart(sent.part);
        if (!part) return part.error();
        parts_[sent.id] = std::make_shared<const part::Part>(std::move(*part));
        return base::success();
    }
    base::Status take(const SentTrack& sent) {
        auto track = trial::decodeTrack(sent.track);
        if (!track) return track.error();
        tracks_[sent.run][sent.id] = std::make_shared<const track::Track>(std::move(*track));
        return base::success();
    }
    base::Status take(const Task& task) {
        Job job{task.id, task.run, task.engine, task.threads, task.step, task.isAside, {}};
        for (const Piece& piece : task.pieces) {
            auto batch = trial::decodeBatch(piece.batch);
            if (!batch) return batch.error();
            const auto& tracks = tracks_[task.run];
            if (!tracks.contains(piece.track)) return base::Error{"Rank 0 did not send the track of a task."};
            batch->track = tracks.at(piece.track);
            for (const std::uint64_t id : piece.parts) {
                if (!parts_.contains(id)) return base::Error{"Rank 0 did not send the part of a task."};
                batch->parts.push_back(parts_.at(id));
            }
            job.batches.push_back(std::move(*batch));
        }
        bench_.add(std::move(job));
        return base::success();
    }
    base::Status take(const Steer& steer) {
        bench_.steer(steer.run, steer.state);
        if (steer.state == RunState::over) tracks_.erase(steer.run);
        return base::success();
    }
    base::Status take(const Pulse& /*unused*/) { return base::success(); }
    base::Status take(const Over& /*unused*/) {
        isOver = true;  // rank 0 says why
        return base::success();
    }
    template <class Other>
    base::Status take(const Other& /*unused*/) {
        return base::Error{"Rank 0 sent what only other ranks send."};
    }

    bool isOver = false;

 private:
    Channel* channel_;
    const UseInstructionSet* useInstructionSet_;
    std::map<std::uint64_t, std::shared_ptr<const part::Part>> parts_;
    std::map<std::uint64_t, std::map<std::uint64_t, std::shared_ptr<const track::Track>>> tracks_;
    Workbench bench_;
};

base::Status workUntilOver(Channel& channel, const trial::EngineRegistry& engines, const Hello& self,
                           const UseInstructionSet& useInstructionSet, const Patience& patience) {
    Worker worker(channel, engines, self.threads, useInstructionSet);
    channel.send(0, encode(self));
    Clock::time_point heard = Clock::now();
    Clock::time_point signGiven = heard;
    Clock::time_point looked = heard;
    while (true) {
        bool isIdle = true;
        while (const auto received = channel.receive()) {
            isIdle = false;
            heard = Clock::now();
            const auto message = decode(received->bytes);
            if (!message) return message.error();
            auto taken = std::visit([&](const auto& content) { return worker.take(content); }, *message);
            if (worker.isOver) return taken;
            if (!taken) {
                channel.send(0, encode(Over{taken.error().message}));
                return taken;
            }
        }
        worker.answer();
        if (secondsSince(signGiven) > patience.pulse) {
            signGiven = Clock::now();
            worker.giveSign();
        }
        // Who was stopped itself heard nobody.
        if (secondsSince(looked) > patience.pulse) heard = Clock::now();
        looked = Clock::now();
        if (secondsSince(heard) > patience.orphaned)
            return base::Error{
                fmt::format("Rank {} on {} has heard nothing of rank 0 for {:.0f} s: it died, hangs, or the "
                            "network is cut.",
                            channel.rank(), self.host, patience.orphaned)};
        if (isIdle) std::this_thread::sleep_for(kNap);
    }
}

}  // namespace

base::Status work(Channel& channel, const trial::EngineRegistry& engines, const Hello& self,
                  const UseInstructionSet& useInstructionSet, const Patience& patience) {
    base::Status ended = workUntilOver(channel, engines, self, useInstructionSet, patience);
    constexpr double kFarewell = 2.0;  // [s]
    channel.flush(kFarewell);
    return ended;
}

}  // namespace trapwright::cluster
