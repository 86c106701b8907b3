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

namespace {

std::array<std::uint64_t, 9> bitsOf(const Outcome& outcome) {
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
Outcome likely(base::Random& random, double step) {
    Outcome outcome;
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
        outcomes.push_back(likely(random, step));
    return outcomes;
}

using Change = std::function<void(Outcome&)>;

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
        QCOMPARE(back->size(), outcomes.size());
        for (std::size_t i = 0; i < outcomes.size(); ++i) {
            QVERIFY(bitsOf((*back)[i]) == bitsOf(outcomes[i]));
            QVERIFY((*back)[i].initial == base::Pose());
        }
        QCOMPARE(trial::packOutcomes(*back), bytes);
    }

    /// One such outcome among likely ones.
    void oddNumbersComeBackToo_data() {
        QTest::addColumn<Change>("change");
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        constexpr double kLeast = std::numeric_limits<double>::denorm_min();
        const auto row = [](const char* name, const Change& change) { QTest::newRow(name) << change; };
        const auto rotation = [&](const char* name, double w, double x, double y, double z) {
            row(name, [=](Outcome& o) { o.farthest.rotation = base::Quaternion(w, x, y, z); });
        };
        for (const double time :
             {0.0, -0.0, -1.0, kNaN, -kNaN, kInfinity, kLeast, 1e-7, 4294.967295, 4294.967296, 1e300,
              std::nextafter(0.2, 1.0), std::nextafter(0.2, 0.0), 0.1 + 0.2})
            row(qPrintable(QString("time %1").arg(time, 0, 'g', 17)), [=](Outcome& o) { o.time = time; });
        for (const double place : {-0.0, kNaN, -kInfinity, kLeast, std::numeric_limits<double>::max()})
            row(qPrintable(QString("place %1").arg(place)),
                [=](Outcome& o) { o.farthest.position.y() = place; });
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
        row("signalling", [](Outcome& o) {
            o.farthest.position.z() = std::bit_cast<double>(std::uint64_t{0x7ff4000000000123U});
        });
    }
    void oddNumbersComeBackToo() {
        QFETCH(Change, change);
        std::vector<Outcome> outcomes = manyLikely(20);
        change(outcomes[7]);
        const auto back = trial::unpackOutcomes(trial::packOutcomes(outcomes), outcomes.size());
        QVERIFY(back.ok());
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            QVERIFY(bitsOf((*back)[i]) == bitsOf(outcomes[i]));
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
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            QVERIFY(bitsOf((*read)[i]) == bitsOf(outcomes[i]));
    }
    void bytesOfThisVersionAreStillRead_data() {
        QTest::addColumn<QString>("sample");
        QTest::addColumn<std::vector<Outcome>>("outcomes");
        QTest::newRow("likely") << "likely" << manyLikely(20);
        std::vector<Outcome> odd = manyLikely(3);
        odd[1].time = 1.0 / 3.0;
        odd[2].farthest.rotation.coeffs() *= 2.0;
        QTest::newRow("odd") << "odd" << odd;
    }

    void damageIsFound() {
        const std::vector<Outcome> outcomes = manyLikely(30);
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
                for (std::size_t i = 0; i < outcomes.size(); ++i)
                    QVERIFY(bitsOf((*back)[i]) == bitsOf(outcomes[i]));
            }
        }
    }
};

QTEST_APPLESS_MAIN(OutcomeCodecTest)
#include "outcome_codec_test.moc"
