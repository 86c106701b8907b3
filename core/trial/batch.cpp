#include "core/trial/batch.h"

#include <fmt/format.h>

#include <algorithm>

namespace trapwright::trial {

namespace {

std::optional<base::Error> findProblem(const part::Part& part) {
    if (part.pieces.empty())
        return base::Error{"The part '" + part.name +
                           "' has no convex pieces to make contact with; import it again."};
    if (!(part.massProperties.mass > 0.0))
        return base::Error{"The part '" + part.name +
                           "' has no mass; check its density and that its mesh is closed."};
    return std::nullopt;
}

/// `number`: the trial's place in its batch.
std::optional<base::Error> findProblem(const TrialBatch& batch, const TrialSpec& trial, std::size_t number) {
    // Nobody may come while a short stream lasts.
    if (trial.parts.empty() && batch.termination.until == 0.0)
        return base::Error{fmt::format("Trial {} of the batch has no part.", number)};
    const bool known = std::ranges::all_of(
        trial.parts, [&](const PartStart& start) { return start.part < batch.parts.size(); });
    if (!known)
        return base::Error{fmt::format("Trial {} places a part that is not among the {} of its batch.",
                                       number, batch.parts.size())};
    return std::nullopt;
}

std::optional<base::Error> findSinglePartProblem(const TrialBatch& batch, const TrialSpec& trial,
                                                 std::size_t number, std::string_view engine) {
    if (trial.parts.size() != 1)
        return base::Error{
            fmt::format("The engine '{}' simulates one part at a time, and trial {} has {}. "
                        "Parts do not touch each other in it: give each a trial of its own.",
                        engine, number, trial.parts.size())};
    if (trial.parts.front().time != 0.0)
        return base::Error{
            fmt::format("The engine '{}' simulates parts that are there from the begin on, "
                        "and that of trial {} comes after {} s. Let it come at 0 s.",
                        engine, number, trial.parts.front().time)};
    if (batch.termination.until > 0.0)
        return base::Error{fmt::format("The engine '{}' simulates no streams.", engine)};
    return std::nullopt;
}

}  // namespace

std::optional<base::Error> findProblem(const TrialBatch& batch) {
    if (!batch.track || batch.parts.empty() || std::ranges::count(batch.parts, nullptr) > 0)
        return base::Error{"A batch of trials has no track or no part."};
    for (const auto& part : batch.parts)
        if (auto problem = findProblem(*part)) return problem;
    for (std::size_t i = 0; i < batch.trials.size(); ++i)
        if (auto problem = findProblem(batch, batch.trials[i], i)) return problem;
    return std::nullopt;
}

std::optional<base::Error> findProblem(const TrialBatch& batch, std::size_t index) {
    if (index >= batch.trials.size())
        return base::Error{
            fmt::format("There is no trial {}: the batch has {}.", index, batch.trials.size())};
    return findProblem(batch);
}

std::optional<base::Error> findSinglePartProblem(const TrialBatch& batch, std::string_view engine) {
    if (auto problem = findProblem(batch)) return problem;
    for (std::size_t i = 0; i < batch.trials.size(); ++i)
        if (auto problem = findSinglePartProblem(batch, batch.trials[i], i, engine)) return problem;
    return std::nullopt;
}

std::optional<base::Error> findSinglePartProblem(const TrialBatch& batch, std::size_t index,
                                                 std::string_view engine) {
    if (auto problem = findProblem(batch, index)) return problem;
    return findSinglePartProblem(batch, batch.trials[index], index, engine);
}

}  // namespace trapwright::trial
