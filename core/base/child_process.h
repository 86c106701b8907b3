#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"

/// A program of ours that does apart what might crash, hang or fill the memory: foreign libraries on foreign
/// files.
namespace trapwright::base {

/// Whether this is built with a sanitizer: its memory is mapped far beyond what is used, so that it has no
/// limit, and signals end it through the sanitizer.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

struct ChildLimits {
    std::chrono::milliseconds time{300'000};
    std::size_t memory = 4ULL << 30U;    // of its address space [bytes]
    std::size_t stack = 64ULL << 20U;    // [bytes]
    std::size_t messages = 1ULL << 30U;  // that it may send in all [bytes]
};

/// How a child came to its end.
enum class ChildEnd { finished, crashed, outOfMemory, outOfTime, cancelled };

struct ChildOutcome {
    ChildEnd end = ChildEnd::finished;
    int signal = 0;      // that it crashed with, 0 if it only ended without a result
    std::string result;  // that it sent, if it finished
    std::string stage;   // the last one that it told
};

/// A program that was installed or built beside this one, for its use alone: <prefix>/libexec/trapwright, or
/// the build tree's. Error: it is not there.
Result<std::filesystem::path> findOwnProgram(std::string_view name);

/// Starts `program`, gives it `request`, and waits for its end, for the limit of time or until `control` is
/// cancelled; `tellStage` is called with each stage that it tells, in the thread that waits. The child dies
/// with its parent, writes to no terminal and leaves no core file. Error: it cannot be started.
Result<ChildOutcome> runChild(const std::filesystem::path& program, std::string_view request,
                              const ChildLimits& limits, const RunControl& control,
                              const std::function<void(std::string_view)>& tellStage = {});

/// The other side: how a child program hears and answers. One in a process.
class ChildDuty {
 public:
    /// Takes the limits from the arguments that runChild gave, and the request. Error: this program was not
    /// started by runChild.
    static Result<ChildDuty> begin(int count, char** arguments);

    [[nodiscard]] const std::string& request() const { return request_; }
    void tellStage(std::string_view stage) const;
    /// The last thing to be done; false if the parent is gone.
    [[nodiscard]] bool answer(std::string_view result) const;

 private:
    std::string request_;
};

}  // namespace trapwright::base
