#include "ui/pages/field_texts.h"

#include <QtTest>
#include <set>

#include "core/study/field_text.h"
#include "ui/pages/problem_text.h"

using namespace trapwright;

class FieldTextsTest : public QObject {
    Q_OBJECT

 private slots:
    void everySettingHasALabelAndOneSentenceOfHelp() {
        for (const study::FieldInfo& field : study::listFields()) {
            const pages::FieldText text = pages::findFieldText(field.key);
            QVERIFY2(!text.label.isEmpty() && text.label.size() <= 24, field.key.c_str());
            QVERIFY2(text.help.endsWith('.'), field.key.c_str());
            if (field.kind == study::FieldKind::choice) QCOMPARE(text.choices.size(), field.choices.size());
            if (field.kind == study::FieldKind::flag) QCOMPARE(text.choices.size(), std::size_t(2));
        }
    }

    // Where it differs: trapwright-studio --settings-page > resources/docs/help/settings.md
    void theHelpListsEverySetting() {
        QFile page(TRAPWRIGHT_SOURCE_DIR "/resources/docs/help/settings.md");
        QVERIFY(page.open(QIODevice::ReadOnly));
        const QStringList stored = QString::fromUtf8(page.readAll()).split('\n');
        const QStringList wanted = pages::settingsReference().split('\n');
        for (const QString& line : wanted)
            QVERIFY2(stored.contains(line), qPrintable("not in settings.md: " + line));
        QCOMPARE(stored.size(), wanted.size());
        for (const study::FieldInfo& field : study::listFields())
            QVERIFY2(stored.contains("### " + pages::settingHeading(field.key)), field.key.c_str());
    }

    // Two fields of one form that are called alike could not be told apart.
    void labelsOfTheTrackPageDiffer() {
        std::set<QString> labels;
        std::size_t count = 0;
        for (const pages::FieldGroup& group : pages::trackGroups()) {
            for (const std::string_view key : group.keys) {
                labels.insert(pages::findFieldText(key).label);
                ++count;
            }
        }
        QCOMPARE(labels.size(), count);
    }

    void theTrackPageShowsAllOfTable1() {
        std::set<std::string_view> keys;
        for (const pages::FieldGroup& group : pages::trackGroups())
            keys.insert(group.keys.begin(), group.keys.end());
        for (const char* key :
             {"track.crossSections", "track.pointsPerSection", "track.minSegmentLength_mm",
              "track.maxSegmentLength_mm", "track.segmentWidth_mm", "track.segmentHeight_mm",
              "evolution.trialsPerEvaluation", "evolution.populationSize", "evolution.tournamentSize",
              "evolution.staticMutation"}) {
            QVERIFY2(keys.count(key) == 1, key);
        }
    }

    void unitsAreThoseOfTheKey() {
        QCOMPARE(pages::unitOf("track.segmentWidth_mm"), QString("mm"));
        QCOMPARE(pages::unitOf("part.density_kg_m3"), QString("kg/m³"));
        QCOMPARE(pages::unitOf("simulation.drive.angle_deg"), QString("°"));
        QCOMPARE(pages::unitOf("evolution.learningStep_ms"), QString("ms"));
        QCOMPARE(pages::unitOf("evolution.tournamentSize"), QString());
    }

    // The sentences are core's own.
    void problemsAreToldInTheWordsOfTheForm() {
        study::Settings settings;
        settings.track.minSegmentLength = 40e-3;
        settings.track.crossSections = 0;
        const std::vector<std::string> problems = study::findProblems(settings);
        QCOMPARE(problems.size(), std::size_t(2));
        const pages::ProblemText range = pages::describeProblem(problems[0]);
        QCOMPARE(range.key, std::string("track.crossSections"));
        QCOMPARE(range.text, QString("It must be from 1 to 200."));
        const pages::ProblemText order = pages::describeProblem(problems[1]);
        QCOMPARE(order.key, std::string("track.minSegmentLength_mm"));
        QCOMPARE(order.text, QString("It must not be more than Longest segment, which is 36."));
    }

    void aSentenceWithoutAKeyIsLeftAsItIs() {
        const pages::ProblemText text = pages::describeProblem("Something else; anything.");
        QVERIFY(text.key.empty());
        QCOMPARE(text.text, QString("Something else; anything."));
    }
};

QTEST_MAIN(FieldTextsTest)
#include "field_texts_test.moc"
