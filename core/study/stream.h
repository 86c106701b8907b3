#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/stats/mean.h"
#include "core/study/evaluator.h"
#include "core/study/operating_box.h"
#include "core/study/settings.h"
#include "core/trial/goal.h"

/// Parts that follow each other on a track (decisions.md#streams): how many leave it in the wanted pose a
/// minute, and where it saturates or jams.
namespace trapwright::study {

/// So many parts can come in one stream.
inline constexpr int kMostPartsOfStream = 4000;

/// Streams at so many parts a minute: each with arrivals, starts and, if the judging varies, friction,
/// restitution and drive of its own. Stream i of an individual draws the same numbers at every inflow, so
/// that differences are the inflow's. Made anew with the same bits.
trial::TrialBatch makeStreamBatch(const Settings& settings, const std::shared_ptr<const part::Part>& part,
                                  const std::shared_ptr<const track::Track>& track,
                                  const IndividualId& individual, double partsPerMinute);

/// The streams by which tracks of a generation are judged while learning (EvolutionSettings::streamsEach), at
/// the study's inflow; others than those of makeStreamBatch, and the same for all individuals of a
/// generation, so that differences are the tracks'. They vary if learning trials do.
trial::TrialBatch makeLearningStreams(const Settings& settings, const Specimens& specimens,
                                      const std::shared_ptr<const track::Track>& track, int generation);
/// What these came to: of as many as came to the track in the time that counts, those that left it as wanted
/// in that time.
stats::Count countThroughput(const StreamSettings& settings, const trial::Goal& goal,
                             const part::SymmetryGroup& symmetry, double tolerance,
                             const trial::TrialBatch& batch, std::span<const trial::Outcome> outcomes);

/// What passed in the time of one stream that counts, after its warm-up.
struct StreamCounts {
    int offered = 0;  // came to the track, whether or not there was room
    int entered = 0;
    int success = 0;  // left the track at its end ...
    int wrong = 0;
    int returned = 0;     // fell off where parts come again ...
    int fellOff = 0;      // ... or elsewhere: lost
    int jams = 0;         // see findJams; those that began before count if they reach into it
    int uncleared = 0;    // of them that lasted to the end
    double jammed = 0.0;  // in all [s]

    [[nodiscard]] int arrived() const { return success + wrong; }
    [[nodiscard]] int left() const { return arrived() + returned + fellOff; }
    friend bool operator==(const StreamCounts&, const StreamCounts&) = default;
};

/// No part arrives, and all on the track or two of them stand still, for Termination::stuckTime or more. [s]
struct Jam {
    double from = 0.0;
    double to = 0.0;
    bool cleared = false;  // else it lasts to the end of the stream
};
std::vector<Jam> findJams(const trial::Outcome& outcome, const trial::Termination& termination);

/// What the streams of one inflow came to.
struct StreamResult {
    double partsPerMinute = 0.0;        // that were to come
    double duration = 0.0;              // of each stream that counts [s]
    std::vector<StreamCounts> streams;  // each
    double transit = 0.0;  // median time from start to finish of parts that arrive; 0 if none does [s]
    double spacing = 0.0;  // median time from one arrival to the next; 0 if there are none [s]
    double closest = 0.0;  // what one in ten of these is less than [s]

    [[nodiscard]] StreamCounts sum() const;
    /// Parts a minute: the mean of the streams, with Student's interval over them.
    [[nodiscard]] stats::MeanEstimate rate(int StreamCounts::*count) const;
    [[nodiscard]] stats::MeanEstimate arrivals() const;
    /// Share of parts that arrive as wanted, of those that arrive: of parts of one stream each says less than
    /// one of its own, so the interval is that of the streams' ratio (Cochran 1977, section 2.11), and never
    /// narrower than Clopper and Pearson's. None: none arrives.
    [[nodiscard]] std::optional<stats::MeanEstimate> successShare() const;
    /// Efficiency of the track: parts that arrive as wanted, of all that leave it, those among them that come
    /// again (Boothroyd 2005, chapter 3); so often a part is right when it has come up once. Likewise.
    [[nodiscard]] std::optional<stats::MeanEstimate> efficiency() const;
    /// Share of the time that counts.
    [[nodiscard]] double jammedShare() const;
    /// How many of the streams are full: less gets onto the track than comes to it, by more than one part in
    /// twenty and one more, which may just be waiting.
    [[nodiscard]] int countFull() const;

    friend bool operator==(const StreamResult&, const StreamResult&) = default;
};

/// What streams of several inflows came to.
struct Streams {
    trial::Goal goal;                   // what counted as success
    StreamSettings settings;            // partsPerMinute is not looked at
    std::vector<StreamResult> results;  // by rising inflow

    /// That which most oriented parts a minute come of; null if there are no results.
    [[nodiscard]] const StreamResult* findBest() const;
};

/// The same of an individual of a study.
struct StreamsRecord : IndividualId {
    std::string engine;
    std::optional<trial::OperatingBox> box{};  // that streams varied over; none: all alike
    Streams streams;
};

/// As studies keep it.
std::string streamsToJson(const Streams& streams);
/// An error if it is none.
base::Result<Streams> streamsFromJson(const std::string& text);

/// The inflows that are tried where nobody says which: 10 to 300 parts a minute.
std::span<const double> defaultInflows();
/// Why streams cannot be made of these settings and this inflow; empty if they can.
std::vector<std::string> findStreamProblems(const Settings& settings, double partsPerMinute);

/// Simulates streams on the track, at each of the inflows. What counts as success is what is given, or else
/// what the settings want, or else the mode of the least inflow. Errors: settings, the engine's, cancelled.
/// `control` counts streams.
base::Result<Streams> measureStreams(const StudyInputs& inputs,
                                     const std::shared_ptr<const track::Track>& track,
                                     const IndividualId& individual, const std::optional<trial::Goal>& given,
                                     std::vector<double> inflows, const base::RunControl& control);

/// A table of all of it, for people.
std::string formatStreams(const Streams& streams);

}  // namespace trapwright::study
