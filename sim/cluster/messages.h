#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"

/// What rank 0 and the others tell each other, as bytes. Parts, tracks, batches and outcomes inside are those
/// of core/trial/batch_codec.
namespace trapwright::cluster {

/// What a rank says of itself before it works.
struct Hello {
    std::string program;  // names the build: only the same one gives the same bits
    std::string host;
    std::uint32_t threads = 1;                 // that it works with
    std::string mathInstructions;              // base::mathInstructionSet()
    std::vector<std::string> instructionSets;  // that its native engine can take, the best first
};

/// Rank 0's answer to all.
struct Welcome {
    std::string instructionSet;  // to be taken from now on
};

/// A part, once in a job.
struct SentPart {
    std::uint64_t id = 0;
    std::string part;
};

/// A track, once in a run to each rank that simulates trials on it.
struct SentTrack {
    std::uint64_t run = 0;
    std::uint64_t id = 0;
    std::string track;
};

/// Trials of one batch.
struct Piece {
    std::uint64_t track = 0;
    std::vector<std::uint64_t> parts;
    std::string batch;
};

/// Trials that a rank shall make; a run is one call of an engine.
struct Task {
    std::uint64_t id = 0;
    std::uint64_t run = 0;
    std::string engine;
    std::uint32_t threads = 0;  // 0: those of the rank
    double step = 0.0;          // trial::EngineOptions::step [s]
    bool isAside = false;       // at the lowest priority, beside what else the rank does
    std::vector<Piece> pieces;
};

/// What came of a task.
struct Answer {
    std::uint64_t task = 0;
    std::string problem;   // of the engine; empty: none
    std::string outcomes;  // of all its trials, in their order
    double seconds = 0.0;  // that it took
};

/// How far a task is.
struct Progress {
    std::uint64_t task = 0;
    std::int64_t done = 0;  // trials
};

/// From every rank to rank 0 and back, now and then: it lives.
struct Pulse {
    std::vector<Progress> progress;
};

enum class RunState : std::uint8_t {
    running,
    paused,
    over  // cancelled, if it has tasks; its tracks are of no use any more
};

/// What the tasks of a run shall do.
struct Steer {
    std::uint64_t run = 0;
    RunState state = RunState::running;
};

/// The job is over; `reason` says why if that is not as it should be.
struct Over {
    std::string reason;
};

using Message = std::variant<Hello, Welcome, SentPart, SentTrack, Task, Answer, Pulse, Steer, Over>;

std::string encode(const Message& message);
/// An error if these are not the bytes of a message of this program.
base::Result<Message> decode(std::string_view bytes);

}  // namespace trapwright::cluster
