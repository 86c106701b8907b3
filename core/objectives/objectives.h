#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// All that there are, in the order in which people read them. Adding one: its file, and its line here.
std::span<const Objective> allObjectives();

/// The one of that key; null if this program has none.
const Objective* findObjective(std::string_view key);

using ObjectiveList = std::vector<const Objective*>;

/// The paper's three: "F_C, F_D, F_O".
inline constexpr std::string_view kPaperObjectives = "F_C, F_D, F_O";
/// Of the objective that counts successes, which people read with exact bounds.
inline constexpr std::string_view kSuccess = "success";
/// Of the objective that counts what ends as it is wanted.
inline constexpr std::string_view kWanted = "F_W";
/// What is best summed up where something is wanted (decisions.md#wanted-orientation).
inline constexpr std::string_view kWantedObjectives = "F_C, F_D, F_O, F_W";
/// Of the objective that counts successes in corners of the operating box.
inline constexpr std::string_view kCorners = "corners";
/// Of the objective that forgives what falls off where it comes again.
inline constexpr std::string_view kSorting = "sorting";
/// Of the objective that counts how few wrong ones there are of what comes to the end.
inline constexpr std::string_view kPurity = "purity";
/// Of the objective that counts how many right ones there are of what is fed, by their logarithm.
inline constexpr std::string_view kYield = "yield";
/// Of the objective that streams of parts are sent for.
inline constexpr std::string_view kThroughput = "throughput";

/// Objectives by their keys, commas between them. An error that names what there is not, what is named twice,
/// and what there is.
base::Result<ObjectiveList> readObjectives(std::string_view text);
/// Whether the objective of that key is one of them.
bool contains(const ObjectiveList& list, std::string_view key);
/// "F_C + F_D + F_O"
std::string describeSum(const ObjectiveList& objectives);

/// A value in people's unit, without the unit: "97.3". A mean of whole numbers is none: at least so many
/// decimals.
std::string shown(const Objective& objective, double value, int leastDecimals = 0);

/// An objective's value.
struct Score {
    std::string key;
    double value = 0.0;
    double error = 0.0;  // standard error; 0: exact, or not known

    friend bool operator==(const Score&, const Score&) = default;
};

/// What a track is worth.
struct Fitness {
    double total = 0.0;  // F, that a search maximises: the sum of the objectives that its settings name
    std::vector<Score> scores;  // of these, and of all others

    friend bool operator==(const Fitness&, const Fitness&) = default;
};

/// The score of that key; null if there is none (a study of a program that did not know the objective).
const Score* findScore(const Fitness& fitness, std::string_view key);

/// What a perfect feeder would score, of each objective that there is in the task where that is known, in
/// their order.
std::vector<Score> listAttainable(const Task& task);

/// Adds up what counts, in its order; less is better counts as minus (paper, section 4.1: F = F_C + F_D +
/// F_O). Every one must have a score.
double calcTotal(std::span<const Score> scores, const ObjectiveList& summed);
/// The standard error of the total, from those of what counts as if they were independent.
double calcTotalError(const Fitness& fitness, const ObjectiveList& summed);

/// The scores of what counts alone: all that a search needs.
Fitness measureSum(const Evaluation& evaluation, const ObjectiveList& summed);
/// The scores of all objectives that there are for the evaluation, in their order.
Fitness measureAll(const Evaluation& evaluation, const ObjectiveList& summed);
/// Adds to scores of what counts those of all others.
Fitness measureOthers(const Evaluation& evaluation, const Fitness& summed);

}  // namespace trapwright::objectives
