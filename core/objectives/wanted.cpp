#include "core/objectives/wanted.h"

#include <cassert>

#include "core/objectives/objectives.h"
#include "core/objectives/success_share.h"

namespace trapwright::objectives {

Objective wanted() {
    Objective objective = successShare();
    objective.key = objective.symbol = kWanted;
    objective.name = "Wanted";
    objective.help = "Parts that finish as they are wanted, of all trials. Higher is better.";
    objective.isDetail = true;
    objective.needsWanted = true;
    objective.measure = [](const Evaluation& evaluation) {
        assert(evaluation.wanted);
        return successShare().measure(evaluation);
    };
    return objective;
}

}  // namespace trapwright::objectives
