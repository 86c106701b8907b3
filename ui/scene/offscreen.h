#pragma once

#include <QOffscreenSurface>
#include <QOpenGLContext>

#include "ui/scene/scene_renderer.h"
#include "ui/scene/stage.h"

namespace trapwright::scene {

/// A stage with an OpenGL context of its own and no window. Belongs to the thread that makes it.
class Offscreen {
 public:
    /// What contexts and surfaces must be like.
    [[nodiscard]] static QSurfaceFormat format();

    /// `surface` lives longer.
    explicit Offscreen(QOffscreenSurface& surface);
    ~Offscreen();

    [[nodiscard]] Rendering draw(const RenderRequest& request);

 private:
    QOffscreenSurface& surface_;
    QOpenGLContext context_;
    Stage stage_;
    QString problem_;
};

}  // namespace trapwright::scene
