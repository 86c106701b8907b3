#pragma once

#include <QFuture>
#include <QImage>
#include <QSize>

#include <memory>

#include "ui/scene/contents.h"
#include "ui/scene/scene_renderer.h"

namespace trapwright::scene {

/// Small pictures without labels, drawn in the background: winners for the film strip, stable poses for
/// cards. Make and use it in the GUI thread; keeps its OpenGL context for the next picture. Pictures are null
/// if there is no OpenGL. For whenReady().
class PictureMaker {
 public:
    void setTheme(const SceneTheme& theme) { theme_ = theme; }

    /// Sizes are logical: the picture has so many times the pixels.
    [[nodiscard]] QFuture<QImage> trackPicture(std::shared_ptr<const track::Track> track, QSize size,
                                               double pixelRatio = 1.0);
    /// The part in this orientation (part frame to world, z up), on nothing.
    [[nodiscard]] QFuture<QImage> partPicture(std::shared_ptr<const part::Part> part,
                                              const base::Quaternion& rotation, QSize size,
                                              double pixelRatio = 1.0);
    /// The part as it leaves the track, near by: at the finish in this pose (part frame to room), from the
    /// operator's side, with an arrow that tells which way it is conveyed.
    [[nodiscard]] QFuture<QImage> exitPicture(std::shared_ptr<const track::Track> track,
                                              std::shared_ptr<const part::Part> part, const base::Pose& pose,
                                              QSize size, double pixelRatio = 1.0);

 private:
    QFuture<QImage> draw(std::shared_ptr<SceneContents> contents, QSize size, double pixelRatio);

    SceneTheme theme_ = SceneTheme::light();
    SceneRenderer renderer_;
};

}  // namespace trapwright::scene
