#include "core/study/records.h"

namespace trapwright::study {

GenerationSummary summarize(const GenerationRecord& record) {
    GenerationSummary summary{record.index, record.winner, record.statistics, record.seconds};
    for (const IndividualRecord& individual : record.individuals)
        summary.trials += individual.trials;
    summary.mendedFrom = record.mendedFrom;
    return summary;
}

}  // namespace trapwright::study
