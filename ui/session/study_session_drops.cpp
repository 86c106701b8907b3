#include <QDateTime>
#include <algorithm>

#include "core/base/parallel.h"
#include "core/study/pose_weights.h"
#include "ui/session/study_session_state.h"

namespace trapwright::session {

namespace {

constexpr int kAtOnceOfEachThread = 4;  // drops, before others have their turn

QString dropsFailed() {
    return StudySession::tr("The part could not be dropped");
}

}  // namespace

/// A drop test that goes on. Values that any thread may read.
struct StudySession::Dropping {
    study::DropSettings settings;
    std::shared_ptr<const part::Part> part;
    std::string engine;  // its name
    unsigned threads = 1;
    base::RunControl control;
};

void StudySession::startDrops(const study::DropSettings& settings) {
    cancelDrops();
    if (const auto problems = study::findProblems(settings); !problems.empty()) {
        emit failed(dropsFailed(), QString::fromStdString(problems.front()));
        return;
    }
    state_->dropping = base::RunControl();
    state_->drops = DropProgress{settings, {}};
    state_->drops->sofar.counts.resize(state_->part.part->stablePoses.size());
    const unsigned threads = state_->threads == 0 ? base::availableThreads() : state_->threads;
    dropSome(std::make_shared<const Dropping>(
        Dropping{settings, state_->part.part,
                 engines().nameFor(state_->settings.simulation.engine, trial::EngineUse::judging), threads,
                 state_->dropping}));
    emit dropsChanged();
}

/// Posts the next drops after those that are done.
void StudySession::dropSome(const std::shared_ptr<const Dropping>& dropping) {
    postSimulation(dropsFailed(), dropping->control,
                   [this, dropping, first = state_->drops->sofar.drops()]() -> Deliver {
                       const auto dropped = [&]() -> base::Result<study::DropResult> {
                           auto engine = state_->environment.engines.make(dropping->engine, {1, 0.0});
                           if (!engine) return engine.error();
                           return study::simulateDrops(
                               **engine, dropping->part, dropping->settings, dropping->threads,
                               dropping->control, first,
                               kAtOnceOfEachThread * static_cast<int>(dropping->threads));
                       };
                       auto result = dropped();
                       if (!result) {
                           return std::function([this, message = result.error().message] {
                               state_->drops.reset();
                               emit dropsChanged();
                               emit failed(dropsFailed(), QString::fromStdString(message));
                           });
                       }
                       return std::function([this, dropping, some = std::move(*result)] {
                           state_->drops->sofar.add(some);
                           if (state_->drops->sofar.drops() < dropping->settings.drops) {
                               dropSome(dropping);
                           } else {
                               finishDrops(*dropping);
                           }
                           emit dropsChanged();
                       });
                   });
}

void StudySession::finishDrops(const Dropping& dropping) {
    study::DropRecord record =
        study::makeDropRecord(*dropping.part, dropping.settings, dropping.engine, state_->drops->sofar);
    record.time = QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString();
    state_->drops.reset();
    note([record](store::StudyFile& file) { return file.addDropTest(record); });
    state_->dropTests.push_back(std::move(record));
    if (state_->settings.part.poseWeights == study::PoseWeights::dropped)
        countPosesBy(study::PoseWeights::dropped);
}

void StudySession::countPosesBy(study::PoseWeights weights) {
    study::Settings settings = state_->settings;
    settings.part.poseWeights = weights;
    const auto test = dropTest();
    settings.part.droppedCounts = weights == study::PoseWeights::dropped && test
                                      ? study::countsText(test->result.counts)
                                      : std::string();
    changeSettings(settings, tr("Poses count by"));
}

void StudySession::cancelDrops() {
    state_->dropping.cancel();
    if (!state_->drops) return;
    state_->drops.reset();
    emit dropsChanged();
}

std::optional<DropProgress> StudySession::drops() const {
    return state_->drops;
}

std::optional<study::DropRecord> StudySession::dropTest() const {
    const auto& tests = state_->dropTests;
    const auto found = std::find_if(tests.rbegin(), tests.rend(), [&](const study::DropRecord& test) {
        return study::holdsFor(test, *state_->part.part);
    });
    if (found == tests.rend()) return std::nullopt;
    return *found;
}

}  // namespace trapwright::session
