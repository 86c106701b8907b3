#include "ui/session/study_session_state.h"

namespace trapwright::session {

std::optional<study::Winner> StudySession::chosen() const {
    if (state_->chosen) return state_->chosen;
    if (!state_->validations.empty()) {
        const study::ValidationRecord& last = state_->validations.back();
        if (auto winner = loadWinner(last.generation, last.individual)) return *winner;
    }
    if (!state_->selections.empty() && !state_->selections.back().entries.empty()) {
        const study::SelectionEntry& best = state_->selections.back().entries.front();
        if (auto winner = loadWinner(best.generation, best.individual)) return *winner;
    }
    if (state_->winners.empty()) return std::nullopt;
    return state_->winners.back();
}

void StudySession::choose(const study::Winner& individual) {
    state_->chosen = individual;
    emit chosenChanged();
}

}  // namespace trapwright::session
