#include "ui/session/study_design.h"

#include <QDateTime>
#include <QElapsedTimer>
#include <QUndoCommand>
#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "core/base/parallel.h"
#include "core/study/pose_weights.h"
#include "core/study/target.h"
#include "core/workflow/estimate.h"
#include "ui/session/study_state.h"

namespace trapwright::session {

namespace {

constexpr qint64 kOneEdit = 1000;       // [ms]
constexpr int kAtOnceOfEachThread = 4;  // drops, before others have their turn

QString lockedMessage() {
    return StudyDesign::tr(
        "The generations of this study were made with its part and settings. Only the number of generations "
        "and what concerns selection, validation and the real feeder can change now; for all else begin a "
        "new study with these settings.");
}

QString dropsFailed() {
    return StudyDesign::tr("The part could not be dropped");
}

/// A change of the settings. One that soon follows another of the same name goes on with it, so that a value
/// that is dragged is undone in one step.
class SettingsCommand : public QUndoCommand {
 public:
    using Apply = std::function<void(const study::Settings&)>;

    SettingsCommand(const QString& what, const study::Settings& before, const study::Settings& after,
                    Apply apply);

    void undo() override { apply_(before_); }
    void redo() override { apply_(after_); }
    [[nodiscard]] int id() const override { return 1; }
    bool mergeWith(const QUndoCommand* later) override;

 private:
    study::Settings before_;
    study::Settings after_;
    Apply apply_;
    QElapsedTimer age_;
};

SettingsCommand::SettingsCommand(const QString& what, const study::Settings& before,
                                 const study::Settings& after, Apply apply)
    : QUndoCommand(what), before_(before), after_(after), apply_(std::move(apply)) {
    age_.start();
}

bool SettingsCommand::mergeWith(const QUndoCommand* later) {
    if (later->text() != text() || age_.elapsed() > kOneEdit) return false;
    after_ = static_cast<const SettingsCommand*>(later)->after_;
    age_.restart();
    setObsolete(after_ == before_);
    return true;
}

/// A change of the part.
class PartCommand : public QUndoCommand {
 public:
    using Apply = std::function<void(const PartVersion&)>;

    PartCommand(const QString& what, PartVersion before, PartVersion after, Apply apply);

    void undo() override { apply_(before_); }
    void redo() override { apply_(after_); }

 private:
    PartVersion before_;
    PartVersion after_;
    Apply apply_;
};

PartCommand::PartCommand(const QString& what, PartVersion before, PartVersion after, Apply apply)
    : QUndoCommand(what), before_(std::move(before)), after_(std::move(after)), apply_(std::move(apply)) {}

}  // namespace

StudyDesign::StudyDesign(StudyState& state) : state_(&state) {}

const study::Settings& StudyDesign::settings() const {
    return state_->settings;
}

const trial::EngineRegistry& StudyDesign::engines() const {
    return state_->environment.engines;
}

const std::filesystem::path& StudyDesign::ownMaterials() const {
    return state_->environment.ownMaterials;
}

std::shared_ptr<const part::Part> StudyDesign::part() const {
    return state_->part.part;
}

const store::StoredPart& StudyDesign::storedPart() const {
    return *state_->part.stored;
}

std::vector<objectives::Score> StudyDesign::attainable() const {
    return objectives::listAttainable(study::makeTask(state_->settings, *state_->part.part));
}

const std::vector<std::string>& StudyDesign::problems() const {
    return state_->problems;
}

const std::vector<std::string>& StudyDesign::recommendations() const {
    return state_->recommendations;
}

bool StudyDesign::locked() const {
    return state_->locked();
}

QUndoStack* StudyDesign::undoStack() {
    return &state_->undo;
}

void StudyDesign::changeSettings(const study::Settings& settings, const QString& what) {
    study::Settings next = settings;
    next.part = state_->settings.part;
    study::takePoseWeights(next.part, settings.part);
    if (next == state_->settings) return;
    // A run has its settings already, for all generations to come.
    const int generations =
        state_->run != nullptr ? std::numeric_limits<int>::max() : static_cast<int>(state_->summaries.size());
    if (locked() && !study::keepsScores(state_->settings, next, generations)) {
        state_->fail(what, lockedMessage());
        return;
    }
    state_->undo.push(new SettingsCommand(what, state_->settings, next,
                                          [this](const study::Settings& wanted) { applySettings(wanted); }));
}

void StudyDesign::changePart(const store::StoredPart& part, const study::PartSettings& settings,
                             const QString& what) {
    partBuilding_.start([this, part, settings, what, present = state_->part.part]() -> NewestTask::Deliver {
        auto built = part::buildPart(part.mesh, part.options);
        if (!built) {
            return [this, what, message = built.error().message] {
                state_->fail(what, QString::fromStdString(message));
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

void StudyDesign::changePart(const ImportedPart& part, const QString& what) {
    pushPart({std::make_shared<const store::StoredPart>(part.stored), part.settings, part.part}, what);
}

void StudyDesign::pushPart(const PartVersion& version, const QString& what) {
    if (locked()) {
        state_->fail(what, lockedMessage());
        return;
    }
    PartVersion before = state_->part;
    before.target = state_->settings.target;
    PartVersion after = version;
    // The poses that are wanted are of the part that there was.
    if (study::holdsFor(study::makeDropRecord(*before.part, {}, {}, {}), *after.part))
        after.target = before.target;
    state_->undo.push(
        new PartCommand(what, before, after, [this](const PartVersion& wanted) { applyPart(wanted); }));
}

void StudyDesign::applySettings(const study::Settings& settings) {
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

void StudyDesign::applyPart(const PartVersion& version) {
    cancelDrops();
    state_->part = version;
    state_->settings.part = version.settings;
    state_->settings.target = version.target;
    state_->forgetCost();
    saveDesign(version.stored);
    emit partChanged();
    emit settingsChanged();
}

void StudyDesign::saveDesign(const std::shared_ptr<const store::StoredPart>& part) {
    state_->findProblems();
    state_->writer.setPending(state_->settings, part);
    state_->work->post([state = state_] { state->savePending(); });
}

/// A drop test that goes on. Values that any thread may read.
struct StudyDesign::Dropping {
    study::DropSettings settings;
    std::shared_ptr<const part::Part> part;
    std::string engine;  // its name
    unsigned threads = 1;
    base::RunControl control;
};

void StudyDesign::startDrops(const study::DropSettings& settings) {
    cancelDrops();
    if (const auto problems = study::findProblems(settings); !problems.empty()) {
        state_->fail(dropsFailed(), QString::fromStdString(problems.front()));
        return;
    }
    state_->dropping = base::RunControl();
    drops_ = DropProgress{settings, {}};
    drops_->sofar.counts.resize(state_->part.part->stablePoses.size());
    const unsigned threads = state_->threads == 0 ? base::availableThreads() : state_->threads;
    dropSome(std::make_shared<const Dropping>(
        Dropping{settings, state_->part.part,
                 engines().nameFor(state_->settings.simulation.engine, trial::EngineUse::judging), threads,
                 state_->dropping}));
    emit dropsChanged();
}

/// Posts the next drops after those that are done.
void StudyDesign::dropSome(const std::shared_ptr<const Dropping>& dropping) {
    state_->postSimulation(
        dropsFailed(), dropping->control, [this, dropping, first = drops_->sofar.drops()]() -> Deliver {
            const auto dropped = [&]() -> base::Result<study::DropResult> {
                auto engine = state_->environment.engines.make(dropping->engine, {1, 0.0});
                if (!engine) return engine.error();
                return study::simulateDrops(**engine, dropping->part, dropping->settings, dropping->threads,
                                            dropping->control, first,
                                            kAtOnceOfEachThread * static_cast<int>(dropping->threads));
            };
            auto result = dropped();
            if (!result) {
                return std::function([this, message = result.error().message] {
                    drops_.reset();
                    emit dropsChanged();
                    state_->fail(dropsFailed(), QString::fromStdString(message));
                });
            }
            return std::function([this, dropping, some = std::move(*result)] {
                drops_->sofar.add(some);
                if (drops_->sofar.drops() < dropping->settings.drops) {
                    dropSome(dropping);
                } else {
                    finishDrops(*dropping);
                }
                emit dropsChanged();
            });
        });
}

void StudyDesign::finishDrops(const Dropping& dropping) {
    study::DropRecord record =
        study::makeDropRecord(*dropping.part, dropping.settings, dropping.engine, drops_->sofar);
    record.time = QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString();
    drops_.reset();
    state_->note([record](store::StudyFile& file) { return file.addDropTest(record); });
    state_->dropTests.push_back(std::move(record));
    if (state_->settings.part.poseWeights == study::PoseWeights::dropped)
        countPosesBy(study::PoseWeights::dropped);
}

void StudyDesign::countPosesBy(study::PoseWeights weights) {
    study::Settings settings = state_->settings;
    settings.part.poseWeights = weights;
    const auto test = dropTest();
    settings.part.droppedCounts = weights == study::PoseWeights::dropped && test
                                      ? study::countsText(test->result.counts)
                                      : std::string();
    changeSettings(settings, tr("Poses count by"));
}

void StudyDesign::cancelDrops() {
    state_->dropping.cancel();
    if (!drops_) return;
    drops_.reset();
    emit dropsChanged();
}

std::optional<DropProgress> StudyDesign::drops() const {
    return drops_;
}

std::optional<study::DropRecord> StudyDesign::dropTest() const {
    const auto& tests = state_->dropTests;
    const auto found = std::find_if(tests.rbegin(), tests.rend(), [&](const study::DropRecord& test) {
        return study::holdsFor(test, *state_->part.part);
    });
    if (found == tests.rend()) return std::nullopt;
    return *found;
}

}  // namespace trapwright::session
