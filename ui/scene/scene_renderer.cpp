#include "ui/scene/scene_renderer.h"

#include <QOffscreenSurface>
#include <QPromise>
#include <QSurfaceFormat>
#include <atomic>

#include "ui/scene/offscreen.h"
#include "ui/scene/render_thread.h"

namespace trapwright::scene {

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
