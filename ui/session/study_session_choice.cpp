#include "core/study/selection.h"
#include "ui/session/study_session_state.h"

namespace trapwright::session {

std::optional<study::Individual> StudySession::chosen() const {
    if (state_->chosen) return state_->chosen;
    if (!state_->selections.empty() && !state_->selections.back().entries.empty()) {
        const study::SelectionEntry& best = state_->selections.back().entries.front();
        if (auto winner = loadWinner(best.generation, best.individual)) return *winner;
    }
    if (const study::Individual* best = study::findBestWinner(state_->winners)) return *best;
    return std::nullopt;
}

void StudySession::choose(const study::Individual& individual) {
    state_->chosen = individual;
    const study::IndividualId place = individual;
    note([place](store::StudyFile& file) { return file.chooseWinner(place); });
    emit chosenChanged();
}

}  // namespace trapwright::session
