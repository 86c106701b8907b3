#include <QTemporaryDir>
#include <QtTest>

#include "core/store/compare.h"
#include "core/study/runner.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;
using store::StudyFile;

namespace {

/// Learns into the study at `path` until the settings' last generation, or until `control` says stop.
base::Result<study::LearningEnd> learn(const std::filesystem::path& path, unsigned threads,
                                       const study::LearningControl& control,
                                       const std::function<void()>& afterTrial = {}) {
    auto file = StudyFile::open(path, "test");
    if (!file) return file.error();
    study::StudyInputs inputs = fake::waveInputs(threads);
    inputs.settings = file->loadSettings().value();
    auto engine = std::make_shared<fake::FakeEngine>(fake::waveLaw, threads);
    engine->afterTrial = afterTrial;
    inputs.engine = engine;
    const auto last = file->loadLearningState();
    if (!last) return last.error();
    study::LearningEvents events;
    events.save = [&](const study::GenerationRecord& record) { return file->saveGeneration(record); };
    return study::evolve(inputs, *last, events, control);
}

}  // namespace

/// The runner and the study file together.
class StudyRunTest : public QObject {
    Q_OBJECT

 private slots:
    void interruptedRunsGiveTheSameFile() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        for (const char* name : {"whole.trap", "pieces.trap"}) {
            VERIFY_OK(StudyFile::create(path / name, fake::waveInputs().settings, {}, "test"));
        }
        VERIFY_OK(learn(path / "whole.trap", 1, {}));

        // Cancelled in the middle of a generation, at another place each time, then left to end.
        int cancelled = 0;
        for (const std::int64_t trials : {70, 200, 10, 150}) {
            study::LearningControl control;
            const auto end = learn(path / "pieces.trap", 3, control, [&] {
                if (control.run.done() >= trials) control.run.cancel();
            });
            VERIFY_OK(end);
            if (*end == study::LearningEnd::cancelled) ++cancelled;
        }
        QVERIFY(cancelled >= 3);
        VERIFY_OK(learn(path / "pieces.trap", 2, {}));

        const auto whole = StudyFile::openReadOnly(path / "whole.trap");
        const auto pieces = StudyFile::openReadOnly(path / "pieces.trap");
        VERIFY_OK(whole);
        VERIFY_OK(pieces);
        QCOMPARE(whole->generationCount().value(), 5);
        QCOMPARE(store::findDifference(*whole, *pieces).value(), std::string());
    }
};

QTEST_APPLESS_MAIN(StudyRunTest)
#include "study_run_test.moc"
