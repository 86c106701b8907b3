// Materials and the drop test on the Part and Track pages: chosen, proposed, made, imported, dropped.

#include "ui/pages/part_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFrame>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>
#include <algorithm>
#include <fstream>

#include "core/part/stable_poses.h"
#include "core/study/presets.h"
#include "core/workflow/part_source.h"
#include "sim/native/native_engine.h"
#include "tests/core/study/fake_engine.h"
#include "ui/pages/materials_dialog.h"
#include "ui/pages/run_actions.h"
#include "ui/pages/track_page.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/session/study_session.h"

using namespace trapwright;

namespace {

constexpr int kPatience = 60000;  // [ms] on a busy machine

session::Environment environment(const std::filesystem::path& own) {
    session::Environment environment;
    environment.program = "trapwright 0.0-test";
    environment.ownMaterials = own;
    environment.engines = fake::enginesMadeBy([](const std::string&, const trial::EngineOptions& options) {
        return std::make_unique<native::NativeEngine>(options);
    });
    return environment;
}

/// A designer at the two pages, who has imported the cuboid.
struct Designer {
    std::unique_ptr<session::StudySession> study;
    pages::PartPage part;
    pages::RunActions run;
    pages::TrackPage track{run};
    QSignalSpy failed{&part, &pages::Page::failed};

    explicit Designer(std::unique_ptr<session::StudySession> opened) : study(std::move(opened)) {
        part.resize(360, 1400);
        part.show();
        part.setSession(study.get());
        track.setSession(study.get());
    }
    ~Designer() {
        part.setSession(nullptr);
        track.setSession(nullptr);
    }
    session::StudySession* session() { return study.get(); }
    template <class Object>
    Object* find(const QString& name) {
        auto* object = part.findChild<Object*>(name);
        return object != nullptr ? object : track.findChild<Object*>(name);
    }
    QString text(const QString& label) { return find<QLabel>(label)->text(); }
    void choose(const QString& box, const QString& text) {
        auto* combo = find<QComboBox>(box);
        combo->setCurrentIndex(combo->findText(text));
        emit combo->activated(combo->currentIndex());
    }
    void press(const QString& button) { find<QPushButton>(button)->click(); }
    const trial::ContactParameters& contact() { return study->design().settings().simulation.contact; }
    pages::MaterialsDialog* library(const QString& button) {
        press(button);
        return find<pages::MaterialsDialog>("materials");
    }
};

}  // namespace

class PartPageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        QCoreApplication::setOrganizationName("Trapwright");
    }
    void init() {
        QSettings().clear();
        own_ = folder_.filePath(QTest::currentTestFunction()).toStdString();
    }

    // The pair of a new material is proposed; the user's own numbers stay until he takes it.
    void materialProposesItsPair() {
        Designer user(create());
        QCOMPARE(user.find<QComboBox>("part.material")->currentText(), QString("ABS"));
        auto* proposal = user.find<QWidget>("part.proposal");
        QVERIFY(proposal->isHidden());
        user.choose("part.material", "steel");
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->density, 7850.0, kPatience);
        QTRY_VERIFY(!proposal->isHidden());
        QVERIFY(user.text("part.proposal.text").startsWith("steel on printed plastic: friction 0.35 static"));
        QCOMPARE(user.contact().staticFriction, 0.5);

        // Refused: nothing changes, and it is not asked again.
        user.press("part.proposal.keep");
        QVERIFY(proposal->isHidden());
        QCOMPARE(user.contact().staticFriction, 0.5);

        user.choose("part.material", "POM");
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->density, 1410.0, kPatience);
        QTRY_VERIFY(!proposal->isHidden());
        user.press("part.proposal.take");
        QVERIFY(proposal->isHidden());
        QCOMPARE(user.contact().staticFriction, 0.3);
        QCOMPARE(user.session()->design().settings().simulation.surface, std::string("printed plastic"));
        user.session()->design().undoStack()->undo();
        QCOMPARE(user.contact().staticFriction, 0.5);
        user.session()->design().undoStack()->undo();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->density, 7850.0, kPatience);
        QCOMPARE(user.find<QComboBox>("part.material")->currentText(), QString("steel"));
    }

    void trackOffersThePairsOfThePart() {
        Designer user(create());
        auto* contact = user.find<QComboBox>("track.contact");
        QCOMPARE(contact->currentText(), QString("ABS on printed plastic"));
        for (int i = 0; i + 1 < contact->count(); ++i)
            QVERIFY(contact->itemText(i).startsWith("ABS on "));
        user.choose("track.contact", "ABS on steel sheet");
        QCOMPARE(user.contact().staticFriction, 0.4);
        QCOMPARE(contact->currentText(), QString("ABS on steel sheet"));
        auto* field = user.find<QLineEdit>("field.simulation.contact.staticFriction");
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, "0.43");
        QTest::keyClick(field, Qt::Key_Return);
        QTRY_COMPARE(contact->currentText(), QString("Own values"));
    }

    void ownPairIsMadeUsedAndRemoved() {
        Designer user(create());
        auto* dialog = user.library("part.library");
        auto* table = dialog->findChild<QTableView*>("materials.table");
        auto* search = dialog->findChild<QLineEdit*>("materials.search");
        QCOMPARE(search->text(), QString("ABS"));
        search->setText("aluminium steel sheet");
        QCOMPARE(table->model()->rowCount(), 1);
        QVERIFY(dialog->findChild<QLabel*>("materials.details")->text().contains("Marks"));
        // What comes with the program is not removed.
        QVERIFY(!dialog->findChild<QPushButton*>("materials.remove")->isEnabled());

        dialog->findChild<QPushButton*>("materials.new")->click();
        auto* editor = dialog->findChild<QDialog*>("pairEditor");
        QVERIFY(editor != nullptr);
        editor->findChild<QLineEdit*>("pair.surface")->setText("our anodised plate");
        editor->findChild<QDoubleSpinBox*>("pair.static.value")->setValue(0.28);
        editor->findChild<QPushButton*>("pair.save")->click();
        auto* problem = editor->findChild<QLabel*>("pair.problem");
        QVERIFY2(problem->text().contains("above the static friction"), qPrintable(problem->text()));
        editor->findChild<QDoubleSpinBox*>("pair.kinetic.value")->setValue(0.22);
        editor->findChild<QLineEdit*>("pair.static.source")->setText("our slope, 20 times");
        editor->findChild<QPushButton*>("pair.save")->click();
        QVERIFY(std::filesystem::exists(own_ / "aluminium-on-our-anodised-plate.json"));
        QVERIFY(dialog->findChild<QLabel*>("materials.details")->text().contains("our slope, 20 times"));

        dialog->findChild<QPushButton*>("materials.use")->click();
        QCOMPARE(user.contact().staticFriction, 0.28);
        // As when the page is shown again.
        user.track.setSession(user.session());
        QCOMPARE(user.contact().kineticFriction, 0.22);
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->density, 2700.0, kPatience);
        QCOMPARE(user.find<QComboBox>("track.contact")->currentText(),
                 QString("aluminium on our anodised plate"));

        dialog = user.library("track.library");
        search = dialog->findChild<QLineEdit*>("materials.search");
        search->setText("anodised");
        dialog->findChild<QPushButton*>("materials.remove")->click();
        auto* question = dialog->findChild<QMessageBox*>("materials.removeQuestion");
        QVERIFY(question != nullptr);
        question->buttons().front()->click();
        QTRY_VERIFY(!std::filesystem::exists(own_ / "aluminium-on-our-anodised-plate.json"));
        // The study keeps its numbers.
        QCOMPARE(user.contact().staticFriction, 0.28);
    }

    void brokenFileIsToldAndHidesNoOther() {
        std::filesystem::create_directories(own_);
        std::ofstream(own_ / "cheese.json") << "{ \"format\": \"trapwright material\" }";
        part::MaterialPair good = *part::findPair(part::readMaterials(), "ABS", "printed PLA");
        good.surface = "cork";
        QVERIFY(part::savePair(own_, good).ok());
        Designer user(create());
        QCOMPARE(user.failed.count(), 1);
        QVERIFY(user.failed[0][1].toString().contains("cheese.json"));
        auto* dialog = user.library("part.library");
        QVERIFY(dialog->findChild<QLabel*>("materials.problems")->text().contains("at \"version\""));
        dialog->findChild<QLineEdit*>("materials.search")->setText("cork");
        QCOMPARE(dialog->findChild<QTableView*>("materials.table")->model()->rowCount(), 1);
    }

    // Poses are chosen, one more, a heading; learning looks at it when the user says so; and all is undone.
    void wantedPosesAreChosen() {
        Designer user(create());
        const auto settings = [&] { return user.session()->design().settings(); };
        const auto press = [&](const QString& name) {
            auto* button = user.find<QAbstractButton>(name);
            QVERIFY2(button != nullptr && button->isVisible(), qPrintable(name));
            QTest::mouseClick(button, Qt::LeftButton);
        };
        QTRY_VERIFY(user.find<QToolButton>("target.pose5") != nullptr);
        // One button for each of the three kinds of pose.
        QVERIFY(user.find<QToolButton>("target.pose2") == nullptr);
        QVERIFY(user.find<QToolButton>("target.any")->isChecked());
        QVERIFY(!user.find<QCheckBox>("target.anyHeading")->isVisible());
        QTRY_VERIFY(!user.find<QToolButton>("target.pose3")->icon().isNull());

        press("target.pose3");
        QCOMPARE(settings().target.poses, std::string("3-4"));
        QVERIFY(!user.find<QToolButton>("target.any")->isChecked());
        QVERIFY2(user.text("target.told").startsWith(QString("Pose 3–4, any heading.")),
                 qPrintable(user.text("target.told")));
        // It is proposed to learn for it, and the user's objective is his own until he agrees.
        QVERIFY(user.find<QWidget>("target.proposal")->isVisible());
        QCOMPARE(settings().evolution.objectives, std::string(objectives::kPaperObjectives));
        press("target.count");
        QCOMPARE(settings().evolution.objectives, std::string(objectives::kWantedObjectives));
        QVERIFY(!user.find<QWidget>("target.proposal")->isVisible());
        QVERIFY(user.session()->design().problems().empty());
        const auto attainable = user.session()->design().attainable();
        QVERIFY(std::ranges::any_of(attainable, [](const objectives::Score& score) {
            return score.key == "F_W" && score.value == 1.0;
        }));

        press("target.pose5");
        QCOMPARE(settings().target.poses, std::string("3-6"));
        QVERIFY(user.text("target.told").startsWith(QString("Pose 3–4 or 5–6, any heading.")));
        press("target.pose3");
        QCOMPARE(settings().target.poses, std::string("5-6"));
        // In a groove no part lies level.
        QVERIFY(!user.text("target.told").contains("lean"));
        study::Settings sorting = settings();
        sorting.track.traps = "groove, groove, 2 x gap";
        user.session()->design().changeSettings(sorting, "Traps");
        QVERIFY2(user.text("target.told").contains(QString("lean across the track by up to 24°")),
                 qPrintable(user.text("target.told")));
        user.session()->design().undoStack()->undo();
        QVERIFY(!user.text("target.told").contains("lean"));

        user.find<QCheckBox>("target.anyHeading")->click();
        QCOMPARE(settings().target.heading, std::string("0"));
        auto* heading = user.find<QDoubleSpinBox>("target.heading");
        QVERIFY(heading->isEnabled());
        heading->setFocus();
        heading->selectAll();
        QTest::keyClicks(heading, "90");
        QTest::keyClick(heading, Qt::Key_Return);
        QCOMPARE(settings().target.heading, std::string("90"));
        QVERIFY(user.text("target.told").startsWith(QString("Pose 5–6, heading 90°.")));

        // Back to any way: F_W, which there is not then, goes with it.
        press("target.any");
        QVERIFY(!settings().target.isSet());
        QCOMPARE(settings().evolution.objectives, std::string(objectives::kPaperObjectives));
        QVERIFY(user.session()->design().problems().empty());
        user.session()->design().undoStack()->undo();
        QCOMPARE(settings().target.poses, std::string("5-6"));
        QCOMPARE(settings().evolution.objectives, std::string(objectives::kWantedObjectives));
        QTRY_VERIFY(user.find<QToolButton>("target.pose5")->isChecked());

        // Another density is the same shape; another shape has other poses.
        user.choose("part.material", "steel");
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->density, 7850.0, kPatience);
        QCOMPARE(settings().target.poses, std::string("5-6"));
        user.session()->design().changePart(workflow::importPart({"cone"}).value(), "Import");
        QCOMPARE(settings().target.poses, std::string());
        user.session()->design().undoStack()->undo();
        QCOMPARE(settings().target.poses, std::string("5-6"));
    }

    /// The part is turned in the scene with the mouse, the keys and the buttons, laid down and chosen.
    void wantedOrientationIsTurnedByHand() {
        Designer user(create());
        scene::SceneView scene;
        scene.resize(600, 400);
        scene.show();
        user.part.activate(scene);
        const auto wanted = [&] { return user.session()->design().settings().target.orientation; };
        const auto press = [&](const QString& name) {
            QTest::mouseClick(user.find<QAbstractButton>(name), Qt::LeftButton);
        };
        const auto shown = [&] { return scene.contents().parts.front().pose; };
        QTRY_VERIFY(user.find<QToolButton>("target.byHand") != nullptr);
        QVERIFY(scene.contents().stablePoses != nullptr);

        press("target.byHand");
        QVERIFY(scene.contents().stablePoses == nullptr);
        QCOMPARE(scene.contents().parts.size(), 1U);
        const std::shared_ptr<const part::Part> part = user.session()->design().part();
        const base::Quaternion resting = part->stablePoses.front().rotation;
        QVERIFY(shown().rotation.angularDistance(resting) < 1e-9);
        QVERIFY(user.text("orientation.told").contains("lies in pose"));
        QVERIFY(!user.find<QPushButton>("orientation.layDown")->isEnabled());

        // A drag turns the part, not the view; it stays on the flat.
        const scene::Camera camera = scene.camera();
        QTest::mousePress(&scene, Qt::LeftButton, {}, {300, 200});
        QMouseEvent move(QEvent::MouseMove, {300, 300}, scene.mapToGlobal(QPoint(300, 300)), Qt::NoButton,
                         Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&scene, &move);
        QTest::mouseRelease(&scene, Qt::LeftButton, {}, {300, 300});
        QCOMPARE(scene.camera(), camera);
        QCOMPARE(qRound(shown().rotation.angularDistance(resting) / base::kDegree), 35);
        double lowest = 1.0;
        for (const base::Vec3& vertex : part->hull.vertices)
            lowest = std::min(lowest, shown().apply(vertex).z());
        QVERIFY(std::abs(lowest) < 1e-9);
        QVERIFY2(user.text("orientation.told").contains("parts do not rest like this"),
                 qPrintable(user.text("orientation.told")));
        // The right button turns the view.
        QTest::mousePress(&scene, Qt::RightButton, {}, {300, 200});
        QMouseEvent orbit(QEvent::MouseMove, {330, 200}, scene.mapToGlobal(QPoint(330, 200)), Qt::NoButton,
                          Qt::RightButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&scene, &orbit);
        QTest::mouseRelease(&scene, Qt::RightButton, {}, {330, 200});
        QVERIFY(scene.camera().azimuth != camera.azimuth);

        // Cancelled, nothing is wanted and the poses are there again.
        press("orientation.cancel");
        QVERIFY(!wanted());
        QVERIFY(scene.contents().stablePoses != nullptr);
        QVERIFY(user.find<QToolButton>("target.any")->isChecked());
        QVERIFY(!user.find<QToolButton>("target.byHand")->isChecked());

        press("target.byHand");
        press("orientation.tip");
        QTest::keyClick(&scene, Qt::Key_Right);
        press("orientation.layDown");
        const base::Quaternion made = shown().rotation;
        press("orientation.want");
        QVERIFY(wanted() && wanted()->angularDistance(made) < 1e-9);
        QVERIFY(part::findStablePose(*part, *wanted()).angle < 1e-6);
        QVERIFY(wanted()->angularDistance(resting) > 80.0 * base::kDegree);
        QVERIFY(user.text("target.told").startsWith("An orientation set by hand."));
        auto* turns = user.find<QCheckBox>("target.anyHeading");
        QVERIFY(turns->isVisible() && !turns->isChecked());
        QVERIFY(!user.find<QDoubleSpinBox>("target.heading")->isVisible());
        turns->click();
        QVERIFY(user.session()->design().settings().target.orientationTurns);
        QVERIFY(user.text("target.told").startsWith("An orientation set by hand, any heading."));
        user.session()->design().undoStack()->undo();
        QVERIFY(wanted() && !user.session()->design().settings().target.orientationTurns);
        QVERIFY(user.find<QToolButton>("target.byHand")->isChecked());
        QTRY_VERIFY(!user.find<QToolButton>("target.byHand")->icon().isNull());
        QVERIFY(user.session()->design().problems().empty());

        // Another page takes the scene: what was not chosen is gone.
        press("target.byHand");
        press("orientation.turn");
        user.part.deactivate();
        QVERIFY(wanted()->angularDistance(made) < 1e-9);
        QVERIFY(!user.find<QWidget>("orientationEditor")->isVisible());
        user.session()->design().undoStack()->undo();
        QVERIFY(!wanted());

        // So does a study that is closed.
        user.part.activate(scene);
        press("target.byHand");
        QVERIFY(user.part.findChild<QWidget*>("orientationEditor")->isVisible());
        user.part.setSession(nullptr);
        QVERIFY(user.part.findChild<QWidget*>("orientationEditor")->isHidden());
    }

    // Dropped, cancelled, dropped again, chosen to count, and the same when it is opened again.
    void partIsDropped() {
        std::filesystem::path path;
        study::DropRecord dropped;
        {
            Designer user(create());
            path = user.session()->path();
            QTRY_COMPARE(user.part.findChildren<QFrame*>("poseCard").size(), 3);
            QVERIFY(user.find<QLabel>("pose.dropped") == nullptr);
            QCOMPARE(user.find<QDoubleSpinBox>("drop.static")->value(), 0.5);
            user.choose("drop.surface", "steel sheet");
            QCOMPARE(user.find<QDoubleSpinBox>("drop.static")->value(), 0.4);
            user.find<QSpinBox>("drop.drops")->setValue(100000);
            user.press("drop.start");
            QVERIFY(user.session()->design().drops().has_value());
            QTRY_VERIFY_WITH_TIMEOUT(user.find<QProgressBar>("drop.bar")->value() > 0, kPatience);
            user.press("drop.cancel");
            QVERIFY(!user.session()->design().drops() && !user.session()->design().dropTest());
            QCOMPARE(user.text("drop.last"), QString("Not dropped yet."));

            user.find<QSpinBox>("drop.drops")->setValue(24);
            user.find<QDoubleSpinBox>("drop.height")->setValue(12.0);
            user.find<QSpinBox>("drop.seed")->setValue(5);
            user.press("drop.start");
            QTRY_VERIFY_WITH_TIMEOUT(user.session()->design().dropTest().has_value(), 3 * kPatience);
            dropped = *user.session()->design().dropTest();
            QCOMPARE(dropped.result.drops(), 24);
            QCOMPARE(dropped.settings.height, 12e-3);
            QCOMPARE(dropped.settings.contact.staticFriction, 0.4);
            QCOMPARE(dropped.engine, std::string("simbody"));
            QTRY_COMPARE(user.part.findChildren<QLabel*>("pose.dropped").size(), 3);
            QVERIFY(user.text("drop.last").startsWith("24 dropped from 12 mm; friction 0.4 static"));
            QVERIFY(!user.find<QLabel>("pose.dropped")->font().bold());
            user.choose("field.part.poseWeights", "Drop test");
            QVERIFY(user.session()->design().settings().part.poseWeights == study::PoseWeights::dropped);
            QTRY_VERIFY(user.find<QLabel>("pose.dropped")->font().bold());
            user.session()->design().undoStack()->undo();
            QVERIFY(user.session()->design().settings().part.poseWeights == study::PoseWeights::quasiStatic);
            user.session()->design().undoStack()->redo();
            QTest::qWait(200);
        }
        auto opened = session::StudySession::open(path, environment(own_));
        QVERIFY(opened.ok());
        Designer user(std::move(opened).value());
        QVERIFY(user.session()->design().dropTest() == dropped);
        QVERIFY(user.session()->design().settings().part.poseWeights == study::PoseWeights::dropped);
        QCOMPARE(user.find<QSpinBox>("drop.seed")->value(), 5);
        QTRY_COMPARE(user.part.findChildren<QLabel*>("pose.dropped").size(), 3);
    }

 private:
    std::unique_ptr<session::StudySession> create() {
        static int number = 0;
        const auto part = workflow::importPart({"cuboid"}).value();
        auto made = session::StudySession::create(
            folder_.filePath(QString("study%1.trap").arg(++number)).toStdString(),
            study::presetSettings("cuboid").value(), part, environment(own_));
        return made.ok() ? std::move(made).value() : nullptr;
    }

    QTemporaryDir folder_;
    std::filesystem::path own_;
};

QTEST_MAIN(PartPageTest)
#include "part_page_test.moc"
