// The studies that come with Trapwright (resources/studies): what was published of them comes out again. All
// of their trials: tests/studies/examples.py.

#include <QDir>
#include <QTemporaryDir>
#include <QTest>

#include "core/store/study_file.h"
#include "core/workflow/example_studies.h"
#include "tests/app/program.h"

using namespace trapwright;
using namespace trapwright::test;

class ExamplesTest : public QObject {
    Q_OBJECT

 private slots:
    void listAndFolderAgree() {
        QStringList listed;
        for (const workflow::ExampleStudy& example : workflow::listExampleStudies())
            listed << QString::fromStdString(workflow::findExampleFile(example).filename().string());
        listed.sort();
        const std::filesystem::path first = workflow::findExampleFile(workflow::listExampleStudies().front());
        const QDir folder(QString::fromStdString(first.parent_path().string()));
        QCOMPARE(folder.entryList(QDir::Files, QDir::Name), listed);
    }

    void eachIsLearnedSelectedAndValidated_data() {
        QTest::addColumn<QString>("name");
        for (const workflow::ExampleStudy& example : workflow::listExampleStudies()) {
            const QString name = QString::fromStdString(std::string(example.name));
            QTest::newRow(qPrintable(name)) << name;
        }
    }

    void eachIsLearnedSelectedAndValidated() {
        QFETCH(QString, name);
        const QTemporaryDir folder;
        const Ran made = run(folder.path(), {"new", "mine.trap", "--example", name});
        QVERIFY2(made.code == 0, made.all());
        QVERIFY2(made.output.contains("Copied the example " + name.toUtf8()), made.all());
        const auto file = store::StudyFile::openReadOnly(folder.filePath("mine.trap").toStdString());
        QVERIFY(file.ok());
        const auto validations = file->loadValidations();
        QVERIFY(validations.ok() && !validations->empty());
        QVERIFY(!file->loadSelections()->empty());
        const study::ValidationRecord& last = validations->back();
        // Some trials of it end again as they are stored. An instruction set that this machine lacks ends
        // them otherwise, which is told, and is no fault.
        constexpr std::size_t kPoses = 3;
        for (std::size_t pose = 0; pose < std::min(kPoses, last.rows.size()); ++pose) {
            const auto kept = file->loadValidationOutcomes(static_cast<int>(validations->size()) - 1,
                                                           static_cast<int>(pose));
            QVERIFY(kept.ok() && kept->has_value());
            const Ran replayed =
                run(folder.path(), {"replay", "mine.trap", "--generation", QString::number(last.generation),
                                    "--individual", QString::number(last.individual), "--kind", "validation",
                                    "--pose", QString::number(pose + 1), "--json"});
            QVERIFY2(replayed.code == 0, replayed.all());
            if (last.engine != "simbody") continue;
            QVERIFY2(replayed.json()["stored_otherwise"].isNull(), replayed.all());
        }
    }

    void whatIsNoExampleIsSaid() {
        const QTemporaryDir folder;
        const Ran unknown = run(folder.path(), {"new", "mine.trap", "--example", "spoon"});
        QCOMPARE(unknown.code, 2);
        QVERIFY2(unknown.errors.contains("no example study \"spoon\". The examples are cuboid"),
                 unknown.all());
        const Ran mixed = run(folder.path(), {"new", "mine.trap", "--example", "cuboid", "--trials", "5"});
        QCOMPARE(mixed.code, 2);
        QVERIFY2(mixed.errors.contains("copied as it is"), mixed.all());
        QVERIFY(QDir(folder.path()).isEmpty());
    }

    void nothingIsReplaced() {
        const QTemporaryDir folder;
        QFile there(folder.filePath("mine.trap"));
        QVERIFY(there.open(QIODevice::WriteOnly) && there.write("kept") == 4);
        there.close();
        const Ran ran = run(folder.path(), {"new", "mine.trap", "--example", "cuboid"});
        QCOMPARE(ran.code, 2);
        QVERIFY2(ran.errors.contains("exists already"), ran.all());
        QVERIFY(there.open(QIODevice::ReadOnly));
        QCOMPARE(there.readAll(), QByteArray("kept"));
    }
};

QTEST_GUILESS_MAIN(ExamplesTest)
#include "examples_test.moc"
