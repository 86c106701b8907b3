#include <QDir>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"

using namespace trapwright::test;

namespace {

/// The long options that a command's --help lists.
QStringList listOptions(const QString& command) {
    const QString help = QString::fromUtf8(run(".", {command, "--help"}).output);
    QStringList names;
    static const QRegularExpression line("^  (?:-[a-z], )?(--[a-z-]+)", QRegularExpression::MultilineOption);
    for (auto matches = line.globalMatch(help); matches.hasNext();)
        names << matches.next().captured(1);
    return names;
}

QStringList sorted(QStringList list) {
    list.sort();
    return list;
}

}  // namespace

/// The shells themselves complete what the program's --help says.
class CompletionTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        for (const char* file : {"one.trap", "clip.stl", "notes.txt", "settings.json"})
            write(folder_.filePath(file), "x");
        const Ran bash = ask({"completion", "bash"});
        QVERIFY2(bash.code == 0, bash.all());
        QVERIFY(QDir(folder_.path()).mkdir("functions"));
        write(folder_.filePath("functions/trapwright.bash"), bash.output);
        write(folder_.filePath("functions/_trapwright"), ask({"completion", "zsh"}).output);
    }

    void unknownShell() {
        QCOMPARE(ask({"completion", "tcsh"}).code, 2);
        QVERIFY(!listCommands().contains("completion"));
    }

    /// The words before the cursor, the last of them begun.
    void completes_data() {
        QTest::addColumn<QString>("line");
        QTest::addColumn<QStringList>("expected");
        const QStringList commands = listCommands();
        QVERIFY(commands.size() >= 15);
        QTest::newRow("commands") << "trapwright " << commands;
        QTest::newRow("a command's beginning") << "trapwright ev" << QStringList{"evolve"};
        for (const QString& command : commands)
            QTest::newRow(qPrintable("options of " + command))
                << "trapwright " + command + " --" << listOptions(command);
        QTest::newRow("engines") << "trapwright evolve one.trap --engine "
                                 << QStringList{"simbody", "native", "simbody-certifying", "hybrid"};
        QTest::newRow("presets") << "trapwright new a.trap --preset c" << QStringList{"cuboid", "cone"};
        QTest::newRow("pairs") << "trapwright new a.trap --contact abs-on-printed-plas"
                               << QStringList{"abs-on-printed-plastic"};
        QTest::newRow("materials") << "trapwright part cuboid --material st"
                                   << QStringList{"steel", "stainless"};
        QTest::newRow("kinds") << "trapwright replay one.trap --kind s" << QStringList{"selection"};
        QTest::newRow("studies") << "trapwright settings o" << QStringList{"one.trap"};
        QTest::newRow("parts") << "trapwright part c"
                               << QStringList{"cuboid", "cone", "cup", "clip", "clip.stl"};
        QTest::newRow("settings files")
            << "trapwright new a.trap --settings se" << QStringList{"settings.json"};
        QTest::newRow("a study ...") << "trapwright export o" << QStringList{"one.trap"};
        QTest::newRow("... or a track") << "trapwright export s" << QStringList{"settings.json"};
        QTest::newRow("a track to begin behind")
            << "trapwright evolve a.trap --behind s" << QStringList{"settings.json"};
        QTest::newRow("values") << "trapwright new a.trap --set track.encoding="
                                << QStringList{"strip", "free"};
    }

    void completes() {
        QFETCH(QString, line);
        QFETCH(QStringList, expected);
        QCOMPARE(sorted(completeInBash(line)), sorted(expected));
        if (!QStandardPaths::findExecutable("zsh").isEmpty())
            QCOMPARE(sorted(completeInZsh(line)), sorted(expected));
    }

    void settingKeys() {
        const QStringList bash = completeInBash("trapwright new a.trap --set track.segmentW");
        QCOMPARE(bash, QStringList{"track.segmentWidth_mm="});
        // Every key of a study's own settings.
        QVERIFY(ask({"new", "whole.trap", "--preset", "cuboid"}).code == 0);
        const QStringList keys = completeInBash("trapwright evolve a.trap --set ");
        QStringList expected;
        collectKeys(ask({"settings", "whole.trap", "--json"}).json(), {}, expected);
        QVERIFY(expected.size() > 40);
        QCOMPARE(sorted(keys), sorted(expected));
    }

 private:
    [[nodiscard]] Ran ask(const QStringList& arguments) const { return run(folder_.path(), arguments); }

    static void collectKeys(const QJsonObject& object, const QString& path, QStringList& keys) {
        for (auto entry = object.begin(); entry != object.end(); ++entry) {
            if (entry->isObject()) {
                collectKeys(entry->toObject(), path + entry.key() + ".", keys);
            } else {
                keys << path + entry.key() + "=";
            }
        }
    }

    [[nodiscard]] QStringList shell(const QString& program, const QStringList& arguments) const {
        QProcess process;
        process.setWorkingDirectory(folder_.path());
        process.start(program, arguments);
        const Ran ran = finish(process);
        QStringList lines = QString::fromUtf8(ran.output).split('\n', Qt::SkipEmptyParts);
        lines.removeDuplicates();
        return lines;
    }

    [[nodiscard]] QStringList completeInBash(const QString& line) const {
        return shell("bash", {"--norc", TRAPWRIGHT_SOURCE_DIR "/tests/app/capture_completion.bash",
                              folder_.filePath("functions/trapwright.bash"), line});
    }

    [[nodiscard]] QStringList completeInZsh(const QString& line) const {
        return shell("zsh", {"-f", TRAPWRIGHT_SOURCE_DIR "/tests/app/capture_completion.zsh",
                             folder_.filePath("functions"), line});
    }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(CompletionTest)
#include "completion_test.moc"
