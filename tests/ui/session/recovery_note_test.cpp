#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

#include "ui/session/recovery_note.h"

using namespace trapwright::session;

/// What tells the next start of the program that a study was learning.
class RecoveryNoteTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        state_ = std::filesystem::path(folder_->path().toStdString()) / "state" / "studio";
        study_ = std::filesystem::path(folder_->path().toStdString()) / "a study.trap";
        std::ofstream(study_) << "x";
    }

    void goodEndLeavesNothing() {
        QVERIFY(takeInterruptedStudies(state_).empty());
        {
            const RecoveryNote note(state_, study_);
            // That which is running now was not interrupted.
            QVERIFY(takeInterruptedStudies(state_).empty());
        }
        QVERIFY(takeInterruptedStudies(state_).empty());
        QVERIFY(std::filesystem::is_empty(state_));
    }

    void badEndIsToldOnce() {
        endBadly();
        const RecoveryNote other(state_, study_.parent_path() / "other.trap");
        QCOMPARE(takeInterruptedStudies(state_), std::vector<std::filesystem::path>{study_});
        QVERIFY(takeInterruptedStudies(state_).empty());
    }

    void studyThatIsGoneIsNotOffered() {
        endBadly();
        std::filesystem::remove(study_);
        QVERIFY(takeInterruptedStudies(state_).empty());
    }

    void folderThatCannotBeWrittenDoesNotMatter() {
        const RecoveryNote note("/proc/none", study_);
        const RecoveryNote nowhere({}, study_);
        QVERIFY(takeInterruptedStudies("/proc/none").empty());
    }

 private:
    /// A process that learns and is killed.
    void endBadly() const {
        const pid_t child = ::fork();
        if (child == 0) {
            const RecoveryNote note(state_, study_);
            ::_exit(0);
        }
        int status = 0;
        QCOMPARE(::waitpid(child, &status, 0), child);
    }

    std::unique_ptr<QTemporaryDir> folder_;
    std::filesystem::path state_;
    std::filesystem::path study_;
};

QTEST_GUILESS_MAIN(RecoveryNoteTest)
#include "recovery_note_test.moc"
