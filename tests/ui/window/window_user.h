#pragma once

#include <QAction>
#include <QLabel>
#include <QtTest>
#include <filesystem>
#include <utility>

#include "ui/look/message_bar.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_session.h"
#include "ui/window/main_window.h"

namespace trapwright::tests {

/// The studio's window on the screen, and what a user sees and does there: the base of those who work on one
/// of its pages.
struct WindowUser {
    window::MainWindow window;

    explicit WindowUser(session::Environment environment) : window(std::move(environment)) {
        window.resize(1280, 720);
        window.show();
        window.activateWindow();
        (void)QTest::qWaitForWindowActive(&window);
    }
    ~WindowUser() {
        window.desk().close(false);
        window.close();
    }
    WindowUser(const WindowUser&) = delete;
    WindowUser& operator=(const WindowUser&) = delete;

    session::StudySession* session() { return window.desk().session(); }
    bool open(const std::filesystem::path& study, const QString& page) {
        constexpr int kPatience = 60000;  // [ms] on a busy machine
        window.openFile(study);
        if (!QTest::qWaitFor([&] { return session() != nullptr; }, kPatience)) return false;
        window.showPage(page);
        return true;
    }
    template <class Object>
    Object* find(const QString& name) {
        return window.findChild<Object*>(name);
    }
    QAction* action(const QString& name) { return find<QAction>(name); }
    QString text(const QString& label) { return find<QLabel>(label)->text(); }
    QString message() { return find<look::MessageBar>("messageBar")->text(); }
    scene::SceneView* sceneView() { return find<scene::SceneView>("scene"); }
    const scene::SceneContents& scene() { return sceneView()->contents(); }
};

}  // namespace trapwright::tests
