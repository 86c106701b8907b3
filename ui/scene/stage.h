#pragma once

#include <QSize>
#include <functional>
#include <memory>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"

namespace trapwright::scene {

/// A scene as VTK draws it, without labels, into whatever OpenGL context is current. One stage serves one
/// context at a time and belongs to its thread.
class Stage {
 public:
    /// VTK asks for its context through `makeCurrent`.
    explicit Stage(std::function<void()> makeCurrent);
    ~Stage();

    /// Draws into a framebuffer of this size in pixels. The context is current. A smooth picture has no
    /// ragged edges; where OpenGL is done in software it takes four times as long.
    void draw(const SceneContents& contents, const Camera& camera, unsigned framebuffer, QSize pixels,
              double pixelRatio, bool smooth);
    /// Gives back everything in the current context, which is about to go. The next draw() starts afresh.
    void releaseGraphics();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
