#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/study/records.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

/// What moved the parts in a trial.
enum class FeederKind {
    unknown,       // studies of programs that did not note it
    real,          // a drive that was connected
    unconnected,   // a feeder that the operator ran by other means
    virtualFeeder  // the program's own virtual feeder: no part moved
};

/// "unknown", "real", "unconnected", "virtual": in files.
std::string nameOf(FeederKind kind);
std::optional<FeederKind> feederKindOf(const std::string& name);

/// Which poses are placed on the track, how often, and in which order.
struct PhysicalPlan {
    std::vector<int> poses;  // indices into the part's stable poses, each once
    int repetitions = 100;   // of each pose, as in the paper
    bool shuffled = false;   // else pose after pose
    std::uint64_t seed = 1;  // of the order

    friend bool operator==(const PhysicalPlan&, const PhysicalPlan&) = default;
};

/// The pose of each trial. Every pose has its repetitions; equal plans have equal orders, on any machine.
/// Poses that are placed in turn show up drift of the feeder in one pose alone; shuffled they share it.
std::vector<int> orderOfTrials(const PhysicalPlan& plan);

/// One placement of the part on the real track.
struct PhysicalTrial {
    int number = 0;  // from 0, in the order of the plan
    int pose = 0;
    trial::Verdict outcome = trial::Verdict::success;  // by what the operator saw
    double seconds = 0.0;                              // from start to outcome; 0 if it was not timed
    double setPoint = 0.0;                             // share of full at the start
    double frequency = 0.0;                            // [Hz]; 0 where the drive does not tell
    std::string note;
    std::string time;  // UTC, "2026-03-31T12:00:00Z"
    FeederKind feeder = FeederKind::unknown;
    std::string drive;        // title of its profile; empty without one
    double halfStroke = 0.0;  // [m], read from the drive or by calibration or profile; 0: not known

    friend bool operator==(const PhysicalTrial&, const PhysicalTrial&) = default;
};

/// One printed track on the real feeder. It may be broken off and gone on with, days later.
/// IndividualId: whose track was printed.
struct PhysicalValidation : IndividualId {
    int number = 0;  // from 0, in the study
    PhysicalPlan plan;
    std::string operatorName;
    std::string track;    // in the operator's words: printer, material, finish
    std::string drive;    // title of its profile
    std::string program;  // that it was begun with, and its version
    std::string started;  // UTC
    std::vector<PhysicalTrial> trials;

    friend bool operator==(const PhysicalValidation&, const PhysicalValidation&) = default;
};

/// How many trials each kind of feeder made.
struct FeederCount {
    int unknown = 0;
    int real = 0;
    int unconnected = 0;
    int virtualFeeder = 0;

    /// Trials that count for a printed track, as far as is known.
    [[nodiscard]] int physical() const { return real + unconnected; }
    /// Whether trials of the virtual feeder stand beside others.
    [[nodiscard]] bool mixed() const { return virtualFeeder > 0 && (physical() > 0 || unknown > 0); }
};
FeederCount countFeeders(const PhysicalValidation& validation);

/// What whoever reads the numbers must know of the feeder: that it was the virtual one, that two kinds are
/// mixed, or that older trials do not tell. Empty if all were made on a real feeder. A sentence or two.
std::string feederNotice(const PhysicalValidation& validation);

/// The pose of the next trial; none if the plan is done.
std::optional<int> nextPose(const PhysicalValidation& validation);

}  // namespace trapwright::study
