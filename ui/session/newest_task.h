#pragma once

#include <functional>
#include <memory>

namespace trapwright::session {

/// Work in the background of which only the newest is wanted. Used by the GUI thread.
class NewestTask {
 public:
    /// Work gives the function that is to be called in the GUI thread with its result.
    using Deliver = std::function<void()>;
    using Work = std::function<Deliver()>;

    NewestTask();
    NewestTask(const NewestTask&) = delete;
    NewestTask& operator=(const NewestTask&) = delete;
    /// Waits for work that has begun.
    ~NewestTask();

    /// Does the work after that which has begun. Nothing that was asked for before is delivered any more.
    void start(Work work);
    void cancel();
    /// Whether something is still to be delivered.
    [[nodiscard]] bool busy() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::session
