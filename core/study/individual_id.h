#pragma once

namespace trapwright::study {

/// Which individual of a study: by this it is found in the file, and its trials have their streams.
struct IndividualId {
    int generation = 0;  // from 0
    int individual = 0;  // its place in the generation

    friend bool operator==(const IndividualId&, const IndividualId&) = default;
};

/// Whether two records are about the same individual.
inline bool isSameIndividual(const IndividualId& a, const IndividualId& b) {
    return a == b;
}

}  // namespace trapwright::study
