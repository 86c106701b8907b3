#include <QComboBox>
#include <QDockWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>

#include "core/store/study_file.h"
#include "core/study/pose_weights.h"
#include "core/study/validation.h"
#include "tests/core/store/stored_outcomes.h"
#include "tests/ui/pages/review_user.h"
#include "ui/charts/curve_chart.h"
#include "ui/charts/robustness_chart.h"
#include "ui/look/message_bar.h"
#include "ui/models/selection_model.h"
#include "ui/models/trial_model.h"
#include "ui/models/validation_model.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::pages;
using models::ValidationModel;

class ReviewPageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(learned_.learn()); }
    void init() {
        study_ = learned_.copy();
        QVERIFY(!study_.isEmpty());
    }

    void trialsOfTheTrackAreListed() {
        ReviewUser user(study_);
        QTRY_COMPARE_WITH_TIMEOUT(user.trials().model()->rowCount(), 16, kPatience);
        int counted = 0;
        for (int verdict = 0; verdict < 4; ++verdict)
            counted += user.find<QToolButton>(QString("trials.chip%1").arg(verdict))
                           ->text()
                           .section(' ', 0, 0)
                           .toInt();
        QCOMPARE(counted, 16);
        // The first one is in the scene, with its path, and stands still.
        QVERIFY(user.waitForReplay());
        QVERIFY(user.scene().track && !user.scene().parts.empty());
        QCOMPARE(user.scene().traces.size(), std::size_t{1});
        QVERIFY(!user.player().playing());
    }

    void storedTrialsAndTheirReplaysAgree() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        const QString origin = user.find<QLabel>("trials.origin")->text();
        QVERIFY2(origin.startsWith("As stored") && origin.contains("trapwright test, native with"),
                 qPrintable(origin));
        QVERIFY(user.find<QWidget>("transport")->findChild<look::MessageBar*>()->text().isEmpty());
    }

    void aReplayThatEndsOtherwiseIsTold() {
        sample::changeMaker(study_.toStdString(), {"trapwright 0.0-other", "native", "AVX9"});
        for (const int generation : {0, 1})
            sample::changeOutcomes(study_.toStdString(), generation,
                                   [](std::size_t trial, trial::PartOutcome& outcome) {
                                       // The table shows it as stored; others are left alone.
                                       if (trial % 16 < 3) outcome = {trial::Ending::timedOut, {}, {}, 9.75};
                                   });
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        const QAbstractItemModel& trials = *user.trials().model();
        QCOMPARE(trials.index(0, models::TrialModel::Time).data(models::ValueRole).toDouble(), 9.75);
        auto* warning = user.find<QWidget>("transport")->findChild<look::MessageBar*>();
        const QString text = warning->text();
        QVERIFY2(text.startsWith("This replay of trial 0 ends otherwise than the stored trial") &&
                     text.contains("Stored: timed out after 9.750 s") && text.contains("native with AVX9") &&
                     text.contains("trapwright test"),
                 qPrintable(text));
        // So do two of the ghosts.
        user.find<QSpinBox>("trials.ghosts")->setValue(4);
        QTRY_VERIFY_WITH_TIMEOUT(warning->text().contains("2 more"), kPatience);
        user.find<QSpinBox>("trials.ghosts")->setValue(0);
        // A replay that ends as stored says nothing.
        user.click(user.trials(), 5, 0);
        QTRY_VERIFY_WITH_TIMEOUT(warning->text().isEmpty(), kPatience);
        QVERIFY(user.waitForReplay());
        QVERIFY(warning->text().isEmpty());
    }

    void olderStudiesSimulateAgain() {
        sample::dropOutcomes(study_.toStdString());
        ReviewUser user(study_);
        QTRY_COMPARE_WITH_TIMEOUT(user.trials().model()->rowCount(), 16, kPatience);
        const QString origin = user.find<QLabel>("trials.origin")->text();
        QVERIFY2(origin.contains("Simulated again") && origin.contains("trapwright test"),
                 qPrintable(origin));
        QVERIFY(user.waitForReplay());
        QVERIFY(user.find<QWidget>("transport")->findChild<look::MessageBar*>()->text().isEmpty());
    }

    void filterShowsOneKindOfOutcome() {
        ReviewUser user(study_);
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
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        ReplayPlayer& player = user.player();
        const base::Vec3 start = user.scene().parts.front().pose.position;
        user.press(Qt::Key_Space);
        QVERIFY(player.playing());
        QTRY_VERIFY(player.time() > 0.1);
        user.press(Qt::Key_Space);
        QVERIFY(!player.playing());
        const double stopped = player.time();
        QVERIFY((user.scene().parts.front().pose.position - start).norm() > 1e-6);
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
        QVERIFY2(text.contains(QLocale().toString(0.25, 'f', 3)) &&
                     text.contains(QLocale().toString(12.5, 'f', 1)),
                 qPrintable(text));
    }

    void clickInTheTimeLineGoesThere() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        auto* line = user.find<QSlider>("transport.line");
        const auto clickAt = [line](double share) {
            QTest::mouseClick(line, Qt::LeftButton, {}, {qRound(share * line->width()), line->height() / 2});
        };
        for (const double share : {0.75, 0.25}) {
            clickAt(share);
            QVERIFY2(std::abs(user.player().time() / user.player().duration() - share) < 0.02,
                     qPrintable(QString::number(user.player().time())));
        }
    }

    void loopBeginsAgainAndSpeedHasItsLimits() {
        ReviewUser user(study_);
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
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        auto* chip = user.find<QToolButton>("trials.chip0");
        chip->setFocus(Qt::TabFocusReason);
        QTest::keyClick(chip, Qt::Key_Space);
        QVERIFY(!chip->isChecked());
        QVERIFY(!user.player().playing());
    }

    void ghostsHaveTheColoursOfTheirOutcomes() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        user.find<QSpinBox>("trials.ghosts")->setValue(5);
        QTRY_COMPARE_WITH_TIMEOUT(user.scene().parts.size(), std::size_t{6}, kPatience);
        QVERIFY(!user.scene().parts.front().colour.isValid());
        for (std::size_t i = 1; i < 6; ++i)
            QVERIFY(user.scene().parts[i].colour.isValid());
        QCOMPARE(user.scene().traces.size(), std::size_t{6});
        user.trigger("replay.trace");
        QVERIFY(user.scene().traces.empty());
        user.find<QSpinBox>("trials.ghosts")->setValue(0);
        QTRY_COMPARE(user.scene().parts.size(), std::size_t{1});
    }

    void forcesAreDrawnOnRequest() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        QVERIFY(user.scene().contacts.empty() && !user.scene().forceLegend);
        user.trigger("replay.forces");
        QVERIFY(user.scene().forceLegend);
        bool pressed = false;
        for (int i = 0; i < 500 && i * 1e-3 < user.player().duration(); ++i) {
            user.player().setTime(i * 1e-3);
            for (const scene::ContactArrow& arrow : user.scene().contacts)
                pressed = pressed || arrow.force.z() > 0.0;
        }
        QVERIFY(pressed);
        user.trigger("replay.forces");
        QVERIFY(user.scene().contacts.empty() && !user.scene().forceLegend);
    }

    void winnersAreComparedAndOneIsChosen() {
        ReviewUser user(study_);
        user.trigger("review.compare");
        QVERIFY(!user.find<QAction>("review.compare")->isEnabled());
        QTRY_COMPARE_WITH_TIMEOUT(user.comparison().model()->rowCount(), 2, kPatience);
        // The best is looked at by itself, and counts until the user says otherwise.
        const auto best = user.session()->runs().selections().back().entries.front();
        QCOMPARE(user.session()->runs().chosen()->generation, best.generation);
        QTRY_VERIFY(user.session()->runs().state() == session::RunState::idle || user.waitForReplay());
        // What was waited for is in front.
        QTRY_VERIFY(user.comparison().isVisible());
        // Conditions vary, and so corners were tried.
        QVERIFY(!user.comparison().isColumnHidden(models::SelectionModel::Corners));
        // Not measured yet; what is hidden takes no room.
        QVERIFY(user.comparison().isColumnHidden(models::SelectionModel::Worst));
        QCOMPARE(user.comparison().columnViewportPosition(models::SelectionModel::Worst + 1),
                 user.comparison().columnViewportPosition(models::SelectionModel::Corners) +
                     user.comparison().columnWidth(models::SelectionModel::Corners));
        user.click(user.comparison(), 1, models::SelectionModel::Generation);
        const auto second = user.session()->runs().selections().back().entries.back();
        QTRY_VERIFY(
            user.find<QComboBox>("review.track")
                ->currentText()
                .contains(
                    QString("Generation %1, individual %2").arg(second.generation).arg(second.individual)));
        user.find<QPushButton>("review.makeFinal")->click();
        QCOMPARE(user.session()->runs().chosen()->generation, second.generation);
        QCOMPARE(user.session()->runs().chosen()->individual, second.individual);
        QVERIFY(!user.find<QPushButton>("review.makeFinal")->isVisible());
        // It is the one that is exported.
        user.window.showPage("export");
        QVERIFY(
            user.find<QComboBox>("export.track")
                ->currentText()
                .contains(
                    QString("generation %1, individual %2").arg(second.generation).arg(second.individual)));
    }

    void successOfATrackIsItsNumber() {
        ReviewUser user(study_);
        const study::Individual winner = *user.session()->runs().chosen();
        const stats::Count learned = winner.record.success().value();
        QCOMPARE(user.text("review.success"), QString("%1 %").arg(100.0 * learned.share(), 0, 'f', 1));
        QVERIFY(user.text("review.successSource").contains("while learning"));
        auto* list = user.find<QComboBox>("review.track");
        for (int row = 0; row < list->count(); ++row)
            QVERIFY2(list->itemText(row).endsWith('%'), qPrintable(list->itemText(row)));
        // A validation tells more.
        QVERIFY(user.validate());
        const study::ValidationTable table = study::tabulate(
            user.session()->runs().validations().back(),
            study::weighPoseGroups(*user.session()->design().part(), user.session()->design().settings()));
        QVERIFY(table.weighted.rate.has_value());
        QTRY_COMPARE(user.text("review.success"),
                     QString("%1 %").arg(100.0 * *table.weighted.rate, 0, 'f', 1));
        QVERIFY(user.text("review.successSource").contains("validation"));
    }

    void trackWithoutSuccessIsAskedAbout() {
        // The same study, but from the first generation's tracks nothing leaves as wanted.
        const QString bad = learned_.file("bad.trap");
        {
            const auto good = store::StudyFile::openReadOnly(study_.toStdString());
            VERIFY_OK(good);
            auto copy = store::StudyFile::create(bad.toStdString(), good->loadSettings().value(),
                                                 good->loadPart().value(), "trapwright test");
            VERIFY_OK(copy);
            for (int index = 0; index < 2; ++index) {
                study::GenerationRecord record = good->loadGeneration(index).value();
                for (study::IndividualRecord& individual : record.individuals)
                    if (index == 0) individual.oriented = individual.finished = 0;
                VERIFY_OK(copy->saveGeneration(record));
            }
        }
        ReviewUser user(bad);
        const study::Individual before = *user.session()->runs().chosen();
        QCOMPARE(before.generation, 1);
        auto* list = user.find<QComboBox>("review.track");
        const int row = list->findText("Generation 0,", Qt::MatchStartsWith);
        QVERIFY(row >= 0 && list->itemText(row).endsWith(" 0 %"));
        list->setCurrentIndex(row);
        emit list->activated(row);
        const auto ask = [&]() -> QMessageBox* {
            user.find<QPushButton>("review.makeFinal")->click();
            return user.find<QMessageBox>("dialog.badTrack");
        };
        QPointer<QMessageBox> box = ask();
        QVERIFY(box && box->isVisible());
        QVERIFY2(box->informativeText().contains("0 %") && box->informativeText().contains("of 16 parts"),
                 qPrintable(box->informativeText()));
        for (const QAbstractButton* button : box->buttons())
            QVERIFY(button->text() != "OK" && button->text() != "Yes" && button->text() != "No");
        QCOMPARE(user.session()->runs().chosen()->generation, 1);
        box->findChild<QPushButton*>("answer.chooseAnother")->click();
        QTRY_VERIFY(box == nullptr);
        QCOMPARE(user.session()->runs().chosen()->generation, 1);
        box = ask();
        box->findChild<QPushButton*>("answer.makeFinal")->click();
        QTRY_COMPARE(user.session()->runs().chosen()->generation, 0);
        // A track that is good is not asked about.
        list->setCurrentIndex(list->findText("Generation 1,", Qt::MatchStartsWith));
        emit list->activated(list->currentIndex());
        QTRY_VERIFY(box == nullptr);
        QVERIFY(ask() == nullptr);
        QCOMPARE(user.session()->runs().chosen()->generation, 1);
    }

    void aFailedRowLeadsToItsReplay() {
        ReviewUser user(study_);
        QVERIFY(user.validate());
        const study::ValidationRecord& table = user.session()->runs().validations().back();
        // Three kinds of poses, and totals that are in sight below them: two, or three if a part fell off.
        const auto& model = static_cast<ValidationModel&>(*user.validation().model());
        constexpr int kGroups = 3;
        const int rows = kGroups + (study::calcTotal(table).tally.fellOff > 0 ? 3 : 2);
        QCOMPARE(model.rowCount(), rows);
        const auto* totals = user.find<QTableView>("review.validation.totals");
        QVERIFY(totals->isVisible());
        for (int i = 0; i < rows; ++i) {
            QCOMPARE(user.validation().isRowHidden(i), i >= kGroups);
            QCOMPARE(totals->isRowHidden(i), i < kGroups);
        }
        QVERIFY(totals->visualRect(model.index(rows - 1, 0)).bottom() <= totals->viewport()->height());
        // All open: each pose has its own row.
        for (int i = model.rowCount() - 1; i >= 0; --i)
            if (model.rows()[static_cast<std::size_t>(i)].opens)
                user.click(user.validation(), i, ValidationModel::Pose);
        QCOMPARE(model.rowCount(), static_cast<int>(table.rows.size()) + rows);
        int row = -1;
        for (int i = 0; i < model.rowCount(); ++i) {
            const models::ValidationTableRow& one = model.rows()[static_cast<std::size_t>(i)];
            if (one.kind == models::ValidationTableRow::Kind::pose && one.row.tally.wrongOrientation > 0)
                row = i;
        }
        QVERIFY2(row >= 0, "The study of this test has no such failure.");
        user.validation().scrollTo(user.validation().model()->index(row, 0));
        user.click(user.validation(), row, ValidationModel::WrongOrientation);
        QTRY_VERIFY_WITH_TIMEOUT(user.player().playing(), kPatience);
        QCOMPARE(user.scene().parts.size(), std::size_t{1});
        const study::ValidationRow wanted = model.rows()[static_cast<std::size_t>(row)].row;
        QVERIFY(user.find<QComboBox>("trials.source")->currentText().contains("poses "));
        QVERIFY(user.find<QComboBox>("trials.pose")->isVisible());
        QCOMPARE(user.find<QComboBox>("trials.pose")->currentData().toInt(), wanted.pose);
        // All of them in the end, and nothing else.
        const QAbstractItemModel& shown = *user.trials().model();
        QTRY_COMPARE_WITH_TIMEOUT(shown.rowCount(), wanted.tally.wrongOrientation, kPatience);
        for (int i = 0; i < shown.rowCount(); ++i)
            QCOMPARE(shown.index(i, 0).data(models::VerdictRole).toInt(),
                     static_cast<int>(trial::Verdict::wrongOrientation));
        for (int i = 0; i < shown.rowCount(); ++i)
            QCOMPARE(shown.index(i, 0).data(models::PoseRole).toInt(), wanted.pose);
        // The group's row lists those of its other pose as well.
        const auto group = std::find_if(model.rows().begin(), model.rows().end(), [&](const auto& one) {
            return one.opens && std::find(one.poses.begin(), one.poses.end(), wanted.pose) != one.poses.end();
        });
        QVERIFY(group != model.rows().end());
        const int all = group->row.tally.wrongOrientation;
        const int groupRow = static_cast<int>(group - model.rows().begin());
        user.validation().scrollTo(model.index(groupRow, 0));
        user.click(user.validation(), groupRow, ValidationModel::WrongOrientation);
        QTRY_COMPARE_WITH_TIMEOUT(shown.rowCount(), all, kPatience);
        QVERIFY(user.message().isEmpty());
    }

    /// Of a validation over the operating box: the failures of a quarter of a condition, of all poses.
    void aQuarterOfAConditionIsOneClickFromItsTrials() {
        ReviewUser user(study_);
        study::Settings settings = user.session()->design().settings();
        settings.validation.conditions = study::TrialConditions::varied;
        user.session()->design().changeSettings(settings, "Judge under");
        QVERIFY(user.validate());
        const auto& model = static_cast<ValidationModel&>(*user.validation().model());
        using Kind = models::ValidationTableRow::Kind;
        const auto findRow = [&](auto&& meant) {
            const auto row = std::ranges::find_if(model.rows(), meant);
            return row == model.rows().end() ? -1 : static_cast<int>(row - model.rows().begin());
        };
        // They come after the table itself.
        QTRY_VERIFY_WITH_TIMEOUT(findRow([](const auto& row) { return row.kind == Kind::condition; }) >= 0,
                                 kPatience);
        const int condition = findRow(
            [](const auto& row) { return row.kind == Kind::condition && row.row.tally.failures() > 0; });
        QVERIFY2(condition >= 0, "The study of this test has no such failure.");
        user.validation().scrollTo(model.index(condition, 0));
        user.click(user.validation(), condition, ValidationModel::Pose);
        const models::ValidationTableRow worst = model.rows()[static_cast<std::size_t>(condition)];
        const int quarter = findRow([&](const auto& row) {
            return row.kind == Kind::slice && row.condition == worst.condition && row.slice != worst.slice &&
                   row.row.tally.failures() > 0;
        });
        int listed = 0;
        for (const int row : {condition, quarter}) {
            if (row < 0) continue;  // all failures are in one quarter
            const models::ValidationTableRow wanted = model.rows()[static_cast<std::size_t>(row)];
            user.validation().scrollTo(model.index(row, 0));
            user.click(user.validation(), row, ValidationModel::Failures);
            QVERIFY(user.find<QComboBox>("trials.source")->currentText().contains(wanted.condition));
            const QAbstractItemModel& shown = *user.trials().model();
            QTRY_COMPARE_WITH_TIMEOUT(shown.rowCount(), wanted.row.tally.failures(), kPatience);
            for (const trial::Verdict verdict : {trial::Verdict::success, trial::Verdict::wrongOrientation,
                                                 trial::Verdict::stuck, trial::Verdict::fellOff}) {
                auto* chip = user.find<QToolButton>(QString("trials.chip%1").arg(static_cast<int>(verdict)));
                QCOMPARE(chip->isChecked(), verdict != trial::Verdict::success);
                if (verdict == trial::Verdict::stuck)
                    QCOMPARE(chip->text().section(' ', 0, 0).toInt(), wanted.row.tally.stuck);
            }
            QTRY_VERIFY_WITH_TIMEOUT(user.player().playing(), kPatience);
            QCOMPARE(user.scene().parts.size(), std::size_t{1});
            // Its number is the trial's own, of which there are more than are listed.
            QTRY_VERIFY(user.waitForReplay());
            ++listed;
        }
        QVERIFY(listed > 0);
        // The replay is of a trial that ends as it is listed.
        QVERIFY(user.find<QWidget>("transport")->findChild<look::MessageBar*>()->text().isEmpty());
        QVERIFY(user.message().isEmpty());
    }

    void anotherPageEndsTheReplay() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        user.player().play();
        user.window.showPage("part");
        QVERIFY(!user.player().playing());
        QVERIFY(user.scene().stablePoses && !user.scene().track);
        user.window.showPage("review");
        QVERIFY(user.scene().track && !user.scene().parts.empty());
        user.window.desk().close(true);
        QTRY_COMPARE(user.trials().model()->rowCount(), 0);
    }

    // From the measurement to the failing trial of a corner, and its replay.
    void aCornerOfTheBoxIsOneClickFromItsTrials() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        auto* chart = user.find<charts::RobustnessChart>("robustness");
        QVERIFY(!chart->saveCsvAction()->isEnabled());
        auto* text = user.find<QLabel>("review.robustness.head");
        QVERIFY(text->isHidden());
        // What it takes is told before.
        const QString cost = user.find<QLabel>("review.robustness.cost")->text();
        QVERIFY2(cost.contains(", about "), qPrintable(cost));
        // Stopped in the middle, nothing is known.
        session::StudyRuns& runs = user.session()->runs();
        user.trigger("review.robustness");
        QCOMPARE(runs.state(), session::RunState::measuring);
        QVERIFY(user.find<QLabel>("review.progress")->text().startsWith("Measuring"));
        user.find<QPushButton>("review.stop")->click();
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), session::RunState::idle, kPatience);
        QVERIFY(text->isHidden());
        // With fewer trials than the button's, for the test's sake.
        runs.startRobustness({*runs.chosen()}, {20, 20, 3, 2});
        QTRY_VERIFY_WITH_TIMEOUT(!text->isHidden(), 3 * kPatience);
        QVERIFY2(text->text().contains("Worst corners") && text->text().contains("riction 0."),
                 qPrintable(text->text()));
        QVERIFY(chart->isVisible());
        // The worst corner is the third number, after "as set" and "over the box".
        emit text->linkActivated("2");
        auto* source = user.find<QComboBox>("trials.source");
        QVERIFY2(source->currentText().startsWith("Friction"), qPrintable(source->currentText()));
        const auto countOf = [&](trial::Verdict verdict) {
            auto* chip = user.find<QToolButton>(QString("trials.chip%1").arg(static_cast<int>(verdict)));
            return chip->text().section(' ', 0, 0).toInt();
        };
        QTRY_COMPARE_WITH_TIMEOUT(countOf(trial::Verdict::success) +
                                      countOf(trial::Verdict::wrongOrientation) +
                                      countOf(trial::Verdict::stuck) + countOf(trial::Verdict::fellOff),
                                  20, kPatience);
        const int right = countOf(trial::Verdict::success);
        // As many as the panel says.
        QVERIFY2(text->text().contains(QString("href=\"2\"><b>%1 %").arg(right * 5.0, 0, 'f', 1)),
                 qPrintable(text->text()));
        QVERIFY(user.waitForReplay());
        // Who looks at another track sees nothing of this one's.
        auto* track = user.find<QComboBox>("review.track");
        track->setCurrentIndex(track->currentIndex() == 0 ? 1 : 0);
        emit track->activated(track->currentIndex());
        QTRY_VERIFY(text->isHidden());
    }

    // From the button to the chart, and to a film of many parts.
    void aStreamIsOneClickFromItsFilm() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        auto* text = user.find<QLabel>("review.stream.head");
        QVERIFY(text->isHidden());
        const QString cost = user.find<QLabel>("review.stream.cost")->text();
        QVERIFY2(cost.startsWith("10 to 300 parts a minute"), qPrintable(cost));
        session::StudyRuns& runs = user.session()->runs();
        user.find<QPushButton>("review.stream.button")->click();
        QCOMPARE(runs.state(), session::RunState::streaming);
        user.find<QPushButton>("review.stop")->click();
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), session::RunState::idle, kPatience);
        QVERIFY(text->isHidden());
        // Fewer and shorter than the button's, for the test's sake.
        study::Settings settings = user.session()->design().settings();
        settings.stream.streams = 2;
        settings.stream.warmUp = 1.0;
        settings.stream.duration = 4.0;
        settings.stream.partsPerMinute = 50.0;
        user.session()->design().changeSettings(settings, "Shorter streams");
        auto* chart = user.find<charts::CurveChart>("stream");
        auto* one = user.find<QPushButton>("review.stream.one.button");
        QCOMPARE(one->text(), QString("Only 50 parts a &minute"));
        one->click();
        QTRY_VERIFY_WITH_TIMEOUT(!text->isHidden(), 3 * kPatience);
        QVERIFY2(chart->csv().contains("\n50,"), qPrintable(chart->csv()));
        QCOMPARE(chart->csv().count('\n'), 2);
        runs.startStreams(*runs.chosen(), {30.0, 120.0});
        QTRY_COMPARE_WITH_TIMEOUT(chart->csv().count('\n'), 3, 3 * kPatience);
        QVERIFY2(text->text().contains("parts a minute</b> as wanted"), qPrintable(text->text()));
        QVERIFY(chart->isVisible());
        QVERIFY2(chart->csv().startsWith("Inflow [1/min],As wanted [1/min]"), qPrintable(chart->csv()));
        QCOMPARE(chart->csv().count('\n'), 3);
        // The second inflow.
        emit text->linkActivated("1");
        auto* source = user.find<QComboBox>("trials.source");
        QVERIFY2(source->currentText().startsWith("Stream, 120 a minute (2)"),
                 qPrintable(source->currentText()));
        QTRY_COMPARE_WITH_TIMEOUT(user.trials().model()->rowCount(), 2, kPatience);
        QTRY_VERIFY_WITH_TIMEOUT(user.player().duration() > 4.9, kPatience);
        // Nobody is there at first, several are later.
        user.player().setTime(0.0);
        QVERIFY(user.scene().parts.size() <= 1);
        std::size_t most = 0;
        for (int tenth = 0; tenth < 50; ++tenth) {
            user.player().setTime(0.1 * tenth);
            most = std::max(most, user.scene().parts.size());
        }
        QVERIFY2(most > 1, qPrintable(QString::number(most)));
    }

    void worstCornersOfAllThatWereCompared() {
        ReviewUser user(study_);
        auto* all = user.find<QAction>("review.robustness.all");
        session::StudyRuns& runs = user.session()->runs();
        if (runs.selections().empty()) {
            QVERIFY(!all->isEnabled());
            QVERIFY2(all->toolTip().contains("Compare"), qPrintable(all->toolTip()));
            user.trigger("review.compare");
            QTRY_VERIFY_WITH_TIMEOUT(!runs.selections().empty(), kPatience);
        }
        QTRY_VERIFY_WITH_TIMEOUT(all->isEnabled(), kPatience);
        const QString left = user.find<QLabel>("review.robustness.all.cost")->text();
        QVERIFY2(left.startsWith("2 tracks left") && left.contains(", about "), qPrintable(left));
        user.find<QPushButton>("review.robustness.all.button")->click();
        QCOMPARE(runs.state(), session::RunState::measuring);
        user.find<QPushButton>("review.stop")->click();
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), session::RunState::idle, kPatience);
        // With fewer trials than the button's, for the test's sake.
        std::vector<study::Individual> tracks;
        for (const study::SelectionEntry& entry : runs.selections().back().entries)
            tracks.push_back(runs.loadIndividual(entry).value());
        runs.startRobustness(tracks, {20, 20, 3, 2});
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), session::RunState::idle, 3 * kPatience);
        QTRY_VERIFY(user.comparison().isVisible());
        QVERIFY(!user.comparison().isColumnHidden(models::SelectionModel::Worst));
        const auto worst = [&](int row) {
            const QAbstractItemModel& model = *user.comparison().model();
            return model.index(row, models::SelectionModel::Worst).data().toString();
        };
        for (int row = 0; row < static_cast<int>(tracks.size()); ++row)
            QVERIFY2(worst(row).contains(" … "), qPrintable(worst(row)));
        QVERIFY(!all->isEnabled());
        QVERIFY2(all->toolTip().contains("are measured"), qPrintable(all->toolTip()));
    }

    void withoutRoomInTheBoxRobustnessCannotBeMeasured() {
        const QString exact = learned_.file("exact.trap");
        study::Settings settings = lowHills();
        settings.box = {trial::BoxDistribution::uniform, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        auto made = session::StudySession::create(exact.toStdString(), settings, session::cuboid(),
                                                  nativeEnvironment());
        VERIFY_OK(made);
        QVERIFY(session::learnToTheEnd(**made));
        made->reset();
        ReviewUser user(exact);
        QVERIFY(!user.find<QAction>("review.robustness")->isEnabled());
        QVERIFY(user.find<QAction>("review.robustness")->toolTip().contains("Track page"));
    }

    void withoutGenerationsThePageSaysWhatToDo() {
        const QString empty = learned_.file("empty.trap");
        auto made = session::StudySession::create(empty.toStdString(), lowHills(), session::cuboid(),
                                                  nativeEnvironment());
        VERIFY_OK(made);
        made->reset();
        ReviewUser user(empty);
        QVERIFY(!user.find<QAction>("review.validate")->isEnabled());
        QVERIFY(user.find<QAction>("review.validate")->toolTip().contains("Learn"));
        QVERIFY(!user.find<QAction>("replay.play")->isEnabled());
        QVERIFY(!user.find<QPushButton>("review.saveMovie")->isEnabled());
    }

 private:
    LearnedStudy learned_{"review_page_test"};
    QString study_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    ReviewPageTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "review_page_test.moc"
