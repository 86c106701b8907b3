#pragma once

#include <QFile>
#include <QSettings>
#include <QTableView>
#include <QtTest>

#include "sim/native/native_engine.h"
#include "tests/ui/session/session_fixture.h"
#include "tests/ui/window/window_user.h"
#include "ui/pages/replay_files.h"
#include "ui/pages/replay_player.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

inline constexpr int kPatience = 60000;  // [ms] for what happens in the background, on a busy machine

inline session::Environment nativeEnvironment() {
    session::Environment environment;
    environment.program = "trapwright test";
    environment.engines = fake::enginesMadeBy([](const std::string&, const trial::EngineOptions& options) {
        return std::make_unique<native::NativeEngine>(options);
    });
    return environment;
}

/// Low hills, on which parts finish, turn, stop and fall in a few generations.
inline study::Settings lowHills() {
    study::Settings settings = session::smallSettings(2);
    settings.evolution.trialsPerEvaluation = 16;
    settings.track.segmentHeight = 6e-3;
    settings.validation.selectionTrials = 80;
    settings.validation.trialsPerPose = 80;
    return settings;
}

/// The window with the study in it, and what a user does there.
struct ReviewUser : tests::WindowUser {
    explicit ReviewUser(const QString& study) : WindowUser(nativeEnvironment()) {
        (void)open(study.toStdString(), "review");
    }
    void trigger(const QString& action) { find<QAction>(action)->trigger(); }
    void press(int key) { QTest::keyClick(sceneView(), Qt::Key(key)); }
    void click(const QTableView& table, int row, int column) {
        const QRect cell = table.visualRect(table.model()->index(row, column));
        QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, cell.center());
    }

    ReplayPlayer& player() { return *window.findChild<ReplayPlayer*>(); }
    QTableView& trials() { return *find<QTableView>("trials.table"); }
    QTableView& validation() { return *find<QTableView>("review.validation.table"); }
    QTableView& comparison() { return *find<QTableView>("review.comparison.table"); }
    pages::ReplayFiles& files() { return *window.findChild<pages::ReplayFiles*>(); }

    /// The first trial of the list in the scene.
    bool waitForReplay() {
        return QTest::qWaitFor([&] { return player().duration() > 0.0 && scene().parts.size() == 1; },
                               kPatience);
    }
    bool validate() {
        trigger("review.validate");
        return QTest::qWaitFor([&] { return validation().model()->rowCount() > 0; }, kPatience);
    }
};

/// A small learned study, and copies of it that may be changed.
class LearnedStudy {
 public:
    explicit LearnedStudy(const QString& program) {
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        qputenv("XDG_DATA_HOME", folder_.filePath("data").toLocal8Bit());
        QCoreApplication::setOrganizationName("Trapwright");
        QCoreApplication::setApplicationName(program);
    }

    [[nodiscard]] QString file(const QString& name) const { return folder_.filePath(name); }
    [[nodiscard]] bool learn() const {
        auto made = session::StudySession::create(file("learned.trap").toStdString(), lowHills(),
                                                  session::cuboid(), nativeEnvironment());
        return made.ok() && session::learnToTheEnd(**made) && (*made)->runs().winners().size() == 2;
    }
    /// With the program's settings as they are at first.
    QString copy() {
        QSettings().clear();
        const QString copied = file(QString("study%1.trap").arg(++count_));
        return QFile::copy(file("learned.trap"), copied) ? copied : QString();
    }

 private:
    QTemporaryDir folder_;
    int count_ = 0;
};

}  // namespace trapwright::pages
