#include "core/trial/batch_codec.h"

#include <QDir>
#include <QFile>
#include <QtTest>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <new>

#include "core/base/random.h"

using namespace trapwright;
using base::Vec3;

namespace {

std::size_t largestRequest = 0;  // of memory since it was set to 0 [byte]

}  // namespace

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TRAPWRIGHT_THREAD_SANITIZER  // which has operators of its own
#endif
#endif
#ifndef TRAPWRIGHT_THREAD_SANITIZER
void* operator new(std::size_t size) {
    largestRequest = std::max(largestRequest, size);
    void* memory = std::malloc(size);
    if (memory == nullptr) std::abort();
    return memory;
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
#endif

namespace {

/// Numbers that are all different, some of them such as no calculation gives.
class Numbers {
 public:
    double operator()() {
        constexpr std::array kOdd = {-0.0, std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::denorm_min(),
                                     std::numeric_limits<double>::max(), 0.1 + 0.2};
        ++count_;
        if (count_ % 7 == 0) return kOdd[static_cast<std::size_t>(count_ / 7) % kOdd.size()];
        if (count_ % 31 == 0)
            return std::bit_cast<double>(0x7ff8000000000000U + static_cast<unsigned>(count_));
        return std::sqrt(count_);
    }
    int whole() { return 1000 + ++count_; }
    Vec3 vector() { return {(*this)(), (*this)(), (*this)()}; }
    base::Quaternion rotation() { return {(*this)(), (*this)(), (*this)(), (*this)()}; }
    base::Pose pose() { return {rotation(), vector()}; }

 private:
    int count_ = 0;
};

geometry::TriangleMesh makeMesh(Numbers& next) {
    return {{next.vector(), next.vector(), next.vector(), next.vector()}, {{0, 2, 1}, {3, 1, 2}}};
}

geometry::ConvexPolytope makePolytope(Numbers& next) {
    geometry::ConvexPolytope polytope;
    polytope.vertices = {next.vector(), next.vector(), next.vector()};
    polytope.faces = {{next.vector(), next(), {2, 0, 1}}, {next.vector(), next(), {}}};
    polytope.edges = {{1, 2, 0, 1}, {2, 0, 1, 0}};
    return polytope;
}

/// No field is as it is at first.
part::Part makePart() {
    Numbers next;
    part::Part part;
    part.name = "clip";
    part.source = std::string("a\0b\n", 4);
    part.density = next();
    part.mesh = makeMesh(next);
    part.massProperties = {next(), next(), next(), next.vector(), base::Mat3::Zero()};
    for (Eigen::Index i = 0; i < part.massProperties.inertia.size(); ++i)
        part.massProperties.inertia.data()[i] = next();
    part.hull = makePolytope(next);
    part.pieces = {makePolytope(next), makePolytope(next)};
    part.symmetry = {"Dinf", {next.rotation(), next.rotation()}, true, next.vector(), true, true};
    part.stablePoses = {{next.rotation(), next(), next(), next.whole()},
                        {next.rotation(), next(), next(), -next.whole()}};
    part.boundingRadius = next();
    return part;
}

track::Track makeTrack() {
    Numbers next;
    track::Track track;
    track.shape = {track::FeederType::bowl, next(), track::Conveying::anticlockwise, next()};
    for (int i = 0; i < 4; ++i)
        track.sections.push_back({next(), {{next(), next()}, {next(), next()}}});
    track.firstTrapSection = 2;
    track.lastTrapSection = 3;
    track.solid = makeMesh(next);
    track.surfaceTriangles = 1;
    track.start = next();
    track.finish = next();
    track.width = next();
    track.height = next();
    track.baseThickness = next();
    track.walls = {next(), next()};
    return track;
}

trial::TrialBatch makeBatch() {
    Numbers next;
    trial::TrialBatch batch;
    batch.drive = {next(), next(), next()};
    batch.contact = {next(), next(), next(), next(), 0x123456789ABCDEFU};
    batch.partsContact = {next(), next(), next()};
    batch.termination = {next(), next(), next(), next()};
    batch.gravity = next();
    batch.step = next();
    for (std::uint32_t i = 0; i < 3; ++i) {
        trial::TrialSpec spec;
        spec.stream = {0x8000000000000001U + i, 7 + i, 0xfffffffeU, 9 + i, base::Purpose::validation};
        spec.phase = next();
        for (std::uint32_t k = 0; k < i; ++k)
            spec.parts.push_back({4 + k, next.pose(), next.vector(), next.vector(), next()});
        if (i > 0) spec.contact = {next(), next(), next(), next(), 77};
        if (i > 1) spec.drive = {next(), next(), next()};
        if (i > 1) spec.place = {next(), next(), next(), next(), next(), next()};
        batch.trials.push_back(spec);
    }
    return batch;
}

std::vector<trial::Outcome> makeOutcomes() {
    Numbers next;
    std::vector<trial::Outcome> outcomes;
    for (const trial::Ending ending :
         {trial::Ending::finished, trial::Ending::fellOff, trial::Ending::stuck, trial::Ending::timedOut})
        outcomes.push_back({{{ending, next.pose(), next.pose(), next(), next()}}, {}});
    outcomes.back().parts.front().entered.reset();
    outcomes[1].parts.front().throughSurface = true;
    outcomes.back().stops = {{0, next(), next()}, {1, next(), next()}};
    outcomes.back().parts.push_back(outcomes.front().parts.front());
    outcomes.emplace_back();
    return outcomes;
}

// Bit for bit, field by field: written out here, so that what the codec forgets is missed.

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <int rows, int columns>
bool same(const Eigen::Matrix<double, rows, columns>& a, const Eigen::Matrix<double, rows, columns>& b) {
    return std::equal(a.data(), a.data() + a.size(), b.data(), [](double x, double y) { return same(x, y); });
}

bool same(const base::Quaternion& a, const base::Quaternion& b) {
    return same(a.coeffs(), b.coeffs());
}

bool same(const base::Pose& a, const base::Pose& b) {
    return same(a.rotation, b.rotation) && same(a.position, b.position);
}

template <class T, class Same>
bool allSame(const std::vector<T>& a, const std::vector<T>& b, Same sameOnes) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), sameOnes);
}

bool same(const geometry::ConvexPolytope& a, const geometry::ConvexPolytope& b);
bool same(const trial::PartStart& a, const trial::PartStart& b);
bool same(const trial::TrialSpec& a, const trial::TrialSpec& b);

constexpr auto kSame = [](const auto& a, const auto& b) { return same(a, b); };

bool same(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b) {
    return allSame(a.vertices, b.vertices, kSame) && a.triangles == b.triangles;
}

bool same(const geometry::ConvexPolytope& a, const geometry::ConvexPolytope& b) {
    return allSame(a.vertices, b.vertices, kSame) &&
           allSame(a.faces, b.faces,
                   [](const auto& x, const auto& y) {
                       return same(x.normal, y.normal) && same(x.offset, y.offset) && x.loop == y.loop;
                   }) &&
           allSame(a.edges, b.edges, [](const auto& x, const auto& y) {
               return x.from == y.from && x.to == y.to && x.left == y.left && x.right == y.right;
           });
}

bool same(const part::Part& a, const part::Part& b) {
    const geometry::MassProperties& m = a.massProperties;
    const geometry::MassProperties& n = b.massProperties;
    const part::SymmetryGroup& s = a.symmetry;
    const part::SymmetryGroup& t = b.symmetry;
    return a.name == b.name && a.source == b.source && same(a.density, b.density) && same(a.mesh, b.mesh) &&
           same(m.volume, n.volume) && same(m.area, n.area) && same(m.mass, n.mass) &&
           same(m.centre, n.centre) && same(m.inertia, n.inertia) && same(a.hull, b.hull) &&
           allSame(a.pieces, b.pieces, kSame) && s.name == t.name &&
           allSame(s.rotations, t.rotations, kSame) && s.continuous == t.continuous && same(s.axis, t.axis) &&
           s.flip == t.flip && s.sphere == t.sphere &&
           allSame(a.stablePoses, b.stablePoses,
                   [](const part::StablePose& x, const part::StablePose& y) {
                       return same(x.rotation, y.rotation) && same(x.height, y.height) &&
                              same(x.probability, y.probability) && x.multiplicity == y.multiplicity;
                   }) &&
           same(a.boundingRadius, b.boundingRadius);
}

bool same(const track::Track& a, const track::Track& b) {
    return a.shape.type == b.shape.type && same(a.shape.bowlRadius, b.shape.bowlRadius) &&
           a.shape.conveying == b.shape.conveying && same(a.shape.slope, b.shape.slope) &&
           allSame(a.sections, b.sections,
                   [](const track::CrossSection& x, const track::CrossSection& y) {
                       return same(x.x, y.x) && allSame(x.points, y.points, kSame);
                   }) &&
           a.firstTrapSection == b.firstTrapSection && a.lastTrapSection == b.lastTrapSection &&
           same(a.solid, b.solid) && a.surfaceTriangles == b.surfaceTriangles && same(a.start, b.start) &&
           same(a.finish, b.finish) && same(a.width, b.width) && same(a.height, b.height) &&
           same(a.baseThickness, b.baseThickness) && same(a.walls.inner, b.walls.inner) &&
           same(a.walls.outer, b.walls.outer);
}

bool same(const trial::PartStart& a, const trial::PartStart& b) {
    return a.part == b.part && same(a.pose, b.pose) && same(a.velocity, b.velocity) &&
           same(a.angularVelocity, b.angularVelocity) && same(a.time, b.time);
}

bool same(const trial::ContactParameters& a, const trial::ContactParameters& b) {
    return same(a.staticFriction, b.staticFriction) && same(a.kineticFriction, b.kineticFriction) &&
           same(a.restitution, b.restitution) && same(a.roughness, b.roughness) && a.surface == b.surface;
}

bool same(const trial::Vibration& a, const trial::Vibration& b) {
    return same(a.frequency, b.frequency) && same(a.halfStroke, b.halfStroke) && same(a.angle, b.angle);
}

bool same(const trial::TrialSpec& a, const trial::TrialSpec& b) {
    return a.stream == b.stream && same(a.phase, b.phase) && allSame(a.parts, b.parts, kSame) &&
           a.contact.has_value() == b.contact.has_value() && (!a.contact || same(*a.contact, *b.contact)) &&
           a.drive.has_value() == b.drive.has_value() && (!a.drive || same(*a.drive, *b.drive)) &&
           a.place == b.place;
}

bool same(const trial::TrialBatch& a, const trial::TrialBatch& b) {
    return same(a.drive, b.drive) && same(a.contact, b.contact) && same(a.partsContact, b.partsContact) &&
           same(a.termination.timeLimit, b.termination.timeLimit) &&
           same(a.termination.stuckTime, b.termination.stuckTime) &&
           same(a.termination.stuckProgress, b.termination.stuckProgress) &&
           same(a.termination.until, b.termination.until) && same(a.gravity, b.gravity) &&
           same(a.step, b.step) && allSame(a.trials, b.trials, kSame);
}

bool same(const std::vector<trial::Outcome>& a, const std::vector<trial::Outcome>& b) {
    const auto samePart = [](const trial::PartOutcome& x, const trial::PartOutcome& y) {
        return x.ending == y.ending && same(x.initial, y.initial) && same(x.farthest, y.farthest) &&
               same(x.time, y.time) && x.entered == y.entered && x.throughSurface == y.throughSurface;
    };
    return allSame(a, b, [&](const trial::Outcome& x, const trial::Outcome& y) {
        return allSame(x.parts, y.parts, samePart) && x.stops == y.stops;
    });
}

/// One of the four kinds of bytes.
struct Sample {
    const char* name;
    std::string bytes;
    /// Of such bytes the same ones again, or why they are refused.
    std::function<base::Result<std::string>(std::string_view)> again;
};

template <class T>
std::function<base::Result<std::string>(std::string_view)> decodeAgain(
    base::Result<T> (*decode)(std::string_view)) {
    return [decode](std::string_view bytes) -> base::Result<std::string> {
        const base::Result<T> value = decode(bytes);
        if (!value) return value.error();
        return trial::encode(*value);
    };
}

const std::vector<Sample>& samples() {
    static const std::vector<Sample> all = {
        {"part", trial::encode(makePart()), decodeAgain(trial::decodePart)},
        {"track", trial::encode(makeTrack()), decodeAgain(trial::decodeTrack)},
        {"batch", trial::encode(makeBatch()), decodeAgain(trial::decodeBatch)},
        {"outcomes", trial::encode(makeOutcomes()), decodeAgain(trial::decodeOutcomes)}};
    return all;
}

/// No list that is read takes more at once.
constexpr std::size_t kMemoryPerByte = 16;

}  // namespace

class BatchCodecTest : public QObject {
    Q_OBJECT

 private slots:
    void everyFieldComesBack() {
        QVERIFY(same(trial::decodePart(trial::encode(makePart())).value(), makePart()));
        QVERIFY(same(trial::decodeTrack(trial::encode(makeTrack())).value(), makeTrack()));
        const trial::TrialBatch batch = trial::decodeBatch(trial::encode(makeBatch())).value();
        QVERIFY(same(batch, makeBatch()));
        QVERIFY(!batch.track && batch.parts.empty());
        QVERIFY(same(trial::decodeOutcomes(trial::encode(makeOutcomes())).value(), makeOutcomes()));
    }

    void nothingAtAllComesBack() {
        QVERIFY(trial::decodeOutcomes(trial::encode(std::vector<trial::Outcome>())).value().empty());
        QVERIFY(trial::decodeBatch(trial::encode(trial::TrialBatch())).value().trials.empty());
        QVERIFY(trial::decodePart(trial::encode(part::Part())).value().pieces.empty());
    }

    void noByteMayBeMissing_data() { listSamples(); }
    void noByteMayBeMissing() {
        QFETCH(int, index);
        const Sample& sample = samples()[static_cast<std::size_t>(index)];
        QCOMPARE(sample.again(sample.bytes).value(), sample.bytes);
        for (std::size_t length = 0; length < sample.bytes.size(); ++length)
            QVERIFY2(!sample.again(std::string_view(sample.bytes).substr(0, length)).ok(),
                     std::to_string(length).c_str());
        QVERIFY(!sample.again(sample.bytes + '\0').ok());
    }

    void damagedBytesAreRefusedOrMeanThemselves_data() { listSamples(); }
    void damagedBytesAreRefusedOrMeanThemselves() {
        QFETCH(int, index);
        const Sample& sample = samples()[static_cast<std::size_t>(index)];
        base::Random random({1, 0, static_cast<std::uint32_t>(index), 0, base::Purpose::test});
        const auto size = static_cast<std::uint32_t>(sample.bytes.size());
        int refused = 0;
        largestRequest = 0;
        for (int i = 0; i < 4000; ++i) {
            std::string bytes = sample.bytes;
            const std::uint32_t changes = 1 + random.below(4);
            for (std::uint32_t k = 0; k < changes; ++k)
                bytes[random.below(size)] = static_cast<char>(random.below(256));
            const auto again = sample.again(bytes);
            refused += again.ok() ? 0 : 1;
            if (again) QVERIFY(*again == bytes);
        }
        // Counts of four thousand million, wherever one may stand.
        for (std::uint32_t i = 0; i + 4 <= size; ++i) {
            std::string bytes = sample.bytes;
            bytes.replace(i, 4, "\xff\xff\xff\xff");
            const auto again = sample.again(bytes);
            refused += again.ok() ? 0 : 1;
            if (again) QVERIFY(*again == bytes);
        }
        QVERIFY(refused > 100);
        QVERIFY2(largestRequest <= kMemoryPerByte * size, std::to_string(largestRequest).c_str());
    }

    void whatIsNotThereIsNotNamed() {
        part::Part part = makePart();
        part.mesh.triangles[1][2] = 4;
        QVERIFY(!trial::decodePart(trial::encode(part)).ok());
        part = makePart();
        part.pieces[1].faces[0].loop[1] = -1;
        QVERIFY(!trial::decodePart(trial::encode(part)).ok());
        part = makePart();
        part.hull.edges[0].right = 2;
        QVERIFY(!trial::decodePart(trial::encode(part)).ok());
        track::Track track = makeTrack();
        track.lastTrapSection = 4;
        QVERIFY(!trial::decodeTrack(trial::encode(track)).ok());
        track = makeTrack();
        track.firstTrapSection = -1;
        QVERIFY(!trial::decodeTrack(trial::encode(track)).ok());
        track = makeTrack();
        track.surfaceTriangles = 3;
        QVERIFY(!trial::decodeTrack(trial::encode(track)).ok());
        track = makeTrack();
        track.solid.triangles[0][0] = 4;
        QVERIFY(!trial::decodeTrack(trial::encode(track)).ok());
    }

    void refusalsTellWhy() {
        const std::string track = trial::encode(makeTrack());
        const auto reason = [](const std::string& bytes) {
            return QString::fromStdString(trial::decodeTrack(bytes).error().message);
        };
        const QString foreign = "These bytes are not a track: they do not come from Trapwright.";
        QCOMPARE(reason(""), foreign);
        QCOMPARE(reason("{}"), foreign);
        std::string changed = track;
        changed[0] = 't';
        QCOMPARE(reason(changed), foreign);
        changed = track;
        changed[5] = 2;
        QCOMPARE(reason(changed),
                 QString("These bytes are not a track: they have version 521, and this program "
                         "knows version 9; run the same Trapwright on both sides."));
        QCOMPARE(reason(trial::encode(makeOutcomes())),
                 QString("These bytes are not a track: they are outcomes of trials."));
        QCOMPARE(reason(track.substr(0, track.size() - 1)),
                 QString("These bytes are not a track: they are damaged or not complete; send them again."));
        QVERIFY(trial::decodeTrack("").error().kind == base::ErrorKind::damaged);
    }

    // The seeds of the fuzz target. Where they differ the bytes have changed: count kVersion on, and take
    // what is written beside.
    void bytesOfThisVersionAreAsEver_data() { listSamples(); }
    void bytesOfThisVersionAreAsEver() {
        QFETCH(int, index);
        const Sample& sample = samples()[static_cast<std::size_t>(index)];
        QFile seed(QString(TRAPWRIGHT_SOURCE_DIR "/tests/fuzz/corpus/batch_codec/") + sample.name);
        const QByteArray wanted = QByteArray::fromStdString(sample.bytes);
        if (seed.open(QIODevice::ReadOnly) && seed.readAll() == wanted) return;
        QFile now(QDir::temp().filePath(QString("trapwright-") + sample.name));
        QVERIFY(now.open(QIODevice::WriteOnly) && now.write(wanted) == wanted.size());
        QFAIL(qPrintable(now.fileName() + " is not " + seed.fileName()));
    }

 private:
    static void listSamples() {
        QTest::addColumn<int>("index");
        for (int i = 0; i < static_cast<int>(samples().size()); ++i)
            QTest::newRow(samples()[static_cast<std::size_t>(i)].name) << i;
    }
};

QTEST_APPLESS_MAIN(BatchCodecTest)
#include "batch_codec_test.moc"
