#include "ui/scene/scene_frames.h"

#include <QPainter>
#include <utility>

#include "ui/scene/overlay.h"
#include "ui/scene/when_ready.h"

namespace trapwright::scene {

namespace {

constexpr int kRest = 150;              // without a change, before a better picture is worth its time [ms]
constexpr double kLongestFrame = 40.0;  // with which the scene follows the mouse [ms]
constexpr double kSmoothFactor = 0.15;  // of a frame's time without smooth edges in one with them, and room

}  // namespace

SceneFrames::SceneFrames(QWidget& view, const SceneContents& contents, const Camera& camera)
    : view_(view), contents_(contents), camera_(camera) {
    rest_.setSingleShot(true);
    rest_.setInterval(kRest);
    connect(&rest_, &QTimer::timeout, this, [this] {
        if (!begun_ && !stale_) draw(true);
    });
}

void SceneFrames::change() {
    rest_.stop();
    stale_ = true;
    // Not at once: most changes come several together.
    if (!std::exchange(called_, true))
        QMetaObject::invokeMethod(this, &SceneFrames::begin, Qt::QueuedConnection);
}

bool SceneFrames::isSettled() const {
    return failed_ || (newest_ && newest_->smooth && !begun_ && !stale_);
}

QFuture<QImage> SceneFrames::picture(QSize pixels, double pixelRatio) {
    const auto contents = std::make_shared<const SceneContents>(contents_);
    return renderer_.render({contents, camera_, pixels, pixelRatio, true})
        .then([contents, camera = camera_, screen = QSizeF(pixels) / pixelRatio](Rendering made) {
            if (made.image.isNull()) return made.image;
            QPainter painter(&made.image);
            paintOverlay(painter, overlayOf(*contents, camera, screen, std::nullopt));
            return made.image;
        });
}

void SceneFrames::begin() {
    called_ = false;
    if (stale_ && !begun_ && view_.isVisible()) draw(smoothIsQuick_);
}

void SceneFrames::draw(bool smooth) {
    stale_ = false;
    begun_ = Frame{std::make_shared<const SceneContents>(contents_),
                   camera_,
                   view_.size(),
                   view_.devicePixelRatioF(),
                   smooth,
                   {}};
    whenReady(renderer_.render({begun_->contents, camera_, (begun_->screen * begun_->pixelRatio).toSize(),
                                begun_->pixelRatio, smooth}),
              this, [this](const Rendering& made) { take(made); });
}

void SceneFrames::take(const Rendering& made) {
    Frame frame = *std::exchange(begun_, std::nullopt);
    if (!made.problem.isEmpty() && !std::exchange(failed_, true)) emit failed(made.problem);
    if (!made.image.isNull()) {
        frame.image = made.image;
        newest_ = std::move(frame);
        // The gap keeps it from changing to and fro.
        smoothIsQuick_ = made.milliseconds < (newest_->smooth ? 1.0 : kSmoothFactor) * kLongestFrame;
        view_.update();
        if (!stale_ && !newest_->smooth) rest_.start();
    }
    begin();
}

}  // namespace trapwright::scene
