#pragma once

#include <QFuture>
#include <QImage>
#include <QObject>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include "ui/scene/scene_renderer.h"

namespace trapwright::scene {

/// A picture of a scene with what it shows.
struct Frame {
    std::shared_ptr<const SceneContents> contents;
    Camera camera;
    QSizeF screen;  // logical pixels
    double pixelRatio = 1.0;
    bool smooth = true;
    QImage image;
};

/// The pictures of a view: one at a time is drawn, of what is to be seen by then. Where smooth edges take
/// long they come when nothing has changed for a moment.
class SceneFrames : public QObject {
    Q_OBJECT
 public:
    /// `contents` and `camera`: what is to be seen, looked at whenever a picture begins.
    SceneFrames(QWidget& view, const SceneContents& contents, const Camera& camera);

    /// Contents, camera or the view are others than before.
    void change();
    /// Null before the first.
    [[nodiscard]] const Frame* newest() const { return newest_ ? &*newest_ : nullptr; }
    /// Whether the newest shows what is to be seen, with smooth edges.
    [[nodiscard]] bool isSettled() const;
    /// A picture of what is to be seen, at another size and with its labels.
    [[nodiscard]] QFuture<QImage> picture(QSize pixels, double pixelRatio);

 signals:
    void failed(const QString& message);  // once

 private:
    void begin();
    void draw(bool smooth);
    void take(const Rendering& made);

    QWidget& view_;
    const SceneContents& contents_;
    const Camera& camera_;
    SceneRenderer renderer_;
    std::optional<Frame> newest_;
    std::optional<Frame> begun_;  // is being drawn
    bool stale_ = false;          // since the one that is being drawn, or else the newest
    bool called_ = false;         // begin() is on its way
    bool smoothIsQuick_ = true;   // by how long the last took
    bool failed_ = false;
    QTimer rest_;  // when it ends nothing has changed for a moment
};

}  // namespace trapwright::scene
