#pragma once

#include <QFuture>
#include <QImage>
#include <QString>

#include <memory>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"

namespace trapwright::scene {

/// A picture to be drawn, without labels.
struct RenderRequest {
    std::shared_ptr<const SceneContents> contents;
    Camera camera;
    QSize pixels;
    double pixelRatio = 1.0;  // pixels of a line one wide
    bool smooth = true;       // no ragged edges; in software four times the work
};

struct Rendering {
    QImage image;               // null if it could not be drawn
    QString problem;            // why there is no OpenGL to draw with
    double milliseconds = 0.0;  // that drawing took
};

/// Draws scenes with VTK in a thread that all renderers share, so that the window never waits for a picture.
/// Each has an OpenGL context of its own and keeps what it drew last, so that a similar picture is quick.
/// Make and use it in the GUI thread.
class SceneRenderer {
 public:
    SceneRenderer();
    /// What is not drawn yet becomes a null picture.
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    /// Pictures are drawn in the order in which they were asked for.
    [[nodiscard]] QFuture<Rendering> render(RenderRequest request);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
