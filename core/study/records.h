#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/objectives/objectives.h"
#include "core/search/search.h"
#include "core/stats/binomial.h"
#include "core/trial/conditions.h"
#include "core/trial/goal.h"
#include "core/trial/orientations.h"
#include "core/trial/outcome.h"

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

/// Tracks of another study that a first generation can begin with, best first, as its search knew them.
struct KnownTracks {
    std::string study;  // its file's name
    std::vector<search::Proposal> tracks;

    friend bool operator==(const KnownTracks&, const KnownTracks&) = default;
};

/// One evaluated individual of a generation.
struct IndividualRecord {
    search::Design design;
    std::vector<search::NamedNumber> traits;  // what else the search knows of it
    objectives::Fitness fitness;
    int overlaps = 0;  // triangles of the surface that overlap another; F_C = -overlaps
    int trials = 0;    // simulated; 0 if the track was not simulated
    int finished = 0;
    int fellOff = 0;
    int stuck = 0;  // stuck or timed out
    /// Success (decisions.md#selection-and-success): finished within the tolerance of what is wanted, or else
    /// of the mode of its own final orientations. None: learned by a program that did not count it.
    std::optional<int> oriented{};

    /// Of all its trials. None: not simulated, or not counted.
    [[nodiscard]] std::optional<stats::Count> success() const {
        if (!oriented || trials == 0) return std::nullopt;
        return stats::Count{*oriented, trials};
    }

    /// Of those that finish: what counts where parts that fall off come again (forgivesFalls). None: as
    /// success(), or none finishes.
    [[nodiscard]] std::optional<stats::Count> correct() const {
        if (!oriented || finished == 0) return std::nullopt;
        return stats::Count{*oriented, finished};
    }

    friend bool operator==(const IndividualRecord&, const IndividualRecord&) = default;
};

/// The curves of Figures 6 and 7 (decisions.md#distance-and-statistics), and success.
struct GenerationStatistics {
    objectives::Fitness best;                 // of the winner
    objectives::Fitness topMean;              // arithmetic mean of the top 30 %
    std::vector<search::NamedNumber> curves;  // what the search reports; the genetic one its strategy values
    std::optional<stats::Count> success{};    // of the winner; none: not simulated, or not counted
    /// Mean share of those of the top 30 % that were simulated. None: there are none, or it was not counted.
    std::optional<double> topSuccess{};

    friend bool operator==(const GenerationStatistics&, const GenerationStatistics&) = default;
};

/// One whole generation, evaluated.
struct GenerationRecord {
    int index = 0;  // from 0
    std::vector<IndividualRecord> individuals;
    int winner = 0;  // index into individuals; the lowest among equals
    GenerationStatistics statistics;
    double seconds = 0.0;  // wall time; the only field that may differ between equal runs
    /// The track that all individuals are mended from, of an earlier generation (judgeVariants); none:
    /// learned.
    std::optional<IndividualId> mendedFrom{};
    /// The search's own after it was told of this generation (search::Search::save). A study keeps that of
    /// its last generation alone (LearningState).
    std::string searchState{};
    /// Of all trials, one individual after the other. Only until they are saved: what is loaded has none.
    trial::MadeOutcomes made{};
};

/// Where a learning run goes on.
struct LearningState {
    int index = 0;       // of the last generation that was saved
    std::string search;  // its GenerationRecord::searchState
};

/// A generation without its individuals.
struct GenerationSummary {
    int index = 0;   // from 0
    int winner = 0;  // index into the generation's individuals
    GenerationStatistics statistics;
    double seconds = 0.0;                      // wall time
    std::int64_t trials = 0;                   // simulated, of all individuals
    std::optional<IndividualId> mendedFrom{};  // as GenerationRecord::mendedFrom

    /// 0 if the generation took no time.
    [[nodiscard]] double trialsPerSecond() const {
        return seconds > 0.0 ? static_cast<double>(trials) / seconds : 0.0;
    }
};

GenerationSummary summarize(const GenerationRecord& record);

/// An individual of a study, often the best of its generation.
struct Individual : IndividualId {
    IndividualRecord record;
};

/// Two scores of an individual, as the objectives measure them.
struct ScorePair : IndividualId {
    int trials = 0;  // that both were made of
    double first = 0.0;
    double second = 0.0;

    friend bool operator==(const ScorePair&, const ScorePair&) = default;
};

/// The individuals for which no other does better in both ways, the best in the first way first: indices into
/// `pairs`. Who has fewer trials than `least`, as a race leaves those behind, is not compared: the luckiest
/// of few trials would be on it.
std::vector<std::size_t> findParetoFront(std::span<const ScorePair> pairs, const objectives::Objective& first,
                                         const objectives::Objective& second, int least);

/// What one engine made of the trials of a check.
struct EngineScore {
    std::string engine;
    objectives::Fitness fitness;
    int finished = 0;
    int oriented = 0;  // finished within the tolerance of what is wanted, or of the learning engine's mode

    friend bool operator==(const EngineScore&, const EngineScore&) = default;
};

/// A generation's winner on the same trials in the engine that learned and in the reference.
struct CheckRecord : IndividualId {
    int trials = 0;  // in each engine
    EngineScore learning;
    EngineScore reference;

    friend bool operator==(const CheckRecord&, const CheckRecord&) = default;
};

/// A winner re-simulated with many trials (paper, section 6.1.1).
struct SelectionEntry : IndividualId {
    objectives::Fitness fitness;  // from the many trials
    int trials = 0;
    int finished = 0;
    int oriented = 0;  // finished within the tolerance of the goal
    trial::Goal goal;  // what was wanted, or this track's modal orientation
    /// Of trials in corners of the operating box, in none of the above; none of those: {0, 0}.
    stats::Count corners{};
};

/// All winners that were re-simulated, best first.
struct SelectionRecord {
    std::string engine;
    std::vector<SelectionEntry> entries;
    trial::MadeOutcomes made{};  // of all trials, one entry after the other; until they are saved
    std::optional<trial::OperatingBox> box{};  // that the trials varied over; none: all alike
};

/// One row of the paper's Tables 2 and 3.
struct ValidationRow {
    int pose = 0;  // index into the part's stable poses
    trial::Tally tally;
};

/// The table of one individual.
struct ValidationRecord : IndividualId {
    std::string engine;
    trial::Goal goal;        // what counted as success
    double tolerance = 0.0;  // [rad]
    std::vector<ValidationRow> rows;
    trial::MadeOutcomes made{};                // of all trials, one row after the other; until they are saved
    std::optional<trial::OperatingBox> box{};  // that the trials varied over; none: all alike
};

}  // namespace trapwright::study
