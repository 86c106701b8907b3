#include <QImage>
#include <QProcess>
#include <QPushButton>
#include <QStandardPaths>
#include <cmath>

#include "tests/ui/pages/review_user.h"

using namespace trapwright;
using namespace trapwright::pages;

namespace {

/// What ffprobe says of a film's picture stream.
QMap<QString, QString> probe(const QString& file) {
    QProcess ffprobe;
    ffprobe.start("ffprobe", {"-v", "error", "-select_streams", "v:0", "-show_entries",
                              "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_frames,duration", "-of",
                              "default=noprint_wrappers=1", file});
    ffprobe.waitForFinished(kPatience);
    QMap<QString, QString> values;
    for (const QByteArray& line : ffprobe.readAllStandardOutput().split('\n')) {
        const qsizetype at = line.indexOf('=');
        if (at > 0) values.insert(QString::fromUtf8(line.left(at)), QString::fromUtf8(line.mid(at + 1)));
    }
    return values;
}

}  // namespace

/// Pictures and films of a replay.
class ReplayFilesTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(learned_.learn()); }
    void init() {
        study_ = learned_.copy();
        QVERIFY(!study_.isEmpty());
    }

    void aFilmIsOneSecondLong() {
        if (QStandardPaths::findExecutable("ffmpeg").isEmpty()) QSKIP("ffmpeg is not installed");
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        // As fast as it takes to be over in a second.
        user.player().setSpeed(user.player().duration());
        const double seconds = user.player().duration() / user.player().speed();
        user.files().setFramesPerSecond(25);
        user.files().setPictureSize({1280, 720});
        const QString file = learned_.file("replay.mp4");
        user.files().saveMovie(file);
        QVERIFY(user.files().movie().busy());
        QTRY_VERIFY_WITH_TIMEOUT(!user.files().movie().busy(), 3 * kPatience);
        QVERIFY2(user.message().isEmpty(), qPrintable(user.message()));
        const QMap<QString, QString> film = probe(file);
        QCOMPARE(film["codec_name"], QString("h264"));
        QCOMPARE(film["pix_fmt"], QString("yuv420p"));
        QCOMPARE(film["width"], QString("1280"));
        QCOMPARE(film["height"], QString("720"));
        QCOMPARE(film["r_frame_rate"], QString("25/1"));
        QCOMPARE(film["nb_frames"].toInt(), static_cast<int>(std::ceil(25 * seconds)) + 1);
        QVERIFY(std::abs(film["duration"].toDouble() - seconds) <= 2.0 / 25);
        QVERIFY(!QFile::exists(file + ".part"));
    }

    // The last picture is that of the end, however far the part goes between two.
    void aFilmRunsToTheFinishAtAnySpeed_data() {
        QTest::addColumn<double>("speed");
        QTest::newRow("4 x") << 4.0;
        QTest::newRow("a speed that no number of pictures fits") << 3.7;
    }

    void aFilmRunsToTheFinishAtAnySpeed() {
        if (QStandardPaths::findExecutable("ffmpeg").isEmpty()) QSKIP("ffmpeg is not installed");
        QFETCH(double, speed);
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        user.player().setSpeed(speed);
        user.files().setFramesPerSecond(25);
        user.files().setPictureSize({1280, 720});
        double last = 0.0;
        connect(&user.player(), &ReplayPlayer::timeChanged, [&](double time) { last = time; });
        QStringList told;
        connect(&user.files().movie(), &MovieExport::progressed, [&] {
            for (const QLabel* label : user.files().findChildren<QLabel*>())
                if (label->text().startsWith("Picture")) told << label->text();
        });
        user.files().saveMovie(learned_.file("fast.mp4"));
        QTRY_VERIFY_WITH_TIMEOUT(!user.files().movie().busy(), 3 * kPatience);
        QVERIFY2(user.message().isEmpty(), qPrintable(user.message()));
        QCOMPARE(last, user.player().duration());
        QVERIFY2(told.join('\n').contains(QRegularExpression("Picture \\d+ of \\d+, \\d+ (s|min) left")),
                 qPrintable(told.join('\n')));
    }

    void aCancelledFilmLeavesNothing() {
        if (QStandardPaths::findExecutable("ffmpeg").isEmpty()) QSKIP("ffmpeg is not installed");
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        user.player().setSpeed(0.05);
        user.files().setPictureSize({1280, 720});
        const QString file = learned_.file("cancelled.mp4");
        user.files().saveMovie(file);
        QTRY_VERIFY_WITH_TIMEOUT(user.player().time() > 0.0, kPatience);
        user.find<QPushButton>("review.cancelMovie")->click();
        QVERIFY(!user.files().movie().busy());
        QVERIFY(!QFile::exists(file) && !QFile::exists(file + ".part"));
    }

    void withoutFfmpegAMessageTellsWhatToInstall() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        const QByteArray path = qgetenv("PATH");
        qputenv("PATH", learned_.file("no/programs").toLocal8Bit());
        user.files().saveMovie(learned_.file("none.mp4"));
        qputenv("PATH", path);
        QVERIFY2(user.message().contains("apt install ffmpeg"), qPrintable(user.message()));
        QVERIFY(!QFile::exists(learned_.file("none.mp4")));
    }

    void aPictureIsSaved() {
        ReviewUser user(study_);
        QVERIFY(user.waitForReplay());
        user.files().setPictureSize({1920, 1080});
        user.files().savePicture(learned_.file("a.png"));
        QTRY_COMPARE_WITH_TIMEOUT(QImage(learned_.file("a.png")).size(), QSize(1920, 1080), kPatience);
        user.files().savePicture(learned_.file("no/such/folder/a.png"));
        QTRY_VERIFY2_WITH_TIMEOUT(user.message().contains("no/such/folder"), qPrintable(user.message()),
                                  kPatience);
    }

 private:
    LearnedStudy learned_{"replay_files_test"};
    QString study_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    ReplayFilesTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "replay_files_test.moc"
