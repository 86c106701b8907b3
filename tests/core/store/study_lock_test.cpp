#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include "core/base/file.h"
#include "core/store/file_lock.h"
#include "core/store/replaced_study.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

/// Another process that has the study open for writing until it is killed, having saved generation `index`.
class OtherWriter {
 public:
    OtherWriter(const std::filesystem::path& path, int index) {
        std::array<int, 2> ready{};
        if (::pipe(ready.data()) != 0) return;
        process_ = ::fork();
        if (process_ == 0) {
            auto study = StudyFile::open(path, sample::kProgram);
            const char state =
                study.ok() && study->saveGeneration(sample::generation(index)).ok() ? 'y' : 'n';
            if (::write(ready[1], &state, 1) != 1) ::_exit(1);
            for (;;)
                ::pause();
        }
        ::close(ready[1]);
        char state = 'n';
        opened_ = ::read(ready[0], &state, 1) == 1 && state == 'y';
        ::close(ready[0]);
    }
    OtherWriter(const OtherWriter&) = delete;
    OtherWriter& operator=(const OtherWriter&) = delete;
    ~OtherWriter() { kill(); }

    [[nodiscard]] bool opened() const { return opened_; }
    [[nodiscard]] pid_t process() const { return process_; }
    void kill() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
        process_ = -1;
    }

 private:
    pid_t process_ = -1;
    bool opened_ = false;
};

/// Whether another process finds the lock by which SQLite tells that it reads.
bool isLockedFor(const std::filesystem::path& path) {
    constexpr off_t kSharedLocks = 0x40000002;  // SQLite's file format, "File Locking"
    const pid_t other = ::fork();
    if (other == 0) {
        struct flock lock {};
        lock.l_type = F_WRLCK;
        lock.l_start = kSharedLocks;
        lock.l_len = 510;
        const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
        ::_exit(::fcntl(file, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK ? 0 : 1);
    }
    int status = 1;
    ::waitpid(other, &status, 0);
    return status == 0;
}

}  // namespace

class StudyLockTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "study.trap";
    }

    void secondWriterInThisProcessIsRefused() {
        sample::write(path_, 1);
        {
            auto first = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(first);
            const QString message = sample::messageOf(StudyFile::open(path_, sample::kProgram));
            QVERIFY2(message.contains("open for writing in another Trapwright"), qPrintable(message));
            QVERIFY2(message.contains(QString::number(::getpid())), qPrintable(message));
            // The refused attempt has not weakened the first.
            QVERIFY(!StudyFile::open(path_, sample::kProgram).ok());
            VERIFY_OK(first->saveGeneration(sample::generation(1)));
        }
        VERIFY_OK(StudyFile::open(path_, sample::kProgram));
    }

    // There is no log beside it, which other machines could not read; but they can read the study while it is
    // written, and nothing is lost with the writer.
    void onANetworkDisk() {
        qputenv("TRAPWRIGHT_NETWORK_DISK", "1");
        const auto restore = qScopeGuard([] { qunsetenv("TRAPWRIGHT_NETWORK_DISK"); });
        sample::write(path_, 1);
        OtherWriter writer(path_, 1);
        QVERIFY(writer.opened());
        QVERIFY(!std::filesystem::exists(path_.string() + "-wal"));
        QVERIFY(!std::filesystem::exists(path_.string() + "-shm"));
        {
            const auto reader = StudyFile::openReadOnly(path_);
            VERIFY_OK(reader);
            QCOMPARE(reader->generationCount().value(), 2);
        }
        QVERIFY(!StudyFile::open(path_, sample::kProgram).ok());
        writer.kill();
        auto next = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(next);
        QCOMPARE(next->generationCount().value(), 2);
        // A reader that is there does not keep the next generation from being saved.
        const auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        VERIFY_OK(next->saveGeneration(sample::generation(2)));
        QCOMPARE(reader->generationCount().value(), 3);
    }

    void otherPathsToTheSameStudyAreRefused() {
        sample::write(path_, 1);
        const std::filesystem::path link = path_.parent_path() / "link.trap";
        std::filesystem::create_symlink(path_, link);
        const auto first = StudyFile::open(link, sample::kProgram);
        VERIFY_OK(first);
        QVERIFY(!StudyFile::open(path_, sample::kProgram).ok());
        QVERIFY(!StudyFile::open(path_.parent_path() / "." / path_.filename(), sample::kProgram).ok());
    }

    void anotherNameOfTheSameFileIsRefused_data() {
        QTest::addColumn<bool>("inAnotherProcess");
        QTest::newRow("this process") << false;
        QTest::newRow("another process") << true;
    }
    void anotherNameOfTheSameFileIsRefused() {
        QFETCH(bool, inAnotherProcess);
        sample::write(path_, 1);
        const std::filesystem::path link = path_.parent_path() / "link.trap";
        std::filesystem::create_hard_link(path_, link);
        {
            std::optional<OtherWriter> other;
            std::optional<StudyFile> own;
            if (inAnotherProcess) {
                other.emplace(path_, 1);
                QVERIFY(other->opened());
            } else {
                auto study = StudyFile::open(path_, sample::kProgram);
                VERIFY_OK(study);
                own = std::move(study).value();
            }
            const auto refused = StudyFile::open(link, sample::kProgram);
            QVERIFY2(sample::messageOf(refused).contains("under another name"),
                     qPrintable(sample::messageOf(refused)));
            QVERIFY(refused.error().kind == base::ErrorKind::busy);
            // The log lies beside the first name, so that SQLite would not find it from here.
            QVERIFY(sample::messageOf(StudyFile::openReadOnly(link)).contains("has another name"));
            QVERIFY(!std::filesystem::exists(link.string() + "-wal"));
        }
        // A killed writer's log still lies there.
        QCOMPARE(StudyFile::open(link, sample::kProgram).ok(), !inAnotherProcess);
        const auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QCOMPARE(study->generationCount().value(), inAnotherProcess ? 2 : 1);
    }

    /// The system drops a process's locks on a file with any descriptor of it that the process closes.
    void readersAndRefusedWritersLeaveSqliteItsLocks() {
        sample::write(path_, 1);
        const auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(isLockedFor(path_));
        VERIFY_OK(StudyFile::openReadOnly(path_));
        QVERIFY(!StudyFile::open(path_, sample::kProgram).ok());
        QVERIFY(isLockedFor(path_));
    }

    void secondWriterInAnotherProcessIsRefused() {
        sample::write(path_, 1);
        OtherWriter other(path_, 1);
        QVERIFY(other.opened());
        const QString message = sample::messageOf(StudyFile::open(path_, sample::kProgram));
        QVERIFY2(message.contains(QString("process %1").arg(other.process())), qPrintable(message));
        // Reading is possible meanwhile.
        const auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        QCOMPARE(reader->generationCount().value(), 2);
    }

    void killedWriterLosesNothingAndFreesTheStudy() {
        sample::write(path_, 1);
        OtherWriter other(path_, 1);
        QVERIFY(other.opened());
        other.kill();
        QVERIFY(std::filesystem::exists(path_.string() + ".lock"));  // as a crash leaves it

        QCOMPARE(StudyFile::openReadOnly(path_).value().generationCount().value(), 2);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QCOMPARE(study->generationCount().value(), 2);
        QVERIFY(sample::equal(study->loadGeneration(1).value(), sample::generation(1)));
        VERIFY_OK(study->saveGeneration(sample::generation(2)));
    }

    void newStudyCannotTakeTheNameOfAnOpenOne() {
        const auto first = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(first);
        QVERIFY(
            sample::messageOf(StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram))
                .contains("exists already"));
    }

    void aDeletedStudyTakesNothingMoreAndIsRescued() {
        sample::write(path_, 1);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->saveGeneration(sample::generation(1)));
        auto beside = study->openBeside();
        VERIFY_OK(beside);
        VERIFY_OK(study->checkInPlace());
        std::filesystem::remove(path_);
        const QString message = sample::messageOf(study->saveGeneration(sample::generation(2)));
        QVERIFY2(message.contains("was deleted or moved"), qPrintable(message));
        QVERIFY(sample::messageOf(beside->chooseWinner({})).contains("was deleted or moved"));
        QVERIFY(!study->openBeside().ok());

        const auto rescued = study->rescue();
        VERIFY_OK(rescued);
        QCOMPARE(rescued->filename().string(), std::string("study-rescued.trap"));
        auto copy = StudyFile::open(*rescued, sample::kProgram);
        VERIFY_OK(copy);
        QCOMPARE(copy->generationCount().value(), 2);
        QVERIFY(sample::equal(copy->loadGeneration(1).value(), sample::generation(1)));
        VERIFY_OK(copy->saveGeneration(sample::generation(2)));
        // Nothing is written over.
        QCOMPARE(study->rescue().value().filename().string(), std::string("study-rescued-2.trap"));
    }

    void aStudyThatTookAnothersPlaceStaysAsItIs() {
        sample::write(path_, 1);
        const std::filesystem::path other = path_.parent_path() / "other.trap";
        sample::write(other, 3);
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveGeneration(sample::generation(1)));
            std::filesystem::rename(other, path_);
            const QString message = sample::messageOf(study->saveGeneration(sample::generation(2)));
            QVERIFY2(message.contains("was replaced by another file"), qPrintable(message));
            VERIFY_OK(study->rescue());
        }
        QVERIFY(!std::filesystem::exists(path_.string() + "-wal"));
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QCOMPARE(study->generationCount().value(), 3);
        for (int i = 0; i < 3; ++i)
            QVERIFY(sample::equal(study->loadGeneration(i).value(), sample::generation(i)));
    }

    void nobodysFileBesideIsTouched() {
        const std::filesystem::path beside = path_.string() + ".new";
        const std::filesystem::path aside = path_.string() + ".replaced";
        VERIFY_OK(base::writeFile(beside, "mine"));
        VERIFY_OK(base::writeFile(aside, "mine, too"));
        sample::write(path_, 1);
        QCOMPARE(base::readFile(beside).value(), std::string("mine"));
        auto replaced = store::ReplacedStudy::setAside(path_);
        VERIFY_OK(replaced);
        sample::write(path_, 2);
        replaced->discard();
        QCOMPARE(StudyFile::openReadOnly(path_).value().generationCount().value(), 2);
        QCOMPARE(base::readFile(aside).value(), std::string("mine, too"));
        QCOMPARE(QDir(folder_->path()).entryList(QDir::Files).size(), 3);
    }

    void lockIsMovedWithItsOwner() {
        auto lock = store::FileLock::acquire(path_);
        VERIFY_OK(lock);
        store::FileLock moved = std::move(lock).value();
        QVERIFY(!store::FileLock::acquire(path_).ok());
        auto other = store::FileLock::acquire(path_.parent_path() / "other.trap");
        VERIFY_OK(other);
        moved = std::move(other).value();
        VERIFY_OK(store::FileLock::acquire(path_));
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyLockTest)
#include "study_lock_test.moc"
