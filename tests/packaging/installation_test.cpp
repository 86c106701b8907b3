#include <QDir>
#include <QMimeDatabase>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"

using namespace trapwright::test;

/// What an installation has beside the programs agrees with them.
class InstallationTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        // The desktop's knowledge of file types, with ours beside it.
        QVERIFY(QDir(folder_.path()).mkpath("mime/packages"));
        QVERIFY(QFile::copy(TRAPWRIGHT_SOURCE_DIR "/packaging/desktop/trapwright-studio.xml",
                            folder_.filePath("mime/packages/trapwright-studio.xml")));
        QVERIFY(QFile::copy("/usr/share/mime/packages/freedesktop.org.xml",
                            folder_.filePath("mime/packages/freedesktop.org.xml")));
        qputenv("XDG_DATA_DIRS", folder_.path().toUtf8());
        qputenv("XDG_DATA_HOME", folder_.filePath("none").toUtf8());
        QCOMPARE(QProcess::execute("update-mime-database", {folder_.filePath("mime")}), 0);
        const Ran made = run(folder_.path(), {"new", "study.trap", "--preset", "cuboid"});
        QVERIFY2(made.code == 0, made.all());
    }

    void studiesAreKnownByNameAndContent() {
        const QMimeDatabase types;
        const QString type = "application/x-trapwright-study";
        QCOMPARE(types.mimeTypeForFile("a.trap", QMimeDatabase::MatchExtension).name(), type);
        QCOMPARE(types.mimeTypeForFile(folder_.filePath("study.trap"), QMimeDatabase::MatchContent).name(),
                 type);
        QVERIFY(types.mimeTypeForName(type).inherits("application/vnd.sqlite3"));
        QCOMPARE(types.mimeTypeForName(type).iconName(), QString("application-x-trapwright-study"));
        // Somebody else's database.
        QFile study(folder_.filePath("study.trap"));
        QVERIFY(study.open(QIODevice::ReadOnly));
        QByteArray header = study.read(4096);
        header.replace(68, 4, "Tree");
        QVERIFY(types.mimeTypeForData(header).name() != type);
    }

    void manuals_data() {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QStringList>("command");
        QTest::newRow("program") << "trapwright" << QStringList{};
        for (const QString& name : listCommands())
            QTest::newRow(qPrintable(name)) << "trapwright-" + name << QStringList{name};
    }

    /// Every option of --help is in the manual page of its command, and every command in the program's.
    void manuals() {
        QFETCH(QString, page);
        QFETCH(QStringList, command);
        const QString manual = readManual(page);
        QVERIFY2(manual.contains(".SH OPTIONS") || manual.contains(".SS \"Options:\""), qPrintable(manual));
        QVERIFY(manual.contains("\n" + page + " \\- "));
        const QString help = QString::fromUtf8(run(".", command + QStringList{"--help"}).output);
        QVERIFY(help.contains("--help"));
        for (const QString& line : help.split('\n')) {
            const int begin = line.indexOf("--");
            if (!line.startsWith("  ") || begin < 0 || begin > 6) continue;
            QString option = line.mid(begin).section(' ', 0, 0);
            QVERIFY2(manual.contains(option.replace("-", "\\-")), qPrintable(page + ": " + option));
        }
        if (command.isEmpty()) {
            for (const QString& one : listCommands())
                QVERIFY2(manual.contains("trapwright-" + one), qPrintable(one));
        }
    }

#ifdef TRAPWRIGHT_STUDIO_MANUAL
    void studioManual() {
        const QString manual = readManual("trapwright-studio");
        QVERIFY(manual.contains("\\-\\-shortcuts"));
        QVERIFY(manual.contains("trapwright-studio \\- "));
    }
#endif

 private:
    static QString readManual(const QString& page) {
        QProcess unpack;
        unpack.start("gzip", {"-dc", TRAPWRIGHT_MANUALS "/" + page + ".1.gz"});
        return QString::fromUtf8(finish(unpack).output);
    }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(InstallationTest)
#include "installation_test.moc"
