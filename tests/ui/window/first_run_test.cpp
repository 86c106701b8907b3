// What a user meets first: the start page, the tour, the help, and what learning will cost.

#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QTextBrowser>
#include <QToolButton>

#include "core/store/study_file.h"
#include "core/study/track_design.h"
#include "core/workflow/example_studies.h"
#include "sim/engines/registry.h"
#include "tests/ui/window/user.h"
#include "ui/help/help_window.h"
#include "ui/models/numbers.h"
#include "ui/pages/page.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/window/recent_files.h"
#include "ui/window/study_card.h"
#include "ui/window/tour.h"

using namespace trapwright;
using session::RunState;
using tests::kPatience;
using tests::User;
using tests::WindowUser;

namespace {

/// A study in a file, with as many recent entries as are wanted.
void saveStudy(const QString& path, const char* part = "pin") {
    User user;
    QVERIFY(user.import(part));
    QVERIFY(user.window.desk().saveAs(path.toStdString()).ok());
}

QString focused(WindowUser& user) {
    const QWidget* focus = user.window.focusWidget();
    return focus != nullptr ? focus->objectName() : QString();
}

void press(WindowUser& user, Qt::Key key) {
    QTest::keyClick(user.window.focusWidget(), key);
}

}  // namespace

class FirstRunTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        tests::useFolder(folder_, "first_run_test");
        qputenv("XDG_CACHE_HOME", folder_.filePath("cache").toLocal8Bit());
    }
    void init() {
        QSettings().clear();
        QSettings().setValue("tour/offered", true);
    }

    void arrowsGoFromCardToCard() {
        User user;
        QTRY_COMPARE(focused(user), QString("welcome.example"));
        const std::vector<std::pair<Qt::Key, const char*>> way = {
            {Qt::Key_Right, "welcome.draft"}, {Qt::Key_Right, "welcome.import"},
            {Qt::Key_Right, "welcome.open"},  {Qt::Key_Right, "welcome.open"},
            {Qt::Key_Left, "welcome.import"}, {Qt::Key_Up, "welcome.import"},
            {Qt::Key_Down, "welcome.import"},
        };
        for (const auto& [key, card] : way) {
            press(user, key);
            QCOMPARE(focused(user), QString(card));
        }
    }

    // As beside the page of a part that is read.
    void cardsAreInTwoRowsWhereThereIsLessRoom() {
        User user;
        QTRY_COMPARE(focused(user), QString("welcome.example"));
        user.window.resize(900, 720);
        const auto right = [&] {
            const auto* open = user.find<QPushButton>("welcome.open");
            return open->mapTo(user.find<QWidget>("welcome"), open->rect().bottomRight()).x();
        };
        QTRY_VERIFY(right() < user.find<QWidget>("welcome")->width());
        press(user, Qt::Key_Down);
        QCOMPARE(focused(user), QString("welcome.import"));
        press(user, Qt::Key_Right);
        QCOMPARE(focused(user), QString("welcome.open"));
        user.window.resize(1280, 720);
        QTRY_COMPARE(user.find<QPushButton>("welcome.open")->y(),
                     user.find<QPushButton>("welcome.example")->y());
    }

    void returnOpensTheStudyThatWasOpenLast() {
        const QString path = folder_.filePath("return.trap");
        saveStudy(path);
        User user;
        QTRY_COMPARE(focused(user), QString("welcome.recent"));
        press(user, Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QCOMPARE(user.session()->path(), std::filesystem::path(path.toStdString()));
        // And a card has the focus again once it is closed.
        QTest::keyClick(&user.window, Qt::Key_W, Qt::ControlModifier);
        QTRY_VERIFY(user.session() == nullptr);
        QTRY_COMPARE(focused(user), QString("welcome.recent"));
        QCOMPARE(user.find<window::StudyCard>("welcome.recent")->size(), window::StudyCard::kSize);
        // It lies below the first way to begin, and comes after the last.
        press(user, Qt::Key_Up);
        QCOMPARE(focused(user), QString("welcome.example"));
        press(user, Qt::Key_Down);
        QCOMPARE(focused(user), QString("welcome.recent"));
        press(user, Qt::Key_Left);
        QCOMPARE(focused(user), QString("welcome.open"));
    }

    void keysOfTheStartPageAskForFiles_data() {
        QTest::addColumn<int>("key");
        QTest::addColumn<QString>("title");
        QTest::newRow("Ctrl+I") << static_cast<int>(Qt::Key_I) << "Import a part";
        QTest::newRow("Ctrl+O") << static_cast<int>(Qt::Key_O) << "Open a study";
        QTest::newRow("Ctrl+N") << static_cast<int>(Qt::Key_N) << "Import a part";
    }
    void keysOfTheStartPageAskForFiles() {
        QFETCH(int, key);
        QFETCH(QString, title);
        User user;
        QTRY_COMPARE(focused(user), QString("welcome.example"));
        QTest::keyClick(user.window.focusWidget(), static_cast<Qt::Key>(key), Qt::ControlModifier);
        QTRY_VERIFY(QApplication::activeModalWidget() != nullptr);
        QCOMPARE(QApplication::activeModalWidget()->windowTitle(), title);
        QApplication::activeModalWidget()->close();
        QTRY_VERIFY(QApplication::activeModalWidget() == nullptr);
    }

    void aLearnedExampleIsOpenedAsACopy() {
        User user;
        user.action("learned.cuboid")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QVERIFY(user.window.desk().isDraft());
        QVERIFY(!user.session()->runs().summaries().empty());
        QVERIFY(!user.session()->runs().validations().empty());
        const workflow::ExampleStudy example = workflow::findExampleStudy("cuboid").value();
        QVERIFY(user.session()->path().parent_path() != workflow::findExampleFile(example).parent_path());
        QTRY_VERIFY(user.find<pages::Page>("page.review")->isVisible());
    }

    // What falls off comes again: all pages and the start page tell the right ones of those that arrive.
    void aSortedExampleIsToldByThePartsThatArrive_data() {
        QTest::addColumn<QString>("name");
        QTest::newRow("a generation's winner") << QString("screw");
        QTest::newRow("another one of the selection") << QString("bracket");
    }
    void aSortedExampleIsToldByThePartsThatArrive() {
        QFETCH(QString, name);
        User user;
        user.action("learned." + name)->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QTRY_VERIFY(user.find<pages::Page>("page.review")->isVisible());
        const session::StudyRuns& runs = user.session()->runs();
        const study::Individual track = *runs.chosen();
        const auto correct = runs.findSuccess(track);
        QVERIFY(correct && correct->ofArriving && correct->arriving < 0.98);
        const QString rate = models::percent(std::optional(correct->rate));
        QTRY_COMPARE(user.find<QLabel>("review.success")->text(), QString("%1 %").arg(rate));
        QVERIFY(user.find<QLabel>("review.successBounds")->text().startsWith("correct"));
        const QString arriving = models::percent(std::optional(correct->arriving));
        QVERIFY(user.find<QLabel>("review.successSource")
                    ->text()
                    .startsWith("validation, of the " + arriving + " % of parts"));
        QVERIFY(user.find<QLabel>("status.success")->text().contains("correct " + rate));
        QVERIFY(user.find<QComboBox>("review.track")->currentText().contains(rate));
        user.window.showPage("export");
        auto* check = user.find<QLabel>("print.check.success");
        QTRY_VERIFY_WITH_TIMEOUT(check->text().contains(rate), kPatience);
        QVERIFY2(check->text().contains("correct") && !check->text().contains("below"),
                 qPrintable(check->text()));

        const QString path = folder_.filePath(name + ".trap");
        const auto example =
            workflow::findExampleFile(workflow::findExampleStudy(name.toStdString()).value());
        QVERIFY(QFile::copy(QString::fromStdString(example.string()), path));
        window::RecentFiles().add(path.toStdString());
        User next;
        auto* card = next.find<window::StudyCard>("welcome.recent");
        QVERIFY(card != nullptr);
        auto* told = card->findChild<QLabel*>("card.success");
        QTRY_VERIFY2_WITH_TIMEOUT(told->text().startsWith(QString("<b>%1 %</b> correct (").arg(rate)),
                                  qPrintable(told->text()), kPatience);
        QVERIFY(card->toolTip().contains("that were fed"));
    }

    void aStudyThatIsGoneIsShownAndTakenOff() {
        const QString path = folder_.filePath("gone.trap");
        saveStudy(path);
        QVERIFY(QFile::remove(path));
        User user;
        auto* card = user.find<window::StudyCard>("welcome.recent");
        QVERIFY(card != nullptr && card->isMissing());
        QCOMPARE(card->findChild<QLabel*>("card.success")->text(), QString("The file is missing"));
        QTRY_COMPARE(focused(user), QString("welcome.recent"));
        press(user, Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(user.message().contains("cannot be opened"), kPatience);
        QVERIFY(user.find<window::StudyCard>("welcome.recent") != nullptr);
        press(user, Qt::Key_Delete);
        QTRY_VERIFY(user.find<window::StudyCard>("welcome.recent") == nullptr);
        QTRY_COMPARE(focused(user), QString("welcome.example"));
        QVERIFY(user.window.desk().recent().list().isEmpty());
    }

    // Without opening the study: another program has it open for writing meanwhile.
    void aCardHasPictureAndSuccess() {
        const QString path = folder_.filePath("known.trap");
        saveStudy(path, "cuboid");
        {
            auto file = store::StudyFile::open(path.toStdString(), "test");
            QVERIFY(file.ok());
            saveOneGeneration(*file);
            study::SelectionRecord selection;
            selection.engine = "native";
            selection.entries.push_back({0, 0, {}, 1000, 990, 980, {}});
            QVERIFY(file->saveSelection(selection).ok());
        }
        auto writer = store::StudyFile::open(path.toStdString(), "test");
        QVERIFY(writer.ok());
        User user;
        auto* card = user.find<window::StudyCard>("welcome.recent");
        QVERIFY(card != nullptr);
        auto* success = card->findChild<QLabel*>("card.success");
        // Clopper and Pearson's bounds of 980 of 1000: 96.9 to 98.8 %.
        QTRY_COMPARE_WITH_TIMEOUT(success->text(), QString("<b>98.0 %</b> success (96.9 … 98.8)"), kPatience);
        QVERIFY(card->toolTip().contains("980 of 1,000") && card->toolTip().contains("95 % bounds"));
        QVERIFY(hasPicture(*card));
        QCOMPARE(card->size(), window::StudyCard::kSize);
        // From the cache the next time: there at once, before anything can have been read.
        User again;
        card = again.find<window::StudyCard>("welcome.recent");
        QCOMPARE(card->findChild<QLabel*>("card.success")->text(), success->text());
        QVERIFY(hasPicture(*card));
    }

    void agesAreTold_data() {
        QTest::addColumn<qint64>("seconds");
        QTest::addColumn<QString>("age");
        QTest::newRow("now") << qint64{20} << "just now";
        QTest::newRow("minutes") << qint64{5 * 60} << "5 min ago";
        QTest::newRow("hours") << qint64{3 * 3600} << "3 h ago";
        QTest::newRow("a day") << qint64{24 * 3600} << "yesterday";
        QTest::newRow("days") << qint64{6 * 86400} << "6 days ago";
        QTest::newRow("weeks") << qint64{22 * 86400} << "3 weeks ago";
    }
    void agesAreTold() {
        QFETCH(qint64, seconds);
        QFETCH(QString, age);
        const QDateTime noon(QDate(2026, 11, 20), QTime(12, 0));
        QCOMPARE(window::ageText(noon.addSecs(-seconds), noon), age);
    }

    void theTourIsOfferedOnce() {
        QSettings().remove("tour/offered");
        {
            User user;
            QTRY_VERIFY(user.message().contains("A tour shows the window in five steps"));
        }
        User again;
        QTest::qWait(100);
        QVERIFY(again.message().isEmpty());
    }

    void theTourPointsAtWhatIsThere_data() {
        QTest::addColumn<QSize>("size");
        QTest::newRow("1280 x 720") << QSize(1280, 720);
        QTest::newRow("900 x 600") << QSize(900, 600);
    }
    void theTourPointsAtWhatIsThere() {
        QFETCH(QSize, size);
        User user;
        user.window.resize(size);
        user.action("help.tour")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.find<window::Tour>("tour") != nullptr, kPatience);
        auto* tour = user.find<window::Tour>("tour");
        const auto steps = window::windowTour();
        QCOMPARE(steps.size(), std::size_t{5});
        for (int i = 0; i < 5; ++i) {
            QCOMPARE(tour->step(), i);
            const auto& step = steps[static_cast<std::size_t>(i)];
            QTRY_VERIFY2(pointsAt(user, *tour, step.widget), qPrintable(step.widget));
            auto* bubble = user.find<QWidget>("tour.bubble");
            QVERIFY(tour->rect().contains(bubble->geometry()));
            QCOMPARE(user.text("tour.title"), step.title);
            // All of the text is seen, and none of what is pointed at is hidden where there is room.
            auto* text = user.find<QLabel>("tour.text");
            QVERIFY(text->height() >= text->heightForWidth(text->width()));
            if (size.width() >= 1280)
                QVERIFY2(!bubble->geometry().intersects(tour->spot()), qPrintable(step.widget));
            QCOMPARE(focused(user), QString("tour.next"));
            press(user, i % 2 == 0 ? Qt::Key_Return : Qt::Key_Right);
        }
        QTRY_VERIFY(user.find<window::Tour>("tour") == nullptr);
    }

    void theTourIsLeftAndGoneBackByKeys() {
        User user;
        QVERIFY(user.import("cuboid"));
        user.action("help.tour")->trigger();
        auto* tour = user.find<window::Tour>("tour");
        QVERIFY(tour != nullptr);
        press(user, Qt::Key_Right);
        press(user, Qt::Key_Right);
        QCOMPARE(tour->step(), 2);
        press(user, Qt::Key_Left);
        QCOMPARE(tour->step(), 1);
        // Tab stays within.
        for (int i = 0; i < 7; ++i) {
            press(user, Qt::Key_Tab);
            QVERIFY2(focused(user).startsWith("tour."), qPrintable(focused(user)));
        }
        press(user, Qt::Key_Escape);
        QTRY_VERIFY(user.find<window::Tour>("tour") == nullptr);
        QVERIFY(user.session() != nullptr);
    }

    void theTourFollowsPageAndSize() {
        User user;
        QVERIFY(user.import("cuboid"));
        user.action("help.tour")->trigger();
        auto* tour = user.find<window::Tour>("tour");
        press(user, Qt::Key_Right);
        press(user, Qt::Key_Right);
        QTRY_VERIFY(pointsAt(user, *tour, "track.starting"));
        user.window.resize(1500, 850);
        QTRY_COMPARE(tour->size(), user.window.size());
        QTRY_VERIFY(pointsAt(user, *tour, "track.starting"));
        QTest::keyClick(&user.window, Qt::Key_5, Qt::ControlModifier);
        QTRY_VERIFY(tour->spot().isEmpty());
        QVERIFY(tour->rect().contains(user.find<QWidget>("tour.bubble")->geometry()));
        press(user, Qt::Key_Left);
        press(user, Qt::Key_Right);
        QTRY_VERIFY(pointsAt(user, *tour, "track.starting"));
    }

    void helpOpensAtThePlace_data() {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QString>("focus");  // a widget of it; empty: none
        QTest::addColumn<QString>("place");
        QTest::newRow("Part") << "part"
                              << ""
                              << "part";
        QTest::newRow("Track") << "track"
                               << ""
                               << "track";
        QTest::newRow("Evolve") << "evolve"
                                << ""
                                << "evolve";
        QTest::newRow("Review") << "review"
                                << ""
                                << "review";
        QTest::newRow("Export") << "export"
                                << ""
                                << "export";
        QTest::newRow("Validate") << "validate"
                                  << ""
                                  << "validate";
        QTest::newRow("a setting") << "track"
                                   << "field.track.segmentWidth_mm"
                                   << "settings#width-tracksegmentwidth_mm";
        QTest::newRow("a setting on Evolve") << "evolve"
                                             << "field.evolution.generations"
                                             << "settings#generations-evolutiongenerations";
        QTest::newRow("a group") << "part"
                                 << "part.material"
                                 << "part#material";
        QTest::newRow("starting") << "evolve"
                                  << "evolve.start"
                                  << "evolve";
        QTest::newRow("the drive") << "validate"
                                   << "dock.inspector"
                                   << "drive";
        QTest::newRow("a panel") << "review"
                                 << "dock.review.trials"
                                 << "review#trials";
    }
    void helpOpensAtThePlace() {
        QFETCH(QString, page);
        QFETCH(QString, focus);
        QFETCH(QString, place);
        User user;
        QVERIFY(user.import("cuboid") && user.show(page));
        if (focus.isEmpty()) {
            user.sceneView()->setFocus();
        } else {
            auto* widget = user.find<QWidget>(focus);
            QVERIFY2(widget != nullptr, qPrintable(focus));
            widget->setFocusPolicy(Qt::StrongFocus);
            widget->setFocus();
            QTRY_VERIFY(widget->hasFocus());
        }
        QTest::keyClick(user.window.focusWidget(), Qt::Key_F1);
        auto* help = user.find<help::HelpWindow>("window.help");
        QVERIFY(help != nullptr && help->isVisible());
        QCOMPARE(help->place(), place);
        QVERIFY(!help->findChild<QTextBrowser*>("help.view")->toPlainText().isEmpty());
        help->close();
    }

    void helpOfTheStartPageIsTheFirstPage() {
        User user;
        QTest::keyClick(&user.window, Qt::Key_F1);
        auto* help = user.find<help::HelpWindow>("window.help");
        QVERIFY(help != nullptr && help->isVisible());
        QCOMPARE(help->place(), QString("index"));
    }

    void whatLearningTakesIsToldBeforeItStarts() {
        WindowUser user({engines::registry(), "trapwright test", {}});
        user.window.openFile(tests::bundled("cuboid"));
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        user.window.showPage("track");
        QTRY_VERIFY_WITH_TIMEOUT(user.session()->runs().draft().has_value(), 3 * kPatience);
        const session::LearningDraft draft = *user.session()->runs().draft();
        QVERIFY(draft.seconds > 0.0 && draft.seconds < 600.0);
        QVERIFY(user.session()->runs().estimatedSeconds() > draft.seconds);
        for (const char* label : {"track.time", "evolve.draftTime"})
            QVERIFY2(user.text(label).contains("on this machine"), qPrintable(user.text(label)));
        QCOMPARE(user.session()->runs().state(), RunState::idle);

        auto* button = user.find<QToolButton>("track.draft");
        QVERIFY(button->isVisible() && button->isEnabled());
        QTest::mouseClick(button, Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->runs().state(), RunState::learning, kPatience);
        // Learning started on Track is watched on Evolve, with the settings that were told.
        QTRY_VERIFY(user.find<pages::Page>("page.evolve")->isVisible());
        QVERIFY(user.session()->design().settings().evolution == draft.evolution);
        user.session()->runs().stopNow();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->runs().state(), RunState::idle, kPatience);
    }

    // What was chosen stands under the title until something else is.
    void settingsForAPartAndATimeAreOneStepToUndo() {
        WindowUser user({engines::registry(), "trapwright test", {}});
        user.window.openFile(tests::bundled("pin"));
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        user.window.showPage("track");
        auto* reasons = user.find<QLabel>("track.proposal");
        QVERIFY(reasons->isHidden());
        const study::Settings before = user.session()->design().settings();
        user.action("preset.time.10min")->trigger();
        QVERIFY(!reasons->isHidden());
        QTRY_VERIFY_WITH_TIMEOUT(user.session()->design().settings() != before, 3 * kPatience);
        const study::Settings chosen = user.session()->design().settings();
        QCOMPARE(chosen.evolution.objectives, std::string("sorting"));
        QVERIFY(chosen.part == before.part);
        // A chain of traps takes its time.
        study::SimulationSettings asked = before.simulation;
        asked.termination.timeLimit = 30.0;
        QVERIFY(chosen.simulation == asked);
        QVERIFY(user.session()->design().problems().empty());
        QVERIFY2(reasons->text().contains("pin (symmetry Cinf)"), qPrintable(reasons->text()));
        QVERIFY(!reasons->isHidden());
        user.action("edit.undo")->trigger();
        QVERIFY(user.session()->design().settings() == before);
        QVERIFY(reasons->isHidden());
        user.action("edit.redo")->trigger();
        QVERIFY(user.session()->design().settings() == chosen);
        QVERIFY(!reasons->isHidden());
    }

    void startedOnReviewThePageStays() {
        WindowUser user({engines::registry(), "trapwright test", {}});
        user.window.openFile(tests::bundled("cuboid"));
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        user.window.showPage("review");
        user.action("run.start")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->runs().state(), RunState::learning, kPatience);
        QVERIFY(user.find<pages::Page>("page.review")->isVisible());
        user.session()->runs().stopNow();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->runs().state(), RunState::idle, kPatience);
        user.window.showPage("track");
        user.action("run.start")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.find<pages::Page>("page.evolve")->isVisible(), kPatience);
        user.session()->runs().stopNow();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->runs().state(), RunState::idle, kPatience);
    }

    void theExampleLearnsByOneKey() {
        WindowUser user({engines::registry(), "trapwright test", {}});
        QTRY_COMPARE(focused(user), QString("welcome.example"));
        QElapsedTimer clock;
        clock.start();
        press(user, Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr && !user.session()->runs().summaries().empty(),
                                 6 * kPatience);
        qInfo("the first winner was there after %.1f s", 1e-3 * static_cast<double>(clock.elapsed()));
        QVERIFY(user.find<pages::Page>("page.evolve")->isVisible());
        // A generation of these is a sixth of Table 1's.
        QCOMPARE(user.session()->design().settings().evolution.populationSize, 40);
        user.session()->runs().stopNow();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->runs().state(), RunState::idle, kPatience);
    }

 private:
    static bool pointsAt(WindowUser& user, const window::Tour& tour, const QString& name) {
        const auto* widget = user.find<QWidget>(name);
        if (widget == nullptr || !widget->isVisible()) return false;
        const QRect place(widget->mapTo(&user.window, QPoint(0, 0)), widget->size());
        // All of it, or what its inspector shows of it.
        return tour.spot().intersects(place) && tour.spot().width() >= std::min(place.width(), 300) &&
               tour.spot().adjusted(-8, -8, 8, 8).contains(place & tour.spot());
    }
    static bool hasPicture(const window::StudyCard& card) {
        for (const QLabel* label : card.findChildren<QLabel*>())
            if (!label->pixmap(Qt::ReturnByValue).isNull()) return true;
        return false;
    }
    static void saveOneGeneration(store::StudyFile& file) {
        const auto settings = file.loadSettings();
        study::GenerationRecord record;
        for (const search::Proposal& proposal : study::makeSearch(*settings)->ask())
            record.individuals.push_back({proposal.design, proposal.traits, {}, 0, 100, 90, 5, 5});
        QVERIFY(file.saveGeneration(record).ok());
    }

    QTemporaryDir folder_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    FirstRunTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "first_run_test.moc"
