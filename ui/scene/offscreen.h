#pragma once

#include <QImage>
#include <memory>

#include "ui/scene/stage.h"

namespace trapwright::scene {

/// A stage with an OpenGL context of its own and no window. GUI thread only.
class Offscreen {
 public:
    Offscreen();
    ~Offscreen();

    /// Null if there is no OpenGL.
    [[nodiscard]] QImage draw(const SceneContents& contents, const Camera& camera, QSize pixels,
                              double pixelRatio);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
