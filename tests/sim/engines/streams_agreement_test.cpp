#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/stats/mean.h"
#include "sim/engines/registry.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;

namespace {

/// Cuboids that come one soon after the other and anyhow, at x, within `width` of the middle, onto a track
/// that conveys them.
trial::TrialBatch makeStreams(std::shared_ptr<const track::Track> track, double x, double width,
                              double until) {
    trial::TrialBatch batch = verify::makeStillScene(std::move(track), verify::makePaperCuboid(), {}, until);
    batch.drive.halfStroke = 0.8e-3;
    batch.partsContact = {0.4, 0.4, 0.2};
    batch.termination.until = until;
    batch.trials.clear();
    for (std::uint32_t i = 0; i < 40; ++i) {
        trial::TrialSpec& spec = batch.trials.emplace_back();
        spec.stream = {9, 0, 0, i, base::Purpose::test};
        base::Random random(spec.stream);
        spec.phase = random.uniform(0.0, 2.0 * base::kPi);
        for (int k = 0; k < 4; ++k) {
            const double y = random.uniform(-width, width);
            const double z = verify::findSurfaceHeight(*batch.track, x, y) + 9e-3;
            spec.parts.push_back(
                {0, {random.rotation(), Vec3(x, y, z)}, Vec3::Zero(), Vec3::Zero(), 0.1 * k});
        }
    }
    return batch;
}

/// What came of all parts.
struct Tally {
    double parts = 0.0;
    double finished = 0.0;
    double fallen = 0.0;
    std::vector<double> transits;  // of those that finished [s]
};

Tally count(const trial::TrialBatch& batch, const trial::EngineKind& kind) {
    Tally tally;
    const auto outcomes = kind.make({2, 0.0})->run({&batch, 1}, {});
    if (!outcomes) return tally;
    for (const trial::Outcome& outcome : outcomes->front()) {
        for (const trial::PartOutcome& part : outcome.parts) {
            tally.parts += 1.0;
            tally.fallen += part.ending == trial::Ending::fellOff ? 1.0 : 0.0;
            if (part.ending != trial::Ending::finished) continue;
            tally.finished += 1.0;
            tally.transits.push_back(part.time - *part.entered);
        }
    }
    return tally;
}

double calcMean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

/// How many standard errors two counts of `parts` are apart, as if all were independent.
double calcDistance(double a, double b, double parts) {
    const double share = (a + b) / (2.0 * parts);
    return std::abs(a - b) / std::sqrt(std::max(1.0, 2.0 * parts * share * (1.0 - share)));
}

}  // namespace

class StreamsAgreementTest : public QObject {
    Q_OBJECT

 private slots:
    void enginesAgree_data() {
        QTest::addColumn<bool>("level");
        QTest::newRow("level") << true;
        QTest::newRow("hills") << false;
    }
    // Single parts soon go apart by chaos; what becomes of many is the same.
    void enginesAgree() {
        QFETCH(bool, level);
        const trial::TrialBatch batch = level ? makeStreams(verify::makeFlat(), 0.36, 0.003, 0.9)
                                              : makeStreams(verify::makeHills(1e-3), 0.29, 0.025, 1.2);
        std::vector<Tally> tallies;
        for (const trial::EngineKind& kind : engines::registry().kinds())
            if (kind.takesStreams) tallies.push_back(count(batch, kind));
        QVERIFY(tallies.size() >= 2);
        for (const Tally& tally : tallies) {
            const Tally& other = tallies.front();
            qInfo("%g parts: %g finished, %g fell; transit %.4f s +- %.4f", tally.parts, tally.finished,
                  tally.fallen, calcMean(tally.transits), stats::calcStandardError(tally.transits));
            QCOMPARE(tally.parts, 160.0);
            QVERIFY(tally.finished >= 20.0);
            QVERIFY(calcDistance(tally.finished, other.finished, tally.parts) < 3.5);
            QVERIFY(calcDistance(tally.fallen, other.fallen, tally.parts) < 3.5);
            const double uncertainty = std::hypot(stats::calcStandardError(tally.transits),
                                                  stats::calcStandardError(other.transits));
            QVERIFY(std::abs(calcMean(tally.transits) - calcMean(other.transits)) < 3.5 * uncertainty);
        }
    }
};

QTEST_APPLESS_MAIN(StreamsAgreementTest)
#include "streams_agreement_test.moc"
