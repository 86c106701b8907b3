#include "ui/session/study_state.h"

#include "core/base/parallel.h"
#include "core/study/runner.h"

namespace trapwright::session {

namespace {

// Below the window's thread, so that it answers at once while all processors learn. What somebody waits for
// goes before what goes on for hours, and that before checks of winners.
constexpr int kSimulatingSteps = 5;
constexpr int kWorkSteps = 10;

}  // namespace

StudyState::StudyState(OpenedStudy study, const Environment& environmentGiven,
                       std::function<void(const QString& what, const QString& message)> failGiven)
    : StudyRecords(std::move(study.records)),
      environment(environmentGiven),
      path(study.file.path()),
      settings(std::move(study.design.settings)),
      part{std::make_shared<const store::StoredPart>(std::move(study.design.stored)), settings.part,
           std::move(study.design.part)},
      reader(std::move(study.reader)),
      fail(std::move(failGiven)),
      writer(std::move(study.file)),
      ledger(std::make_unique<StudyLedger>(std::move(study.ledger),
                                           [this](const std::string& message) {
                                               tell([this, message = QString::fromStdString(message)] {
                                                   fail(StudySession::tr("What was noted could not be saved"),
                                                        message);
                                               });
                                           })),
      work(std::make_unique<WorkThread>([] { base::lowerPriority(kWorkSteps); })),
      simulating(std::make_unique<WorkThread>([] { base::lowerPriority(kSimulatingSteps); })) {
    findProblems();
}

void StudyState::end() {
    if (run) run->leave();
    simulated.cancel();
    estimate.cancel();
    proposing.cancel();
    speedTable.cancel();
    dropping.cancel();
    // These go first: while others have it open, the writer cannot put the study into one file.
    reader.reset();
    ledger.reset();
    simulating.reset();
    work.reset();
}

void StudyState::findProblems() {
    problems = study::findProblems(settings);
    for (std::string& problem : study::findPartProblems(settings, *part.part))
        problems.push_back(std::move(problem));
    // Once they are learned from nobody looks at them.
    if (std::string problem = study::findKnownProblem(settings, known); !problem.empty() && summaries.empty())
        problems.push_back(std::move(problem));
    recommendations = study::findRecommendations(settings);
}

base::Error StudyState::cannotRead() const {
    return {"The study " + path.string() + " can no longer be read. Close it and open it again."};
}

void StudyState::savePending() {
    if (const auto saved = writer.savePending(); !saved) {
        tell([this, message = QString::fromStdString(saved.error().message)] {
            fail(StudySession::tr("The settings could not be saved"), message);
        });
    }
}

void StudyState::postSimulation(const QString& what, const base::RunControl& control,
                                std::function<Deliver()> simulate) {
    // Who waits for trials shall not wait for an estimate; it is asked for again.
    estimate.cancel();
    countSimulations(1);
    simulating->post([this, what, control, simulate = std::move(simulate)] {
        auto deliver = control.cancelled() ? Deliver(std::function<void()>()) : simulate();
        tell([this, what, control, deliver = std::move(deliver)] {
            if (!control.cancelled()) {
                if (deliver) {
                    (*deliver)();
                } else {
                    fail(what, QString::fromStdString(deliver.error().message));
                }
            }
            countSimulations(-1);
        });
    });
}

void StudyState::countSimulations(int change) {
    simulations += change;
    simulationsChanged();
}

}  // namespace trapwright::session
