#pragma once

#include <vector>

#include "core/search/ga/genes.h"

/// Chromosomes for the tests of the genetic search.
namespace trapwright::sample {

/// 40 points of 10 bits, and 5 numbers.
inline const search::ga::ChromosomeLayout kLayout{std::vector<int>(80, 10), std::vector<int>(5, 10)};

inline search::ga::Chromosome keep(search::ga::Chromosome child, double /*probability*/,
                                   base::Random& /*random*/) {
    return child;
}

inline double countDifferent(const search::ga::Bits& a, const search::ga::Bits& b) {
    double count = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] != b[i] ? 1.0 : 0.0;
    return count;
}

}  // namespace trapwright::sample
