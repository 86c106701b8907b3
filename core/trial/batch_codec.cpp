#include "core/trial/batch_codec.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <utility>

#include "core/base/byte_archive.h"
#include "core/part/part_fields.h"

// Whoever changes what follows, or core/part/part_fields.h, changes the bytes: kVersion below then counts on,
// and the seeds in tests/fuzz/corpus/batch_codec are made anew (tests/core/trial/batch_codec_test.cpp).

namespace trapwright::base {

/// Every byte: a purpose only names a stream.
constexpr Purpose lastOf(Purpose /*unused*/) {
    return Purpose{UINT8_MAX};
}

template <class Archive, OrConst<StreamKey> T>
void serialize(Archive& archive, T& key) {
    auto& [seed, generation, individual, trial, purpose] = key;
    archive(seed, generation, individual, trial, purpose);
}

}  // namespace trapwright::base

namespace trapwright::track {

constexpr FeederType lastOf(FeederType /*unused*/) {
    return FeederType::bowl;
}

constexpr Conveying lastOf(Conveying /*unused*/) {
    return Conveying::anticlockwise;
}

template <class Archive, base::OrConst<FeederShape> T>
void serialize(Archive& archive, T& shape) {
    auto& [type, bowlRadius, conveying, slope] = shape;
    archive(type, bowlRadius, conveying, slope);
}

template <class Archive, base::OrConst<CrossSection> T>
void serialize(Archive& archive, T& section) {
    auto& [x, points] = section;
    archive(x, points);
}

template <class Archive, base::OrConst<Walls> T>
void serialize(Archive& archive, T& walls) {
    auto& [inner, outer] = walls;
    archive(inner, outer);
}

template <class Archive, base::OrConst<Track> T>
void serialize(Archive& archive, T& track) {
    auto& [shape, sections, firstTrapSection, lastTrapSection, solid, surfaceTriangles, start, finish, width,
           height, baseThickness, walls] = track;
    archive(shape, sections, firstTrapSection, lastTrapSection, solid, surfaceTriangles, start, finish, width,
            height, baseThickness, walls);
}

}  // namespace trapwright::track

namespace trapwright::trial {

constexpr Ending lastOf(Ending /*unused*/) {
    return Ending::timedOut;
}

template <class Archive, base::OrConst<Vibration> T>
void serialize(Archive& archive, T& drive) {
    auto& [frequency, halfStroke, angle] = drive;
    archive(frequency, halfStroke, angle);
}

template <class Archive, base::OrConst<ContactParameters> T>
void serialize(Archive& archive, T& contact) {
    auto& [staticFriction, kineticFriction, restitution, roughness, surface] = contact;
    archive(staticFriction, kineticFriction, restitution, roughness, surface);
}

template <class Archive, base::OrConst<Termination> T>
void serialize(Archive& archive, T& termination) {
    auto& [timeLimit, stuckTime, stuckProgress, until] = termination;
    archive(timeLimit, stuckTime, stuckProgress, until);
}

template <class Archive, base::OrConst<PartStart> T>
void serialize(Archive& archive, T& start) {
    auto& [part, pose, velocity, angularVelocity, time] = start;
    archive(part, pose, velocity, angularVelocity, time);
}

template <class Archive, base::OrConst<TrialSpec> T>
void serialize(Archive& archive, T& spec) {
    auto& [stream, phase, parts, contact, drive, place] = spec;
    archive(stream, phase, parts, contact, drive, place);
}

template <class Archive, base::OrConst<TrialBatch> T>
void serialize(Archive& archive, T& batch) {
    auto& [track, parts, drive, contact, partsContact, termination, gravity, step, trials] = batch;
    archive(drive, contact, partsContact, termination, gravity, step, trials);
}

template <class Archive, base::OrConst<PartOutcome> T>
void serialize(Archive& archive, T& outcome) {
    auto& [ending, initial, farthest, time, entered, throughSurface] = outcome;
    archive(ending, initial, farthest, time, entered, throughSurface);
}

template <class Archive, base::OrConst<Stop> T>
void serialize(Archive& archive, T& stop) {
    auto& [part, from, to] = stop;
    archive(part, from, to);
}

template <class Archive, base::OrConst<Outcome> T>
void serialize(Archive& archive, T& outcome) {
    auto& [parts, stops] = outcome;
    archive(parts, stops);
}

namespace {

constexpr std::array<std::uint8_t, 4> kMark = {'T', 'R', 'A', 'P'};
constexpr std::uint32_t kVersion = 9;

enum class Kind : std::uint8_t { part, track, batch, outcomes };

constexpr Kind lastOf(Kind /*unused*/) {
    return Kind::outcomes;
}

const char* kindName(Kind kind) {
    switch (kind) {
        case Kind::part:
            return "a part";
        case Kind::track:
            return "a track";
        case Kind::batch:
            return "a batch of trials";
        case Kind::outcomes:
            return "outcomes of trials";
    }
    return "";
}

template <class T>
std::string write(Kind kind, const T& value) {
    base::ByteWriter archive;
    archive(kMark, kVersion, kind, value);
    return std::move(archive).bytes();
}

bool isWhole(const track::Track& track) {
    const int sections = static_cast<int>(track.sections.size());
    return sections >= 2 && track.firstTrapSection >= 0 && track.firstTrapSection <= track.lastTrapSection &&
           track.lastTrapSection < sections && part::isWhole(track.solid) &&
           track.surfaceTriangles <= track.solid.triangles.size();
}

bool isWhole(const TrialBatch& /*batch*/) {
    return true;
}

bool isWhole(const std::vector<Outcome>& /*outcomes*/) {
    return true;
}

template <class T>
base::Result<T> read(Kind wanted, std::string_view bytes) {
    const auto refuse = [&](const std::string& why) {
        return base::Error{fmt::format("These bytes are not {}: {}.", kindName(wanted), why),
                           base::ErrorKind::damaged};
    };
    base::ByteReader archive(bytes);
    std::array<std::uint8_t, kMark.size()> mark{};
    std::uint32_t version = 0;
    Kind kind = wanted;
    archive(mark, version);
    if (archive.failed() || mark != kMark) return refuse("they do not come from Trapwright");
    if (version != kVersion) {
        return refuse(fmt::format(
            "they have version {}, and this program knows version {}; run the same Trapwright on both sides",
            version, kVersion));
    }
    archive(kind);
    if (!archive.failed() && kind != wanted) return refuse(fmt::format("they are {}", kindName(kind)));
    T value;
    archive(value);
    if (!archive.finished() || !isWhole(value))
        return refuse("they are damaged or not complete; send them again");
    return value;
}

}  // namespace

std::string encode(const part::Part& part) {
    return write(Kind::part, part);
}

std::string encode(const track::Track& track) {
    return write(Kind::track, track);
}

std::string encode(const TrialBatch& batch) {
    return write(Kind::batch, batch);
}

std::string encode(std::span<const Outcome> outcomes) {
    return write(Kind::outcomes, std::vector<Outcome>(outcomes.begin(), outcomes.end()));
}

base::Result<part::Part> decodePart(std::string_view bytes) {
    return read<part::Part>(Kind::part, bytes);
}

base::Result<track::Track> decodeTrack(std::string_view bytes) {
    return read<track::Track>(Kind::track, bytes);
}

base::Result<TrialBatch> decodeBatch(std::string_view bytes) {
    return read<TrialBatch>(Kind::batch, bytes);
}

base::Result<std::vector<Outcome>> decodeOutcomes(std::string_view bytes) {
    return read<std::vector<Outcome>>(Kind::outcomes, bytes);
}

}  // namespace trapwright::trial
