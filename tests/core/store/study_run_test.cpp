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
    // A copy learns on elsewhere; what it adds comes home while it grows, and learning goes on here from
    // there.
    void whatACopyLearnsComesHome() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        const study::Settings settings = fake::waveInputs().settings;
        study::Settings longer = settings;
        longer.evolution.generations = settings.evolution.generations + 3;
        VERIFY_OK(StudyFile::create(path / "home.trap", settings, {}, "test"));
        study::LearningControl first;
        first.setGenerations(1);
        VERIFY_OK(learn(path / "home.trap", 1, first));
        VERIFY_OK(StudyFile::openReadOnly(path / "home.trap")->copyTo(path / "away.trap"));
        {
            auto home = StudyFile::open(path / "home.trap", "test");
            VERIFY_OK(home);
            for (const int generations : {1, 2, 4}) {
                study::LearningControl control;
                control.setGenerations(generations);
                VERIFY_OK(learn(path / "away.trap", 2, control));
                const auto away = StudyFile::openReadOnly(path / "away.trap");
                const int before = home->generationCount().value();
                const auto taken = home->takeGenerations(*away);
                VERIFY_OK(taken);
                QCOMPARE(static_cast<int>(taken->generations.size()), generations - before);
                QCOMPARE(home->generationCount().value(), generations);
                QCOMPARE(store::findDifference(*home, *away).value(), std::string());
                // With the trials.
                const auto own = home->loadLearningOutcomes({generations - 1, 0});
                const auto theirs = away->loadLearningOutcomes({generations - 1, 0});
                QCOMPARE(own.value().has_value(), theirs.value().has_value());
                if (own.value()) QVERIFY(store::unpack(**own).value() == store::unpack(**theirs).value());
            }
            VERIFY_OK(home->changeSettings(longer));
        }
        VERIFY_OK(StudyFile::open(path / "away.trap", "test")->changeSettings(longer));
        VERIFY_OK(learn(path / "home.trap", 1, {}));
        VERIFY_OK(learn(path / "away.trap", 1, {}));
        auto home = StudyFile::open(path / "home.trap", "test");
        const auto away = StudyFile::openReadOnly(path / "away.trap");
        QCOMPARE(home->generationCount().value(), longer.evolution.generations);
        QCOMPARE(store::findDifference(*home, *away).value(), std::string());
        // Who has less adds nothing.
        VERIFY_OK(StudyFile::create(path / "young.trap", settings, {}, "test"));
        QVERIFY(home->takeGenerations(*StudyFile::openReadOnly(path / "young.trap"))->generations.empty());
    }

    void onlyACopysGenerationsAreTaken() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        study::Settings settings = fake::waveInputs().settings;
        settings.evolution.generations = 2;
        VERIFY_OK(StudyFile::create(path / "home.trap", settings, {}, "test"));
        settings.evolution.seed += 1;
        VERIFY_OK(StudyFile::create(path / "seed.trap", settings, {}, "test"));
        VERIFY_OK(learn(path / "seed.trap", 1, {}));
        auto home = StudyFile::open(path / "home.trap", "test");
        const auto taken = home->takeGenerations(*StudyFile::openReadOnly(path / "seed.trap"));
        QVERIFY(!taken.ok());
        QVERIFY2(taken.error().message.find("other settings") != std::string::npos,
                 taken.error().message.c_str());
        settings.evolution.seed -= 1;
        store::StoredPart part;
        part.mesh.vertices = {{0, 0, 1}};
        VERIFY_OK(StudyFile::create(path / "part.trap", settings, part, "test"));
        const auto other = home->takeGenerations(*StudyFile::openReadOnly(path / "part.trap"));
        QVERIFY(!other.ok() && other.error().message.find("part is another one") != std::string::npos);
        QCOMPARE(home->generationCount().value(), 0);
    }

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
