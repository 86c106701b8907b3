#include "core/base/file.h"

#include <QTemporaryDir>
#include <QtTest>
#include <string>

using namespace trapwright;

class FileTest : public QObject {
    Q_OBJECT

    static std::filesystem::path at(const QTemporaryDir& folder, const char* name) {
        return folder.filePath(name).toStdString();
    }

 private slots:
    void readsWhatWasWritten() {
        const QTemporaryDir folder;
        std::string content(200000, '\0');
        for (std::size_t i = 0; i < content.size(); ++i)
            content[i] = static_cast<char>(i % 251);
        QVERIFY(base::writeFile(at(folder, "a"), content).ok());
        const auto again = base::readFile(at(folder, "a"));
        QVERIFY(again.ok());
        QVERIFY(*again == content);
    }

    void replacesAndLeavesNothingBeside() {
        const QTemporaryDir folder;
        QVERIFY(base::writeFile(at(folder, "a"), "a long old content").ok());
        QVERIFY(base::writeFile(at(folder, "a"), "new").ok());
        QCOMPARE(*base::readFile(at(folder, "a")), std::string("new"));
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{"a"});
    }

    void devicesAndWhatIsTooLongAreRefused() {
        const QTemporaryDir folder;
        const auto endless = base::readFile("/dev/zero");
        QVERIFY(!endless.ok() && endless.error().message.find("device") != std::string::npos);
        QVERIFY(base::writeFile(at(folder, "a"), std::string((1U << 20U) + 1, 'a')).ok());
        QVERIFY(base::readFile(at(folder, "a"), (1U << 20U) + 1).ok());
        const auto tooLong = base::readFile(at(folder, "a"), 1U << 20U);
        QVERIFY(!tooLong.ok() && tooLong.error().message.find("longer than 1 MiB") != std::string::npos);
    }

    void namesWhatCannotBeReadOrWritten() {
        const QTemporaryDir folder;
        const auto missing = base::readFile(at(folder, "missing"));
        QVERIFY(!missing.ok());
        QVERIFY(missing.error().message.find("missing: No such file") != std::string::npos);
        QVERIFY(!base::readFile(folder.path().toStdString()).ok());

        const auto nowhere = base::writeFile(at(folder, "no/such/folder"), "text");
        QVERIFY(!nowhere.ok());
        QVERIFY(nowhere.error().message.find("no/such/folder: No such file") != std::string::npos);
    }

    // A rename onto a folder fails after the content has been written: nothing may stay beside it.
    void failedReplacementLeavesNothing() {
        const QTemporaryDir folder;
        QVERIFY(QDir(folder.path()).mkdir("taken"));
        QVERIFY(!base::writeFile(at(folder, "taken"), "text").ok());
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 0);
    }
};

QTEST_APPLESS_MAIN(FileTest)
#include "file_test.moc"
