#include <SQLiteCpp/SQLiteCpp.h>

#include <QTemporaryDir>
#include <QtTest>

#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

/// The first message of all that a study can be asked for; empty where it tells everything.
QString firstMessage(const StudyFile& study) {
    QString message;
    const auto check = [&](const auto& result) {
        if (!result && message.isEmpty()) message = QString::fromStdString(result.error().message);
    };
    check(study.loadGeneration(0));
    check(study.loadSummaries());
    check(study.loadWinners());
    check(study.loadChecks());
    check(study.loadSelections());
    check(study.loadValidations());
    check(study.loadPhysicalValidations());
    check(study.loadDropTests());
    return message;
}

void fill(StudyFile& study) {
    VERIFY_OK(study.saveGeneration(sample::generation(0)));
    VERIFY_OK(study.saveCheck({{0, 0}, 10, {"native", {}, 9, 8}, {"simbody", {}, 7, 6}}));
    study::SelectionRecord selection;
    selection.entries.push_back({});
    selection.entries[0].trials = 10;
    VERIFY_OK(study.saveSelection(selection));
    study::ValidationRecord validation;
    validation.rows.push_back({0, {6, 2, 1, 1}});
    VERIFY_OK(study.saveValidation(validation));
    study::PhysicalValidation physical;
    physical.plan.poses = {0, 1};
    physical.trials.push_back({});
    physical.trials[0].time = "2026-03-31T10:00:00Z";
    VERIFY_OK(study.addPhysicalValidation(physical));
    study::DropRecord dropped;
    dropped.poses = {base::Quaternion::Identity(), base::Quaternion(0.5, 0.5, 0.5, 0.5)};
    dropped.result.counts = {600, 390};
    dropped.result.unsettled = 10;
    VERIFY_OK(study.addDropTest(dropped));
}

}  // namespace

/// Values that SQLite takes and that no program of ours writes. Statistics and tables rely on counts that are
/// possible: an interval of 5 successes in 3 trials is an exception of Boost's, and the end of the program.
class StudyValuesTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "study.trap";
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        fill(*study);
        QCOMPARE(firstMessage(*study), QString());
    }

    void impossibleCountsAreDamage_data() {
        QTest::addColumn<QString>("change");
        QTest::addColumn<QString>("what");
        const auto row = [](const char* change, const char* what) {
            QTest::newRow(change) << change << what;
        };
        row("individual SET oriented = trials + 1", "the winner of generation 0");
        row("individual SET oriented = -1", "the winner of generation 0");
        row("individual SET finished = 1000", "individual 0 of generation 0");
        row("individual SET trials = -1", "individual 0 of generation 0");
        row("individual SET overlaps = -1", "individual 0 of generation 0");
        row("winner_check SET learning_finished = 11", "the check of generation 0");
        row("winner_check SET reference_oriented = -1", "the check of generation 0");
        row("winner_check SET trials = 0", "the check of generation 0");
        row("selection_entry SET oriented = 11", "the counts of a selection");
        row("selection_entry SET trials = -3", "the counts of a selection");
        row("selection_entry SET goal = '[]'", "the goal of a selection");
        row("validation SET goal = '{\"rotation\": 1}'", "the goal of a validation");
        row("validation_row SET failures = 11", "the counts of a validation");
        row("validation_row SET pose = -1", "the counts of a validation");
        row("validation_row SET stuck = -1", "the counts of a validation");
        row("physical_validation SET repetitions = -1", "the number of repetitions");
        row("physical_validation SET repetitions = 2000000000", "the number of repetitions");
        row("physical_pose SET pose = -1", "a pose of a physical validation");
        row("physical_trial SET pose = 2000000000", "the pose of a trial on the feeder");
        row("drop_pose SET count = -1", "the counts of a drop test");
        row("drop_pose SET count = 2000000000", "the counts of a drop test");
        row("drop_test SET unsettled = -1", "the counts of a drop test");
    }
    void impossibleCountsAreDamage() {
        QFETCH(QString, change);
        QFETCH(QString, what);
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("UPDATE " + change.toStdString());
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        const QString message = firstMessage(*study);
        QVERIFY2(message.contains("is damaged: " + what), qPrintable(message));
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_GUILESS_MAIN(StudyValuesTest)
#include "study_values_test.moc"
