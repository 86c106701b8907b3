#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QtTest>
#include <csignal>
#include <fstream>

#include "core/store/connection.h"
#include "core/store/schema.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

/// No file of this process may grow past `bytes`, as on a disk that is full.
class FullDisk {
 public:
    explicit FullDisk(std::uintmax_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

 private:
    rlimit before_{};
    void (*handler_)(int) = SIG_DFL;
};

/// Takes the write permission from a folder, and root's privileges from this process, which would ignore
/// that.
class ReadOnlyFolder {
 public:
    explicit ReadOnlyFolder(const std::filesystem::path& folder) : folder_(folder) {
        constexpr uid_t kNobody = 65534;
        ::chmod(folder.c_str(), 0555);
        if (::geteuid() == 0) lowered_ = ::seteuid(kNobody) == 0;
    }
    ReadOnlyFolder(const ReadOnlyFolder&) = delete;
    ReadOnlyFolder& operator=(const ReadOnlyFolder&) = delete;
    ~ReadOnlyFolder() {
        if (lowered_) raised_ = ::seteuid(0);
        ::chmod(folder_.c_str(), 0755);
    }
    [[nodiscard]] bool holds() const { return ::access(folder_.c_str(), W_OK) != 0 || lowered_; }

 private:
    std::filesystem::path folder_;
    bool lowered_ = false;
    int raised_ = 0;
};

std::string readAll(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeAll(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
}

}  // namespace

class StudyTroubleTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        directory_ = folder_->path().toStdString();
        path_ = directory_ / "study.trap";
    }

    /// A run is killed, and somebody deletes the study, but not the log beside it.
    void logOfAStudyThatIsGoneIsNotTakenUp() {
        std::filesystem::path log = path_;
        log += "-wal";
        const std::filesystem::path kept = directory_ / "kept";
        sample::write(path_, 0);
        {
            auto study = store::StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveGeneration(sample::generation(0)));
            QVERIFY(std::filesystem::copy_file(log, kept));
        }
        std::filesystem::remove(path_);
        std::filesystem::rename(kept, log);
        const auto create = [&] {
            return store::StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        };
        QVERIFY(sample::messageOf(create()).contains("study.trap-wal is there"));
        QVERIFY(std::filesystem::exists(log) && !std::filesystem::exists(path_));
        std::filesystem::remove(log);
        const auto made = create();
        VERIFY_OK(made);
        QCOMPARE(made->generationCount().value(), 0);
    }

    void unusableFilesAreRefused_data() {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("message");
        QTest::newRow("missing") << "missing"
                                 << "There is no study at";
        QTest::newRow("folder") << "folder"
                                << "is a folder";
        QTest::newRow("pipe") << "pipe"
                              << "is no ordinary file";
        QTest::newRow("empty") << "empty"
                               << "is empty";
        QTest::newRow("text") << "text"
                              << "is not a study of Trapwright";
        QTest::newRow("one byte") << "one byte"
                                  << "is not a study of Trapwright";
        QTest::newRow("noise") << "noise"
                               << "is not a study of Trapwright";
        QTest::newRow("noise after the header") << "noise after the header"
                                                << "damaged";
        QTest::newRow("another SQLite file") << "foreign"
                                             << "not a study of Trapwright";
        QTest::newRow("newer") << "newer"
                               << "written by a newer Trapwright (schema version 99";
        QTest::newRow("cut in the header") << "cut 50"
                                           << "cut off after 50 bytes";
        QTest::newRow("cut in the first page") << "cut 3000"
                                               << "cut off after 3000 of";
        QTest::newRow("cut in the middle") << "cut half"
                                           << "cut off after";
        QTest::newRow("creation interrupted") << "version 0"
                                              << "";
        QTest::newRow("settings gone") << "no settings"
                                       << "it holds no settings";
    }
    void unusableFilesAreRefused() {
        QFETCH(QString, kind);
        QFETCH(QString, message);
        makeUnusable(kind.toStdString());
        const bool isFile = kind != "folder" && kind != "pipe";
        const std::string before = isFile ? readAll(path_) : "";

        const QString read = sample::messageOf(StudyFile::openReadOnly(path_));
        QVERIFY2(read.contains(QString::fromStdString(path_.string())), qPrintable(read));
        QVERIFY2(read.contains(kind == "version 0" ? "it holds no settings" : message), qPrintable(read));
        if (isFile) QVERIFY(readAll(path_) == before);
        const QString write = sample::messageOf(StudyFile::open(path_, sample::kProgram));
        QVERIFY2(write.contains(QString::fromStdString(path_.string())), qPrintable(write));
        QVERIFY2(write.contains(kind == "version 0" ? "it holds no settings" : message), qPrintable(write));
        // Opening for writing brings a version up to date; nothing else may touch a file that is refused.
        if (isFile && kind != "version 0") QVERIFY(readAll(path_) == before);
        QVERIFY(!std::filesystem::exists(path_.string() + ".lock"));
    }

    void damageInsideIsReportedNotFollowed() {
        sample::write(path_, 30);
        const std::string whole = readAll(path_);
        base::Random random({.seed = 3});
        int refused = 0;
        for (int round = 0; round < 60; ++round) {
            std::string broken = whole;
            const std::size_t begin = 200 + random.below(static_cast<std::uint32_t>(whole.size() - 400));
            for (std::size_t i = begin; i < std::min(begin + 100, whole.size()); ++i)
                broken[i] = static_cast<char>(random.bits32());
            writeAll(path_, broken);
            auto study = StudyFile::openReadOnly(path_);
            bool sound = study.ok() && study->loadSettings().ok() && study->loadPart().ok() &&
                         study->loadWinners().ok();
            for (int i = 0; sound && i < 30; ++i)
                sound = study->loadGeneration(i).ok();
            if (!sound) ++refused;
        }
        QVERIFY(refused > 10);  // the others hit numbers, text or free space
    }

    void existingFileIsNeverReplaced() {
        writeAll(path_, "precious");
        QVERIFY(
            sample::messageOf(StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram))
                .contains("exists already"));
        QCOMPARE(readAll(path_), std::string("precious"));
    }

    void missingFolderIsNamed() {
        const QString message = sample::messageOf(StudyFile::create(
            directory_ / "nowhere" / "s.trap", sample::settings(), sample::part(), sample::kProgram));
        QVERIFY2(message.contains("there is no folder") && message.contains("nowhere"), qPrintable(message));
    }

    void fullDiskLosesNothing() {
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        for (int i = 0; i < 3; ++i)
            VERIFY_OK(study->saveGeneration(sample::generation(i)));
        {
            const FullDisk full(std::filesystem::file_size(path_.string() + "-wal") + 5000);
            const QString message = sample::messageOf(study->saveGeneration(sample::generation(3, 400)));
            QVERIFY2(message.contains("Generation 3 could not be saved"), qPrintable(message));
            QVERIFY2(message.contains("what was saved before is safe"), qPrintable(message));
        }
        // The same object goes on when there is space again.
        QCOMPARE(study->generationCount().value(), 3);
        VERIFY_OK(study->saveGeneration(sample::generation(3, 400)));
        QVERIFY(sample::equal(study->loadGeneration(3).value(), sample::generation(3, 400)));
    }

    /// The log and its index are made by whoever reads first, which must be the opening.
    void diskWithoutRoomForTheLogIsToldOnOpening() {
        sample::write(path_, 1);
        {
            const FullDisk full(20000);  // less than the index takes
            const auto study = StudyFile::open(path_, sample::kProgram);
            QVERIFY2(sample::messageOf(study).contains("could not be opened"),
                     qPrintable(sample::messageOf(study)));
            QVERIFY(study.error().kind == base::ErrorKind::cannotWrite);
        }
        QCOMPARE(StudyFile::open(path_, sample::kProgram).value().generationCount().value(), 1);
    }

    void fullDatabaseIsCalledAFullDisk() {
        // SQLite's own "database or disk is full", which a write that finds no space ends in.
        const QString message =
            QString::fromStdString(store::describeFailure(SQLite::Exception("full", SQLITE_FULL), path_,
                                                          "The selection could not be saved")
                                       .message);
        QVERIFY2(message.contains("is full. Free some space"), qPrintable(message));
    }

    /// Damage that is met while a study is open: another connection has written, so pages are read again.
    void damageThatIsMetOnSavingIsCalledSo() {
        sample::write(path_, 3);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        {
            auto beside = study->openBeside();
            VERIFY_OK(beside);
            VERIFY_OK(beside->chooseWinner({}));
        }
        std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
        for (std::uintmax_t page = 1; page < std::filesystem::file_size(path_) / 4096; ++page) {
            file.seekp(static_cast<std::streamoff>(page * 4096));
            file << std::string(16, '\xff');
        }
        file.close();
        const auto saved = study->saveGeneration(sample::generation(3));
        QVERIFY2(sample::messageOf(saved).contains("is damaged"), qPrintable(sample::messageOf(saved)));
        QVERIFY(saved.error().kind == base::ErrorKind::damaged);
    }

    void fullDiskLeavesNoHalfStudy() {
        {
            const FullDisk full(20000);
            const QString message = sample::messageOf(
                StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram));
            QVERIFY2(message.contains("could not be made"), qPrintable(message));
        }
        QVERIFY(std::filesystem::is_empty(directory_));
        sample::write(path_, 1);
    }

    void readOnlyFolder_data() {
        QTest::addColumn<bool>("settled");
        QTest::newRow("closed properly") << true;
        QTest::newRow("closed while somebody read") << false;
    }
    void readOnlyFolder() {
        QFETCH(bool, settled);
        sample::write(path_, 2);
        if (!settled) {
            // The reader keeps the writer from settling; the log is taken in, the file stays in write-ahead
            // mode.
            SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).execAndGet("PRAGMA journal_mode = WAL");
            std::filesystem::remove(path_.string() + "-wal");
            std::filesystem::remove(path_.string() + "-shm");
            QCOMPARE(readAll(path_)[18], char{2});
        }
        const ReadOnlyFolder readOnly(directory_);
        if (!readOnly.holds()) QSKIP("this system lets us write everywhere");
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        QVERIFY(sample::equal(study->loadGeneration(1).value(), sample::generation(1)));
        const QString open = sample::messageOf(StudyFile::open(path_, sample::kProgram));
        QVERIFY2(open.contains("cannot be written") && open.contains("folder that you can write"),
                 qPrintable(open));
        const QString made = sample::messageOf(
            StudyFile::create(directory_ / "new.trap", sample::settings(), sample::part(), sample::kProgram));
        QVERIFY2(made.contains("cannot be written"), qPrintable(made));
    }

    void readOnlyFolderWithPendingLog() {
        // What a crash leaves, copied to where nothing can be written, without the shared-memory file.
        const std::filesystem::path other = directory_ / "source.trap";
        sample::write(other, 1);
        {
            auto writer = StudyFile::open(other, sample::kProgram);
            VERIFY_OK(writer);
            VERIFY_OK(writer->saveGeneration(sample::generation(1)));
            std::filesystem::copy_file(other, path_);
            std::filesystem::copy_file(other.string() + "-wal", path_.string() + "-wal");
        }
        {
            const ReadOnlyFolder readOnly(directory_);
            if (!readOnly.holds()) QSKIP("this system lets us write everywhere");
            const QString message = sample::messageOf(StudyFile::openReadOnly(path_));
            QVERIFY2(message.contains("study.trap-wal") && message.contains("Copy both"),
                     qPrintable(message));
        }
        // As the message says: where it can be written everything is there.
        QCOMPARE(StudyFile::openReadOnly(path_).value().generationCount().value(), 2);
    }

    void readOnlyFileIsReadNotWritten() {
        sample::write(path_, 1);
        ::chmod(path_.c_str(), 0444);
        ::chmod(directory_.c_str(), 0777);
        const bool root = ::geteuid() == 0;
        if (root) QCOMPARE(::seteuid(65534), 0);
        const QString message = sample::messageOf(StudyFile::open(path_, sample::kProgram));
        const bool readable = StudyFile::openReadOnly(path_).ok();
        if (root) QCOMPARE(::seteuid(0), 0);
        QVERIFY2(message.contains("cannot be written"), qPrintable(message));
        QVERIFY(readable);
    }

 private:
    void makeUnusable(const std::string& kind) {
        if (kind == "missing") return;
        if (kind == "folder") {
            std::filesystem::create_directory(path_);
        } else if (kind == "pipe") {
            QCOMPARE(::mkfifo(path_.c_str(), 0600), 0);
        } else if (kind == "empty") {
            writeAll(path_, "");
        } else if (kind == "one byte") {
            writeAll(path_, "x");
        } else if (kind == "text") {
            writeAll(path_, std::string(5000, 'a'));
        } else if (kind == "noise" || kind == "noise after the header") {
            base::Random random({.seed = 9});
            std::string noise(20000, '\0');
            for (char& c : noise)
                c = static_cast<char>(random.bits32());
            if (kind != "noise") noise.replace(0, 16, std::string("SQLite format 3\0", 16));
            if (kind != "noise") noise.replace(28, 4, std::string(4, '\0'));
            writeAll(path_, noise);
        } else if (kind == "foreign") {
            SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
                .exec("CREATE TABLE study (id)");
        } else if (kind == "version 0") {
            SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
                .exec("PRAGMA application_id = " + std::to_string(store::kApplicationId));
        } else {
            sample::write(path_, 3);
            const std::string whole = readAll(path_);
            if (kind == "newer")
                SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
            if (kind == "no settings")
                SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("DELETE FROM study");
            if (kind == "cut 50") writeAll(path_, whole.substr(0, 50));
            if (kind == "cut 3000") writeAll(path_, whole.substr(0, 3000));
            if (kind == "cut half") writeAll(path_, whole.substr(0, whole.size() / 2));
        }
    }

    std::optional<QTemporaryDir> folder_;
    std::filesystem::path directory_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyTroubleTest)
#include "study_trouble_test.moc"
