#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTableView>
#include <QToolButton>
#include <QtTest>

#include "core/trial/recorded_motion.h"
#include "sim/native/native_engine.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/look/message_bar.h"
#include "ui/models/selection_model.h"
#include "ui/models/trial_model.h"
#include "ui/models/validation_model.h"
#include "ui/pages/page.h"
#include "ui/pages/replay_files.h"
#include "ui/pages/replay_player.h"
#include "ui/scene/scene_view.h"
#include "ui/window/main_window.h"

using namespace trapwright;
using models::TrialModel;
using models::ValidationModel;
using pages::ReplayPlayer;
using work::TrialVerdict;

namespace {

constexpr int kPatience = 60000;  // [ms] for what happens in the background, on a busy machine

session::Environment nativeEnvironment() {
    session::Environment environment;
    environment.program = "trapwright test";
    environment.makeEngine =
        [](const std::string&,
           const trial::EngineOptions& options) -> base::Result<std::shared_ptr<const trial::Engine>> {
        return std::shared_ptr<const trial::Engine>(std::make_shared<native::NativeEngine>(options));
    };
    return environment;
}

/// Low hills, on which parts finish, turn, stop and fall in a few generations.
study::Settings lowHills() {
    study::Settings settings = session::smallSettings(2);
    settings.evolution.trialsPerEvaluation = 16;
    settings.track.segmentHeight = 6e-3;
    settings.validation.selectionTrials = 80;
    settings.validation.trialsPerPose = 80;
    return settings;
}

/// The window with the study in it, and what a user does there.
struct User {
    window::MainWindow window{nativeEnvironment()};

    explicit User(const QString& study) {
        window.resize(1280, 720);
        window.show();
        window.activateWindow();
        (void)QTest::qWaitForWindowActive(&window);
        window.openFile(study.toStdString());
        (void)QTest::qWaitFor([&] { return session() != nullptr; }, kPatience);
        window.showPage("review");
    }
    ~User() {
        window.desk().close(false);
        window.close();
    }
    session::StudySession* session() { return window.desk().session(); }
    template <class Object>
    Object* find(const QString& name) {
        return window.findChild<Object*>(name);
    }
    void trigger(const QString& action) { find<QAction>(action)->trigger(); }
    void press(int key) { QTest::keyClick(find<scene::SceneView>("scene"), Qt::Key(key)); }
    void click(const QTableView& table, int row, int column) {
        const QRect cell = table.visualRect(table.model()->index(row, column));
        QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, cell.center());
    }
    QString message() { return find<look::MessageBar>("messageBar")->text(); }

    ReplayPlayer& player() { return *window.findChild<ReplayPlayer*>(); }
    const scene::SceneContents& scene() { return find<scene::SceneView>("scene")->contents(); }
    QTableView& trials() { return *find<QTableView>("trials.table"); }
    QTableView& validation() { return *find<QTableView>("review.validation.table"); }
    QTableView& comparison() { return *find<QTableView>("review.comparison.table"); }
    pages::ReplayFiles& files() { return *window.findChild<pages::ReplayFiles*>(); }

    /// The first trial of the list in the scene.
    bool waitForReplay() {
        return QTest::qWaitFor([&] { return player().duration() > 0.0 && scene().partPoses.size() == 1; }, kPatience);
    }
    bool validate() {
        trigger("review.validate");
        return QTest::qWaitFor([&] { return validation().model()->rowCount() > 0; }, kPatience);
    }
};

/// What ffprobe says of a film's picture stream.
QMap<QString, QString> probe(const QString& file) {
    QProcess ffprobe;
    ffprobe.start("ffprobe", {"-v", "error", "-select_streams", "v:0", "-show_entries",
                              "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_frames,duration", "-of",
                              "default=noprint_wrappers=1", file});
    ffprobe.waitForFinished(kPatience);
    QMap<QString, QString> values;
    for (const QByteArray& line : ffprobe.readAllStandardOutput().split('\n')) {
        const qsizetype at = line.indexOf('=');
        if (at > 0) values.insert(QString::fromUtf8(line.left(at)), QString::fromUtf8(line.mid(at + 1)));
    }
    return values;
}

}  // namespace

class ReviewPageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        qputenv("XDG_DATA_HOME", folder_.filePath("data").toLocal8Bit());
        QCoreApplication::setOrganizationName("Trapwright");
        QCoreApplication::setApplicationName("review_page_test");
        auto made = session::StudySession::create(folder_.filePath("learned.trap").toStdString(), lowHills(),
                                                  session::cuboid(), nativeEnvironment());
        VERIFY_OK(made);
        QVERIFY(session::learnToTheEnd(**made));
        QCOMPARE((*made)->winners().size(), std::size_t{2});
    }
    void init() {
        QSettings().clear();
        study_ = folder_.filePath(QString("study%1.trap").arg(++count_));
        QVERIFY(QFile::copy(folder_.filePath("learned.trap"), study_));
    }

    void trialsOfTheLastWinnerAreListed() {
        User user(study_);
        QTRY_COMPARE_WITH_TIMEOUT(user.trials().model()->rowCount(), 16, kPatience);
        int counted = 0;
        for (int verdict = 0; verdict < 4; ++verdict)
            counted += user.find<QToolButton>(QString("trials.chip%1").arg(verdict))->text().section(' ', 0, 0).toInt();
        QCOMPARE(counted, 16);
        // The first one is in the scene, with its path, and stands still.
        QVERIFY(user.waitForReplay());
        QVERIFY(user.scene().track && user.scene().part);
        QCOMPARE(user.scene().traces.size(), std::size_t{1});
        QVERIFY(!user.player().playing());
    }

    void filterShowsOneKindOfOutcome() {
        User user(study_);
        QTRY_COMPARE_WITH_TIMEOUT(user.trials().model()->rowCount(), 16, kPatience);
        for (int kept = 0; kept < 4; ++kept) {
            int expected = 0;
            for (int verdict = 0; verdict < 4; ++verdict) {
                auto* chip = user.find<QToolButton>(QString("trials.chip%1").arg(verdict));
                if (chip->isChecked() != (verdict == kept)) chip->click();
                if (verdict == kept) expected = chip->text().section(' ', 0, 0).toInt();
            }
            const QAbstractItemModel& shown = *user.trials().model();
            QCOMPARE(shown.rowCount(), expected);
            for (int row = 0; row < shown.rowCount(); ++row)
                QCOMPARE(shown.index(row, 0).data(models::VerdictRole).toInt(), kept);
        }
    }

    void keysPlayStepAndJump() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        ReplayPlayer& player = user.player();
        const base::Vec3 start = user.scene().partPoses.front().position;
        user.press(Qt::Key_Space);
        QVERIFY(player.playing());
        QTRY_VERIFY(player.time() > 0.1);
        user.press(Qt::Key_Space);
        QVERIFY(!player.playing());
        const double stopped = player.time();
        QVERIFY((user.scene().partPoses.front().position - start).norm() > 1e-6);
        user.press(Qt::Key_Right);
        QVERIFY(std::abs(player.time() - stopped - 1e-3) < 1e-9);
        user.press(Qt::Key_Left);
        QVERIFY(std::abs(player.time() - stopped) < 1e-9);
        QTest::keyClick(user.find<scene::SceneView>("scene"), Qt::Key_Right, Qt::ShiftModifier);
        QVERIFY(std::abs(player.time() - stopped - 1.0 / 50.0) < 1e-9);
        user.press(Qt::Key_End);
        QCOMPARE(player.time(), player.duration());
        user.press(Qt::Key_Home);
        QCOMPARE(player.time(), 0.0);
        user.find<QSlider>("transport.line")->setValue(250);
        QCOMPARE(player.time(), 0.25);
        // 0.25 s are 12.5 periods of 50 Hz.
        const QString text = user.find<QLabel>("transport.time")->text();
        QVERIFY2(text.contains(QLocale().toString(0.25, 'f', 3)) && text.contains(QLocale().toString(12.5, 'f', 1)),
                 qPrintable(text));
    }

    void loopBeginsAgainAndSpeedHasItsLimits() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        ReplayPlayer& player = user.player();
        player.setSpeed(100.0);
        QCOMPARE(player.speed(), 4.0);
        QCOMPARE(user.find<QComboBox>("transport.speed")->currentData().toDouble(), 4.0);
        player.setTime(player.duration() - 0.01);
        player.play();
        QTRY_VERIFY(!player.playing());
        QCOMPARE(player.time(), player.duration());
        user.trigger("replay.loop");
        player.setTime(player.duration() - 0.01);
        player.play();
        QTRY_VERIFY(player.time() < player.duration() - 0.02);
        QVERIFY(player.playing());
        player.pause();
        player.setSpeed(0.0);
        QCOMPARE(player.speed(), 0.05);
    }

    // A button that has the focus keeps its key.
    void spaceOnAButtonPressesIt() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        auto* chip = user.find<QToolButton>("trials.chip0");
        chip->setFocus(Qt::TabFocusReason);
        QTest::keyClick(chip, Qt::Key_Space);
        QVERIFY(!chip->isChecked());
        QVERIFY(!user.player().playing());
    }

    void ghostsHaveTheColoursOfTheirOutcomes() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        user.find<QSpinBox>("trials.ghosts")->setValue(5);
        QTRY_COMPARE_WITH_TIMEOUT(user.scene().partPoses.size(), std::size_t{6}, kPatience);
        QVERIFY(!user.scene().partColours.front().isValid());
        for (std::size_t i = 1; i < 6; ++i)
            QVERIFY(user.scene().partColours[i].isValid());
        QCOMPARE(user.scene().traces.size(), std::size_t{6});
        user.trigger("replay.trace");
        QVERIFY(user.scene().traces.empty());
        user.find<QSpinBox>("trials.ghosts")->setValue(0);
        QTRY_COMPARE(user.scene().partPoses.size(), std::size_t{1});
    }

    // Over a second of resting and hopping the track carries the part's weight on average.
    void forcesAreDrawnOnRequest() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        QVERIFY(user.scene().contacts.empty() && !user.scene().forceLegend);
        user.trigger("replay.forces");
        QVERIFY(user.scene().forceLegend);
        bool pressed = false;
        for (double time = 0.0; time < std::min(user.player().duration(), 0.5); time += 1e-3) {
            user.player().setTime(time);
            for (const scene::ContactArrow& arrow : user.scene().contacts)
                pressed = pressed || arrow.force.z() > 0.0;
        }
        QVERIFY(pressed);
        user.trigger("replay.forces");
        QVERIFY(user.scene().contacts.empty() && !user.scene().forceLegend);
    }

    void winnersAreComparedAndOneIsChosen() {
        User user(study_);
        user.trigger("review.compare");
        QVERIFY(!user.find<QAction>("review.compare")->isEnabled());
        QTRY_COMPARE_WITH_TIMEOUT(user.comparison().model()->rowCount(), 2, kPatience);
        // The best is looked at by itself, and counts until the user says otherwise.
        const auto best = user.session()->selections().back().entries.front();
        QCOMPARE(user.session()->chosen()->generation, best.generation);
        QTRY_VERIFY(user.session()->state() == session::RunState::idle || user.waitForReplay());
        user.find<QDockWidget>("dock.review.comparison")->raise();
        user.click(user.comparison(), 1, models::SelectionModel::Generation);
        const auto second = user.session()->selections().back().entries.back();
        QTRY_VERIFY(user.find<QComboBox>("review.track")->currentText().contains(
            QString("Generation %1, individual %2").arg(second.generation).arg(second.individual)));
        user.find<QPushButton>("review.makeFinal")->click();
        QCOMPARE(user.session()->chosen()->generation, second.generation);
        QCOMPARE(user.session()->chosen()->individual, second.individual);
        QVERIFY(!user.find<QPushButton>("review.makeFinal")->isVisible());
    }

    void aFailedRowLeadsToItsReplay() {
        User user(study_);
        QVERIFY(user.validate());
        const study::ValidationRecord& table = user.session()->validations().back();
        QCOMPARE(user.validation().model()->rowCount(), static_cast<int>(table.rows.size()) + 1);
        int row = -1;
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            if (table.rows[i].wrongOrientation > 0) row = static_cast<int>(i);
        QVERIFY2(row >= 0, "The study of this test has no such failure.");
        user.validation().scrollTo(user.validation().model()->index(row, 0));
        user.click(user.validation(), row, ValidationModel::WrongOrientation);
        QTRY_VERIFY_WITH_TIMEOUT(user.player().playing(), kPatience);
        QCOMPARE(user.scene().partPoses.size(), std::size_t{1});
        const auto& wanted = table.rows[static_cast<std::size_t>(row)];
        QVERIFY(user.find<QComboBox>("trials.source")->currentText().contains(QString::number(wanted.pose + 1)));
        // All of them in the end, and nothing else.
        const QAbstractItemModel& shown = *user.trials().model();
        QTRY_COMPARE_WITH_TIMEOUT(shown.rowCount(), wanted.wrongOrientation, kPatience);
        for (int i = 0; i < shown.rowCount(); ++i)
            QCOMPARE(shown.index(i, 0).data(models::VerdictRole).toInt(),
                     static_cast<int>(TrialVerdict::wrongOrientation));
        QVERIFY(user.message().isEmpty());
    }

    void anotherPageEndsTheReplay() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        user.player().play();
        user.window.showPage("part");
        QVERIFY(!user.player().playing());
        QVERIFY(user.scene().stablePoses && !user.scene().track);
        user.window.showPage("review");
        QVERIFY(user.scene().track && user.scene().part);
        user.window.desk().close(true);
        QTRY_COMPARE(user.trials().model()->rowCount(), 0);
    }

    void withoutGenerationsThePageSaysWhatToDo() {
        const QString empty = folder_.filePath("empty.trap");
        auto made = session::StudySession::create(empty.toStdString(), lowHills(), session::cuboid(),
                                                  nativeEnvironment());
        VERIFY_OK(made);
        made->reset();
        User user(empty);
        QVERIFY(!user.find<QAction>("review.validate")->isEnabled());
        QVERIFY(user.find<QAction>("review.validate")->toolTip().contains("Learn"));
        QVERIFY(!user.find<QAction>("replay.play")->isEnabled());
        QVERIFY(!user.find<QPushButton>("review.saveMovie")->isEnabled());
    }

    void aFilmIsOneSecondLong() {
        if (QStandardPaths::findExecutable("ffmpeg").isEmpty()) QSKIP("ffmpeg is not installed");
        User user(study_);
        QVERIFY(user.waitForReplay());
        // The trial that fits best into a second.
        user.player().setSpeed(user.player().duration());
        const double seconds = user.player().duration() / user.player().speed();
        user.files().setFramesPerSecond(25);
        user.files().setPictureSize({1280, 720});
        const QString file = folder_.filePath("replay.mp4");
        user.files().saveMovie(file);
        QVERIFY(user.files().movie().busy());
        QTRY_VERIFY_WITH_TIMEOUT(!user.files().movie().busy(), 3 * kPatience);
        QVERIFY2(user.message().isEmpty(), qPrintable(user.message()));
        const QMap<QString, QString> film = probe(file);
        QCOMPARE(film["codec_name"], QString("h264"));
        QCOMPARE(film["pix_fmt"], QString("yuv420p"));
        QCOMPARE(film["width"], QString("1280"));
        QCOMPARE(film["height"], QString("720"));
        QCOMPARE(film["r_frame_rate"], QString("25/1"));
        QCOMPARE(film["nb_frames"].toInt(), static_cast<int>(std::ceil(25 * seconds)));
        QVERIFY(std::abs(film["duration"].toDouble() - seconds) <= 1.0 / 25);
        QVERIFY(!QFile::exists(file + ".part"));
    }

    void aCancelledFilmLeavesNothing() {
        if (QStandardPaths::findExecutable("ffmpeg").isEmpty()) QSKIP("ffmpeg is not installed");
        User user(study_);
        QVERIFY(user.waitForReplay());
        user.player().setSpeed(0.05);
        user.files().setPictureSize({1280, 720});
        const QString file = folder_.filePath("cancelled.mp4");
        user.files().saveMovie(file);
        QTRY_VERIFY_WITH_TIMEOUT(user.player().time() > 0.0, kPatience);
        user.find<QPushButton>("review.cancelMovie")->click();
        QVERIFY(!user.files().movie().busy());
        QVERIFY(!QFile::exists(file) && !QFile::exists(file + ".part"));
    }

    void withoutFfmpegAMessageTellsWhatToInstall() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        const QByteArray path = qgetenv("PATH");
        qputenv("PATH", folder_.path().toLocal8Bit());
        user.files().saveMovie(folder_.filePath("none.mp4"));
        qputenv("PATH", path);
        QVERIFY2(user.message().contains("apt install ffmpeg"), qPrintable(user.message()));
        QVERIFY(!QFile::exists(folder_.filePath("none.mp4")));
    }

    void aPictureIsSaved() {
        User user(study_);
        QVERIFY(user.waitForReplay());
        user.files().setPictureSize({1920, 1080});
        user.files().savePicture(folder_.filePath("a.png"));
        QCOMPARE(QImage(folder_.filePath("a.png")).size(), QSize(1920, 1080));
        user.files().savePicture(folder_.filePath("no/such/folder/a.png"));
        QVERIFY2(user.message().contains("no/such/folder"), qPrintable(user.message()));
    }

 private:
    QTemporaryDir folder_;
    QString study_;
    int count_ = 0;
};

int main(int argc, char** argv) {
    scene::SceneView::prepareApplication();
    QApplication application(argc, argv);
    ReviewPageTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "review_page_test.moc"
