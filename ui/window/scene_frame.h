#pragma once

#include <QHash>
#include <QWidget>

#include "ui/scene/scene_view.h"

class QStackedWidget;
class QVBoxLayout;

namespace trapwright::look {
class MessageBar;
}

namespace trapwright::window {

class Welcome;

/// The middle of the window: messages, then the scene with its views, then what the page has below it.
/// Without a study the welcome takes the place of the scene.
class SceneFrame : public QWidget {
    Q_OBJECT
 public:
    explicit SceneFrame(QWidget* parent);

    scene::SceneView& scene() { return *scene_; }
    look::MessageBar& messages() { return *messages_; }
    Welcome& welcome() { return *welcome_; }

    void showWelcome(bool welcome);
    /// Gives a page its place below the scene.
    void addBar(const QString& page, QWidget* bar);
    void showBar(const QString& page);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    QWidget* makeTools();
    void colour();

    look::MessageBar* messages_;
    QStackedWidget* stack_;
    Welcome* welcome_;
    scene::SceneView* scene_;
    QVBoxLayout* layout_;
    QHash<QString, QWidget*> bars_;
};

}  // namespace trapwright::window
