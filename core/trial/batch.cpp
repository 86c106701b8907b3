#include "core/trial/batch.h"

#include <string>

namespace trapwright::trial {

std::optional<base::Error> findProblem(const TrialBatch& batch) {
    if (!batch.track || !batch.part) return base::Error{"A batch of trials has no track or no part."};
    if (batch.part->pieces.empty())
        return base::Error{"The part '" + batch.part->name +
                           "' has no convex pieces to make contact with; import it again."};
    if (!(batch.part->massProperties.mass > 0.0))
        return base::Error{"The part '" + batch.part->name +
                           "' has no mass; check its density and that its mesh is closed."};
    return std::nullopt;
}

std::optional<base::Error> findProblem(const TrialBatch& batch, std::size_t index) {
    if (index >= batch.trials.size())
        return base::Error{"There is no trial " + std::to_string(index) + ": the batch has " +
                           std::to_string(batch.trials.size()) + "."};
    return findProblem(batch);
}

}  // namespace trapwright::trial
