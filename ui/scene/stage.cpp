#include "ui/scene/stage.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <cmath>

#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"

namespace trapwright::scene {

namespace {

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

}  // namespace

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

}  // namespace trapwright::scene
