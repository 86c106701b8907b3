#include "ui/scene/scene_renderer.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QObject>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <QPromise>
#include <QSize>
#include <QSurfaceFormat>
#include <QThread>

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "core/base/parallel.h"
#include "ui/scene/camera.h"
#include "ui/scene/contents.h"
#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"

namespace trapwright::scene {

namespace {

/// The thread in which everything of VTK and OpenGL happens. There is one as long as someone holds it. GUI
/// thread only.
class RenderThread {
 public:
    [[nodiscard]] static std::shared_ptr<RenderThread> get();
    RenderThread();
    ~RenderThread();

    /// Does it there after what was posted before.
    void post(std::function<void()> work);
    void postAndWait(std::function<void()> work);

 private:
    QThread thread_;
    QObject inside_;  // lives in the thread
};

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

/// The window goes before its pictures; both go before learning.
constexpr int kPrioritySteps = 3;

std::shared_ptr<RenderThread> RenderThread::get() {
    static std::weak_ptr<RenderThread> present;
    std::shared_ptr<RenderThread> thread = present.lock();
    if (!thread) present = thread = std::make_shared<RenderThread>();
    return thread;
}

RenderThread::RenderThread() {
    thread_.setObjectName("scene");
    inside_.moveToThread(&thread_);
    thread_.start();
    post([] { base::lowerPriority(kPrioritySteps); });
}

RenderThread::~RenderThread() {
    thread_.quit();
    thread_.wait();
}

void RenderThread::post(std::function<void()> work) {
    QMetaObject::invokeMethod(&inside_, std::move(work), Qt::QueuedConnection);
}

void RenderThread::postAndWait(std::function<void()> work) {
    QMetaObject::invokeMethod(&inside_, std::move(work), Qt::BlockingQueuedConnection);
}

constexpr std::pair kVersion(3, 2);  // of OpenGL, that VTK needs

QString advice() {
    return QCoreApplication::translate("scene",
                                       "Update the display's driver, or set LIBGL_ALWAYS_SOFTWARE=1 to draw "
                                       "without it.");
}

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

constexpr int kSamples = 4;  // per pixel of a smooth picture

void aim(vtkCamera& camera, const Camera& wanted) {
    const base::Vec3 eye = wanted.eye() * kDrawn;
    const base::Vec3 focus = wanted.focus * kDrawn;
    const base::Vec3 up = wanted.up();
    camera.SetPosition(eye.data());
    camera.SetFocalPoint(focus.data());
    camera.SetViewUp(up.data());
    camera.SetViewAngle(wanted.viewAngle / base::kDegree);
    camera.SetParallelProjection(wanted.parallel);
    camera.SetParallelScale(wanted.distance * kDrawn * std::tan(0.5 * wanted.viewAngle));
}

struct Stage::State {
    std::function<void()> makeCurrent;
    vtkNew<vtkRenderer> renderer;
    vtkSmartPointer<vtkGenericOpenGLRenderWindow>
        window;  // of the current context; null before its first picture
    SubjectLayer subject{*renderer};
    HighlightLayer highlights{*renderer};
    MarksLayer marks{*renderer};
    PartLayer part{*renderer};
    MotionLayer motion{*renderer};
    EdgeLayer edges{*renderer};

    void openWindow() {
        window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
        vtkNew<vtkCallbackCommand> current;
        current->SetClientData(this);
        current->SetCallback(
            [](vtkObject*, unsigned long, void* state, void*) { static_cast<State*>(state)->makeCurrent(); });
        window->AddObserver(vtkCommand::WindowMakeCurrentEvent, current);
        window->SetOwnContext(0);
        window->SetFrameBlitModeToBlitToCurrent();
        // Core profiles draw no wide lines; VTK then makes them of triangles.
        window->SetForceMaximumHardwareLineWidth(1.0F);
        window->SetReadyForRendering(true);
        window->SetMapped(1);
        window->SetIsCurrent(true);
        window->GetState()->Reset();
        window->OpenGLInitContext();
        window->AddRenderer(renderer);
    }
};

Stage::Stage(std::function<void()> makeCurrent) : state_(std::make_unique<State>()) {
    state_->makeCurrent = std::move(makeCurrent);
}

Stage::~Stage() = default;

void Stage::draw(const SceneContents& contents, const Camera& camera, unsigned framebuffer, QSize pixels,
                 double pixelRatio, bool smooth) {
    State& state = *state_;
    if (!state.window) state.openWindow();
    state.part.show(contents);
    state.subject.show(contents, state.part.shades());
    state.highlights.show(contents, pixelRatio);
    state.marks.show(contents, camera, pixelRatio);
    state.motion.show(contents, pixelRatio);
    state.edges.show(contents, camera, pixelRatio);
    state.part.setCamera(camera);
    state.subject.setCamera(camera);
    state.highlights.setCamera(camera);
    state.marks.setCamera(camera);
    state.motion.setCamera(camera);

    const QColor& top = contents.theme.backgroundTop;
    const QColor& bottom = contents.theme.backgroundBottom;
    state.renderer->GradientBackgroundOn();
    state.renderer->SetBackground(bottom.redF(), bottom.greenF(), bottom.blueF());
    state.renderer->SetBackground2(top.redF(), top.greenF(), top.blueF());
    aim(*state.renderer->GetActiveCamera(), camera);
    state.renderer->ResetCameraClippingRange();

    state.window->SetMultiSamples(smooth ? kSamples : 0);
    state.window->SetSize(pixels.width(), pixels.height());
    // Qt has made a framebuffer in the meantime: what VTK remembers of the state is wrong.
    vtkOpenGLState* gl = state.window->GetState();
    gl->Reset();
    gl->Push();
    gl->vtkglDepthFunc(GL_LEQUAL);
    gl->vtkglEnable(GL_MULTISAMPLE);
    QOpenGLContext::currentContext()->functions()->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    state.window->Render();
    gl->Pop();
}

void Stage::releaseGraphics() {
    if (!state_->window) return;
    state_->window->RemoveRenderer(state_->renderer);
    state_->renderer->ReleaseGraphicsResources(state_->window);
    state_->window->Finalize();
    state_->window = nullptr;
}

}  // namespace

struct SceneRenderer::State {
    std::shared_ptr<RenderThread> thread = RenderThread::get();
    QOffscreenSurface surface;             // belongs to the GUI thread, whoever draws with it
    std::unique_ptr<Offscreen> offscreen;  // made, used and taken away in the render thread
    std::atomic<bool> ends = false;
};

SceneRenderer::SceneRenderer() : state_(std::make_unique<State>()) {
    state_->surface.setFormat(Offscreen::format());
    state_->surface.create();
}

SceneRenderer::~SceneRenderer() {
    state_->ends = true;
    state_->thread->postAndWait([this] { state_->offscreen = nullptr; });
}

QFuture<Rendering> SceneRenderer::render(RenderRequest request) {
    const auto promise = std::make_shared<QPromise<Rendering>>();
    QFuture<Rendering> future = promise->future();
    promise->start();
    // The state outlives what was posted: its end waits for it.
    state_->thread->post([state = state_.get(), request = std::move(request), promise] {
        Rendering made;
        if (!state->ends) {
            if (!state->offscreen) state->offscreen = std::make_unique<Offscreen>(state->surface);
            made = state->offscreen->draw(request);
        }
        promise->addResult(std::move(made));
        promise->finish();
    });
    return future;
}

}  // namespace trapwright::scene
