#pragma once

#include "core/study/records.h"
#include "tests/core/objectives/paper_fitness.h"

/// Records made up for the tables and charts.
namespace trapwright::sample {

inline study::GenerationSummary summary(int index, double orientation = 0.5) {
    study::GenerationSummary made;
    made.index = index;
    made.winner = 3 + index;
    made.statistics.best = testing::paperFitness(-2.0, -0.25, orientation);
    made.statistics.topMean = testing::paperFitness(-4.0, -0.5, orientation / 2.0);
    made.statistics.best.scores.push_back({"conveying_speed", 0.05, 0.002});
    made.statistics.curves = {{"p_x", 0.8}, {"p_dm", 0.01}, {"p_s", 0.05}};
    made.statistics.success = stats::Count{17, 20};
    made.statistics.topSuccess = 0.5;
    made.seconds = 2.0;
    return made;
}

inline study::CheckRecord check(int generation, int learning, int reference) {
    study::CheckRecord made;
    made.generation = generation;
    made.individual = 3 + generation;
    made.trials = 10;
    made.learning = {"native", testing::paperFitness(0.0, -0.1, 1.0), 10, learning};
    made.reference = {"simbody", testing::paperFitness(0.0, -0.2, 0.9), 10, reference};
    return made;
}

}  // namespace trapwright::sample
