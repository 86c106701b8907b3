#include "ui/scene/offscreen.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QOpenGLFramebufferObject>
#include <utility>

namespace trapwright::scene {

namespace {

constexpr std::pair kVersion(3, 2);  // of OpenGL, that VTK needs

QString advice() {
    return QCoreApplication::translate("scene",
                                       "Update the display's driver, or set LIBGL_ALWAYS_SOFTWARE=1 to draw "
                                       "without it.");
}

}  // namespace

QSurfaceFormat Offscreen::format() {
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(kVersion.first, kVersion.second);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setRedBufferSize(8);
    format.setGreenBufferSize(8);
    format.setBlueBufferSize(8);
    format.setAlphaBufferSize(8);
    format.setDepthBufferSize(24);
    format.setStencilBufferSize(8);
    // VTK smooths edges in a framebuffer of its own.
    format.setSamples(0);
    return format;
}

Offscreen::Offscreen(QOffscreenSurface& surface)
    : surface_(surface), stage_([this] { context_.makeCurrent(&surface_); }) {
    context_.setFormat(format());
    if (!context_.create() || !context_.makeCurrent(&surface_)) {
        problem_ = QCoreApplication::translate("scene", "This display offers no OpenGL.") + ' ' + advice();
        return;
    }
    const auto version = context_.format().version();
    if (version < kVersion) {
        problem_ = QCoreApplication::translate("scene",
                                               "The 3D scene needs OpenGL %1.%2; this display offers %3.%4.")
                       .arg(kVersion.first)
                       .arg(kVersion.second)
                       .arg(version.first)
                       .arg(version.second) +
                   ' ' + advice();
    }
}

Offscreen::~Offscreen() {
    if (!context_.makeCurrent(&surface_)) return;
    stage_.releaseGraphics();
    context_.doneCurrent();
}

Rendering Offscreen::draw(const RenderRequest& request) {
    Rendering made;
    made.problem = problem_;
    if (!problem_.isEmpty() || request.pixels.isEmpty() || !context_.makeCurrent(&surface_)) return made;
    QElapsedTimer clock;
    clock.start();
    QOpenGLFramebufferObject frame(request.pixels, QOpenGLFramebufferObject::CombinedDepthStencil);
    if (!frame.bind()) return made;
    stage_.draw(*request.contents, request.camera, frame.handle(), request.pixels, request.pixelRatio,
                request.smooth);
    made.image = frame.toImage().convertToFormat(QImage::Format_RGB32);
    made.image.setDevicePixelRatio(request.pixelRatio);
    made.milliseconds = 1e-6 * static_cast<double>(clock.nsecsElapsed());
    return made;
}

}  // namespace trapwright::scene
