// What a user can do wrong in the window: each is told with what was wrong, where and what to do, changes
// nothing that is open, and the program goes on. tests/app/bad_input_test.cpp has the same list for the
// command line.

#include <sys/resource.h>
#include <QMessageBox>
#include <QPushButton>
#include <QToolButton>
#include <csignal>

#include "core/study/presets.h"
#include "core/workflow/part_source.h"
#include "sim/engines/registry.h"
#include "tests/ui/window/user.h"
#include "ui/pages/value_edit.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using session::RunState;
using tests::kPatience;
using tests::User;

namespace {

/// A box of 4 x 8 x `height` as ASCII STL; the first of its faces that are left, and its first coordinate as
/// given.
QByteArray boxStl(int triangles, const QByteArray& first = "0", double height = 12.0) {
    const double corners[8][3] = {{0, 0, 0},      {4, 0, 0},      {4, 8, 0},      {0, 8, 0},
                                  {0, 0, height}, {4, 0, height}, {4, 8, height}, {0, 8, height}};
    const int faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                              {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    QByteArray text = "solid box\n";
    for (int i = 0; i < triangles; ++i) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const int corner : faces[i]) {
            text += "  vertex ";
            text += corner == 0 && i == 0 ? first : QByteArray::number(corners[corner][0]);
            text += ' ' + QByteArray::number(corners[corner][1]) + ' ' +
                    QByteArray::number(corners[corner][2]) + '\n';
        }
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid box\n";
}

void write(const QString& path, const QByteArray& content) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(content) == content.size());
}

/// Files of this process cannot grow beyond this as long as it lives: a disk that is full.
class FullDisk {
 public:
    explicit FullDisk(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
    rlimit before_{};
};

}  // namespace

class BadInputTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        tests::useFolder(folder_, "bad_input_test");
        write(path("empty.stl"), "");
        write(path("text.stl"),
              "Dear reader,\nthis is not a mesh but a letter that somebody gave the wrong name.\n");
        write(path("nan.stl"), boxStl(12, "nan"));
        write(path("flat.stl"), boxStl(12, "0", 0.0));
        write(path("letter.txt"), "hello");
        write(path("unknown.json"), "{\"track\": {\"colour\": 3}}");
        write(path("garbage.trap"), QByteArray(5000, 'x'));
        write(path("empty.trap"), "");
        QVERIFY(QDir(folder_.path()).mkdir("folder.trap") && QDir(folder_.path()).mkdir("folder.stl"));
        makeStudy("good.trap");
        makeStudy("cut.trap");
        QVERIFY(QFile::resize(path("cut.trap"), 6000));
    }
    void init() { QSettings().clear(); }

    void files_data() {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("message");  // a part of it
        QTest::newRow("part: missing") << "missing.stl"
                                       << "missing.stl does not exist";
        QTest::newRow("part: empty") << "empty.stl"
                                     << "empty.stl is empty";
        QTest::newRow("part: text named .stl") << "text.stl"
                                               << "text.stl";
        QTest::newRow("part: NaN") << "nan.stl"
                                   << "nan.stl";
        QTest::newRow("part: zero volume") << "flat.stl"
                                           << "volume";
        QTest::newRow("part: folder") << "folder.stl"
                                      << "not a file";
        QTest::newRow("part: another kind of file") << "letter.txt"
                                                    << "letter.txt";
        QTest::newRow("part: settings") << "unknown.json"
                                        << "unknown.json";
        QTest::newRow("study: missing") << "missing.trap"
                                        << "no study at";
        QTest::newRow("study: garbage") << "garbage.trap"
                                        << "garbage.trap is not a study";
        QTest::newRow("study: empty") << "empty.trap"
                                      << "empty.trap is empty";
        QTest::newRow("study: folder") << "folder.trap"
                                       << "is a folder";
        QTest::newRow("study: cut off") << "cut.trap"
                                        << "cut.trap is damaged";
    }
    void files() {
        QFETCH(QString, file);
        QFETCH(QString, message);
        User user;
        // Without a study, and then beside one, which stays as it is.
        for (const bool open : {false, true}) {
            if (open) QVERIFY(user.import("pin"));
            const session::StudySession* before = user.session();
            user.window.openFile(path(file).toStdString());
            QTRY_VERIFY2_WITH_TIMEOUT(user.message().contains(message), qPrintable(user.message()),
                                      kPatience);
            QVERIFY(QApplication::activeModalWidget() == nullptr);
            QVERIFY(user.session() == before);
        }
        QCOMPARE(user.session()->design().part()->name, std::string("pin"));
    }

    void aStudyThatAnotherHasOpen() {
        const auto other = store::StudyFile::open(path("good.trap").toStdString(), "another program");
        QVERIFY(other.ok());
        User user;
        user.window.openFile(path("good.trap").toStdString());
        QTRY_VERIFY2_WITH_TIMEOUT(user.message().contains("good.trap"), qPrintable(user.message()),
                                  kPatience);
        QVERIFY2(user.message().contains("open"), qPrintable(user.message()));
        QVERIFY(user.session() == nullptr);
    }

    void values_data() {
        QTest::addColumn<QString>("page");
        QTest::addColumn<QString>("field");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("reason");  // a part of it
        QTest::newRow("negative population") << "track"
                                             << "evolution.populationSize"
                                             << "-40"
                                             << "must be";
        QTest::newRow("no trials") << "track"
                                   << "evolution.trialsPerEvaluation"
                                   << "0"
                                   << "must be from 1";
        QTest::newRow("segment lengths") << "track"
                                         << "track.minSegmentLength_mm"
                                         << "40"
                                         << "must not be more";
        QTest::newRow("negative friction") << "track"
                                           << "simulation.contact.kineticFriction"
                                           << "-1"
                                           << "must be";
    }
    void values() {
        QFETCH(QString, page);
        QFETCH(QString, field);
        QFETCH(QString, text);
        QFETCH(QString, reason);
        User user;
        QVERIFY(user.import("cuboid") && user.show(page));
        const study::Settings before = user.session()->design().settings();
        auto* edit = user.find<pages::ValueEdit>("field." + field);
        QVERIFY(edit != nullptr);
        const QString good = edit->text();
        user.type(field, text);
        QVERIFY(edit->isBad());
        const QString told = user.find<QLabel>("reason." + field)->text();
        QVERIFY2(told.contains(reason), qPrintable(told));
        QVERIFY(!user.action("run.start")->isEnabled());
        user.type(field, good);
        QVERIFY(!edit->isBad());
        QVERIFY(user.session()->design().settings() == before);
        QVERIFY(user.action("run.start")->isEnabled());
    }

    // Told while it is typed; it never becomes a value.
    void textsThatAreNoNumber_data() {
        QTest::addColumn<QString>("field");
        QTest::addColumn<QString>("text");
        QTest::newRow("a word") << "evolution.populationSize"
                                << "many";
        QTest::newRow("half an individual") << "evolution.populationSize"
                                            << "10.5";
        QTest::newRow("two numbers") << "track.segmentWidth_mm"
                                     << "6 0";
        QTest::newRow("nothing") << "track.segmentWidth_mm"
                                 << " ";
        QTest::newRow("infinite") << "track.segmentWidth_mm"
                                  << "inf";
        QTest::newRow("too large to be a number") << "track.segmentWidth_mm"
                                                  << "1e999";
    }
    void textsThatAreNoNumber() {
        QFETCH(QString, field);
        QFETCH(QString, text);
        User user;
        QVERIFY(user.import("cuboid") && user.show("track"));
        const study::Settings before = user.session()->design().settings();
        auto* edit = user.find<pages::ValueEdit>("field." + field);
        const QString good = edit->text();
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTRY_VERIFY(edit->isBad());
        QVERIFY(!user.find<QLabel>("reason." + field)->text().isEmpty());
        QTest::keyClick(edit, Qt::Key_Return);
        QCOMPARE(edit->text(), good);
        QVERIFY(!edit->isBad());
        QVERIFY(user.session()->design().settings() == before);
    }

    void aPartOfNothing() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("part"));
        user.type("part.density_kg_m3", "0");
        const auto told = [&] {
            return user.message() + user.find<QLabel>("reason.part.density_kg_m3")->text();
        };
        QTRY_VERIFY2_WITH_TIMEOUT(told().contains("out of range"), qPrintable(told()), kPatience);
        QVERIFY(user.session()->design().part()->density > 0.0);
    }

    void aStudyWithoutGenerationsHasNothingToJudgeOrExport() {
        User user;
        QVERIFY(user.import("cuboid") && user.show("review"));
        for (const char* name : {"review.compare", "review.validate"}) {
            QVERIFY2(!user.action(name)->isEnabled(), name);
            QVERIFY2(user.action(name)->toolTip().contains("Learn"),
                     qPrintable(user.action(name)->toolTip()));
        }
        QVERIFY(user.show("export"));
        QVERIFY(!user.action("export.stl")->isEnabled() && !user.action("export.3mf")->isEnabled());
        QVERIFY(user.find<QLabel>("export.empty")->isVisible());
    }

    void placesThatCannotBeSavedTo_data() {
        QTest::addColumn<QString>("place");
        QTest::addColumn<QString>("message");
        QTest::newRow("no folder") << path("nowhere/x.trap") << "no folder";
        QTest::newRow("folder that cannot be written") << "/proc/x.trap"
                                                       << "/proc/x.trap";
        QTest::newRow("folder of that name") << path("folder.trap") << "is a folder";
        QTest::newRow("open in another program") << path("locked.trap") << "locked.trap";
    }
    void placesThatCannotBeSavedTo() {
        QFETCH(QString, place);
        QFETCH(QString, message);
        makeStudy("locked.trap");
        const auto locked = store::StudyFile::open(path("locked.trap").toStdString(), "another program");
        User user;
        QVERIFY(user.import("cuboid"));
        const std::filesystem::path before = user.session()->path();
        const base::Status saved = user.window.desk().saveAs(place.toStdString());
        QVERIFY(!saved.ok());
        const QString told = QString::fromStdString(saved.error().message);
        QVERIFY2(told.contains(message), qPrintable(told));
        // It goes on where it was.
        QCOMPARE(user.session()->path(), before);
        QVERIFY(user.show("track"));
        user.type("track.segmentWidth_mm", "61");
        QCOMPARE(user.session()->design().settings().track.segmentWidth, 61e-3);
        QVERIFY(locked->loadSettings().ok());
    }

    void aStudyIsReplacedWhenAskedTo() {
        makeStudy("old.trap");
        User user;
        QVERIFY(user.import("pin"));
        const base::Status saved = user.window.desk().saveAs(path("old.trap").toStdString());
        QVERIFY2(saved.ok(), saved.ok() ? "" : saved.error().message.c_str());
        user.window.desk().close(true);
        const auto study = store::StudyFile::openReadOnly(path("old.trap").toStdString());
        QVERIFY(study.ok());
        QCOMPARE(study->loadPart()->options.name, std::string("pin"));
        QVERIFY(!QFile::exists(path("old.trap.replaced")));
    }

    // What was learned stays, the study is still open, and goes on when there is space again.
    void aDiskThatFillsUpWhileItLearns() {
        makeStudy("filled.trap");
        window::MainWindow window{{engines::registry(), "trapwright test", {}}};
        window.show();
        window.openFile(path("filled.trap").toStdString());
        QTRY_VERIFY_WITH_TIMEOUT(window.desk().session() != nullptr, kPatience);
        session::StudySession& session = *window.desk().session();
        const auto* message = window.findChild<look::MessageBar*>("messageBar");
        {
            const FullDisk full(120000);
            window.findChild<QAction*>("run.start")->trigger();
            QTRY_VERIFY_WITH_TIMEOUT(!message->text().isEmpty(), 60000);
            QTRY_COMPARE_WITH_TIMEOUT(session.runs().state(), RunState::idle, 60000);
        }
        QVERIFY2(message->text().contains("filled.trap"), qPrintable(message->text()));
        const std::size_t known = session.runs().summaries().size();
        session.runs().startLearning();
        QTRY_VERIFY_WITH_TIMEOUT(session.runs().summaries().size() > known, 60000);
        session.runs().stopNow();
        QTRY_COMPARE_WITH_TIMEOUT(session.runs().state(), RunState::idle, 60000);
        const std::size_t saved = session.runs().summaries().size();
        window.desk().close(true);
        const auto study = store::StudyFile::openReadOnly(path("filled.trap").toStdString());
        QVERIFY(study.ok());
        QCOMPARE(study->generationCount().value(), static_cast<int>(saved));
    }

 private:
    [[nodiscard]] QString path(const QString& name) const { return folder_.filePath(name); }

    void makeStudy(const QString& name) {
        QFile::remove(path(name));
        workflow::PartRequest request;
        request.part = "cuboid";
        const auto part = workflow::importPart(request);
        QVERIFY(part.ok());
        study::Settings settings = study::presetSettings("cuboid").value();
        settings.part = part->settings;
        settings.simulation.engine = "native";
        settings.evolution.populationSize = 6;
        settings.evolution.trialsPerEvaluation = 4;
        settings.evolution.generations = 100000;
        const auto made =
            store::StudyFile::create(path(name).toStdString(), settings, part->stored, "trapwright test");
        QVERIFY2(made.ok(), made.ok() ? "" : made.error().message.c_str());
    }

    QTemporaryDir folder_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    BadInputTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "bad_input_test.moc"
