// The window while its study learns, with the program's own engines.

#include <QMessageBox>
#include <QPushButton>
#include <optional>

#include "core/study/presets.h"
#include "core/study/selection.h"
#include "sim/engines/registry.h"
#include "tests/ui/window/user.h"
#include "ui/models/numbers.h"
#include "ui/session/part_import.h"
#include "ui/session/recovery_note.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using session::RunState;

namespace {

constexpr int kPatience = 60000;  // [ms]

}  // namespace

class RunningTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        tests::useFolder(folder_, "running_test");
        state_ = folder_.filePath("running").toStdString();
        makeStudy();
    }

    void startPauseResumeAndStop() {
        window::MainWindow window{{engines::registry(), "trapwright test", state_}};
        open(window);
        auto* session = window.desk().session();
        auto* state = window.findChild<QLabel*>("status.state");
        action(window, "run.start")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::learning, kPatience);
        QCOMPARE(state->text(), QString("Learning"));
        QVERIFY(!action(window, "run.start")->isEnabled());
        QTRY_VERIFY_WITH_TIMEOUT(!window.findChild<QLabel*>("status.speed")->text().isEmpty(), kPatience);

        action(window, "run.pause")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::paused, kPatience);
        QCOMPARE(state->text(), QString("Paused"));
        QVERIFY(action(window, "run.start")->isEnabled() && !action(window, "run.pause")->isEnabled());
        action(window, "run.start")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::learning, kPatience);

        QTRY_VERIFY_WITH_TIMEOUT(!session->runs().summaries().empty(), kPatience);
        action(window, "run.stopAfterGeneration")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::idle, kPatience);
        QVERIFY(window.findChild<QLabel*>("status.generation")->text().endsWith("of 100000 generations"));
        const study::Individual* best = session->runs().bestWinner();
        auto* success = window.findChild<QLabel*>("status.success");
        QVERIFY(success->isVisible());
        QCOMPARE(success->text(), "success " + models::successWord(best->record.success()));
        // The settings belong to the scores from now on.
        window.showPage("track");
        QVERIFY(window.findChild<QWidget*>("track.locked")->isVisible());
        QVERIFY(!window.findChild<QWidget*>("field.track.segmentWidth_mm")->isEnabled());
        QVERIFY(window.findChild<QWidget*>("field.evolution.generations")->isEnabled());
    }

    void closingWhileItRunsAsks() {
        window::MainWindow window{{engines::registry(), "trapwright test", state_}};
        open(window);
        auto* session = window.desk().session();
        const std::size_t before = session->runs().summaries().size();
        action(window, "run.start")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::learning, kPatience);
        // Before its first generation a run has none to wait for.
        QTRY_VERIFY_WITH_TIMEOUT(session->runs().progress().trials > 0, kPatience);

        answer(window, "answer.goOn");
        QTRY_VERIFY(window.findChild<QMessageBox*>("dialog.running") == nullptr);
        QVERIFY(window.isVisible());
        QCOMPARE(session->runs().state(), RunState::learning);

        answer(window, "answer.stopAfter");
        QTRY_VERIFY_WITH_TIMEOUT(!window.isVisible(), kPatience);
        QVERIFY(session->runs().summaries().size() > before);
    }

    void stoppingNowClosesAtOnce() {
        window::MainWindow window{{engines::registry(), "trapwright test", state_}};
        open(window);
        action(window, "run.start")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(window.desk().session()->runs().state(), RunState::learning, kPatience);
        answer(window, "answer.stopNow");
        QTRY_VERIFY_WITH_TIMEOUT(!window.isVisible(), 5000);
    }

    // Nothing but the generation in progress is lost, and the user is asked where the rest is to go.
    void aStudyThatIsDeletedWhileItLearnsIsSavedElsewhere() {
        const QString study = folder_.filePath("gone.trap");
        QVERIFY(QFile::copy(QString::fromStdString(study_), study));
        window::MainWindow window{{engines::registry(), "trapwright test", state_}};
        window.show();
        window.openFile(study.toStdString());
        QTRY_VERIFY_WITH_TIMEOUT(window.desk().session() != nullptr, kPatience);
        auto* session = window.desk().session();
        action(window, "run.start")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(session->runs().summaries().size() >= 2, kPatience);
        QVERIFY(QFile::remove(study));
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::idle, kPatience);
        QVERIFY(!session->isInPlace());
        auto* message = window.findChild<look::MessageBar*>("messageBar");
        QVERIFY2(message->text().contains("was deleted or moved"), qPrintable(message->text()));
        QPushButton* save = message->findChild<QPushButton*>();
        QCOMPARE(save->text(), QString("Save a copy..."));
        const std::size_t learned = session->runs().summaries().size();

        // The old name is still kept for it; another one takes all, and learning goes on there.
        QVERIFY(!window.desk().saveAs(study.toStdString()).ok());
        const auto copy = folder_.filePath("rescued.trap").toStdString();
        const auto saved = window.desk().saveAs(copy);
        QVERIFY2(saved.ok(), saved.ok() ? "" : saved.error().message.c_str());
        QVERIFY(session->isInPlace());
        QCOMPARE(store::StudyFile::openReadOnly(copy).value().generationCount().value(),
                 static_cast<int>(learned));
        action(window, "run.start")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(session->runs().summaries().size() > learned, kPatience);
        action(window, "run.stopNow")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(session->runs().state(), RunState::idle, kPatience);
        QCOMPARE(store::StudyFile::openReadOnly(copy).value().generationCount().value(),
                 static_cast<int>(session->runs().summaries().size()));
    }

    // The note of a program that is gone: its lock is free, its file is there.
    void afterABadEndItOffersToGoOn() {
        {
            window::MainWindow window{{engines::registry(), "trapwright test", state_}};
            open(window);
            action(window, "run.start")->trigger();
            QTRY_COMPARE_WITH_TIMEOUT(window.desk().session()->runs().state(), RunState::learning, kPatience);
            QTRY_VERIFY_WITH_TIMEOUT(hasNote(), kPatience);
            std::filesystem::copy(state_, copy_, std::filesystem::copy_options::recursive);
        }
        std::filesystem::remove_all(state_);
        std::filesystem::copy(copy_, state_, std::filesystem::copy_options::recursive);

        window::MainWindow window{{engines::registry(), "trapwright test", state_}};
        window.show();
        auto* message = window.findChild<look::MessageBar*>("messageBar");
        QTRY_VERIFY_WITH_TIMEOUT(message->text().contains("study was learning"), kPatience);
        QPushButton* goOn = message->findChild<QPushButton*>();
        QCOMPARE(goOn->text(), QString("Go on learning"));
        QTest::mouseClick(goOn, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(window.desk().session() != nullptr, kPatience);
        QTRY_COMPARE_WITH_TIMEOUT(window.desk().session()->runs().state(), RunState::learning, kPatience);
    }

 private:
    void makeStudy() {
        session::PartImport import;
        std::optional<workflow::LoadedPart> part;
        connect(&import, &session::PartImport::finished,
                [&](const workflow::LoadedPart& one) { part = one; });
        workflow::PartRequest request;
        request.part = "cuboid";
        import.start(request);
        QVERIFY(QTest::qWaitFor([&] { return part.has_value(); }, kPatience));
        study::Settings settings = study::presetSettings("cuboid").value();
        settings.part = part->settings;
        settings.simulation.engine = "native";
        settings.evolution.populationSize = 6;
        settings.evolution.trialsPerEvaluation = 10;
        settings.evolution.generations = 100000;
        study_ = folder_.filePath("study.trap").toStdString();
        QVERIFY(store::StudyFile::create(study_, settings, part->stored, "trapwright test").ok());
    }
    void open(window::MainWindow& window) {
        window.show();
        window.openFile(study_);
        QVERIFY(QTest::qWaitFor([&] { return window.desk().session() != nullptr; }, kPatience));
    }
    /// Its lock is there before it.
    [[nodiscard]] bool hasNote() const {
        std::error_code missing;
        for (const auto& entry : std::filesystem::directory_iterator(state_, missing)) {
            if (entry.path().extension() == ".note") return true;
        }
        return false;
    }
    static QAction* action(window::MainWindow& window, const char* name) {
        return window.findChild<QAction*>(name);
    }
    static void answer(window::MainWindow& window, const char* name) {
        window.close();
        auto* question = window.findChild<QMessageBox*>("dialog.running");
        QVERIFY(question != nullptr && question->isVisible());
        QTest::mouseClick(question->findChild<QPushButton*>(name), Qt::LeftButton);
    }

    QTemporaryDir folder_;
    std::filesystem::path state_;
    std::filesystem::path copy_ = std::filesystem::path(folder_.filePath("copy").toStdString());
    std::filesystem::path study_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    RunningTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "running_test.moc"
