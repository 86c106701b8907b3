#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/trial/engine.h"

namespace trapwright::trial {

/// What an engine is there for.
enum class EngineRole {
    quick,       // learns where a study's setting is kHybrid
    reference,   // judges there, and is what the others are held against
    certifying,  // what the reference is held against: much too slow to learn with
    other
};

/// Makes an engine that works with these options.
using EngineFactory = std::function<std::unique_ptr<Engine>(const EngineOptions&)>;

/// An engine that can be had, and what others need to know of it.
struct EngineKind {
    std::string name;  // Engine::name(): in studies, on the command line and in JSON
    EngineFactory make;
    std::string title{};  // the same for people, as a word of its own
    EngineRole role = EngineRole::other;
    /// The largest relative error of energy and angular momentum that a body may show which tumbles freely
    /// for 10 s.
    double freeMotionTolerance = 1e-3;
    /// Whether it simulates trials of several parts, which touch each other, and streams of them.
    bool takesStreams = true;
    std::string about{};  // what sets one that is certifying apart, for people
};

/// The setting of a study, or --engine, that stands for two: the quick engine learns, the reference judges.
inline constexpr const char* kHybrid = "hybrid";

/// What an engine is wanted for.
enum class EngineUse {
    learning,  // a generation's trials, as many as possible
    judging    // what is looked at closely: selection, validation, a single track
};

/// The engines that there are, by name. Which they are is known to sim/engines; the program hands them to
/// whoever needs one. An immutable value.
class EngineRegistry {
 public:
    /// Of none: every name is unknown, kHybrid too.
    EngineRegistry() = default;
    /// All names differ; one engine is the quick one, and one the reference.
    explicit EngineRegistry(std::vector<EngineKind> kinds);

    [[nodiscard]] const std::vector<EngineKind>& kinds() const { return kinds_; }
    [[nodiscard]] const EngineKind& quick() const;
    [[nodiscard]] const EngineKind& reference() const;

    /// Null if there is none of that name.
    [[nodiscard]] const EngineKind* find(std::string_view name) const;
    /// The engine of that name, backed by the reference (BackedEngine); an error that lists those that there
    /// are otherwise. Who wants to see an engine fail takes its kind's `make`.
    [[nodiscard]] base::Result<std::shared_ptr<const Engine>> make(std::string_view name,
                                                                   const EngineOptions& options) const;
    /// "There is no engine named ...", with those that there are.
    [[nodiscard]] base::Error describeUnknown(std::string_view name) const;

    /// What a study's setting can be where people choose: kHybrid, the two that it stands for, then the other
    /// engines that can learn.
    [[nodiscard]] std::vector<std::string> settings() const;
    /// The name of the engine that a study's setting means for this use: any but kHybrid is itself a name.
    [[nodiscard]] std::string nameFor(const std::string& setting, EngineUse use) const;
    /// The engine in which each generation's winner is checked: the reference if the setting is kHybrid, else
    /// null.
    [[nodiscard]] const EngineKind* referenceFor(std::string_view setting) const;

 private:
    [[nodiscard]] const EngineKind& firstOf(EngineRole role) const;

    std::vector<EngineKind> kinds_;
};

}  // namespace trapwright::trial
