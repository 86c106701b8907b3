// What mouse wheel, keys and dialogs do, on every page of a study that has learned.

#include <QtTest/qtestspontaneevent.h>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QFileDialog>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QSpinBox>
#include <QTabBar>
#include <QTreeView>
#include <QVBoxLayout>
#include <array>

#include "core/store/study_file.h"
#include "tests/ui/pages/review_user.h"
#include "ui/pages/page.h"

using namespace trapwright;
using pages::kPatience;

namespace {

constexpr std::array kPages = {"part", "track", "evolve", "review", "export", "validate"};

struct BrokenEngine : fake::FakeEngine {
    using FakeEngine::FakeEngine;
    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch>, base::RunControl) const override {
        return base::Error{"The engine is broken."};
    }
};

struct User : tests::WindowUser {
    User() : WindowUser(pages::nativeEnvironment()) {}
    explicit User(const QString& study, const QString& page = "part") : User() {
        (void)open(study.toStdString(), page);
    }
    QString page() {
        for (const pages::Page* page : window.findChildren<pages::Page*>())
            if (page->isVisible()) return page->face().name;
        return {};
    }
    /// As from the desktop: what lies under the mouse may be given the focus for it.
    void turnWheel(QWidget& widget, int notches = -1) {
        const QPointF place = widget.rect().center();
        QWheelEvent wheel(place, widget.mapToGlobal(place), {}, {0, 120 * notches}, Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QSpontaneKeyEvent::setSpontaneous(&wheel);
        // Sent any other way, it would not be taken for the desktop's.
        qApp->notify(&widget, &wheel);
    }
    QFileDialog* dialog() {
        QFileDialog* shown = nullptr;
        (void)QTest::qWaitFor([&] { return (shown = find<QFileDialog>("dialog.file")) != nullptr; });
        return shown;
    }
};

/// What the wheel could change of it; invalid: nothing.
QVariant valueOf(const QWidget& widget) {
    if (const auto* combo = qobject_cast<const QComboBox*>(&widget)) return combo->currentIndex();
    if (const auto* spin = qobject_cast<const QAbstractSpinBox*>(&widget)) return spin->text();
    if (const auto* edit = qobject_cast<const QLineEdit*>(&widget)) return edit->text();
    if (const auto* tabs = qobject_cast<const QTabBar*>(&widget)) return tabs->currentIndex();
    if (qobject_cast<const QScrollBar*>(&widget) != nullptr) return {};
    if (const auto* slider = qobject_cast<const QAbstractSlider*>(&widget)) return slider->value();
    return {};
}

void addPages() {
    QTest::addColumn<QString>("page");
    for (const char* page : kPages)
        QTest::newRow(page) << page;
}

}  // namespace

class InputTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(learned_.learn()); }
    void init() {
        study_ = learned_.copy();
        QVERIFY(!study_.isEmpty());
    }

    void theWheelChangesNothingThatHasNotTheFocus_data() { addPages(); }
    void theWheelChangesNothingThatHasNotTheFocus() {
        QFETCH(QString, page);
        User user(study_, page);
        user.sceneView()->setFocus();
        QTest::qWait(300);
        int tried = 0;
        for (QWidget* widget : user.window.findChildren<QWidget*>()) {
            const QVariant before = valueOf(*widget);
            if (!widget->isVisible() || !before.isValid()) continue;
            ++tried;
            for (const int notches : {-1, 1}) {
                user.turnWheel(*widget, notches);
                QVERIFY2(valueOf(*widget) == before, qPrintable(widget->objectName()));
                QVERIFY2(user.sceneView()->hasFocus(), qPrintable(widget->objectName()));
            }
        }
        QVERIFY(tried > 0);
    }

    void theWheelScrollsWhatAListOfChoicesLiesIn() {
        User user;
        user.action("example.cuboid")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        user.window.showPage("track");
        auto* contact = user.find<QComboBox>("track.contact");
        QScrollArea* area = nullptr;
        for (QWidget* around = contact; area == nullptr; around = around->parentWidget())
            area = qobject_cast<QScrollArea*>(around);
        QTRY_VERIFY(area->verticalScrollBar()->maximum() > 0);
        area->ensureWidgetVisible(contact);
        QTest::qWait(300);
        const int before = area->verticalScrollBar()->value();
        user.turnWheel(*contact, before > 0 ? 1 : -1);
        QTRY_VERIFY(area->verticalScrollBar()->value() != before);
    }

    void withTheFocusTheWheelChooses() {
        User user(study_, "export");
        auto* track = user.find<QComboBox>("export.track");
        QVERIFY(track->count() > 1);
        track->setCurrentIndex(0);
        track->setFocus();
        user.turnWheel(*track);
        QCOMPARE(track->currentIndex(), 1);
    }

    void theWheelIsTheSameInADialog() {
        User user(study_);
        QDialog dialog(&user.window);
        auto* spin = new QSpinBox(&dialog);
        auto* other = new QLineEdit(&dialog);
        auto* column = new QVBoxLayout(&dialog);
        column->addWidget(other);
        column->addWidget(spin);
        dialog.open();
        QVERIFY(QTest::qWaitForWindowActive(&dialog));
        other->setFocus();
        QTRY_VERIFY(other->hasFocus());
        user.turnWheel(*spin, 1);
        QCOMPARE(spin->value(), 0);
        QVERIFY(other->hasFocus());
        spin->setFocus();
        QTRY_VERIFY(spin->hasFocus());
        user.turnWheel(*spin, 1);
        QCOMPARE(spin->value(), 1);
    }

    void keysOfTheSceneWorkWhereNoTextIsTyped_data() {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QString>("focus");
        QTest::addColumn<bool>("works");
        QTest::newRow("scene") << "review"
                               << "scene" << true;
        QTest::newRow("table") << "review"
                               << "trials.table" << true;
        QTest::newRow("list of choices") << "review"
                                         << "transport.speed" << true;
        QTest::newRow("button") << "review"
                                << "review.savePicture" << true;
        QTest::newRow("rail") << "part"
                              << "rail.track" << true;
        QTest::newRow("list of winners") << "evolve"
                                         << "filmStrip.list" << true;
        QTest::newRow("slider") << "evolve"
                                << "filmStrip.slider" << true;
        QTest::newRow("field") << "evolve"
                               << "field.evolution.generations" << false;
        QTest::newRow("spin box") << "review"
                                  << "trials.ghosts" << false;
    }

    void keysOfTheSceneWorkWhereNoTextIsTyped() {
        QFETCH(QString, page);
        QFETCH(QString, focus);
        QFETCH(bool, works);
        User user(study_, page);
        // Of fields, some pages have the same.
        auto* widget = user.find<QWidget>("page." + page)->findChild<QWidget*>(focus);
        if (widget == nullptr) widget = user.find<QWidget>(focus);
        QVERIFY(widget != nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(widget->isVisible() && widget->isEnabled(), kPatience);
        widget->setFocus();
        QTRY_VERIFY(widget->hasFocus());
        const auto edges = [&] { return user.scene().edges; };
        const bool before = edges();
        QTest::keyClick(widget, Qt::Key_E);
        QCOMPARE(edges(), works ? !before : before);
        QTest::keyClick(widget, Qt::Key_E);
        QCOMPARE(edges(), before);
    }

    void importHasItsKeyOnEveryPage_data() {
        QTest::addColumn<QString>("page");
        QTest::newRow("start") << "";
        for (const char* page : kPages)
            QTest::newRow(page) << page;
    }

    void importHasItsKeyOnEveryPage() {
        QFETCH(QString, page);
        User user;
        if (!page.isEmpty()) QVERIFY(user.open(study_.toStdString(), page));
        QTest::keyClick(&user.window, Qt::Key_I, Qt::ControlModifier);
        QVERIFY(user.dialog() != nullptr);
        QCOMPARE(user.dialog()->acceptMode(), QFileDialog::AcceptOpen);
    }

    // Also what a page was still building when its study was closed stays out of the next one's scene.
    void aStudyIsOpenedAgainAsItWasLeft_data() { addPages(); }
    void aStudyIsOpenedAgainAsItWasLeft() {
        QFETCH(QString, page);
        User user(study_, page);
        const auto shown = [&] {
            const scene::SceneContents& scene = user.scene();
            return QString("track %1, solid %2, poses %3")
                .arg(scene.track != nullptr)
                .arg(scene.solid != nullptr)
                .arg(scene.stablePoses != nullptr);
        };
        constexpr int kSettle = 1500;  // [ms]
        QTest::qWait(kSettle);
        const QString before = shown();
        QVERIFY(before.contains('1'));
        user.action("file.close")->trigger();
        QTRY_VERIFY(user.session() == nullptr);
        user.window.openFile(study_.toStdString());
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QCOMPARE(user.page(), page);
        QTest::qWait(kSettle);
        QCOMPARE(shown(), before);
    }

    void anotherStudyBeginsWithItsOwnPage() {
        const QString other = learned_.file("other.trap");
        QFile::remove(other);
        QVERIFY(QFile::copy(study_, other));
        User user(study_, "export");
        user.action("file.close")->trigger();
        QTRY_VERIFY(user.session() == nullptr);
        user.window.openFile(other.toStdString());
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QCOMPARE(user.page(), QString("part"));
        QTRY_VERIFY_WITH_TIMEOUT(user.scene().stablePoses != nullptr && user.scene().track == nullptr,
                                 kPatience);
    }

    void noPageWidensTheWindow() {
        User user(study_, "part");
        user.window.resize(1280, 720);
        for (const char* page : {"validate", "export", "review", "evolve", "track", "part", "evolve"}) {
            user.window.showPage(page);
            QTest::qWait(200);
            QVERIFY2(user.window.width() == 1280,
                     qPrintable(QString("%1: %2").arg(page).arg(user.window.width())));
        }
    }

    void aMessageLeavesWithItsPage() {
        User user(study_, "review");
        auto* page = user.find<pages::Page>("page.review");
        emit page->failed("The picture cannot be saved", "The disk is full.");
        QVERIFY(user.message().contains("disk is full"));
        user.window.showPage("review");
        QVERIFY(user.message().contains("disk is full"));
        user.window.showPage("export");
        QVERIFY2(user.message().isEmpty(), qPrintable(user.message()));
        // What the study could not do for a page is the page's.
        emit user.session()->failed("The trials cannot be simulated", "None are stored.");
        user.window.showPage("track");
        QVERIFY2(user.message().isEmpty(), qPrintable(user.message()));
    }

    // Whoever looks elsewhere while the study works has to know that it stopped.
    void theEndOfARunIsToldOnEveryPage() {
        session::Environment environment = pages::nativeEnvironment();
        environment.engines = fake::enginesMadeBy([](const std::string&, const trial::EngineOptions&) {
            return std::make_unique<BrokenEngine>(fake::waveLaw);
        });
        tests::WindowUser user(environment);
        QVERIFY(user.open(study_.toStdString(), "review"));
        user.action("review.validate")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.message().contains("engine is broken"), kPatience);
        user.window.showPage("track");
        QVERIFY(user.message().contains("engine is broken"));
    }

    void newFilesBeginBesideTheStudyWithItsName_data() {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QString>("action");
        QTest::addColumn<QString>("ending");
        QTest::newRow("study") << "part"
                               << "file.saveAs"
                               << ".trap";
        QTest::newRow("solid") << "export"
                               << "export.stl"
                               << "-track.stl";
    }

    void newFilesBeginBesideTheStudyWithItsName() {
        QFETCH(QString, page);
        QFETCH(QString, action);
        QFETCH(QString, ending);
        User user(study_, page);
        QTRY_VERIFY_WITH_TIMEOUT(user.action(action)->isEnabled(), kPatience);
        user.action(action)->trigger();
        // A track that learned so shortly may be too bad to be exported unasked.
        if (auto* all = user.find<QPushButton>("dialog.success.export")) all->click();
        QVERIFY(user.dialog() != nullptr);
        const QFileInfo study(study_);
        QCOMPARE(user.dialog()->directory().absolutePath(), study.absolutePath());
        QCOMPARE(QFileInfo(user.dialog()->selectedFiles().value(0)).fileName(),
                 study.completeBaseName() + ending);
    }

    void studiesAreLookedForWhereTheLastOneWas() {
        User user(study_);
        user.action("file.close")->trigger();
        QTRY_VERIFY(user.session() == nullptr);
        user.action("file.open")->trigger();
        QVERIFY(user.dialog() != nullptr);
        QCOMPARE(user.dialog()->directory().absolutePath(), QFileInfo(study_).absolutePath());
    }

    // There is no folder of documents where these tests are at home.
    void aDraftIsSavedUnderThePartsName() {
        User user;
        user.action("example.cuboid")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QTest::keyClick(&user.window, Qt::Key_S, Qt::ControlModifier);
        QVERIFY(user.dialog() != nullptr);
        QCOMPARE(QFileInfo(user.dialog()->selectedFiles().value(0)).fileName(), QString("cuboid.trap"));
        QVERIFY(user.dialog()->directory().exists());
    }

    void aStudyWithANameIsSavedAlready() {
        User user(study_);
        QTest::keyClick(&user.window, Qt::Key_S, Qt::ControlModifier);
        QVERIFY(user.dialog() == nullptr);
        QVERIFY(user.message().contains("as it happens"));
        user.window.showPage("track");
        QVERIFY(!user.message().contains("as it happens"));
    }

    void noTitleOfAColumnIsCut_data() { addPages(); }
    void noTitleOfAColumnIsCut() {
        QFETCH(QString, page);
        User user(study_, page);
        if (page == "review") {
            user.action("review.validate")->trigger();
            auto* validation = user.find<QTableView>("review.validation.table");
            QTRY_VERIFY_WITH_TIMEOUT(validation->model()->rowCount() > 0, kPatience);
        }
        for (QDockWidget* dock : user.window.findChildren<QDockWidget*>()) {
            if (!dock->objectName().startsWith("dock." + page)) continue;
            dock->raise();
            QTest::qWait(200);
            auto* methods = dock->findChild<QComboBox*>("calibrate.method");
            for (int method = 0; method < (methods != nullptr ? methods->count() : 1); ++method) {
                if (methods != nullptr) methods->setCurrentIndex(method);
                for (const QHeaderView* header : dock->findChildren<QHeaderView*>())
                    checkTitles(*header);
            }
        }
    }

    void theStatusLineTellsWhetherTheEnginesAgree_data() {
        QTest::addColumn<int>("learned");
        QTest::addColumn<int>("checked");
        QTest::addColumn<QString>("told");
        QTest::newRow("alike") << 97 << 97 << "Simbody agrees: 97.0 % and 97.0 %";
        // 90 of 100: 82.4 to 95.1 % (Clopper-Pearson); 60 of 100: 49.7 to 69.7 %.
        QTest::newRow("within chance") << 95 << 90 << "Simbody agrees: 95.0 % and 90.0 %";
        QTest::newRow("too few trials") << 68 << 60 << "Simbody: 68.0 % and 60.0 %, too few trials to tell";
        QTest::newRow("beyond chance") << 96 << 90 << "Simbody differs: 96.0 % and 90.0 %";
    }

    void theStatusLineTellsWhetherTheEnginesAgree() {
        QFETCH(int, learned);
        QFETCH(int, checked);
        QFETCH(QString, told);
        {
            auto file = store::StudyFile::open(study_.toStdString(), "trapwright test");
            QVERIFY(file.ok());
            study::CheckRecord check;
            check.trials = 100;
            check.learning.engine = "native";
            check.learning.oriented = learned;
            check.reference.engine = "simbody";
            check.reference.oriented = checked;
            QVERIFY(file->saveCheck(check).ok());
        }
        User user(study_);
        QCOMPARE(user.text("status.engines"), told);
    }

 private:
    static void checkTitles(const QHeaderView& header) {
        if (!header.isVisible()) return;
        for (int section = 0; section < header.count(); ++section) {
            if (header.isSectionHidden(section)) continue;
            const QString title =
                header.model()->headerData(section, header.orientation(), Qt::DisplayRole).toString();
            QVERIFY2(header.sectionSize(section) >= header.sectionSizeHint(section),
                     qPrintable(QString("%1: %2 has %3 of %4")
                                    .arg(header.parentWidget()->objectName(), title)
                                    .arg(header.sectionSize(section))
                                    .arg(header.sectionSizeHint(section))));
        }
    }

    pages::LearnedStudy learned_{"input_test"};
    QString study_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    InputTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "input_test.moc"
