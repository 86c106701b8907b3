#include "ui/pages/evolve_page.h"

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QListView>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QSpinBox>
#include <QTableView>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>
#include <QtTest>
#include <cmath>

#include "core/study/selection.h"
#include "core/study/standstill.h"
#include "tests/ui/session/event_loop_probe.h"
#include "tests/ui/session/session_fixture.h"
#include "tests/ui/window/window_user.h"
#include "ui/charts/plot.h"
#include "ui/charts/study_chart.h"
#include "ui/charts/trade_off_chart.h"
#include "ui/look/folding_group.h"
#include "ui/look/message_bar.h"
#include "ui/models/generation_model.h"
#include "ui/models/individual_model.h"
#include "ui/models/roles.h"
#include "ui/pages/learning_charts.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using session::RunState;
using session::waitUntil;

namespace {

constexpr int kGenerations = 6;
constexpr int kIndividuals = 8;

/// The window with a study of its own in it, and what a user does there.
struct User : tests::WindowUser {
    explicit User(const session::SessionFixture& studies) : WindowUser(studies.environment()) {}
    explicit User(const session::Environment& environment) : WindowUser(environment) {}

    RunState state() { return session()->runs().state(); }
    int saved() { return static_cast<int>(session()->runs().summaries().size()); }
    std::shared_ptr<const track::Track> track() { return scene().track; }
    QAbstractItemModel* rows(const QString& table) { return find<QTableView>(table + ".table")->model(); }
    int winners() { return find<QListView>("filmStrip.list")->model()->rowCount(); }
    charts::StudyChart* chart(const QString& name) { return find<charts::StudyChart>(name); }

    bool open(const std::filesystem::path& study) {
        return WindowUser::open(study, "evolve") &&
               waitUntil([&] { return find<pages::Page>("page.evolve")->isVisible(); });
    }
    void click(const QString& button) {
        auto* found = find<QAbstractButton>(button);
        QVERIFY2(found != nullptr && found->isVisible() && found->isEnabled(), qPrintable(button));
        QTest::mouseClick(found, Qt::LeftButton);
    }
    bool waitFor(RunState wanted) {
        return waitUntil([&] { return state() == wanted; });
    }
    bool waitForGenerations(int count) {
        return waitUntil([&] { return saved() >= count; });
    }
    void show(const QString& panel) {
        auto* dock = find<QDockWidget>("dock.evolve." + panel);
        dock->show();
        dock->raise();
        QVERIFY(waitUntil([&] { return dock->widget()->isVisible() && !dock->visibleRegion().isEmpty(); }));
    }
    /// Presses a button of a question as soon as it is asked.
    bool answer(const QString& question, const QString& button) {
        QMessageBox* box = nullptr;
        if (!waitUntil([&] { return (box = find<QMessageBox>(question)) != nullptr && box->isVisible(); }))
            return false;
        QTest::mouseClick(box->findChild<QPushButton*>(button), Qt::LeftButton);
        return true;
    }
};

double heightSum(const track::Track& track) {
    double sum = 0.0;
    for (const track::CrossSection& section : track.sections)
        for (const base::Vec2& point : section.points)
            sum += point.y();
    return sum;
}

}  // namespace

class EvolvePageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        qputenv("XDG_DATA_HOME", folder_.filePath("data").toLocal8Bit());
        QCoreApplication::setOrganizationName("Trapwright");
        QCoreApplication::setApplicationName("evolve_page_test");
    }
    void init() { QSettings().clear(); }

    void beforeLearningItSaysWhatToDo() {
        session::SessionFixture studies;
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QCOMPARE(user.text("evolve.state"), QString("Ready to learn"));
        QVERIFY(user.find<QLabel>("filmStrip.empty")->isVisible());
        // How long it takes is measured without being asked.
        QVERIFY(waitUntil([&] { return user.text("evolve.detail").startsWith("About"); }));
        QVERIFY(user.text("evolve.detail").contains("6 generations"));
        // The flat track that learning starts from.
        QVERIFY(waitUntil([&] { return user.track() != nullptr; }));
        QVERIFY(user.find<QToolButton>("evolve.start")->isEnabled());
        for (const char* button : {"evolve.pause", "evolve.stopAfterGeneration", "evolve.stopNow"})
            QVERIFY2(!user.find<QToolButton>(button)->isEnabled(), button);
    }

    void learningFillsEverything() {
        session::SessionFixture studies;
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QVERIFY(waitUntil([&] { return user.track() != nullptr; }));
        const double flat = heightSum(*user.track());
        user.click("evolve.start");
        QCOMPARE(user.state(), RunState::learning);
        QVERIFY(waitUntil([&] { return user.text("evolve.state") == "All 6 generations learned"; }));
        for (const char* name : {"success", "fitness", "search", "speed"}) {
            const charts::StudyCurves& curves = user.chart(name)->studies().front();
            QCOMPARE(curves.summaries.size(), std::size_t{kGenerations});
            QCOMPARE(curves.trialsPerSecond.size(), std::size_t{kGenerations});
            QVERIFY(curves.trialsPerSecond.back() > 0.0);
        }
        QCOMPARE(user.rows("generations")->rowCount(), kGenerations);
        // The newest is on top.
        QCOMPARE(user.rows("generations")->index(0, 0).data(models::ValueRole).toInt(), kGenerations - 1);
        QCOMPARE(user.winners(), kGenerations);
        const study::Individual best = *user.session()->runs().bestWinner();
        QCOMPARE(user.text("filmStrip.caption"), QString("Generation %1, best so far").arg(best.generation));
        QVERIFY(waitUntil([&] { return heightSum(*user.track()) != flat; }));
        // Its success is the number of the page, in the largest letters.
        QCOMPARE(user.text("evolve.success"),
                 QString("%1 %").arg(100.0 * best.record.success()->share(), 0, 'f', 1));
        QVERIFY(user.text("evolve.successBounds").contains("95 %"));
        QVERIFY(user.find<QLabel>("evolve.success")->parentWidget()->toolTip().contains("Clopper-Pearson"));
        for (const QLabel* label : user.find<QWidget>("page.evolve")->findChildren<QLabel*>())
            QVERIFY(label->objectName() == "evolve.success" ||
                    label->font().pointSizeF() < user.find<QLabel>("evolve.success")->font().pointSizeF());
        const auto* log = user.find<QTreeWidget>("log.list");
        QCOMPARE(log->findItems("Generation", Qt::MatchStartsWith, 1).size(), kGenerations);
        QVERIFY(log->topLevelItem(log->topLevelItemCount() - 1)->text(1).startsWith("Ended"));
        QVERIFY(!user.find<QToolButton>("evolve.start")->isEnabled());
    }

    // A random search of many generations does not get on.
    void whereNothingIsGainedItIsSaid() {
        session::SessionFixture studies;
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        study::Settings settings = user.session()->design().settings();
        settings.evolution.search = search::Method::random;
        settings.evolution.generations = 30;
        user.session()->design().changeSettings(settings, "Random");
        const auto* label = user.find<QLabel>("evolve.standstill");
        QVERIFY(!label->isVisible());
        user.click("evolve.start");
        QVERIFY(waitUntil([&] { return user.text("evolve.state") == "All 30 generations learned"; }));
        const std::optional<int> since = study::findStandstill(user.session()->runs().summaries());
        QVERIFY(since.has_value());
        QVERIFY(label->isVisible());
        QCOMPARE(label->text(), QString("Nothing was gained since generation %1.").arg(*since));
    }

    // What is learned goes on in corners of the operating box, at a click.
    void whatIsLearnedGoesOnInCorners() {
        session::SessionFixture studies;
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        study::Settings settings = user.session()->design().settings();
        settings.evolution.conditions = study::TrialConditions::varied;
        settings.evolution.trialsPerEvaluation = 10;
        user.session()->design().changeSettings(settings, "Varied");
        const auto* corners = user.find<QToolButton>("evolve.corners");
        QVERIFY(!corners->isVisible());
        user.click("evolve.start");
        QVERIFY(waitUntil([&] { return user.text("evolve.state") == "All 6 generations learned"; }));
        QVERIFY(corners->isVisible());
        user.click("evolve.corners");
        QCOMPARE(user.state(), RunState::learning);
        QVERIFY(!corners->isVisible());
        const study::EvolutionSettings& now = user.session()->design().settings().evolution;
        QCOMPARE(now.cornersFrom, kGenerations);
        QCOMPARE(now.generations, kGenerations + 20);
        QVERIFY(!user.session()->design().undoStack()->canUndo());
        QVERIFY(user.waitForGenerations(kGenerations + 2));
        user.click("evolve.stopNow");
        QVERIFY(user.waitFor(RunState::idle));
        const study::Individual& best = *user.session()->runs().bestWinner();
        QVERIFY(best.generation >= kGenerations);
        QVERIFY(user.text("evolve.successSource").contains("6 of them in corners of the box"));
        QVERIFY(!corners->isVisible());
        // While it learns, and once some generations have been learned so, there is no way back.
        settings = user.session()->design().settings();
        settings.evolution.cornerShare = 0.0;
        user.session()->design().changeSettings(settings, "Back");
        QVERIFY(user.session()->design().settings().evolution.cornerShare > 0.0);
    }

    // One trial in each generation is lost by the quick engine; learning goes on and tells it.
    void trialsThatWereMadeAgainAreTold() {
        session::SessionFixture studies;
        QVERIFY(makeStudy(studies));
        session::Environment environment = studies.environment();
        environment.engines = fake::enginesMadeBy([](const std::string& name, const trial::EngineOptions&) {
            auto engine = std::make_unique<fake::FakeEngine>(
                [name](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
                    trial::PartOutcome outcome = fake::waveLaw(batch, spec);
                    const bool isLost = name == "native" && spec.stream.individual == 0 &&
                                        spec.stream.trial == 1 && spec.stream.generation == 2;
                    if (isLost) outcome.farthest.position.x() = std::nan("");
                    return outcome;
                });
            engine->title = name;
            return engine;
        });
        User user(environment);
        QVERIFY(user.open(studies.path("a.trap")));
        study::Settings settings = user.session()->design().settings();
        settings.evolution.commonRandomNumbers = false;
        settings.simulation.engine = "native";
        user.session()->design().changeSettings(settings, "Native");
        const auto* label = user.find<QLabel>("evolve.remade");
        QVERIFY(!label->isVisible());
        user.click("evolve.start");
        QVERIFY(waitUntil([&] { return user.text("evolve.state") == "All 6 generations learned"; }));
        QVERIFY(label->isVisible());
        QCOMPARE(label->text(), QString("Trials made again with the reference engine: 1."));
        const auto* log = user.find<QTreeWidget>("log.list");
        const auto lines = log->findItems(
            "Made again with the reference engine: trial 1 of individual 0 of "
            "generation 2 (native: its pose is not a number)",
            Qt::MatchExactly, 1);
        QCOMPARE(lines.size(), 1);
    }

    // Where parts that fall come again, those that arrive are what counts.
    void sortingIsToldByThePartsThatArrive() {
        session::SessionFixture studies;
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        study::Settings settings = user.session()->design().settings();
        settings.evolution.objectives = "sorting";
        user.session()->design().changeSettings(settings, "Sorting");
        user.click("evolve.start");
        QVERIFY(waitUntil([&] { return user.text("evolve.state") == "All 6 generations learned"; }));
        const study::IndividualRecord& best = user.session()->runs().bestWinner()->record;
        for (const study::Individual& winner : user.session()->runs().winners())
            QVERIFY(best.fitness.total >= winner.record.fitness.total);
        if (best.finished == 0) {
            QCOMPARE(user.text("evolve.successBounds"), QString("no part arrives"));
            return;
        }
        QVERIFY(user.text("evolve.successBounds").startsWith("correct, 95 %"));
        QCOMPARE(user.text("evolve.success"),
                 QString("%1 %").arg(100.0 * best.oriented.value_or(0) / best.finished, 0, 'f', 1));
        QVERIFY(user.text("evolve.successSource").contains("parts that arrive"));
    }

    // Two objectives of all tracks against each other; a point, or a link above, opens its track.
    void theTradeOffOpensTracks() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        user.show("tradeOff");
        auto* chart = user.find<charts::TradeOffChart>("tradeOff");
        const auto head = [&] { return user.text("evolve.tradeOff.head"); };
        QVERIFY(waitUntil([&] { return head().contains("on the Pareto front"); }));
        auto* up = user.find<QComboBox>("evolve.tradeOff.up");
        QCOMPARE(up->currentData().toString(), QString("success"));
        // Another objective: read anew.
        up->setCurrentIndex(up->findData("F_O"));
        QVERIFY(waitUntil([&] { return chart->sheet().plots[0].yTitle.startsWith("Orientation"); }));
        const std::vector<charts::Curve>& curves = chart->sheet().plots[0].curves;
        const std::shared_ptr<const track::Track> before = user.track();
        charts::Plot* plot = chart->shownPlots().front();
        // The front's other end is not the best winner, or it has one point alone.
        const charts::Curve front = curves[2];
        QVERIFY(!front.points.empty());
        const QString name = front.pointName(front.points.size() - 1);
        QTest::mouseClick(plot->viewport(), Qt::LeftButton, {},
                          plot->toWidget(front.points.back()).toPoint());
        const auto generation = [&] { return user.text("filmStrip.caption").section(',', 0, 0); };
        QVERIFY2(waitUntil([&] { return generation() == name.section(',', 0, 0); }), qPrintable(name));
        QVERIFY(waitUntil([&] { return user.find<QAction>("evolve.follow")->isEnabled(); }));
        user.find<QAction>("evolve.follow")->trigger();
        QVERIFY(user.text("filmStrip.caption").endsWith("best so far"));
        // And a link.
        emit user.find<QLabel>("evolve.tradeOff.head")->linkActivated("4/3");
        QCOMPARE(generation(), QString("Generation 4"));
        QVERIFY(waitUntil([&] { return user.track() != before; }));
        QCOMPARE(chart->sheet().plots[0].curves[4].points.size(), std::size_t{1});
    }

    void winnersInViewGetPictures() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        const QAbstractItemModel* strip = user.find<QListView>("filmStrip.list")->model();
        QVERIFY(waitUntil([&] {
            for (int row = 0; row < strip->rowCount(); ++row)
                if (strip->index(row, 0).data(Qt::DecorationRole).value<QPixmap>().isNull()) return false;
            return strip->rowCount() == kGenerations;
        }));
    }

    void pauseAndResume() {
        session::SessionFixture studies;
        studies.trialTime = std::chrono::milliseconds(4);
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        user.click("evolve.start");
        QVERIFY(user.waitForGenerations(1));
        user.click("evolve.pause");
        QCOMPARE(user.state(), RunState::paused);
        QCOMPARE(user.text("evolve.state"), QString("Paused"));
        const int saved = user.saved();
        QTest::qWait(500);
        QVERIFY(user.saved() <= saved + 1);  // one may have been on its way
        QVERIFY(user.find<QToolButton>("evolve.start")->text().contains("sume"));
        user.click("evolve.start");
        QCOMPARE(user.state(), RunState::learning);
        QVERIFY(user.waitForGenerations(saved + 2));
    }

    void stopAfterThisGenerationSavesIt() {
        session::SessionFixture studies;
        studies.trialTime = std::chrono::milliseconds(4);
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        user.click("evolve.start");
        QVERIFY(user.waitForGenerations(1));
        user.click("evolve.stopAfterGeneration");
        QVERIFY(user.waitFor(RunState::idle));
        QVERIFY(user.saved() >= 2 && user.saved() < kGenerations);
        QCOMPARE(user.text("evolve.state"), QString("%1 of 6 generations learned").arg(user.saved()));
    }

    void stopNowAndGoOn() {
        session::SessionFixture studies;
        studies.trialTime = std::chrono::milliseconds(4);
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        user.click("evolve.start");
        QVERIFY(user.waitForGenerations(1));
        user.click("evolve.stopNow");
        QVERIFY(user.waitFor(RunState::idle));
        const int saved = user.saved();
        QVERIFY(saved < kGenerations);
        user.click("evolve.start");
        QVERIFY(user.waitForGenerations(saved + 1));
        QCOMPARE(user.winners(), user.saved());
    }

    void anyIndividualCanBeLookedAt() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QVERIFY(waitUntil([&] { return user.track() != nullptr; }));
        const auto newest = user.track();
        const int best = user.session()->runs().bestWinner()->generation;
        user.show("individuals");
        auto* table = user.find<QTableView>("individuals.table");
        QVERIFY(waitUntil([&] { return table->model()->rowCount() == kIndividuals; }));
        // Sorted by success: the worst is last.
        const QModelIndex worst = table->model()->index(kIndividuals - 1, 0);
        table->scrollTo(worst);
        QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualRect(worst).center());
        const int individual = worst.data(models::IndividualRole).toInt();
        QCOMPARE(user.text("filmStrip.caption"),
                 QString("Generation %1, individual %2").arg(best).arg(individual));
        QVERIFY(waitUntil([&] { return user.track() != newest; }));
        QVERIFY(heightSum(*user.track()) != heightSum(*newest));
        QVERIFY(user.text("evolve.lengths").startsWith("Segments of"));
        QVERIFY(!user.find<QWidget>("evolve.design")->accessibleDescription().isEmpty());

        const int other = best == 2 ? 3 : 2;
        user.find<QSpinBox>("individuals.generation")->setValue(other);
        QCOMPARE(user.text("filmStrip.caption"), QString("Generation %1, winner").arg(other));
        QCOMPARE(table->model()->index(0, 0).data(models::GenerationRole).toInt(), other);

        user.window.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&user.window));
        QTest::keyClick(table, Qt::Key_Escape);
        QCOMPARE(user.text("filmStrip.caption"), QString("Generation %1, best so far").arg(best));
        QVERIFY(waitUntil([&] { return heightSum(*user.track()) == heightSum(*newest); }));
    }

    void theStripGoesThroughAllWinners() {
        session::SessionFixture studies;
        studies.trialTime = std::chrono::milliseconds(4);
        QVERIFY(makeStudy(studies));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        user.click("evolve.start");
        QVERIFY(user.waitForGenerations(2));
        auto* slider = user.find<QSlider>("filmStrip.slider");
        slider->setValue(1);
        slider->setValue(0);
        QVERIFY(user.text("filmStrip.caption").startsWith("Generation 0, "));
        QVERIFY(!user.find<QToolButton>("filmStrip.follow")->isChecked());
        const int saved = user.saved();
        QVERIFY(user.waitForGenerations(saved + 1));
        // What was picked stays while learning goes on.
        QVERIFY(user.text("filmStrip.caption").startsWith("Generation 0, "));
        QCOMPARE(slider->value(), 0);
        QCOMPARE(slider->maximum(), user.saved() - 1);
        user.find<QAction>("evolve.next")->trigger();
        QVERIFY(user.text("filmStrip.caption").startsWith("Generation 1, "));
        user.click("filmStrip.follow");
        QVERIFY(user.waitFor(RunState::idle));
        QVERIFY(waitUntil([&] {
            return user.text("filmStrip.caption") ==
                   QString("Generation %1, best so far").arg(user.session()->runs().bestWinner()->generation);
        }));
    }

    /// Following shows the best winner, also when a newer one is worse.
    void followingStaysWithTheBest() {
        session::SessionFixture studies;
        study::Settings settings = session::smallSettings(kGenerations);
        settings.evolution.trialsPerEvaluation = 20;
        QVERIFY(studies.create("a.trap", settings) != nullptr);
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QStringList shown;
        QObject::connect(&user.session()->runs(), &session::StudyRuns::generationSaved, &user.window,
                         [&] { shown.append(user.text("filmStrip.caption")); });
        user.click("evolve.start");
        QVERIFY(user.waitForGenerations(kGenerations) && user.waitFor(RunState::idle));
        const std::vector<study::Individual>& winners = user.session()->runs().winners();
        QCOMPARE(shown.size(), kGenerations);
        bool stayed = false;
        for (int last = 0; last < kGenerations; ++last) {
            const auto known = std::span(winners).first(static_cast<std::size_t>(last) + 1);
            const int best = study::findBestWinner(known, false)->generation;
            QCOMPARE(shown[last], QString("Generation %1, best so far").arg(best));
            stayed = stayed || best < last;
        }
        QVERIFY2(stayed, "In this study every winner is better than the one before.");
    }

    void detailsOfTheAlgorithmAreOneFoldAway() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        {
            User user(studies);
            QVERIFY(user.open(studies.path("a.trap")));
            QVERIFY(user.find<QWidget>("evolve.parts")->isVisible());
            for (const char* name : {"evolve.scores", "evolve.design"})
                QVERIFY2(!user.find<QWidget>(name)->isVisible(), name);
            // The chart in front is success; the others are behind it.
            QVERIFY(waitUntil(
                [&] { return !user.find<QDockWidget>("dock.evolve.success")->visibleRegion().isEmpty(); }));
            QVERIFY(user.find<QDockWidget>("dock.evolve.algorithm")->visibleRegion().isEmpty());
            user.find<look::FoldingGroup>("group.evolve.algorithm")->setFolded(false);
            QVERIFY(user.find<QWidget>("evolve.scores")->isVisible());
            QVERIFY(user.find<QWidget>("evolve.design")->isVisible());
            user.show("algorithm");
            QVERIFY(user.find<QWidget>("fitness")->isVisible());

            user.show("generations");
            auto* table = user.find<QTableView>("generations.table");
            QVERIFY(!table->isColumnHidden(models::GenerationModel::Success));
            QVERIFY(table->isColumnHidden(models::GenerationModel::firstDetail()));
            user.click("generations.table.details");
            QVERIFY(!table->isColumnHidden(models::GenerationModel::firstDetail()));
        }
        // As it was left.
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QVERIFY(!user.find<QTableView>("generations.table")
                     ->isColumnHidden(models::GenerationModel::firstDetail()));
        QVERIFY(user.find<QTableView>("individuals.table")
                    ->isColumnHidden(models::IndividualModel::firstDetail()));
    }

    void closingWhileItLearnsAsksAndItCanGoOn() {
        session::SessionFixture studies;
        studies.trialTime = std::chrono::milliseconds(20);
        QVERIFY(makeStudy(studies));
        int saved = 0;
        {
            User user(studies);
            QVERIFY(user.open(studies.path("a.trap")));
            user.click("evolve.start");
            QVERIFY(user.waitForGenerations(1));
            user.window.close();
            QVERIFY(user.answer("dialog.running", "answer.goOn"));
            QCOMPARE(user.state(), RunState::learning);
            QVERIFY(user.window.isVisible());
            user.window.close();
            QVERIFY(user.answer("dialog.running", "answer.stopNow"));
            QVERIFY(waitUntil([&] { return !user.window.isVisible(); }));
            saved = user.saved();
        }
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QVERIFY(user.saved() >= saved && user.saved() < kGenerations);
        QCOMPARE(user.winners(), user.saved());
        user.click("evolve.start");
        QVERIFY(waitUntil([&] { return user.saved() == kGenerations && user.state() == RunState::idle; }));
    }

    void twoStudiesAreCompared() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        QVERIFY(makeLearned(studies, "b.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        auto* charts = user.window.findChild<pages::LearningCharts*>();
        charts->compareWith({studies.path("b.trap")});
        QVERIFY(waitUntil([&] { return user.chart("fitness")->studies().size() == 2; }));
        QCOMPARE(user.chart("speed")->studies()[1].summaries.size(), std::size_t{kGenerations});
        QVERIFY(user.text("evolve.compared").contains("b"));
        user.click("evolve.endComparison");
        QCOMPARE(user.chart("fitness")->studies().size(), std::size_t{1});
        charts->compareWith({studies.path("missing.trap")});
        QVERIFY(waitUntil(
            [&] { return user.find<look::MessageBar>("messageBar")->text().contains("missing.trap"); }));
    }

    // The open one among them.
    void seedsAreComparedByTheirMedian() {
        session::SessionFixture studies;
        for (const char* name : {"a.trap", "b.trap", "c.trap", "d.trap"})
            QVERIFY(makeLearned(studies, name));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        auto* charts = user.window.findChild<pages::LearningCharts*>();
        charts->compareWith(
            {studies.path("a.trap"), studies.path("b.trap"), studies.path("c.trap"), studies.path("d.trap")});
        QVERIFY(waitUntil([&] { return user.chart("success")->studies().size() == 2; }));
        const charts::StudyCurves& all = user.chart("success")->studies()[1];
        QCOMPARE(all.name, QString("median and quartiles of 4 studies"));
        QCOMPARE(all.members.size(), std::size_t{4});
        QCOMPARE(user.text("compared.0.0"), QString("Study"));
        QCOMPARE(user.text("compared.4.0"), QString("d"));
        QCOMPARE(user.text("compared.4.1"), QString::number(kGenerations));
        QCOMPARE(user.text("compared.6.0"), QString("Median"));
        // All are alike.
        QCOMPARE(user.text("compared.6.2"), user.text("compared.1.2"));
        user.click("evolve.endComparison");
        QCOMPARE(user.chart("success")->studies().size(), std::size_t{1});
        QVERIFY(!user.find<QWidget>("evolve.comparisonTable")->isVisible());
    }

    void lockedSettingsAreChangedInANewStudy() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QVERIFY(!user.find<pages::Page>("page.evolve")
                     ->findChild<QWidget*>("field.simulation.engine")
                     ->isEnabled());
        user.click("evolve.change");
        QVERIFY(waitUntil([&] { return user.saved() == 0; }));
        QVERIFY(user.find<pages::Page>("page.track")->isVisible());
        QCOMPARE(user.session()->design().settings().evolution.populationSize, kIndividuals);
    }

    // What was learned need not be learned again in the new study.
    void aNewStudyBeginsWithTheTracks() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        const int last = user.saved() - 1;
        const study::GenerationRecord known = user.session()->runs().loadGeneration(last).value();
        user.click("rail.track");
        QVERIFY(waitUntil([&] { return user.find<QWidget>("track.locked")->isVisible(); }));
        user.click("track.forkTracks");
        user.click("track.fork");
        QVERIFY(waitUntil([&] { return user.saved() == 0; }));
        study::Settings settings = user.session()->design().settings();
        QVERIFY(settings.evolution.firstGeneration == search::ga::FirstGeneration::known);
        settings.simulation.contact.restitution = 0.31;
        user.session()->design().changeSettings(settings, "Bouncier");
        QVERIFY(user.session()->design().problems().empty());
        user.click("track.start");
        QVERIFY(user.waitForGenerations(1));
        user.click("evolve.stopNow");
        QVERIFY(user.waitFor(RunState::idle));
        const study::GenerationRecord first = user.session()->runs().loadGeneration(0).value();
        for (std::size_t i = 0; i < first.individuals.size() / 2; ++i)
            QVERIFY(std::ranges::any_of(known.individuals, [&](const study::IndividualRecord& one) {
                return one.design == first.individuals[i].design;
            }));
    }

    void everyControlHasANameAndTakesKeys() {
        session::SessionFixture studies;
        QVERIFY(makeLearned(studies, "a.trap"));
        User user(studies);
        QVERIFY(user.open(studies.path("a.trap")));
        QList<QWidget*> controls;
        for (const char* place :
             {"page.evolve", "filmStrip", "generations", "individuals", "evolve.tradeOffPanel"}) {
            auto* widget = user.find<QWidget>(place);
            for (QWidget* child : widget->findChildren<QWidget*>()) {
                if (qobject_cast<QAbstractButton*>(child) || qobject_cast<QAbstractSpinBox*>(child) ||
                    qobject_cast<QSlider*>(child))
                    controls << child;
            }
        }
        QVERIFY(controls.size() > 10);
        for (QWidget* control : controls) {
            if (control->objectName() == "qt_spinbox_lineedit" ||
                qobject_cast<QTableView*>(control->parent()))
                continue;
            const auto* button = qobject_cast<QAbstractButton*>(control);
            const QString name = control->accessibleName() + (button != nullptr ? button->text() : QString());
            QVERIFY2(!name.isEmpty(), qPrintable(control->objectName()));
            QVERIFY2(control->focusPolicy() & Qt::TabFocus, qPrintable(name));
        }
    }

 private:
    static bool makeStudy(const session::SessionFixture& studies) {
        return studies.create("a.trap", session::smallSettings(kGenerations)) != nullptr;
    }
    static bool makeLearned(const session::SessionFixture& studies, const std::string& name) {
        const auto made = studies.create(name, session::smallSettings(kGenerations));
        return made && session::learnToTheEnd(*made);
    }

    QTemporaryDir folder_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    EvolvePageTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "evolve_page_test.moc"
