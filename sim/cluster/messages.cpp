#include "sim/cluster/messages.h"

#include <array>
#include <cstddef>
#include <utility>

#include "core/base/byte_archive.h"

namespace trapwright::cluster {

constexpr RunState lastOf(RunState /*unused*/) {
    return RunState::over;
}

template <class Archive, base::OrConst<Hello> T>
void serialize(Archive& archive, T& hello) {
    auto& [program, host, threads, mathInstructions, instructionSets] = hello;
    archive(program, host, threads, mathInstructions, instructionSets);
}

template <class Archive, base::OrConst<Welcome> T>
void serialize(Archive& archive, T& welcome) {
    auto& [instructionSet] = welcome;
    archive(instructionSet);
}

template <class Archive, base::OrConst<SentPart> T>
void serialize(Archive& archive, T& sent) {
    auto& [id, part] = sent;
    archive(id, part);
}

template <class Archive, base::OrConst<SentTrack> T>
void serialize(Archive& archive, T& sent) {
    auto& [run, id, track] = sent;
    archive(run, id, track);
}

template <class Archive, base::OrConst<Piece> T>
void serialize(Archive& archive, T& piece) {
    auto& [track, parts, batch] = piece;
    archive(track, parts, batch);
}

template <class Archive, base::OrConst<Task> T>
void serialize(Archive& archive, T& task) {
    auto& [id, run, engine, threads, step, isAside, pieces] = task;
    archive(id, run, engine, threads, step, isAside, pieces);
}

template <class Archive, base::OrConst<Answer> T>
void serialize(Archive& archive, T& answer) {
    auto& [task, problem, outcomes, seconds] = answer;
    archive(task, problem, outcomes, seconds);
}

template <class Archive, base::OrConst<Progress> T>
void serialize(Archive& archive, T& progress) {
    auto& [task, done] = progress;
    archive(task, done);
}

template <class Archive, base::OrConst<Pulse> T>
void serialize(Archive& archive, T& pulse) {
    auto& [progress] = pulse;
    archive(progress);
}

template <class Archive, base::OrConst<Steer> T>
void serialize(Archive& archive, T& steer) {
    auto& [run, state] = steer;
    archive(run, state);
}

template <class Archive, base::OrConst<Over> T>
void serialize(Archive& archive, T& over) {
    auto& [reason] = over;
    archive(reason);
}

namespace {

constexpr std::array<std::uint8_t, 4> kMark = {'T', 'R', 'C', 'L'};
constexpr std::uint32_t kVersion = 1;

/// The alternative of this number, read; nothing if there is none.
template <std::size_t kind = 0>
void readKind(std::size_t wanted, base::ByteReader& archive, Message& message) {
    if constexpr (kind < std::variant_size_v<Message>) {
        if (wanted != kind) return readKind<kind + 1>(wanted, archive, message);
        archive(message.emplace<kind>());
    }
}

}  // namespace

std::string encode(const Message& message) {
    base::ByteWriter archive;
    archive(kMark, kVersion, static_cast<std::uint8_t>(message.index()));
    std::visit([&](const auto& content) { archive(content); }, message);
    return std::move(archive).bytes();
}

base::Result<Message> decode(std::string_view bytes) {
    base::ByteReader archive(bytes);
    std::array<std::uint8_t, kMark.size()> mark{};
    std::uint32_t version = 0;
    std::uint8_t kind = 0;
    archive(mark, version, kind);
    Message message;
    if (!archive.failed() && mark == kMark && version == kVersion) readKind(kind, archive, message);
    if (mark != kMark || version != kVersion || !archive.finished() || kind >= std::variant_size_v<Message>)
        return base::Error{"A message from another rank is damaged, or comes from another Trapwright.",
                           base::ErrorKind::damaged};
    return message;
}

}  // namespace trapwright::cluster
