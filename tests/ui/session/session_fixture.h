#pragma once

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "core/workflow/part_source.h"
#include "tests/core/study/fake_engine.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::session {

inline const std::string kProgram = "trapwright 0.0-test";

/// The 4 x 8 x 12 mm cuboid.
inline const ImportedPart& cuboid() {
    static const ImportedPart part = workflow::importPart({"cuboid"}).value();
    return part;
}

/// A study of the cuboid with few individuals and trials.
inline study::Settings smallSettings(int generations = 3) {
    study::Settings settings = study::presetSettings("cuboid").value();
    settings.evolution.populationSize = 8;
    settings.evolution.trialsPerEvaluation = 4;
    settings.evolution.generations = generations;
    settings.evolution.tournamentSize = 3;
    settings.evolution.seed = 7;
    settings.simulation.engine = "native";
    settings.validation.selectionWinners = 2;
    settings.validation.selectionTrials = 20;
    settings.validation.selectionCornerTrials = 16;
    settings.validation.trialsPerPose = 10;
    return settings;
}

/// Studies in a folder of their own, judged by a law instead of mechanics.
class SessionFixture {
 public:
    /// Every trial takes this long, so that something can be done while a study learns.
    std::chrono::milliseconds trialTime{0};

    [[nodiscard]] std::filesystem::path path(const std::string& name) const {
        return std::filesystem::path(folder_.path().toStdString()) / name;
    }

    [[nodiscard]] Environment environment() const {
        Environment environment;
        environment.program = kProgram;
        environment.stateFolder = path("state");
        environment.engines = fake::lawEngines(fake::waveLaw, [time = trialTime] {
            if (time.count() > 0) std::this_thread::sleep_for(time);
        });
        return environment;
    }

    [[nodiscard]] std::unique_ptr<StudySession> create(const std::string& name,
                                                       const study::Settings& settings) const {
        auto made = StudySession::create(path(name), settings, cuboid(), environment());
        return made ? std::move(*made) : nullptr;
    }

    [[nodiscard]] std::unique_ptr<StudySession> open(const std::string& name) const {
        auto opened = StudySession::open(path(name), environment());
        return opened ? std::move(*opened) : nullptr;
    }

 private:
    QTemporaryDir folder_;
};

/// Patiently, because the work in the background is of low priority.
template <class Condition>
bool waitUntil(Condition condition) {
    return QTest::qWaitFor(condition, 60000);
}

inline bool waitForState(const StudySession& session, RunState state) {
    return waitUntil([&] { return session.runs().state() == state; });
}

inline bool learnToTheEnd(StudySession& session) {
    session.runs().startLearning();
    return session.runs().state() == RunState::learning && waitForState(session, RunState::idle);
}

}  // namespace trapwright::session
