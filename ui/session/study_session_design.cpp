#include "core/workflow/estimate.h"
#include "ui/session/study_session_state.h"

namespace trapwright::session {

namespace {

QString lockedMessage() {
    return StudySession::tr(
        "The generations of this study were made with its part and settings. Only the number of generations "
        "and what concerns selection, validation and the real feeder can change now; for all else begin a "
        "new study with these settings.");
}

}  // namespace

void StudySession::changeSettings(const study::Settings& settings, const QString& what) {
    study::Settings next = settings;
    next.part = state_->settings.part;
    study::takePoseWeights(next.part, settings.part);
    if (next == state_->settings) return;
    if (locked() && !study::keepsScores(state_->settings, next)) {
        emit failed(what, lockedMessage());
        return;
    }
    state_->undo.push(new SettingsCommand(what, state_->settings, next,
                                          [this](const study::Settings& wanted) { applySettings(wanted); }));
}

void StudySession::changePart(const store::StoredPart& part, const study::PartSettings& settings,
                              const QString& what) {
    state_->partBuilding.start(
        [this, part, settings, what, present = state_->part.part]() -> NewestTask::Deliver {
            auto built = part::buildPart(part.mesh, part.options);
            if (!built) {
                return [this, what, message = built.error().message] {
                    emit failed(what, QString::fromStdString(message));
                };
            }
            PartVersion version{std::make_shared<const store::StoredPart>(part), settings,
                                std::make_shared<const part::Part>(std::move(built->part))};
            // The counts are of the poses that there were.
            if (!study::holdsFor(study::makeDropRecord(*present, {}, {}, {}), *version.part))
                version.settings.droppedCounts.clear();
            return [this, what, version] { pushPart(version, what); };
        });
}

void StudySession::changePart(const ImportedPart& part, const QString& what) {
    pushPart({std::make_shared<const store::StoredPart>(part.stored), part.settings, part.part}, what);
}

void StudySession::pushPart(const PartVersion& version, const QString& what) {
    if (locked()) {
        emit failed(what, lockedMessage());
        return;
    }
    state_->undo.push(new PartCommand(what, state_->part, version,
                                      [this](const PartVersion& wanted) { applyPart(wanted); }));
}

void StudySession::applySettings(const study::Settings& settings) {
    // The part has commands of its own; how its poses count is no matter of the part.
    const study::Settings before = state_->settings;
    state_->settings = settings;
    state_->found.reset();
    state_->settings.part = before.part;
    study::takePoseWeights(state_->settings.part, settings.part);
    state_->part.settings = state_->settings.part;
    if (!workflow::costTheSame(before, state_->settings)) state_->forgetCost();
    if (state_->run) state_->run->learning.setGenerations(settings.evolution.generations);
    saveDesign(nullptr);
    emit settingsChanged();
}

void StudySession::applyPart(const PartVersion& version) {
    cancelDrops();
    state_->part = version;
    state_->settings.part = version.settings;
    state_->forgetCost();
    saveDesign(version.stored);
    emit partChanged();
    emit settingsChanged();
}

void StudySession::saveDesign(const std::shared_ptr<const store::StoredPart>& part) {
    state_->findProblems();
    state_->writer.setPending(state_->settings, part);
    state_->work->post([this] { savePending(); });
}

void StudySession::savePending() {
    if (const auto saved = state_->writer.savePending(); !saved) {
        tell(this, [this, message = QString::fromStdString(saved.error().message)] {
            emit failed(tr("The settings could not be saved"), message);
        });
    }
}

}  // namespace trapwright::session
