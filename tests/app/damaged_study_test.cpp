#include <QTemporaryDir>
#include <QtTest>

#include "core/base/file.h"
#include "tests/app/program.h"
#include "tests/core/store/sample_study.h"

using namespace trapwright;
using namespace trapwright::test;

namespace {

constexpr int kPage = 4096;  // bytes

/// The commands that work on a study, quickly.
const QList<QStringList>& studyCommands() {
    static const QList<QStringList> kCommands = {
        {"dump", "x.trap"},
        {"dump", "x.trap", "--checks"},
        {"settings", "x.trap"},
        {"physical", "x.trap"},
        {"evolve", "x.trap", "--resume", "--generations", "3", "--threads", "1"},
        {"select", "x.trap", "--winners", "1", "--trials", "2", "--corner-trials", "2", "--engine", "native"},
        {"validate", "x.trap", "--trials", "1", "--engine", "native"},
        {"export", "x.trap", "x.stl"},
        {"replay", "x.trap", "--out", "x.csv"}};
    return kCommands;
}

QByteArray read(const QString& path) {
    QFile file(path);
    (void)file.open(QIODevice::ReadOnly);
    return file.readAll();
}

/// Something of every table that learning leaves empty.
void fill(const std::filesystem::path& path) {
    auto study = store::StudyFile::open(path, sample::kProgram);
    VERIFY_OK(study);
    VERIFY_OK(study->saveSelection({"native", {study::SelectionEntry{}}}));
    study::ValidationRecord validation;
    validation.engine = "native";
    validation.rows = {{0, {9, 1, 0, 0}}};
    VERIFY_OK(study->saveValidation(validation));
    VERIFY_OK(study->chooseWinner(study::IndividualId{}));
    study::PhysicalValidation physical;
    physical.plan = {{0}, 2};
    physical.trials.resize(1);
    VERIFY_OK(study->addPhysicalValidation(physical));
    VERIFY_OK(study->appendDriveLog(std::vector<drive::LogEntry>(20)));
    calibration::Calibration calibration;
    calibration.readings = std::vector<calibration::Tilt>(1);
    VERIFY_OK(study->addCalibration(calibration));
    study::DropRecord drops;
    drops.poses = {base::Quaternion::Identity()};
    drops.result.counts = {1};
    VERIFY_OK(study->addDropTest(drops));
}

}  // namespace

/// Studies with damage anywhere: exit code 3, what is damaged and what to do; never a crash, nor a full disk
/// or a fault of the program for one.
class DamagedStudyTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        const Ran made = run(folder_.path(), quickStudy("whole.trap", 2) + QStringList{"--threads", "1"});
        QVERIFY2(made.code == 0, made.all());
        fill(path("whole.trap").toStdString());
        whole_ = read(path("whole.trap"));
        QVERIFY(whole_.size() > 20 * kPage && whole_.size() % kPage == 0);
    }

    void wholeStudyWorks() {
        for (const QStringList& command : studyCommands()) {
            put(whole_);
            const Ran ran = run(folder_.path(), command);
            QVERIFY2(ran.code == 0, command.join(' ').toUtf8() + "\n" + ran.all());
        }
    }

    void header_data() {
        QTest::addColumn<int>("offset");
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("message");
        const QString damaged = "damaged";
        QTest::newRow("magic") << 0 << QByteArray("SQLite formal 3") << "is not a study of Trapwright";
        QTest::newRow("page size") << 16 << QByteArray("\x12\x34", 2) << damaged;
        QTest::newRow("format") << 18 << QByteArray("\x09\x09", 2) << damaged;
        QTest::newRow("payload") << 21 << QByteArray("\x01\x02\x03", 3) << damaged;
        QTest::newRow("schema") << 44 << QByteArray("\x00\x00\x00\x63", 4) << "unsupported file format";
        QTest::newRow("encoding") << 56 << QByteArray("\x00\x00\x00\x63", 4) << damaged;
        QTest::newRow("first page") << 100 << QByteArray(100, '\xff') << damaged;
    }
    void header() {
        QFETCH(int, offset);
        QFETCH(QByteArray, bytes);
        QFETCH(QString, message);
        for (const QStringList& command : studyCommands()) {
            put(QByteArray(whole_).replace(offset, bytes.size(), bytes));
            const Ran ran = run(folder_.path(), command);
            QVERIFY2(ran.code == 3, command.join(' ').toUtf8() + "\n" + ran.all());
            QVERIFY2(ran.errors.contains(message.toUtf8()) && ran.errors.contains("x.trap"), ran.all());
        }
    }

    void anyPage_data() {
        QTest::addColumn<int>("offset");
        QTest::addColumn<QByteArray>("bytes");
        QTest::newRow("begin") << 0 << QByteArray(16, '\xff');
        QTest::newRow("middle") << 2000 << QByteArray(100, '\x5a');
        QTest::newRow("end") << 4000 << QByteArray(96, '\xff');
        QTest::newRow("all") << 0 << QByteArray(kPage, '\0');
    }
    void anyPage() {
        QFETCH(int, offset);
        QFETCH(QByteArray, bytes);
        int refused = 0;
        const int pages = static_cast<int>(whole_.size()) / kPage;
        for (int page = 1; page < pages; ++page) {
            put(QByteArray(whole_).replace(page * kPage + offset, bytes.size(), bytes));
            // Each command meets each kind of page in some row.
            const QStringList& command = studyCommands()[(page + refused) % studyCommands().size()];
            const Ran ran = run(folder_.path(), command);
            // Damage may lie in a table that is not asked, in free space, or make another number of one.
            const QByteArray what = command.join(' ').toUtf8() + ", page " + QByteArray::number(page) + "\n";
            QVERIFY2(ran.code == 0 || ran.code == 3, what + ran.all());
            if (ran.code == 0) continue;
            ++refused;
            QVERIFY2(ran.errors.contains("x.trap"), what + ran.all());
            if (bytes.size() == kPage || offset == 0)
                QVERIFY2(ran.errors.contains("damaged") && ran.errors.contains("Restore it from a copy"),
                         what + ran.all());
        }
        if (bytes.size() == kPage || offset == 0) QVERIFY(refused > pages / 8);
    }

    /// Who writes checks all of it first.
    void writersRefuseAnyTable() {
        const int pages = static_cast<int>(whole_.size()) / kPage;
        for (int page = 1; page < pages; ++page) {
            const char kind = whole_[page * kPage];
            if (kind != '\x0d' && kind != '\x05' && kind != '\x0a' && kind != '\x02') continue;
            const QByteArray broken = QByteArray(whole_).replace(page * kPage, 8, QByteArray(8, '\xff'));
            put(broken);
            const Ran ran =
                run(folder_.path(), {"evolve", "x.trap", "--resume", "--generations", "3", "--threads", "1"});
            QVERIFY2(ran.code == 3, QByteArray::number(page) + "\n" + ran.all());
            QVERIFY2(ran.errors.contains("damaged") && ran.errors.contains("Restore it from a copy"),
                     ran.all());
            QCOMPARE(read(path("x.trap")), broken);
        }
    }

    void log_data() {
        QTest::addColumn<int>("offset");
        QTest::addColumn<int>("size");  // of the damage; negative: cut off there
        QTest::newRow("none") << 0 << 0;
        QTest::newRow("header") << 0 << 32;
        QTest::newRow("first frame's header") << 32 << 24;
        QTest::newRow("first frame") << 500 << 64;
        QTest::newRow("later frame") << 32 + 3 * (kPage + 24) + 700 << 64;
        QTest::newRow("cut in the header") << 10 << -1;
        QTest::newRow("cut in a frame") << 32 + 2 * (kPage + 24) + 99 << -1;
    }
    /// A log that is cut off or damaged holds good transactions up to there.
    void log() {
        QFETCH(int, offset);
        QFETCH(int, size);
        const std::filesystem::path source = path("source.trap").toStdString();
        QByteArray file;
        QByteArray log;
        {
            std::filesystem::remove(source);
            sample::write(source, 1);
            auto writer = store::StudyFile::open(source, sample::kProgram);
            VERIFY_OK(writer);
            for (int index = 1; index < 4; ++index)
                VERIFY_OK(writer->saveGeneration(sample::generation(index)));
            file = read(path("source.trap"));
            log = read(path("source.trap-wal"));
        }
        put(file);
        if (size < 0) {
            log.truncate(offset);
        } else {
            log.replace(offset, size, QByteArray(size, '\xff'));
        }
        test::write(path("x.trap-wal"), log);
        const Ran ran = run(folder_.path(), {"dump", "x.trap"});
        QVERIFY2(ran.code == 0, ran.all());
        const auto lines = ran.output.count('\n');
        QVERIFY2(lines % 6 == 0 && lines >= 6 && (size == 0) == (lines == 24), ran.all());
        const auto study = store::StudyFile::open(path("x.trap").toStdString(), sample::kProgram);
        VERIFY_OK(study);
        QCOMPARE(study->generationCount().value(), static_cast<int>(lines) / 6);
    }

 private:
    [[nodiscard]] QString path(const QString& name) const { return folder_.filePath(name); }

    /// The study that the commands work on.
    void put(const QByteArray& content) const {
        for (const char* suffix : {"", "-wal", "-shm", "-journal"})
            QFile::remove(path(QString("x.trap") + suffix));
        test::write(path("x.trap"), content);
    }

    QTemporaryDir folder_;
    QByteArray whole_;
};

QTEST_GUILESS_MAIN(DamagedStudyTest)
#include "damaged_study_test.moc"
