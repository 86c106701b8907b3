#include <QJsonArray>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"
#include "tests/core/store/stored_outcomes.h"

using namespace trapwright;
using namespace trapwright::test;

/// Replays of trials whose outcomes a study holds, through the program.
class StoredTrialsTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        QVERIFY(folder_->isValid());
        QVERIFY(ask(quickStudy("study.trap", 2)).code == 0);
    }

    void whereAReplayEndsAsStoredNothingIsSaid() {
        const Ran ran = replay();
        QVERIFY2(ran.code == 0, ran.all());
        QVERIFY(ran.json().contains("stored_otherwise") && ran.json()["stored_otherwise"].isNull());
        QVERIFY2(!ran.errors.contains("otherwise"), ran.all());
    }

    void whereItEndsOtherwiseItIsSaid() {
        const QJsonObject before = replay().json();
        sample::changeMaker(path(), {"trapwright 0.0-other", "native", "AVX9"});
        QVERIFY(replay().json()["stored_otherwise"].isNull());
        sample::changeOutcomes(path(), 1, [](std::size_t, trial::PartOutcome& outcome) {
            outcome.ending = trial::Ending::timedOut;
            outcome.time = 9.75;
        });
        const Ran ran = replay();
        QVERIFY2(ran.code == 0, ran.all());
        QVERIFY2(ran.errors.contains("ends otherwise than the stored trial"), ran.all());
        QVERIFY2(ran.errors.contains("trapwright 0.0-other, native with AVX9"), ran.all());
        const QJsonObject stored = ran.json()["stored_otherwise"].toObject();
        QCOMPARE(stored["ending"].toString(), "timed out");
        QCOMPARE(stored["time_s"].toDouble(), 9.75);
        QCOMPARE(stored["instruction_set"].toString(), "AVX9");
        // The replay itself is as it was.
        QCOMPARE(ran.json()["ending"], before["ending"]);
        QCOMPARE(ran.json()["samples"], before["samples"]);
    }

    void withoutStoredOutcomesItIsAReplayAsEver() {
        const QJsonObject before = replay().json();
        sample::dropOutcomes(path());
        QCOMPARE(replay().json(), before);
    }

    void damageIsRefused() {
        sample::alter(path(), "UPDATE outcomes SET trials = x'00'");
        const Ran ran = replay();
        QCOMPARE(ran.code, 3);
        QVERIFY2(ran.errors.contains("study.trap is damaged"), ran.all());
        QCOMPARE(ask({"dump", "study.trap"}).code, 0);
    }

 private:
    [[nodiscard]] Ran ask(const QStringList& arguments) const { return run(folder_->path(), arguments); }
    [[nodiscard]] Ran replay() const {
        return ask(
            {"replay", "study.trap", "--generation", "1", "--individual", "2", "--trial", "1", "--json"});
    }
    [[nodiscard]] std::filesystem::path path() const { return folder_->filePath("study.trap").toStdString(); }

    std::unique_ptr<QTemporaryDir> folder_;
};

QTEST_GUILESS_MAIN(StoredTrialsTest)
#include "stored_trials_test.moc"
