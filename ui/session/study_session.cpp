#include "ui/session/study_session.h"

#include <future>

#include "core/base/parallel.h"
#include "core/base/thread_priority.h"
#include "core/study/pose_weights.h"
#include "core/study/settings.h"
#include "ui/session/study_session_state.h"

namespace trapwright::session {

namespace {

constexpr int kTick = 250;  // between two progressed() [ms]
// Below the window's thread, so that it answers at once while all processors learn. What somebody waits for
// goes before what goes on for hours, and that before checks of winners.
constexpr int kSimulatingSteps = 5;
constexpr int kWorkSteps = 10;

base::Result<std::unique_ptr<StudySession>> makeSession(base::Result<OpenedStudy> study,
                                                        const Environment& environment) {
    if (!study) return study.error();
    return std::make_unique<StudySession>(std::move(*study), environment);
}

}  // namespace

StudySession::State::State(OpenedStudy study, const Environment& environmentGiven,
                           std::function<void(const std::string&)> cannotNote)
    : environment(environmentGiven),
      path(study.file.path()),
      settings(std::move(study.design.settings)),
      part{std::make_shared<const store::StoredPart>(std::move(study.design.stored)), settings.part,
           std::move(study.design.part)},
      summaries(std::move(study.summaries)),
      winners(std::move(study.winners)),
      checks(std::move(study.checks)),
      selections(std::move(study.selections)),
      validations(std::move(study.validations)),
      physicalValidations(std::move(study.physicalValidations)),
      calibrations(std::move(study.calibrations)),
      dropTests(std::move(study.dropTests)),
      chosen(std::move(study.chosen)),
      reader(std::move(study.reader)),
      writer(std::move(study.file)),
      ledger(std::make_unique<StudyLedger>(std::move(study.ledger), std::move(cannotNote))),
      work(std::make_unique<WorkThread>([] { base::lowerPriority(kWorkSteps); })),
      simulating(std::make_unique<WorkThread>([] { base::lowerPriority(kSimulatingSteps); })) {
    findProblems();
}

void StudySession::State::findProblems() {
    problems = study::findProblems(settings);
    for (std::string& problem : study::findPartProblems(settings, *part.part))
        problems.push_back(std::move(problem));
    recommendations = study::findRecommendations(settings);
}

base::Error StudySession::State::cannotRead() const {
    return {"The study " + path.string() + " can no longer be read. Close it and open it again."};
}

base::Result<study::StudyInputs> StudySession::State::makeInputs(const Environment& environment,
                                                                 const study::Settings& settings,
                                                                 std::shared_ptr<const part::Part> part,
                                                                 trial::EngineUse use, unsigned threads) {
    const unsigned count = threads == 0 ? base::availableThreads() : threads;
    auto engine =
        environment.engines.make(environment.engines.nameFor(settings.simulation.engine, use), {count, 0.0});
    if (!engine) return engine.error();
    return study::StudyInputs{settings, std::move(part), std::move(*engine), count};
}

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
    : state_(std::make_unique<State>(std::move(study), environment,
                                     [this](const std::string& message) { tellNotNoted(message); })) {
    state_->tick.setInterval(kTick);
    connect(&state_->tick, &QTimer::timeout, this, [this] { emit progressed(progress()); });
}

StudySession::~StudySession() {
    if (state_->run) state_->run->cancel();
    state_->simulated.cancel();
    state_->estimate.cancel();
    state_->speedTable.cancel();
    state_->dropping.cancel();
    // These go first: while others have it open, the writer cannot put the study into one file.
    state_->reader.reset();
    state_->ledger.reset();
    state_->simulating.reset();
    state_->work.reset();
}

const std::filesystem::path& StudySession::path() const {
    return state_->path;
}

const trial::EngineRegistry& StudySession::engines() const {
    return state_->environment.engines;
}

const std::filesystem::path& StudySession::ownMaterials() const {
    return state_->environment.ownMaterials;
}

const study::Settings& StudySession::settings() const {
    return state_->settings;
}

std::shared_ptr<const part::Part> StudySession::part() const {
    return state_->part.part;
}

const store::StoredPart& StudySession::storedPart() const {
    return *state_->part.stored;
}

std::vector<objectives::Score> StudySession::attainable() const {
    return objectives::listAttainable(state_->part.part->symmetry,
                                      state_->settings.evolution.orientationDistance);
}

const std::vector<study::GenerationSummary>& StudySession::summaries() const {
    return state_->summaries;
}

const std::vector<study::Individual>& StudySession::winners() const {
    return state_->winners;
}

const std::vector<study::CheckRecord>& StudySession::checks() const {
    return state_->checks;
}

const std::vector<study::SelectionRecord>& StudySession::selections() const {
    return state_->selections;
}

const std::vector<study::ValidationRecord>& StudySession::validations() const {
    return state_->validations;
}

bool StudySession::isInPlace() const {
    return state_->reader && state_->reader->checkInPlace().ok();
}

std::optional<study::TrackSuccess> StudySession::findSuccess(const study::Individual& individual) const {
    std::vector<part::PoseGroup> groups;
    if (part() && !validations().empty()) groups = study::weighPoseGroups(*part(), settings());
    return study::findSuccess(selections(), validations(), individual, groups);
}

base::Result<study::GenerationRecord> StudySession::loadGeneration(int index) const {
    // Who follows a run asks for this one, and the disk may be busy just then.
    if (state_->newest && state_->newest->index == index) return *state_->newest;
    if (!state_->reader) return state_->cannotRead();
    return state_->reader->loadGeneration(index);
}

base::Result<study::Individual> StudySession::loadWinner(int generation, int individual) const {
    if (generation >= 0 && generation < static_cast<int>(state_->winners.size())) {
        const study::Individual& winner = state_->winners[static_cast<std::size_t>(generation)];
        if (winner.individual == individual) return winner;
    }
    if (!state_->reader) return state_->cannotRead();
    auto record = state_->reader->loadIndividual({generation, individual});
    if (!record) return record.error();
    return study::Individual{{generation, individual}, std::move(*record)};
}

const std::vector<std::string>& StudySession::problems() const {
    return state_->problems;
}

const std::vector<std::string>& StudySession::recommendations() const {
    return state_->recommendations;
}

bool StudySession::locked() const {
    return !state_->summaries.empty() || state_->run != nullptr;
}

QUndoStack* StudySession::undoStack() {
    return &state_->undo;
}

unsigned StudySession::threads() const {
    return state_->threads;
}

void StudySession::setThreads(unsigned threads) {
    if (state_->threads == threads) return;
    state_->threads = threads;
    state_->forgetCost();
    emit estimated(0.0);
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

base::Result<std::unique_ptr<StudySession>> StudySession::fork(const std::filesystem::path& path) const {
    auto file =
        store::StudyFile::create(path, state_->settings, *state_->part.stored, state_->environment.program);
    if (!file) return file.error();
    // Its weights may be those of the drop test.
    const auto drops = dropTest();
    if (drops) {
        if (const auto added = file->addDropTest(*drops); !added) return added.error();
    }
    auto study = readNewStudy(std::move(*file), {state_->settings, *state_->part.stored, state_->part.part});
    if (study && drops) study->dropTests = {*drops};
    return makeSession(std::move(study), state_->environment);
}

}  // namespace trapwright::session
