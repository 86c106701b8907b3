#pragma once

#include <QImage>
#include <QSize>
#include <memory>

#include "ui/scene/contents.h"

namespace trapwright::scene {

/// Small pictures without labels, drawn off-screen: winners for the film strip, stable poses for cards. GUI
/// thread only; keeps its OpenGL context for the next picture. Pictures are null if there is no OpenGL.
class PictureMaker {
 public:
    PictureMaker();
    ~PictureMaker();

    void setTheme(const SceneTheme& theme);

    [[nodiscard]] QImage trackPicture(std::shared_ptr<const track::Track> track, QSize pixels);
    /// The part in this orientation (part frame to world, z up), on nothing.
    [[nodiscard]] QImage partPicture(std::shared_ptr<const part::Part> part, const base::Quaternion& rotation,
                                     QSize pixels);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
