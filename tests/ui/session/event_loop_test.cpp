#include <QElapsedTimer>
#include <QTimer>
#include <QtTest>
#include <algorithm>

#include "sim/native/native_engine.h"
#include "sim/simbody/simbody_engine.h"
#include "tests/ui/session/event_loop_probe.h"
#include "tests/ui/session/session_fixture.h"

using namespace trapwright;
using namespace trapwright::session;

namespace {

/// The engines of the program, on all processors.
Environment realEnvironment(const SessionFixture& fixture) {
    Environment environment = fixture.environment();
    environment.makeEngine =
        [](const std::string& name,
           const trial::EngineOptions& options) -> base::Result<std::shared_ptr<const trial::Engine>> {
        if (name == "native")
            return std::shared_ptr<const trial::Engine>(std::make_shared<native::NativeEngine>(options));
        return std::shared_ptr<const trial::Engine>(std::make_shared<simbody::SimbodyEngine>(options));
    };
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
        settings.evolution.populationSize = 40;
        settings.evolution.trialsPerEvaluation = 40;
        settings.evolution.generations = 1000;
        settings.simulation.engine = "hybrid";
        auto made =
            StudySession::create(fixture.path("a.trap"), settings, cuboid(), realEnvironment(fixture));
        VERIFY_OK(made);
        StudySession& session = **made;
        // What a window does with every generation.
        connect(&session, &StudySession::generationSaved, this,
                [&](int generation) { QVERIFY(session.loadGeneration(generation).ok()); });
        EventLoopProbe idle;
        QTest::qWait(1000);
        const EventLoopProbe::Delays before = idle.delays();

        session.startLearning();
        QTRY_VERIFY_WITH_TIMEOUT(!session.summaries().empty(), 60000);
        EventLoopProbe busy;
        QTest::qWait(8000);
        const EventLoopProbe::Delays learning = busy.delays();
        QCOMPARE(session.state(), RunState::learning);
        qInfo(
            "event loop: idle worst %.1f ms, 99.9 %% %.1f ms; learning (%zu generations) worst %.1f ms, "
            "99.9 %% %.1f ms, of %d events",
            before.worst, before.most, session.summaries().size(), learning.worst, learning.most,
            learning.events);
        QElapsedTimer clock;
        clock.start();
        made.value().reset();
        const qint64 closing = clock.elapsed();
        qInfo("closing while it learns: %lld ms", static_cast<long long>(closing));
        QVERIFY(closing < 1000);
        // The bound is 50 ms; where other programs take the processors, this test can only be less strict.
        QVERIFY2(learning.most < 50.0, "events are late");
    }
};

QTEST_GUILESS_MAIN(EventLoopTest)
#include "event_loop_test.moc"
