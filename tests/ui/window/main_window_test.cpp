#include "ui/window/main_window.h"

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>
#include <QtTest>
#include <fstream>

#include "core/part/bundled.h"
#include "ui/look/message_bar.h"
#include "ui/look/theme.h"
#include "ui/pages/page.h"
#include "ui/pages/value_edit.h"
#include "ui/scene/scene_view.h"
#include "ui/window/shortcut_list.h"

using namespace trapwright;

namespace {

constexpr int kPatience = 20000;  // [ms] for what happens in the background, on a busy machine

base::Result<std::shared_ptr<const trial::Engine>> noEngine(const std::string&, const trial::EngineOptions&) {
    return base::Error{"There is no engine in this test."};
}

std::filesystem::path bundled(const char* name) {
    return part::findBundledFile(part::findBundledPart(name).value());
}

bool writeObj(const geometry::TriangleMesh& mesh, const std::filesystem::path& path) {
    std::ofstream file(path);
    file.precision(17);
    for (const base::Vec3& v : mesh.vertices)
        file << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const geometry::Triangle& t : mesh.triangles)
        file << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    return bool(file.flush());
}

/// The window and what a user does in it.
struct User {
    window::MainWindow window{{noEngine, "trapwright test", {}}};

    User() {
        window.resize(1280, 720);
        window.show();
        window.activateWindow();
        (void)QTest::qWaitForWindowActive(&window);
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
    QAction* action(const QString& name) { return find<QAction>(name); }
    QString message() { return find<look::MessageBar>("messageBar")->text(); }

    bool import(const char* name) {
        window.openFile(bundled(name));
        return QTest::qWaitFor([&] { return session() != nullptr; }, kPatience);
    }
    bool show(const QString& page) {
        window.showPage(page);
        return QTest::qWaitFor([&] { return find<pages::Page>("page." + page)->isVisible(); });
    }
    void type(const QString& field, const QString& text) {
        auto* edit = find<QLineEdit>("field." + field);
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    }
};

}  // namespace

class MainWindowTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        qputenv("XDG_DATA_HOME", folder_.filePath("data").toLocal8Bit());
        QCoreApplication::setOrganizationName("Trapwright");
        QCoreApplication::setApplicationName("main_window_test");
    }
    void init() { QSettings().clear(); }

    void withoutAStudyThereAreThreeWaysToBegin() {
        User user;
        for (const char* name : {"welcome.import", "welcome.open", "welcome.example"})
            QVERIFY2(user.find<QPushButton>(name)->isVisible(), name);
        QVERIFY(!user.find<scene::SceneView>("scene")->isVisible());
        QVERIFY(!user.action("run.start")->isEnabled());
        QVERIFY(!user.action("file.saveAs")->isEnabled());
    }

    void importShowsThePart() {
        User user;
        QVERIFY(user.import("cuboid"));
        QCOMPARE(user.find<QLabel>("part.name")->text(), QString("cuboid"));
        QCOMPARE(user.find<QLabel>("part.size")->text(), QString("4 × 8 × 12 mm"));
        QVERIFY(user.find<QLabel>("part.symmetry")->text().startsWith("D2"));
        // Three pairs of faces, each face a pose.
        QTRY_COMPARE(user.window.findChildren<QFrame*>("poseCard").size(), 6);
        QVERIFY(user.find<scene::SceneView>("scene")->contents().stablePoses != nullptr);
        QVERIFY(user.action("run.start")->isEnabled());
    }

    // STL has no unit; 4 x 8 x 12 of what would be 0.3 m in feet.
    void anotherUnitChangesTheSizeAndCanBeUndone() {
        User user;
        QVERIFY(user.import("cuboid"));
        auto* unit = user.find<QComboBox>("part.unit");
        QVERIFY(unit->findData("cm") >= 0);
        unit->setCurrentIndex(unit->findData("cm"));
        emit unit->activated(unit->currentIndex());
        QTRY_COMPARE_WITH_TIMEOUT(user.find<QLabel>("part.size")->text(), QString("40 × 80 × 120 mm"), kPatience);
        // It does not fit the track any more: said here, and learning waits for it.
        QVERIFY(user.find<QLabel>("part.misfit")->isVisible());
        QVERIFY(!user.action("run.start")->isEnabled());
        user.action("edit.undo")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(user.find<QLabel>("part.size")->text(), QString("4 × 8 × 12 mm"), kPatience);
        QVERIFY(user.action("run.start")->isEnabled());
    }

    void materialSetsTheDensity() {
        User user;
        QVERIFY(user.import("cuboid"));
        auto* material = user.find<QComboBox>("part.material");
        material->setCurrentIndex(material->findText("steel"));
        emit material->activated(material->currentIndex());
        // EN 1991-1-1.
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->settings().part.density, 7850.0, kPatience);
        QCOMPARE(user.session()->part()->density, 7850.0);
        QCOMPARE(user.find<QLineEdit>("field.part.density_kg_m3")->text(), QString("7850"));
    }

    void anEditIsUndoneAndRedone() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        user.type("track.segmentWidth_mm", "70");
        QCOMPARE(user.session()->settings().track.segmentWidth, 70e-3);
        QTest::keyClick(&user.window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(user.session()->settings().track.segmentWidth, 60e-3);
        QCOMPARE(user.find<QLineEdit>("field.track.segmentWidth_mm")->text(), QString("60"));
        QTest::keyClick(&user.window, Qt::Key_Y, Qt::ControlModifier);
        QCOMPARE(user.session()->settings().track.segmentWidth, 70e-3);
    }

    void theSceneFollowsAnEdit() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        auto* scene = user.find<scene::SceneView>("scene");
        QTRY_VERIFY_WITH_TIMEOUT(scene->contents().track != nullptr, kPatience);
        QCOMPARE(scene->contents().track->width, 60e-3);
        user.type("track.segmentWidth_mm", "90");
        QTRY_COMPARE_WITH_TIMEOUT(scene->contents().track->width, 90e-3, kPatience);
        // Its start point has 60 mm of lead-in behind it (decision 3).
        QCOMPARE(scene->contents().track->start, 60e-3);
    }

    void aBadValueIsMarkedAndKeepsLearningOff() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        QVERIFY(user.action("run.start")->isEnabled());
        user.type("track.crossSections", "0");
        QVERIFY(user.find<pages::ValueEdit>("field.track.crossSections")->isBad());
        QCOMPARE(user.find<QLabel>("reason.track.crossSections")->text(), QString("It must be from 1 to 200."));
        QVERIFY(!user.action("run.start")->isEnabled());
        QVERIFY(user.find<QLabel>("track.problems")->isVisible());
        QCOMPARE(user.find<QLabel>("status.state")->text(), QString("Not ready to learn"));
        user.type("track.crossSections", "5");
        QVERIFY(user.action("run.start")->isEnabled());
        QVERIFY(!user.find<QLabel>("track.problems")->isVisible());
    }

    // design.md, section 3, decision 12.
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
        const study::Settings before = user.session()->settings();
        user.action("preset.cone")->trigger();
        // Table 1.
        QCOMPARE(user.session()->settings().track.minSegmentLength, 22e-3);
        QCOMPARE(user.session()->settings().evolution.staticMutation, 0.001);
        QVERIFY(user.session()->settings().part == before.part);
        user.action("edit.undo")->trigger();
        QVERIFY(user.session()->settings() == before);
    }

    void droppedFilesAreOpened() {
        User user;
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(bundled("pin").string()))});
        QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&user.window, &enter);
        QVERIFY(enter.isAccepted());
        QDropEvent drop({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&user.window, &drop);
        QVERIFY2(QTest::qWaitFor([&] { return user.session() != nullptr; }, kPatience), qPrintable(user.message()));
        QCOMPARE(user.find<QLabel>("part.name")->text(), QString("pin"));
    }

    void aFileThatIsNoPartIsToldWithoutADialog_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("content");
        QTest::newRow("empty") << "empty.stl" << QByteArray();
        QTest::newRow("damaged") << "damaged.stl" << QByteArray("solid x\nfacet normal 0 0");
        QTest::newRow("another kind") << "letter.txt" << QByteArray("hello");
        QTest::newRow("damaged study") << "damaged.trap" << QByteArray("no database");
    }
    void aFileThatIsNoPartIsToldWithoutADialog() {
        QFETCH(QString, name);
        QFETCH(QByteArray, content);
        QFile file(folder_.filePath(name));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(content) == content.size());
        file.close();
        User user;
        user.window.openFile(file.fileName().toStdString());
        QTRY_VERIFY_WITH_TIMEOUT(!user.message().isEmpty(), kPatience);
        QVERIFY2(user.message().contains(name), qPrintable(user.message()));
        QVERIFY(user.session() == nullptr);
        QVERIFY(QApplication::activeModalWidget() == nullptr);
    }

    // The same cuboid in metres: 12 thousandths of a millimetre would be no part.
    void theUnitIsAskedForWhereItCannotBeAssumed() {
        geometry::TriangleMesh metres = part::makeBundledShape("cuboid");
        const std::filesystem::path file = folder_.filePath("metres.obj").toStdString();
        QVERIFY(writeObj(metres, file));
        User user;
        user.window.openFile(file);
        QTRY_VERIFY_WITH_TIMEOUT(user.find<QPushButton>("unit.m") != nullptr, kPatience);
        QVERIFY(user.find<QPushButton>("unit.m")->isVisible());
        QVERIFY(user.find<QPushButton>("unit.m")->text().contains("4 × 8 × 12 mm"));
        QTest::mouseClick(user.find<QPushButton>("unit.m"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QCOMPARE(user.session()->settings().part.units, std::string("m"));
        QCOMPARE(user.find<QLabel>("part.size")->text(), QString("4 × 8 × 12 mm"));
    }

    void aLargeHoleIsClosedOnlyWhenAsked() {
        geometry::TriangleMesh open = part::makeBundledShape("cuboid");
        for (base::Vec3& vertex : open.vertices)
            vertex *= 1e3;
        open.triangles.pop_back();
        const std::filesystem::path file = folder_.filePath("open.obj").toStdString();
        QVERIFY(writeObj(open, file));
        User user;
        user.window.openFile(file);
        QTRY_VERIFY_WITH_TIMEOUT(user.find<QPushButton>("repair") != nullptr, kPatience);
        QVERIFY(user.session() == nullptr);
        QTest::mouseClick(user.find<QPushButton>("repair"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        // Closed, it is the cuboid again: 4 x 8 x 12 mm.
        QVERIFY(std::abs(user.session()->part()->massProperties.volume - 384e-9) < 1e-12);
        QTRY_VERIFY_WITH_TIMEOUT(!user.find<QLabel>("part.notes")->text().isEmpty(), kPatience);
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
        QCOMPARE(user.session()->settings().track.segmentWidth, 56e-3);
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

    void everyShortcutIsListedOnce() {
        User user;
        const std::vector<window::Shortcut> shortcuts = window::findShortcuts(user.window);
        QStringList keys;
        for (const window::Shortcut& shortcut : shortcuts) {
            QVERIFY(!shortcut.text.isEmpty() && !shortcut.keys.isEmpty());
            keys << shortcut.keys;
        }
        for (const char* expected : {"Ctrl+N", "Ctrl+O", "Ctrl+Shift+S", "Ctrl+W", "Ctrl+Q", "Ctrl+Z", "Ctrl+1", "Ctrl+2",
                                     "Ctrl+I", "F1", "F5", "F11"}) {
            QVERIFY2(keys.contains(expected), expected);
        }
        keys.sort();
        QStringList unique = keys;
        unique.removeDuplicates();
        QCOMPARE(keys, unique);
        QVERIFY(window::shortcutTable(shortcuts).contains("| File | Open study | Ctrl+O |"));
    }

    void helpShowsTheShortcuts() {
        User user;
        QTest::keyClick(&user.window, Qt::Key_F1);
        auto* list = user.find<QTreeWidget>("shortcuts.list");
        QVERIFY(list != nullptr && list->isVisible());
        QTest::keyClicks(user.find<QLineEdit>("shortcuts.search"), "undo");
        int shown = 0;
        for (int i = 0; i < list->topLevelItemCount(); ++i)
            for (int j = 0; j < list->topLevelItem(i)->childCount(); ++j)
                shown += !list->topLevelItem(i)->isHidden() && !list->topLevelItem(i)->child(j)->isHidden() ? 1 : 0;
        QCOMPARE(shown, 1);
    }

    // The keyboard reaches everything, and a screen reader has a name for it.
    void everyControlHasANameAndTakesTheFocus() {
        User user;
        QVERIFY(user.import("cuboid"));
        for (const char* page : {"part", "track"}) {
            QVERIFY(user.show(page));
            for (const QAbstractButton* button : user.window.findChildren<QAbstractButton*>()) {
                if (!button->isVisible() || button->objectName().startsWith("qt_")) continue;
                const QString name = button->accessibleName().isEmpty() ? button->text() : button->accessibleName();
                QVERIFY2(!name.isEmpty(), qPrintable(button->objectName()));
                QVERIFY2(button->focusPolicy() & Qt::TabFocus, qPrintable(button->objectName() + name));
            }
        }
    }

    // 1280 x 720 holds the whole window, and the inspector does not need to be moved sideways.
    void itFitsOnASmallScreen() {
        User user;
        QVERIFY(user.import("cuboid"));
        for (const char* page : {"part", "track"}) {
            QVERIFY(user.show(page));
            QVERIFY2(user.window.minimumSizeHint().width() <= 1280 && user.window.minimumSizeHint().height() <= 720, page);
            QCOMPARE(user.window.size(), QSize(1280, 720));
            auto* field = user.find<QWidget>(page == QString("part") ? "field.part.density_kg_m3" : "track.presets");
            QVERIFY(user.window.rect().contains(field->mapTo(&user.window, field->rect().bottomRight())));
        }
    }

 private:
    QTemporaryDir folder_;
};

int main(int argc, char** argv) {
    scene::SceneView::prepareApplication();
    QApplication application(argc, argv);
    MainWindowTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "main_window_test.moc"
