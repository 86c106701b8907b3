#include "ui/scene/render_thread.h"

#include "core/base/thread_priority.h"

namespace trapwright::scene {

namespace {

/// The window goes before its pictures; both go before learning.
constexpr int kPrioritySteps = 3;

}  // namespace

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

}  // namespace trapwright::scene
