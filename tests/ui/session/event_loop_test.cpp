#include <QElapsedTimer>
#include <QTimer>
#include <QtTest>
#include <algorithm>

#include "sim/engines/registry.h"
#include "tests/ui/session/event_loop_probe.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::session;

namespace {

constexpr double kBound = 50.0;  // the studio promises not to be later [ms]

/// The engines of the program, on all processors.
Environment realEnvironment(const SessionFixture& fixture) {
    Environment environment = fixture.environment();
    environment.engines = engines::registry();
    return environment;
}

}  // namespace

/// Whether whoever clicks is answered while a study learns on every processor.
class EventLoopTest : public QObject {
    Q_OBJECT

 private slots:
    void noEventIsLateWhileItLearns() {
        const SessionFixture fixture;
        study::Settings settings = study::presetSettings("cuboid").value();
        settings.evolution.populationSize = 20;
        settings.evolution.trialsPerEvaluation = 20;
        settings.evolution.generations = 1000;
        settings.simulation.engine = "hybrid";
        auto made =
            StudySession::create(fixture.path("a.trap"), settings, cuboid(), realEnvironment(fixture));
        VERIFY_OK(made);
        StudySession& session = **made;
        // What a window does with every generation.
        connect(&session.runs(), &StudyRuns::generationSaved, this,
                [&](int generation) { QVERIFY(session.runs().loadGeneration(generation).ok()); });
        const EventDelays before = watchEvents(2000);
        qInfo("idle: worst %.1f ms, 99.9 %% %.1f ms", before.worst, before.most);

        session.runs().startLearning();
        QVERIFY(waitUntil([&] { return !session.runs().summaries().empty(); }));
        // What other programs do to this thread's group is not ours: the best of a few looks counts.
        double best = 1e9;
        const std::size_t generations = session.runs().summaries().size();
        for (int look = 0; look < 4 && (best > kBound || session.runs().summaries().size() == generations);
             ++look) {
            const EventDelays learning = watchEvents(5000);
            best = std::min(best, learning.worst);
            qInfo("learning: worst %.1f ms, 99.9 %% %.1f ms, %d events, %zu generations", learning.worst,
                  learning.most, learning.events, session.runs().summaries().size());
        }
        QCOMPARE(session.runs().state(), RunState::learning);
        QVERIFY(session.runs().summaries().size() > generations);
        QElapsedTimer clock;
        clock.start();
        made.value().reset();
        const qint64 closing = clock.elapsed();
        qInfo("closing while it learns: %lld ms", static_cast<long long>(closing));
        QVERIFY(closing < 1000);
        QVERIFY2(best < kBound, "events are late");
    }
};

QTEST_GUILESS_MAIN(EventLoopTest)
#include "event_loop_test.moc"
