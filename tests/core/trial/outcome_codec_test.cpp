#include "core/trial/outcome_codec.h"

#include <QDir>
#include <QFile>
#include <QtTest>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/random.h"

using namespace trapwright;
using trial::Outcome;
using trial::PartOutcome;

namespace {

std::array<std::uint64_t, 9> bitsOf(const PartOutcome& outcome) {
    const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
    const base::Pose& pose = outcome.farthest;
    return {static_cast<std::uint64_t>(outcome.ending),
            bits(outcome.time),
            bits(pose.position.x()),
            bits(pose.position.y()),
            bits(pose.position.z()),
            bits(pose.rotation.w()),
            bits(pose.rotation.x()),
            bits(pose.rotation.y()),
            bits(pose.rotation.z())};
}

/// As an engine of fixed steps has them.
PartOutcome likely(base::Random& random, double step) {
    PartOutcome outcome;
    outcome.ending = static_cast<trial::Ending>(random.below(4));
    outcome.time = static_cast<double>(10 * random.below(5000)) * step;
    outcome.farthest.position = {random.uniform(0.1, 0.6), random.uniform(-0.02, 0.02),
                                 random.uniform(0.01, 0.02)};
    outcome.farthest.rotation = random.rotation().normalized();
    return outcome;
}

std::vector<Outcome> manyLikely(std::size_t count, double step = 2e-4) {
    base::Random random({.seed = 11, .trial = static_cast<std::uint32_t>(count)});
    std::vector<Outcome> outcomes;
    for (std::size_t i = 0; i < count; ++i)
        outcomes.push_back({{likely(random, step)}, {}});
    return outcomes;
}

/// Every bit of all parts, trial by trial.
std::vector<std::vector<std::array<std::uint64_t, 9>>> bitsOf(const std::vector<Outcome>& outcomes) {
    std::vector<std::vector<std::array<std::uint64_t, 9>>> bits;
    for (const Outcome& outcome : outcomes) {
        bits.emplace_back();
        for (const PartOutcome& part : outcome.parts)
            bits.back().push_back(bitsOf(part));
    }
    return bits;
}

using Change = std::function<void(PartOutcome&)>;

}  // namespace

Q_DECLARE_METATYPE(Change)

class OutcomeCodecTest : public QObject {
    Q_OBJECT

 private slots:
    void everyBitComesBack_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("step");
        QTest::newRow("none") << 0 << 2e-4;
        QTest::newRow("one") << 1 << 2e-4;
        QTest::newRow("two") << 2 << 1e-4;
        QTest::newRow("a track's") << 100 << 2e-4;
        QTest::newRow("a generation's") << 10000 << 2e-4;
        QTest::newRow("as many as there can be") << static_cast<int>(trial::kMostPacked) << 1e-3;
        QTest::newRow("odd steps") << 1000 << 1.0 / 7000.0;
    }
    void everyBitComesBack() {
        QFETCH(int, count);
        QFETCH(double, step);
        const std::vector<Outcome> outcomes = manyLikely(static_cast<std::size_t>(count), step);
        const std::string bytes = trial::packOutcomes(outcomes);
        const auto back = trial::unpackOutcomes(bytes, outcomes.size());
        QVERIFY2(back.ok(), back.ok() ? "" : back.error().message.c_str());
        QVERIFY(bitsOf(*back) == bitsOf(outcomes));
        for (const Outcome& outcome : *back)
            QVERIFY(outcome.parts[0].initial == base::Pose());
        QCOMPARE(trial::packOutcomes(*back), bytes);
    }

    // Of streams, too: parts that came later or never, and who stood still when.
    void streamsComeBack() {
        base::Random random({.seed = 12});
        std::vector<Outcome> outcomes(20);
        for (std::size_t i = 0; i < outcomes.size(); ++i) {
            for (std::size_t k = 0; k < 3 * i; ++k) {
                PartOutcome& part = outcomes[i].parts.emplace_back(likely(random, 2e-4));
                part.entered = k % 4 == 0 ? std::nullopt : std::optional(random.uniform(0.0, 60.0));
            }
            for (std::size_t k = 0; k < i / 4; ++k)
                outcomes[i].stops.push_back({k, random.uniform(0.0, 30.0), random.uniform(30.0, 60.0)});
        }
        const std::string bytes = trial::packOutcomes(outcomes);
        const auto back = trial::unpackOutcomes(bytes, outcomes.size());
        QVERIFY(back.ok());
        QVERIFY(*back == outcomes);
        QCOMPARE(trial::packOutcomes(*back), bytes);
        // Of single trials nothing of it is written.
        QCOMPARE(trial::packOutcomes(manyLikely(1)).at(1) & 8, 0);
        // A stop of a part that there is not.
        outcomes[4].stops[0].part = 99;
        QVERIFY(!trial::unpackOutcomes(trial::packOutcomes(outcomes), outcomes.size()).ok());
    }

    /// One such outcome among likely ones.
    void oddNumbersComeBackToo_data() {
        QTest::addColumn<Change>("change");
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        constexpr double kLeast = std::numeric_limits<double>::denorm_min();
        const auto row = [](const char* name, const Change& change) { QTest::newRow(name) << change; };
        const auto rotation = [&](const char* name, double w, double x, double y, double z) {
            row(name, [=](PartOutcome& o) { o.farthest.rotation = base::Quaternion(w, x, y, z); });
        };
        for (const double time :
             {0.0, -0.0, -1.0, kNaN, -kNaN, kInfinity, kLeast, 1e-7, 4294.967295, 4294.967296, 1e300,
              std::nextafter(0.2, 1.0), std::nextafter(0.2, 0.0), 0.1 + 0.2})
            row(qPrintable(QString("time %1").arg(time, 0, 'g', 17)), [=](PartOutcome& o) { o.time = time; });
        for (const double place : {-0.0, kNaN, -kInfinity, kLeast, std::numeric_limits<double>::max()})
            row(qPrintable(QString("place %1").arg(place)),
                [=](PartOutcome& o) { o.farthest.position.y() = place; });
        rotation("identity", 1, 0, 0, 0);
        rotation("minus identity", -1, -0.0, 0, -0.0);
        rotation("half a turn", 0, 0, -1, 0);
        rotation("all alike", 0.5, -0.5, 0.5, -0.5);
        rotation("two alike", std::sqrt(0.5), 0, std::sqrt(0.5), 0);
        rotation("no rotation", 0, 0, 0, 0);
        rotation("minus zero", -0.0, -0.0, -0.0, -0.0);
        rotation("too long", 3, 4, 0, 0);
        rotation("too short", 1e-200, 0, kLeast, 0);
        rotation("not a number", kNaN, 0, 0, 1);
        rotation("not a number, the rest sound", 1, 0, kNaN, 0);
        rotation("infinite", 0, kInfinity, -kInfinity, 1);
        rotation("a little long", std::nextafter(1.0, 2.0), 0, 0, 0);
        rotation("hardly turned", 1.0, 1e-170, kLeast, -1e-9);
        row("signalling", [](PartOutcome& o) {
            o.farthest.position.z() = std::bit_cast<double>(std::uint64_t{0x7ff4000000000123U});
        });
    }
    void oddNumbersComeBackToo() {
        QFETCH(Change, change);
        std::vector<Outcome> outcomes = manyLikely(20);
        change(outcomes[7].parts[0]);
        const auto back = trial::unpackOutcomes(trial::packOutcomes(outcomes), outcomes.size());
        QVERIFY(back.ok());
        QVERIFY(bitsOf(*back) == bitsOf(outcomes));
    }

    void trialsOfSeveralParts_data() {
        QTest::addColumn<std::vector<int>>("counts");
        QTest::newRow("two") << std::vector<int>{2};
        QTest::newRow("one and many") << std::vector<int>{1, 1, 40, 1};
        QTest::newRow("some have none") << std::vector<int>{0, 3, 0, 0, 1};
        QTest::newRow("all have none") << std::vector<int>{0, 0};
        QTest::newRow("as many as there can be") << std::vector<int>{16000, 384};
    }
    void trialsOfSeveralParts() {
        QFETCH(std::vector<int>, counts);
        base::Random random({.seed = 12});
        std::vector<Outcome> outcomes(counts.size());
        for (std::size_t i = 0; i < counts.size(); ++i)
            for (int part = 0; part < counts[i]; ++part)
                outcomes[i].parts.push_back(likely(random, 2e-4));
        QCOMPARE(trial::countPackable(outcomes), outcomes.size());
        const std::string bytes = trial::packOutcomes(outcomes);
        const auto back = trial::unpackOutcomes(bytes, outcomes.size());
        QVERIFY2(back.ok(), back.ok() ? "" : back.error().message.c_str());
        QVERIFY(bitsOf(*back) == bitsOf(outcomes));
        QVERIFY(!trial::unpackOutcomes(bytes, outcomes.size() + 1).ok());
        QVERIFY(!trial::unpackOutcomes(bytes, outcomes.size() - 1).ok());
    }

    void asManyAsCanBePackedAreCounted() {
        std::vector<Outcome> outcomes = manyLikely(3);
        outcomes[1].parts.resize(trial::kMostPacked - 1, outcomes[0].parts[0]);
        QCOMPARE(trial::countPackable(outcomes), std::size_t{2});
        outcomes[1].parts.push_back(outcomes[0].parts[0]);
        QCOMPARE(trial::countPackable(outcomes), std::size_t{1});
        outcomes[0].parts.resize(trial::kMostPacked + 1, outcomes[0].parts[0]);
        QCOMPARE(trial::countPackable(outcomes), std::size_t{0});
        QCOMPARE(trial::countPackable(manyLikely(trial::kMostPacked + 1)), trial::kMostPacked);
    }

    void packedTheyAreSmall() {
        const std::vector<Outcome> outcomes = manyLikely(10000);
        const double each = static_cast<double>(trial::packOutcomes(outcomes).size()) / 10000.0;
        qInfo("%.2f bytes each", each);
        QVERIFY(each < 46.0);
    }

    /// What a program has once stored can be read for ever.
    void bytesOfThisVersionAreStillRead() {
        QFETCH(QString, sample);
        QFETCH(std::vector<Outcome>, outcomes);
        QFile seed(TRAPWRIGHT_SOURCE_DIR "/tests/fuzz/corpus/outcome_codec/" + sample);
        if (!seed.open(QIODevice::ReadOnly)) {
            QFile now(QDir::temp().filePath("trapwright-" + sample));
            QVERIFY(now.open(QIODevice::WriteOnly));
            now.putChar(static_cast<char>(outcomes.size() >> 8));
            now.putChar(static_cast<char>(outcomes.size()));
            now.write(QByteArray::fromStdString(trial::packOutcomes(outcomes)));
            QFAIL(qPrintable(now.fileName() + " is to be " + seed.fileName()));
        }
        const std::string bytes = seed.readAll().toStdString();
        const auto read = trial::unpackOutcomes(std::string_view(bytes).substr(2), outcomes.size());
        QVERIFY(read.ok());
        QVERIFY(bitsOf(*read) == bitsOf(outcomes));
    }
    void bytesOfThisVersionAreStillRead_data() {
        QTest::addColumn<QString>("sample");
        QTest::addColumn<std::vector<Outcome>>("outcomes");
        QTest::newRow("likely") << "likely" << manyLikely(20);
        std::vector<Outcome> odd = manyLikely(3);
        odd[1].parts[0].time = 1.0 / 3.0;
        odd[2].parts[0].farthest.rotation.coeffs() *= 2.0;
        QTest::newRow("odd") << "odd" << odd;
        std::vector<Outcome> several = manyLikely(4);
        several[1].parts.push_back(several[0].parts[0]);
        several[2].parts.clear();
        QTest::newRow("several") << "several" << several;
    }

    void damageIsFound_data() {
        QTest::addColumn<int>("second");
        QTest::newRow("one part") << 1;
        QTest::newRow("several parts") << 3;
    }
    void damageIsFound() {
        QFETCH(int, second);
        std::vector<Outcome> outcomes = manyLikely(30);
        outcomes[1].parts.resize(static_cast<std::size_t>(second), outcomes[0].parts[0]);
        const std::string bytes = trial::packOutcomes(outcomes);
        QVERIFY(!trial::unpackOutcomes(bytes, 29).ok());
        QVERIFY(!trial::unpackOutcomes(bytes, 31).ok());
        QVERIFY(!trial::unpackOutcomes(bytes, std::numeric_limits<std::size_t>::max()).ok());
        QVERIFY(!trial::unpackOutcomes(bytes, trial::kMostPacked + 1).ok());
        for (std::size_t place = 0; place < bytes.size(); ++place) {
            const auto cut = trial::unpackOutcomes(std::string_view(bytes).substr(0, place), 30);
            QVERIFY(!cut.ok());
            QVERIFY(cut.error().kind == base::ErrorKind::damaged);
            for (int bit = 0; bit < 8; ++bit) {
                std::string damaged = bytes;
                damaged[place] = static_cast<char>(damaged[place] ^ (1 << bit));
                const auto back = trial::unpackOutcomes(damaged, 30);
                if (!back) continue;
                // Bits of the compression that mean nothing.
                QVERIFY(bitsOf(*back) == bitsOf(outcomes));
            }
        }
    }
};

QTEST_APPLESS_MAIN(OutcomeCodecTest)
#include "outcome_codec_test.moc"
