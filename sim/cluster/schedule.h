#pragma once

#include <cstddef>

/// How many trials a rank is given at a time: a share of what is left, by how fast it is, so that shares
/// shrink towards the end and all ranks end together (guided self-scheduling: Polychronopoulos and Kuck, IEEE
/// Transactions on Computers C-36(12), 1987; by measured speeds: Hummel, Schmidt, Uma, Wein, SPAA 1996).
namespace trapwright::cluster {

/// Into how many shares each rank's part of what is left is cut.
inline constexpr double kShares = 2.0;
/// How long a share lasts at least, so that messages and its last trials, which wide instructions make with
/// few lanes, do not matter. [s]
inline constexpr double kLeastTime = 0.15;

/// `left`: trials that nobody has yet; `speed`, `allSpeeds`: of this rank and of all together [trials/s], or
/// threads where no speed is known. Between 1 and `left`, which is not 0.
std::size_t chooseShare(std::size_t left, double speed, double allSpeeds, bool isSpeedKnown);

}  // namespace trapwright::cluster
