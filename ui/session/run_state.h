#pragma once

#include <cstdint>

namespace trapwright::session {

/// What a study is doing.
enum class RunState {
    idle,
    learning,
    paused,                   // in the middle of a generation; nothing is lost
    stoppingAfterGeneration,  // as soon as the present generation is saved
    stopping,                 // at once; what is not complete is dropped
    selecting,
    validating,
    simulating  // trials or a replay, while nothing else goes on
};

/// How far learning, selection or validation has come.
struct RunProgress {
    int generation = 0;       // the present one, from 0
    int generations = 0;      // of the whole run; 0 unless it learns
    int individualsDone = 0;  // of the present generation
    int individuals = 0;
    std::int64_t trialsDone = 0;  // of the present generation; of all when it selects or validates
    std::int64_t trials = 0;
    double trialsPerSecond = 0.0;  // since the run began, pauses left out
    double secondsLeft = 0.0;      // 0 while unknown
};

}  // namespace trapwright::session
