#include "ui/pages/settings_form.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>

#include "core/study/presets.h"
#include "ui/pages/settings_row.h"
#include "ui/pages/value_edit.h"

using namespace trapwright;
using pages::SettingsForm;

namespace {

/// A form whose owner takes every change, as a session does.
struct Owner {
    study::Settings settings;
    SettingsForm form{pages::trackGroups(), {}};
    QStringList changes;

    Owner() {
        QObject::connect(
            &form, &SettingsForm::edited, [this](const study::Settings& changed, const QString& what) {
                settings = changed;
                changes << what;
                form.show(settings);
                form.setProblems(study::findProblems(settings), study::findRecommendations(settings));
            });
        form.resize(340, 900);
        form.show(settings);
        form.QWidget::show();
    }
    template <class Widget = QLineEdit>
    Widget* find(const char* name) {
        return form.findChild<Widget*>(name);
    }
    void type(const char* name, const char* text) {
        auto* field = find(name);
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
    }
};

}  // namespace

class SettingsFormTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    }

    void typingChangesTheSettings() {
        Owner owner;
        owner.type("field.track.segmentWidth_mm", "45.5");
        QTRY_COMPARE(owner.settings.track.segmentWidth, 45.5e-3);
        QCOMPARE(owner.changes.last(), QString("Width"));
        // The rest is as it was.
        owner.settings.track.segmentWidth = study::Settings{}.track.segmentWidth;
        QVERIFY(owner.settings == study::Settings{});
    }

    void enterDoesNotWait() {
        Owner owner;
        owner.type("field.track.crossSections", "7");
        QTest::keyClick(owner.find("field.track.crossSections"), Qt::Key_Return);
        QCOMPARE(owner.settings.track.crossSections, 7);
    }

    void choicesAndFlagsAreChosen() {
        Owner owner;
        auto* feeder = owner.find<QComboBox>("field.track.feeder");
        feeder->setFocus();
        QTest::keyClick(feeder, Qt::Key_Down);
        QCOMPARE(owner.settings.track.shape.type, track::FeederType::bowl);
        auto* overlapping = owner.find<QComboBox>("field.evolution.simulateOverlapping");
        overlapping->setFocus();
        QTest::keyClick(overlapping, Qt::Key_Down);
        QVERIFY(owner.settings.evolution.simulateOverlapping);
    }

    void resetGoesBackToTheDefault() {
        Owner owner;
        auto* reset = owner.find<QToolButton>("reset.track.segmentWidth_mm");
        QVERIFY(reset->isHidden());
        owner.type("field.track.segmentWidth_mm", "45");
        QTRY_VERIFY(!reset->isHidden());
        QTest::mouseClick(reset, Qt::LeftButton);
        QCOMPARE(owner.settings.track.segmentWidth, 60e-3);
        QCOMPARE(owner.find("field.track.segmentWidth_mm")->text(), QString("60"));
        QVERIFY(reset->isHidden());
    }

    void aBadValueIsMarkedInPlaceWithTheReason() {
        Owner owner;
        owner.type("field.track.segmentWidth_mm", "5000");
        auto* reason = owner.find<QLabel>("reason.track.segmentWidth_mm");
        QTRY_COMPARE(reason->text(), QString("It must be from 1 to 1000."));
        QVERIFY(reason->isVisible());
        QVERIFY(owner.find<pages::ValueEdit>("field.track.segmentWidth_mm")->isBad());
        QVERIFY(!owner.find<pages::ValueEdit>("field.track.segmentHeight_mm")->isBad());
        owner.type("field.track.segmentWidth_mm", "50");
        QTRY_VERIFY(!reason->isVisible());
        QVERIFY(!owner.find<pages::ValueEdit>("field.track.segmentWidth_mm")->isBad());
    }

    void textThatIsNoNumberIsMarkedAndGivesWay() {
        Owner owner;
        auto* field = owner.find<pages::ValueEdit>("field.track.segmentWidth_mm");
        owner.type("field.track.segmentWidth_mm", "wide");
        QTRY_VERIFY(field->isBad());
        QCOMPARE(owner.find<QLabel>("reason.track.segmentWidth_mm")->text(),
                 QString("This is not a number."));
        QTest::keyClick(field, Qt::Key_Return);
        QCOMPARE(field->text(), QString("60"));
        QVERIFY(!field->isBad());
        QVERIFY(owner.settings == study::Settings{});
    }

    // Advice is told where it belongs, but nothing is bad.
    void adviceIsNoError() {
        Owner owner;
        owner.type("field.track.leadInLength_mm", "70");
        auto* reason = owner.find<QLabel>("reason.track.leadInLength_mm");
        QTRY_VERIFY(reason->isVisible());
        QVERIFY(!owner.find<pages::ValueEdit>("field.track.leadInLength_mm")->isBad());
    }

    void lockedFieldsCannotBeEdited() {
        Owner owner;
        owner.form.setLocked([](const std::string& key) { return key == "evolution.generations"; });
        QVERIFY(!owner.find("field.track.segmentWidth_mm")->isEnabled());
        QVERIFY(owner.find("field.evolution.generations")->isEnabled());
    }

    void everyFieldIsNamedForScreenReaders() {
        Owner owner;
        for (const QLineEdit* edit : owner.form.findChildren<pages::ValueEdit*>()) {
            QVERIFY2(!edit->accessibleName().isEmpty(), qPrintable(edit->objectName()));
            QVERIFY2(!edit->accessibleDescription().isEmpty(), qPrintable(edit->objectName()));
        }
        for (const QComboBox* combo : owner.form.findChildren<QComboBox*>())
            QVERIFY2(!combo->accessibleName().isEmpty(), qPrintable(combo->objectName()));
    }

 private:
    QTemporaryDir folder_;
};

QTEST_MAIN(SettingsFormTest)
#include "settings_form_test.moc"
