#include "ui/session/study_session.h"

#include <future>

#include "core/study/presets.h"
#include "core/study/track_design.h"
#include "core/workflow/learning.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_replays.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_state.h"

namespace trapwright::session {

namespace {

base::Result<std::unique_ptr<StudySession>> makeSession(base::Result<OpenedStudy> study,
                                                        const Environment& environment) {
    if (!study) return study.error();
    return std::make_unique<StudySession>(std::move(*study), environment);
}

}  // namespace

base::Result<std::unique_ptr<StudySession>> StudySession::create(const std::filesystem::path& path,
                                                                 const study::Settings& settings,
                                                                 const store::StoredPart& part,
                                                                 const Environment& environment) {
    // Before the file is made: nothing must be left behind by a part that cannot be built.
    auto built = part::buildPart(part.mesh, part.options);
    if (!built) return base::Error{part.options.name + ": " + built.error().message};
    auto file = store::StudyFile::create(path, settings, part, environment.program);
    if (!file) return file.error();
    return makeSession(
        readNewStudy(std::move(*file),
                     {settings, part, std::make_shared<const part::Part>(std::move(built->part))}),
        environment);
}

base::Result<std::unique_ptr<StudySession>> StudySession::create(const std::filesystem::path& path,
                                                                 const study::Settings& settings,
                                                                 const ImportedPart& part,
                                                                 const Environment& environment) {
    study::Settings own = settings;
    own.part = part.settings;
    auto file = store::StudyFile::create(path, own, part.stored, environment.program);
    if (!file) return file.error();
    return makeSession(readNewStudy(std::move(*file), {own, part.stored, part.part}), environment);
}

base::Result<std::unique_ptr<StudySession>> StudySession::open(const std::filesystem::path& path,
                                                               const Environment& environment) {
    auto file = store::StudyFile::open(path, environment.program);
    if (!file) return file.error();
    return makeSession(readStudy(std::move(*file)), environment);
}

StudySession::StudySession(OpenedStudy study, const Environment& environment)
    : state_(std::make_unique<StudyState>(
          std::move(study), environment,
          [this](const QString& what, const QString& message) { emit failed(what, message); })),
      design_(std::make_unique<StudyDesign>(*state_)),
      runs_(std::make_unique<StudyRuns>(*state_, *design_)),
      replays_(std::make_unique<StudyReplays>(*state_, *runs_)),
      feeder_(std::make_unique<StudyFeeder>(*state_, *runs_)) {}

StudySession::~StudySession() {
    state_->end();
}

const std::filesystem::path& StudySession::path() const {
    return state_->path;
}

bool StudySession::isInPlace() const {
    return state_->reader && state_->reader->checkInPlace().ok();
}

base::Status StudySession::saveAs(const std::filesystem::path& path) {
    if (state_->run) {
        return base::Error{"The study " + state_->path.string() +
                           " is at work. Stop that, and save it then under another name."};
    }
    const bool gone = !isInPlace();
    // What could not be noted in a file that is gone is noted in its copy.
    if (auto noted = state_->ledger->finish(); !noted && !gone) return noted;
    // The thread that writes is idle, so this takes no longer than the copying.
    std::optional<store::StudyFile> before;
    before.swap(state_->reader);
    if (!gone) before.reset();
    std::promise<base::Status> moved;
    std::optional<store::StudyFile> ledger;
    state_->work->post([&] {
        base::Status status = gone ? base::success() : state_->writer.savePending();
        if (status) status = state_->writer.moveTo(path, state_->environment.program);
        if (status && gone) status = state_->writer.savePending();
        if (status) {
            auto beside = state_->writer.file().openBeside();
            if (beside) ledger.emplace(std::move(*beside));
        }
        moved.set_value(status);
    });
    base::Status status = moved.get_future().get();
    if (status) {
        state_->path = path;
        state_->ledger->moveTo(std::move(ledger));
    }
    if (!status && gone) {
        state_->reader.swap(before);
        return status;
    }
    auto reader = store::StudyFile::openReadOnly(state_->path);
    if (!reader) return reader.error();
    state_->reader.emplace(std::move(*reader));
    if (!status) return status;
    state_->undo.setClean();
    emit pathChanged();
    return base::success();
}

base::Result<std::unique_ptr<StudySession>> StudySession::fork(const std::filesystem::path& path,
                                                               Fork kind) const {
    study::Settings settings = state_->settings;
    study::KnownTracks known = state_->known;
    if (kind == Fork::trapBehind) {
        const auto chosen = runs_->chosen();
        if (!chosen) return base::Error{"There is no track yet that traps could follow. Learn one first."};
        const auto track = study::decodeTrack(settings.track, chosen->record.design);
        if (!track) return track.error();
        auto rejecting = study::rejectingMode(settings, *track);
        if (!rejecting) return rejecting.error();
        settings = *std::move(rejecting);
        known = {};
    }
    if (kind == Fork::knownTracks) {
        if (!state_->reader) return state_->cannotRead();
        auto collected = workflow::collectTracks(*state_->reader);
        if (!collected) return collected.error();
        known = std::move(*collected);
        settings.evolution.firstGeneration = search::ga::FirstGeneration::known;
    }
    auto file = store::StudyFile::create(path, settings, *state_->part.stored, state_->environment.program);
    if (!file) return file.error();
    if (!known.tracks.empty()) {
        if (const auto saved = file->saveKnownTracks(known, settings); !saved) return saved.error();
    }
    // Its weights may be those of the drop test.
    const auto drops = design_->dropTest();
    if (drops) {
        if (const auto added = file->addDropTest(*drops); !added) return added.error();
    }
    auto study = readNewStudy(std::move(*file), {settings, *state_->part.stored, state_->part.part});
    if (study && drops) study->records.dropTests = {*drops};
    if (study) study->records.known = std::move(known);
    return makeSession(std::move(study), state_->environment);
}

void StudySession::leave(const QObject* listener) const {
    disconnect(listener);
    design_->disconnect(listener);
    runs_->disconnect(listener);
    replays_->disconnect(listener);
    feeder_->disconnect(listener);
}

}  // namespace trapwright::session
