#pragma once

#include <cmath>

#include "core/objectives/objectives.h"

namespace trapwright::testing {

/// The paper's three scores and their sum.
inline objectives::Fitness paperFitness(double collision, double distance, double orientation) {
    return {collision + distance + orientation,
            {{"F_C", collision}, {"F_D", distance}, {"F_O", orientation}}};
}

/// NaN if there is none of that key.
inline double scoreOf(const objectives::Fitness& fitness, std::string_view key) {
    const objectives::Score* score = objectives::findScore(fitness, key);
    return score == nullptr ? std::nan("") : score->value;
}

}  // namespace trapwright::testing
