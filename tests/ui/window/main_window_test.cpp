#include "ui/window/main_window.h"

#include <QDockWidget>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QTabBar>
#include <QTreeWidget>
#include <array>

#include "tests/ui/window/user.h"
#include "ui/look/theme.h"
#include "ui/pages/field_texts.h"
#include "ui/pages/value_edit.h"
#include "ui/session/study_design.h"
#include "ui/window/shortcut_list.h"

using namespace trapwright;
using tests::kPatience;
using tests::User;

namespace {

constexpr std::array kPages = {"part", "track", "evolve", "review", "export", "validate"};

}  // namespace

class MainWindowTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { tests::useFolder(folder_, "main_window_test"); }
    void init() { QSettings().clear(); }

    void withoutAStudyThereAreFourWaysToBegin() {
        User user;
        for (const char* name : {"welcome.example", "welcome.draft", "welcome.import", "welcome.open"})
            QVERIFY2(user.find<QPushButton>(name)->isVisible(), name);
        QVERIFY(!user.find<scene::SceneView>("scene")->isVisible());
        QVERIFY(!user.action("run.start")->isEnabled());
        QVERIFY(!user.action("file.saveAs")->isEnabled());
    }

    void anEditIsUndoneAndRedone() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        user.type("track.segmentWidth_mm", "70");
        QCOMPARE(user.session()->design().settings().track.segmentWidth, 70e-3);
        QTest::keyClick(&user.window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(user.session()->design().settings().track.segmentWidth, 60e-3);
        QCOMPARE(user.find<QLineEdit>("field.track.segmentWidth_mm")->text(), QString("60"));
        QTest::keyClick(&user.window, Qt::Key_Y, Qt::ControlModifier);
        QCOMPARE(user.session()->design().settings().track.segmentWidth, 70e-3);
    }

    // What another search or another trap does not have is not shown; the scene follows.
    void searchAndTrapsAreChosen() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        auto* scene = user.find<scene::SceneView>("scene");
        QTRY_VERIFY_WITH_TIMEOUT(scene->contents().track != nullptr, kPatience);
        const auto sections = [&] { return scene->contents().track->sections.size(); };
        QCOMPARE(sections(), std::size_t{2 + 5 + 2});
        user.choose("track.traps", "Step");
        QCOMPARE(user.session()->design().settings().track.traps, std::string("step"));
        QTRY_COMPARE_WITH_TIMEOUT(sections(), std::size_t{2 + 2 + 2}, kPatience);
        QVERIFY(!user.find<QWidget>("row.track.crossSections")->isVisible());
        user.choose("track.traps", "Step, free form");
        QTRY_COMPARE_WITH_TIMEOUT(sections(), std::size_t{2 + 2 + 5 + 2}, kPatience);
        QVERIFY(user.find<QWidget>("row.track.crossSections")->isVisible());
        user.choose("evolution.search", "Random");
        QVERIFY(user.session()->design().settings().evolution.search == search::Method::random);
        QVERIFY(user.find<QWidget>("row.evolution.tournamentSize")->isHidden());
        QVERIFY(user.find<QWidget>("row.evolution.firstGeneration")->isHidden());
        user.choose("evolution.search", "Exchange");
        QVERIFY(user.find<QWidget>("row.evolution.tournamentSize")->isHidden());
        QVERIFY(!user.find<QWidget>("row.evolution.firstGeneration")->isHidden());
        user.choose("evolution.search", "Genetic");
        QVERIFY(!user.find<QWidget>("row.evolution.tournamentSize")->isHidden());
    }

    // Every sum that is offered can be read, and is told on Evolve.
    void objectivesAreChosen() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        for (const pages::Choice& choice : pages::objectiveChoices()) {
            QVERIFY(objectives::readObjectives(choice.value).ok());
            user.choose("evolution.objectives", choice.label);
            QCOMPARE(user.session()->design().settings().evolution.objectives, choice.value);
        }
        QVERIFY(user.show("evolve"));
        QStringList facts;
        for (const QLabel* label : user.find<QWidget>("evolve.summary")->findChildren<QLabel*>())
            facts << label->text();
        QVERIFY2(facts.contains("F_C + F_D + Success + Speed"), qPrintable(facts.join('|')));
    }

    void theSceneFollowsAnEdit() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        auto* scene = user.find<scene::SceneView>("scene");
        QTRY_VERIFY_WITH_TIMEOUT(scene->contents().track != nullptr, kPatience);
        QCOMPARE(scene->contents().track->width, 60e-3);
        user.type("track.segmentWidth_mm", "90");
        QTRY_COMPARE_WITH_TIMEOUT(scene->contents().track->width, 90e-3, kPatience);
        // Its start point has 60 mm of lead-in behind it (decisions.md#lead-in-and-lead-out).
        QCOMPARE(scene->contents().track->start, 60e-3);
    }

    void aBadValueIsMarkedAndKeepsLearningOff() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        QVERIFY(user.action("run.start")->isEnabled());
        user.type("track.crossSections", "0");
        QVERIFY(user.find<pages::ValueEdit>("field.track.crossSections")->isBad());
        QCOMPARE(user.find<QLabel>("reason.track.crossSections")->text(),
                 QString("It must be from 1 to 200."));
        QVERIFY(!user.action("run.start")->isEnabled());
        QVERIFY(user.find<QLabel>("track.problems")->isVisible());
        QCOMPARE(user.find<QLabel>("status.state")->text(), QString("Not ready to learn"));
        user.type("track.crossSections", "5");
        QVERIFY(user.action("run.start")->isEnabled());
        QVERIFY(!user.find<QLabel>("track.problems")->isVisible());
    }

    // decisions.md#drive.
    void theThrowNumberFollowsTheDrive() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        auto* label = user.find<QLabel>("drive.throw");
        QTRY_VERIFY_WITH_TIMEOUT(label->text().startsWith("Throw number 1.67: parts hop"), kPatience);
        user.type("simulation.drive.halfStroke_mm", "0.478");
        QTRY_VERIFY_WITH_TIMEOUT(label->text().startsWith("Throw number 1:"), kPatience);
    }

    void presetsAreOneStepToUndo() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        const study::Settings before = user.session()->design().settings();
        user.action("preset.cone")->trigger();
        // Table 1.
        QCOMPARE(user.session()->design().settings().track.minSegmentLength, 22e-3);
        QCOMPARE(user.session()->design().settings().evolution.staticMutation, 0.001);
        QVERIFY(user.session()->design().settings().part == before.part);
        user.action("edit.undo")->trigger();
        QVERIFY(user.session()->design().settings() == before);
        user.action("preset.sorting")->trigger();
        const study::Settings sorting = user.session()->design().settings();
        QCOMPARE(sorting.evolution.objectives, std::string("sorting"));
        QCOMPARE(sorting.track.traps, std::string("groove, groove, 8 x gap"));
        QVERIFY(user.session()->design().problems().empty());
        user.action("edit.undo")->trigger();
        user.action("preset.ledges")->trigger();
        const study::Settings ledges = user.session()->design().settings();
        QCOMPARE(ledges.track.traps, std::string("groove, groove, 8 x gap, 6 x ledge"));
        QVERIFY(ledges.track.spiral.wall > 1e-3);
        QVERIFY(user.session()->design().problems().empty());
        user.action("edit.undo")->trigger();
        user.action("preset.slots")->trigger();
        QCOMPARE(user.session()->design().settings().track.traps, std::string("groove, groove, 3 x slot"));
        QVERIFY(user.session()->design().problems().empty());
        user.action("edit.undo")->trigger();
        user.action("preset.rails")->trigger();
        QCOMPARE(user.session()->design().settings().track.traps, std::string("drop, groove, narrow rails"));
        QVERIFY(user.session()->design().problems().empty());
        user.action("edit.undo")->trigger();
        QVERIFY(user.session()->design().settings() == before);
    }

    void savedStudiesAreOpenedAgainFromTheRecentOnes() {
        const QString path = folder_.filePath("pins.trap");
        QFile::remove(path);
        {
            User user;
            QVERIFY(user.import("pin") && user.show("track"));
            QVERIFY(user.window.desk().isDraft());
            user.type("track.segmentWidth_mm", "55");
            QVERIFY(user.window.desk().saveAs(path.toStdString()).ok());
            QVERIFY(!user.window.desk().isDraft());
            QVERIFY(user.window.windowTitle().startsWith("pins.trap"));
            user.type("track.segmentWidth_mm", "56");
            user.action("file.close")->trigger();
            QTRY_VERIFY(user.session() == nullptr);
        }
        User user;
        auto* link = user.find<QPushButton>("welcome.recent");
        QVERIFY(link != nullptr && link->toolTip() == path);
        QTest::mouseClick(link, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QCOMPARE(user.session()->design().settings().track.segmentWidth, 56e-3);
        QVERIFY(user.action("recent." + path) != nullptr);
    }

    void aDraftThatWasWorkedOnIsNotLostUnasked() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        user.type("track.segmentWidth_mm", "70");
        user.window.close();
        auto* question = user.find<QMessageBox>("dialog.draft");
        QVERIFY(question != nullptr && user.window.isVisible());
        QTest::mouseClick(question->findChild<QPushButton*>("answer.cancel"), Qt::LeftButton);
        QTRY_VERIFY(user.find<QMessageBox>("dialog.draft") == nullptr);
        QVERIFY(user.session() != nullptr);
        user.window.close();
        question = user.find<QMessageBox>("dialog.draft");
        QTest::mouseClick(question->findChild<QPushButton*>("answer.discard"), Qt::LeftButton);
        QTRY_VERIFY(!user.window.isVisible());
    }

    void theThemeIsChosenAndRemembered() {
        {
            User user;
            user.action("theme.dark")->trigger();
            QCOMPARE(look::schemeOf(QApplication::palette()), look::Scheme::dark);
            QCOMPARE(look::schemeOf(user.window.palette()), look::Scheme::dark);
            QCOMPARE(user.find<scene::SceneView>("scene")->contents().theme, scene::SceneTheme::dark());
            user.action("theme.light")->trigger();
            QCOMPARE(look::schemeOf(user.window.palette()), look::Scheme::light);
            user.action("theme.dark")->trigger();
        }
        User again;
        QCOMPARE(look::schemeOf(again.window.palette()), look::Scheme::dark);
        QVERIFY(again.action("theme.dark")->isChecked());
    }

    void linksAreReadableInEitherTheme() {
        User user;
        QVERIFY(user.import("cuboid"));
        QVERIFY(user.show("export"));
        auto* label = user.find<QLabel>("export.empty");
        for (const char* theme : {"theme.light", "theme.dark", "theme.light"}) {
            user.action(theme)->trigger();
            const QColor link =
                look::makePalette(look::schemeOf(user.window.palette())).color(QPalette::Link);
            const QImage shown = label->grab().toImage();
            int found = 0;  // the line under the link
            for (int y = 0; y < shown.height(); ++y) {
                for (int x = 0; x < shown.width(); ++x)
                    found += shown.pixelColor(x, y) == link ? 1 : 0;
            }
            QVERIFY2(found > 20, theme);
        }
    }

    void docksAreMovedClosedAndRemembered() {
        {
            User user;
            QVERIFY(user.import("cuboid"));
            auto* inspector = user.find<QDockWidget>("dock.inspector");
            QVERIFY(inspector->isVisible());
            user.window.addDockWidget(Qt::LeftDockWidgetArea, inspector);
            QVERIFY(user.show("track"));
            QCOMPARE(user.window.dockWidgetArea(inspector), Qt::RightDockWidgetArea);
            user.window.desk().close(false);
        }
        User user;
        QVERIFY(user.import("cuboid"));
        auto* inspector = user.find<QDockWidget>("dock.inspector");
        QCOMPARE(user.window.dockWidgetArea(inspector), Qt::LeftDockWidgetArea);
        inspector->close();
        QVERIFY(!inspector->isVisible());
        user.action("docks.reset")->trigger();
        QVERIFY(inspector->isVisible());
        QCOMPARE(user.window.dockWidgetArea(inspector), Qt::RightDockWidgetArea);
    }

    // Qt's windows keep bars of tabs that no dock needs any more, and do not hide each of them.
    void noEmptyBarOfTabsLiesOverADock() {
        User user;
        QVERIFY(user.import("cuboid"));
        for (int round = 0; round < 2; ++round) {
            for (const pages::Page* page : user.window.findChildren<pages::Page*>()) {
                QVERIFY(user.show(page->face().name));
                QTest::qWait(300);  // docks move into their places
                const auto bars = user.window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly);
                for (const QTabBar* bar : bars) {
                    if (bar->count() > 0 || !user.window.rect().intersects(bar->geometry())) continue;
                    QVERIFY(user.window.childAt(bar->geometry().center()) != bar);
                }
            }
        }
    }

    // A tab names its panel; a bar without a name would only be a band between them.
    void aPanelHasATabOrATitle() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("evolve"));
        auto* log = user.find<QDockWidget>("dock.evolve.log");
        QTRY_COMPARE(log->titleBarWidget()->sizeHint().height(), 0);
        log->raise();
        QTRY_COMPARE(log->widget()->y(), 0);
        log->setFloating(true);
        QTRY_VERIFY(log->titleBarWidget()->height() > 10);
        QTRY_VERIFY(log->titleBarWidget()->findChild<QLabel*>()->isVisible());
        log->setFloating(false);
        QTRY_COMPARE(log->titleBarWidget()->sizeHint().height(), 0);
        // The last one that is left has no tab any more.
        for (QDockWidget* dock : user.window.findChildren<QDockWidget*>())
            if (dock->objectName().startsWith("dock.evolve.") && dock != log) dock->close();
        QTRY_VERIFY(log->titleBarWidget()->height() > 10);
        QCOMPARE(log->titleBarWidget()->findChild<QLabel*>()->text(), log->windowTitle());
    }

    void aTabFloatsAndClosesItsPanel() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("evolve"));
        auto* log = user.find<QDockWidget>("dock.evolve.log");
        QTabBar* tabs = nullptr;
        int tab = -1;
        QTRY_VERIFY(([&] {
            for (QTabBar* bar : user.window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
                for (int i = 0; i < bar->count(); ++i)
                    if (bar->tabText(i) == log->windowTitle()) tabs = bar, tab = i;
            return tabs != nullptr;
        })());
        QTRY_COMPARE(tabs->contextMenuPolicy(), Qt::CustomContextMenu);
        emit tabs->customContextMenuRequested(tabs->tabRect(tab).center());
        auto* menu = tabs->findChild<QMenu*>("panelMenu");
        QVERIFY(menu != nullptr && menu->actions().size() == 2);
        menu->actions().back()->trigger();
        QVERIFY(log->isHidden());
        menu->close();
        log->toggleViewAction()->trigger();
        QTRY_VERIFY(!log->isHidden());
    }

    // Only one page is shown at a time, and Validate has the scene's digits while it is.
    void everyShortcutIsListedOnce() {
        User user;
        const std::vector<window::Shortcut> shortcuts = window::findShortcuts(user.window);
        const QStringList menus = {"File", "Edit", "View", "Run", "Help"};
        const QStringList taken = {"1", "2", "3"};
        QStringList keys;
        QStringList used;
        for (const window::Shortcut& shortcut : shortcuts) {
            QVERIFY(!shortcut.text.isEmpty() && !shortcut.keys.isEmpty());
            keys << shortcut.keys;
            used << (menus.contains(shortcut.place) ? QString() : shortcut.place + ' ') + shortcut.keys;
        }
        for (const char* expected : {"Ctrl+N", "Ctrl+O", "Ctrl+Shift+S", "Ctrl+W", "Ctrl+Q", "Ctrl+Z",
                                     "Ctrl+1", "Ctrl+2", "Ctrl+I", "F1", "F5", "F11"}) {
            QVERIFY2(keys.contains(expected), expected);
        }
        QStringList unique = used;
        unique.removeDuplicates();
        QCOMPARE(used, unique);
        for (const window::Shortcut& shortcut : shortcuts) {
            if (menus.contains(shortcut.place) || taken.contains(shortcut.keys)) continue;
            QVERIFY2(!used.contains(shortcut.keys), qPrintable(shortcut.keys));
        }
        QVERIFY(window::shortcutTable(shortcuts).contains("| File | Open study | Ctrl+O |"));
    }

    // One that works only in a chart or a table would be pressed elsewhere, and do nothing.
    void aKeyThatAMenuShowsWorksEverywhere() {
        User user;
        QVERIFY(user.import("cuboid"));
        for (const QAction* action : user.window.findChildren<QAction*>()) {
            if (action->shortcut().isEmpty() || action->associatedObjects().isEmpty()) continue;
            QVERIFY2(action->shortcutContext() == Qt::WindowShortcut ||
                         action->shortcutContext() == Qt::ApplicationShortcut ||
                         !action->isShortcutVisibleInContextMenu(),
                     qPrintable(action->text()));
        }
    }

    // Where it has not: paste what trapwright-studio --shortcuts prints.
    void theReadmeHasTheTable() {
        QFile readme(TRAPWRIGHT_SOURCE_DIR "/README.md");
        QVERIFY(readme.open(QIODevice::ReadOnly));
        const QString text = QString::fromUtf8(readme.readAll());
        const User user;
        for (const QString& line : window::shortcutTable(window::findShortcuts(user.window)).split('\n'))
            QVERIFY2(text.contains(line), qPrintable(line));
    }

    void helpShowsTheShortcuts() {
        User user;
        QTest::keyClick(&user.window, Qt::Key_F1, Qt::ControlModifier);
        auto* list = user.find<QTreeWidget>("shortcuts.list");
        QVERIFY(list != nullptr && list->isVisible());
        QTest::keyClicks(user.find<QLineEdit>("shortcuts.search"), "undo");
        int shown = 0;
        for (int i = 0; i < list->topLevelItemCount(); ++i)
            for (int j = 0; j < list->topLevelItem(i)->childCount(); ++j)
                shown += !list->topLevelItem(i)->isHidden() && !list->topLevelItem(i)->child(j)->isHidden()
                             ? 1
                             : 0;
        QCOMPARE(shown, 1);
    }

    // The keyboard reaches everything, and a screen reader has a name for it.
    void everyControlHasANameAndTakesTheFocus() {
        User user;
        QVERIFY(user.import("cuboid"));
        for (const char* page : kPages) {
            QVERIFY(user.show(page));
            for (const QAbstractButton* button : user.window.findChildren<QAbstractButton*>()) {
                if (!button->isVisible() || button->objectName().startsWith("qt_")) continue;
                const QString name =
                    button->accessibleName().isEmpty() ? button->text() : button->accessibleName();
                QVERIFY2(!name.isEmpty(), qPrintable(button->objectName()));
                QVERIFY2(button->focusPolicy() & Qt::TabFocus, qPrintable(button->objectName() + name));
            }
        }
    }

    // 1280 x 720 holds the whole window, and the inspector does not need to be moved sideways.
    void itFitsOnASmallScreen() {
        User user;
        QVERIFY(user.import("cuboid"));
        for (const char* page : kPages) {
            QVERIFY(user.show(page));
            QVERIFY2(user.window.minimumSizeHint().width() <= 1280 &&
                         user.window.minimumSizeHint().height() <= 720,
                     page);
            QCOMPARE(user.window.size(), QSize(1280, 720));
            // Nothing of the page is to the right of what is seen.
            const auto* shown = user.find<pages::Page>(QString("page.") + page);
            QTRY_VERIFY2(shown->width() <= shown->parentWidget()->width(), page);
        }
    }

 private:
    QTemporaryDir folder_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    MainWindowTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "main_window_test.moc"
