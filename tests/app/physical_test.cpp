#include <QJsonArray>
#include <QTemporaryDir>
#include <QtTest>

#include "core/workflow/part_source.h"
#include "tests/app/program.h"
#include "tests/core/store/sample_study.h"

using namespace trapwright;
using namespace trapwright::test;

/// The command `physical`: a track on the real feeder beside its simulation.
class PhysicalTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        makeStudy("study.trap");
    }

    void showsTheTable() {
        {
            auto study =
                store::StudyFile::open(folder_->filePath("study.trap").toStdString(), sample::kProgram);
            VERIFY_OK(study);
            study::ValidationRecord simulated;
            simulated.rows = {{0, {990, 10, 0, 0}}, {2, {980, 0, 20, 0}}};
            VERIFY_OK(study->saveValidation(simulated));
            study::PhysicalValidation physical;
            physical.plan = {{0, 2}, 2};
            physical.trials.resize(3);
            physical.trials[1].number = 1;
            physical.trials[1].outcome = trial::Verdict::fellOff;
            physical.trials[2].number = 2;
            physical.trials[2].pose = 2;
            VERIFY_OK(study->addPhysicalValidation({}));
            VERIFY_OK(study->addPhysicalValidation(physical));
        }
        const Ran shown = ask({"physical", "study.trap"});
        QCOMPARE(shown.code, 0);
        QVERIFY2(shown.output.contains("Validation 2 of 2") && shown.output.contains("Simulation") &&
                     shown.output.contains("2 of 3 parts succeeded"),
                 shown.all());
        const QJsonObject table = ask({"physical", "study.trap", "--json"}).json();
        QCOMPARE(table["rows"].toArray().size(), 2);
        const QJsonObject total = table["total"].toObject();
        QCOMPARE(total["simulated"].toObject()["success"].toObject()["count"].toInt(), 1970);
        QCOMPARE(total["physical"].toObject()["fell_off"].toInt(), 1);
        QVERIFY(total["p"].toDouble() > 0.0 && total["p"].toDouble() < 0.1);
        const Ran trials = ask({"physical", "study.trap", "--trials"});
        QCOMPARE(trials.output.count('\n'), 4);
        QVERIFY2(trials.output.contains("\n2,1,fell-off,"), trials.all());
        QCOMPARE(ask({"physical", "study.trap", "--csv"}).output.count('\n'), 5);
        QVERIFY(ask({"physical", "study.trap", "--number", "1"}).output.contains("No part"));
        QCOMPARE(ask({"physical", "study.trap", "--number", "3"}).code, 2);
    }

    void saysThatTheFeederWasVirtual_data() {
        QTest::addColumn<QString>("second");
        QTest::addColumn<QString>("title");
        QTest::addColumn<QString>("notice");
        QTest::addColumn<QString>("word");
        QTest::newRow("virtual") << "virtual"
                                 << "on the virtual feeder, begun"
                                 << "Made with the virtual feeder"
                                 << "virtual";
        QTest::newRow("mixed") << "real"
                               << "on the virtual feeder and others, mixed"
                               << "Mixed: 1 trial was made with the virtual feeder"
                               << "mixed";
        QTest::newRow("older") << "unknown"
                               << "on the virtual feeder and others, mixed"
                               << "which did not note the feeder"
                               << "mixed";
    }
    void saysThatTheFeederWasVirtual() {
        QFETCH(QString, second);
        QFETCH(QString, title);
        QFETCH(QString, notice);
        QFETCH(QString, word);
        {
            auto study =
                store::StudyFile::open(folder_->filePath("study.trap").toStdString(), sample::kProgram);
            VERIFY_OK(study);
            study::PhysicalValidation physical;
            physical.plan = {{0, 2}, 2};
            physical.trials.resize(2);
            physical.trials[0].feeder = study::FeederKind::virtualFeeder;
            physical.trials[0].drive = "Virtual feeder, by Modbus";
            physical.trials[0].halfStroke = 0.6e-3;
            physical.trials[1].number = 1;
            physical.trials[1].feeder = study::feederKindOf(second.toStdString()).value();
            VERIFY_OK(study->addPhysicalValidation(physical));
        }
        const QString shown = ask({"physical", "study.trap"}).output;
        QVERIFY2(shown.contains(title) && shown.contains(notice), qPrintable(shown));
        const QJsonObject json = ask({"physical", "study.trap", "--json"}).json();
        QVERIFY(json["notice"].toString().contains(notice));
        QVERIFY(json["feeder"].toObject()["virtual"].toInt() > 0);
        const QString csv = ask({"physical", "study.trap", "--csv"}).output;
        const QStringList table = csv.split('\n', Qt::SkipEmptyParts);
        QVERIFY(table.front().endsWith(",feeder"));
        for (int i = 1; i < table.size(); ++i)
            QVERIFY2(table[i].endsWith(',' + word), qPrintable(table[i]));
        const QString trials = ask({"physical", "study.trap", "--trials"}).output;
        QVERIFY2(trials.contains(",virtual,\"Virtual feeder, by Modbus\",0.6\n"), qPrintable(trials));
        QVERIFY2(trials.contains(',' + second + ','), qPrintable(trials));
    }

    void saysThatThereIsNone() {
        const Ran ran = ask({"physical", "study.trap"});
        QCOMPARE(ran.code, 3);
        QVERIFY2(ran.errors.contains("real feeder"), ran.all());
    }

    // The track that was chosen in the studio is the one that the commands take.
    void finalTrackIsTaken() {
        {
            auto study =
                store::StudyFile::open(folder_->filePath("study.trap").toStdString(), sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->chooseWinner(study::IndividualId{0, 99}));
        }
        const Ran ran = ask({"export", "study.trap", "track.json"});
        QCOMPARE(ran.code, 3);
        QVERIFY2(ran.errors.contains("99"), ran.all());
    }

 private:
    /// Of the cuboid: tables are by groups of its poses.
    void makeStudy(const QString& name) {
        const auto part = workflow::importPart({"cuboid"});
        QVERIFY(part.ok());
        auto study = store::StudyFile::create(folder_->filePath(name).toStdString(), sample::settings(),
                                              part->stored, sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->saveGeneration(sample::generation(0)));
    }
    [[nodiscard]] Ran ask(const QStringList& arguments) const { return run(folder_->path(), arguments); }

    std::optional<QTemporaryDir> folder_;
};

QTEST_GUILESS_MAIN(PhysicalTest)
#include "physical_test.moc"
