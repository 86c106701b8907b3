#pragma once

#include <vector>

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// A share with the binomial's standard error; of none 0.
Measured measureShare(int count, double of);

/// The share of all trials that finish in the wanted orientation (decisions.md#selection-and-success), with
/// the binomial's standard error; tables of people show the exact bounds beside it (core/stats/binomial).
Objective successShare();

/// F_W: success where something is wanted, and only there: a search that sums it up is led to one way of
/// ending, where F_O is content with any (decisions.md#wanted-orientation).
Objective wanted();

/// How many parts end in the goal.
int countSuccess(const Evaluation& evaluation);

/// Which trials are a success. Of trials of several parts those of which all are.
std::vector<bool> listRight(const Evaluation& evaluation);

/// The same of those that finish alone: what comes out of a track that throws back what lies wrong.
Objective correctShare();

/// For tracks that throw out what lies wrong, so that it comes again, in bits: minus the binary logarithm of
/// the share of those that do not come again (trial::comesAgain) that finish in the wanted orientation, and
/// kBitsOfHalving for each halving of the parts by what comes again. Four equally frequent ways have 2 bits,
/// and one of the four alone a third: order is worth more than what it costs. What gets stuck or is lost
/// counts as wrong. The part that makes an orientation the mode is left out, or of few parts a large share
/// would lie so by chance.
Objective sorting();
/// With 1, throwing out half of the ways would gain nothing; with 0, throwing out almost all parts would cost
/// nothing (decisions.md#sorting).
inline constexpr double kBitsOfHalving = 1.0 / 6.0;

/// For tracks behind whose end nothing may be wrong, in nines: minus the decimal logarithm of the share of
/// wrong parts among those that do not come again, by Laplace's rule of succession ((wrong + 1) / (all + 2)),
/// so that with none wrong more parts that arrive are more certainty. What gets
/// stuck or is lost counts as wrong.
Objective purity();

/// For tracks that throw out what lies wrong, in decades: the decimal logarithm of the share of right parts
/// of all that are fed, ((right + 1) / (all + 2)), 0 if all are right. Beside purity twice as many right ones
/// are worth as much as half of the wrong ones, however few there are.
Objective yield();

/// Parts of streams that leave the track as wanted, of those that come to it (core/study/stream). Without
/// streams nothing, so that a search may send them over its best tracks alone.
Objective throughput();

}  // namespace trapwright::objectives
