#include "ui/scene/offscreen.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>

namespace trapwright::scene {

namespace {

/// Puts back the context that was current before: a widget may be in the middle of painting.
class CurrentContext {
 public:
    CurrentContext(QOpenGLContext& context, QOffscreenSurface& surface)
        : before_(QOpenGLContext::currentContext()),
          beforeSurface_(before_ ? before_->surface() : nullptr),
          context_(context) {
        made_ = context.makeCurrent(&surface);
    }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;
    ~CurrentContext() {
        if (before_ && beforeSurface_) {
            before_->makeCurrent(beforeSurface_);
        } else if (made_) {
            context_.doneCurrent();
        }
    }
    [[nodiscard]] bool made() const { return made_; }

 private:
    QOpenGLContext* before_;
    QSurface* beforeSurface_;
    QOpenGLContext& context_;
    bool made_ = false;
};

}  // namespace

struct Offscreen::State {
    QOffscreenSurface surface;
    QOpenGLContext context;
    Stage stage{[this] { context.makeCurrent(&surface); }};
};

Offscreen::Offscreen() : state_(std::make_unique<State>()) {
    state_->surface.setFormat(QSurfaceFormat::defaultFormat());
    state_->surface.create();
    state_->context.setFormat(QSurfaceFormat::defaultFormat());
    state_->context.create();
}

Offscreen::~Offscreen() {
    const CurrentContext current(state_->context, state_->surface);
    if (current.made()) state_->stage.releaseGraphics();
}

QImage Offscreen::draw(const SceneContents& contents, const Camera& camera, QSize pixels, double pixelRatio) {
    const CurrentContext current(state_->context, state_->surface);
    if (!current.made() || pixels.isEmpty()) return {};
    QOpenGLFramebufferObject frame(pixels, QOpenGLFramebufferObject::CombinedDepthStencil);
    if (!frame.bind()) return {};
    state_->stage.draw(contents, camera, frame.handle(), pixels, pixelRatio, true);
    QImage image = frame.toImage().convertToFormat(QImage::Format_RGB32);
    image.setDevicePixelRatio(pixelRatio);
    return image;
}

}  // namespace trapwright::scene
