#pragma once

#include <QObject>
#include <QThread>
#include <functional>
#include <memory>

namespace trapwright::scene {

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

}  // namespace trapwright::scene
