#include "core/study/stream.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/part/stable_poses.h"
#include "core/study/operating_box.h"
#include "core/study/track_design.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;
using study::StreamCounts;

namespace {

constexpr double kTransit = 4.0;  // [s]

/// Every part is 4 s on its way. One that comes less than half a second after another arrives wrong, and one
/// less than a tenth after it falls.
trial::Outcome crowdLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    trial::Outcome outcome;
    double before = -1e9;
    for (const trial::PartStart& start : spec.parts) {
        trial::PartOutcome& part = outcome.parts.emplace_back();
        part.entered = start.time;
        part.initial.position.x() = batch.track->start;
        part.farthest.position.x() = batch.track->finish;
        part.time = start.time + kTransit;
        part.ending = start.time - before < 0.1 ? trial::Ending::fellOff : trial::Ending::finished;
        if (start.time - before < 0.5) part.farthest.rotation = Eigen::AngleAxisd(1.5, base::Vec3::UnitX());
        if (part.time > batch.termination.until) {
            part.time = batch.termination.until;
            part.ending = trial::Ending::timedOut;
        }
        before = start.time;
    }
    return outcome;
}

study::StudyInputs crowdInputs() {
    study::StudyInputs inputs = fake::waveInputs(2);
    auto engine = std::make_shared<fake::FakeEngine>(fake::waveLaw, 2);
    engine->streamLaw = crowdLaw;
    inputs.engine = engine;
    inputs.settings.stream.streams = 40;
    return inputs;
}

std::shared_ptr<const track::Track> makeTrack(const study::StudyInputs& inputs) {
    const search::Design design(study::designSpace(inputs.settings.track).dimensions.size(), 0.5);
    return std::make_shared<const track::Track>(study::decodeTrack(inputs.settings.track, design).value());
}

trial::TrialBatch makeBatch(const study::StudyInputs& inputs, double inflow) {
    return study::makeStreamBatch(inputs.settings, inputs.part, makeTrack(inputs), {2, 3}, inflow);
}

bool isNear(const stats::MeanEstimate& estimate, double expected) {
    return estimate.interval.low <= expected && expected <= estimate.interval.high &&
           std::abs(estimate.mean - expected) < 0.15 * expected;
}

}  // namespace

class StreamTest : public QObject {
    Q_OBJECT

 private slots:
    // So many a minute, at times that say nothing of each other; at another inflow the same, closer together.
    void partsComeAtRandom() {
        study::StudyInputs inputs = crowdInputs();
        inputs.settings.stream.streams = 60;
        const trial::TrialBatch batch = makeBatch(inputs, 90.0);
        QCOMPARE(batch.trials.size(), std::size_t{60});
        QCOMPARE(batch.termination.until, 75.0);
        double parts = 0.0;
        int shorter = 0;
        int gaps = 0;
        for (const trial::TrialSpec& spec : batch.trials) {
            parts += static_cast<double>(spec.parts.size());
            for (std::size_t i = 1; i < spec.parts.size(); ++i) {
                const double gap = spec.parts[i].time - spec.parts[i - 1].time;
                QVERIFY(gap > 0.0 && spec.parts[i].time < 75.0);
                shorter += gap < 60.0 / 90.0 ? 1 : 0;
                ++gaps;
            }
        }
        // Mean 112.5 a stream, standard deviation its root; of exponential gaps 1 - 1 / e are less than their
        // mean.
        QVERIFY(std::abs(parts / 60.0 - 112.5) < 4.0 * std::sqrt(112.5 / 60.0));
        QVERIFY(std::abs(static_cast<double>(shorter) / gaps - (1.0 - std::exp(-1.0))) < 0.03);
        const trial::TrialBatch slow = makeBatch(inputs, 45.0);
        for (std::size_t i = 0; i < 60; ++i) {
            const trial::TrialSpec& quick = batch.trials[i];
            QVERIFY(slow.trials[i].phase == quick.phase);
            for (std::size_t k = 0; k < std::min<std::size_t>(slow.trials[i].parts.size(), 20); ++k) {
                QVERIFY(std::abs(slow.trials[i].parts[k].time - 2.0 * quick.parts[k].time) < 1e-9);
                QVERIFY(slow.trials[i].parts[k].pose == quick.parts[k].pose);
            }
        }
        const trial::TrialBatch again = makeBatch(inputs, 90.0);
        for (std::size_t i = 0; i < 60; ++i)
            QVERIFY(again.trials[i].parts.back().pose == batch.trials[i].parts.back().pose);
    }

    void partsComeRegularly() {
        study::StudyInputs inputs = crowdInputs();
        inputs.settings.stream.arrivals = study::Arrivals::regular;
        for (const trial::TrialSpec& spec : makeBatch(inputs, 60.0).trials) {
            QCOMPARE(spec.parts.size(), std::size_t{75});
            for (std::size_t i = 1; i < spec.parts.size(); ++i)
                QVERIFY(std::abs(spec.parts[i].time - spec.parts[i - 1].time - 1.0) < 1e-9);
        }
    }

    // In their stable poses, as often as they land so; or anyhow.
    void partsAreDelivered() {
        study::StudyInputs inputs = crowdInputs();
        inputs.settings.validation.conditions = study::TrialConditions::nominal;
        const auto countLying = [&](double most) {
            std::vector<int> counts(4, 0);
            for (const trial::TrialSpec& spec : makeBatch(inputs, 60.0).trials) {
                for (const trial::PartStart& start : spec.parts) {
                    const auto nearest = part::findStablePose(*inputs.part, start.pose.rotation);
                    ++counts[nearest.angle < most ? nearest.index : 3];
                }
            }
            return counts;
        };
        const std::vector<int> resting = countLying(10.0 * base::kDegree);
        const double all = resting[0] + resting[1] + resting[2] + resting[3];
        QVERIFY(std::abs(resting[0] / all - 0.645) < 0.04 && std::abs(resting[1] / all - 0.243) < 0.04);
        QVERIFY(resting[3] < 0.001 * all);
        inputs.settings.stream.delivery = study::Delivery::anyhow;
        QVERIFY(countLying(10.0 * base::kDegree)[3] > 0.8 * all);
    }

    // What is the feeder's is the stream's, what is the part's each part's own.
    void conditionsVary() {
        study::StudyInputs inputs = crowdInputs();
        const trial::TrialBatch batch = makeBatch(inputs, 60.0);
        QCOMPARE(batch.parts.size(), std::size_t{study::kSpecimens});
        QVERIFY(batch.partsContact.kineticFriction == inputs.settings.stream.contact.kineticFriction);
        std::vector<double> frictions;
        for (const trial::TrialSpec& spec : batch.trials) {
            QVERIFY(spec.contact && spec.drive && spec.place);
            frictions.push_back(spec.contact->kineticFriction);
            const auto [least, most] = std::ranges::minmax(spec.parts, {}, &trial::PartStart::part);
            QVERIFY(least.part < 2 && most.part > 5);
        }
        const auto [low, high] = std::ranges::minmax(frictions);
        QVERIFY(high - low > 0.3 && low >= 0.29 && high <= 0.71);
        inputs.settings.validation.conditions = study::TrialConditions::nominal;
        const trial::TrialBatch nominal = makeBatch(inputs, 60.0);
        QCOMPARE(nominal.parts.size(), std::size_t{1});
        QVERIFY(!nominal.trials[0].contact && !nominal.trials[0].place);
    }

    void jamsAreFound_data() {
        QTest::addColumn<QList<double>>("stops");  // from, to
        QTest::addColumn<QList<double>>("finishes");
        QTest::addColumn<QList<double>>("jams");  // from, to
        const auto row = [](const char* name, const QList<double>& stops, const QList<double>& finishes,
                            const QList<double>& jams) { QTest::newRow(name) << stops << finishes << jams; };
        row("nobody stands", {}, {1, 2}, {});
        row("one stands, others pass", {10, 20}, {11, 12, 13, 14, 15, 16, 17, 18, 19, 20}, {});
        row("one stands alone", {10, 20}, {9, 25}, {10, 20});
        row("alone but for a while", {10, 20}, {15}, {15, 20});
        row("two stand, a third comes", {10, 20, 12, 20}, {23}, {10, 20});
        row("two stand, others pass", {10, 20, 12, 20}, {14, 15, 19}, {12, 14, 15, 19});
        row("two jams", {10, 12, 30, 33}, {}, {10, 12, 30, 33});
        row("to the end", {50, 60}, {52}, {52, 60});
    }
    void jamsAreFound() {
        QFETCH(QList<double>, stops);
        QFETCH(QList<double>, finishes);
        QFETCH(QList<double>, jams);
        trial::Outcome outcome;
        const auto addPart = [&](double entered, double time, trial::Ending ending) {
            trial::PartOutcome& part = outcome.parts.emplace_back();
            part.entered = entered;
            part.time = time;
            part.ending = ending;
        };
        for (const double time : finishes)
            addPart(time - 4.0, time, trial::Ending::finished);
        for (qsizetype i = 0; i < stops.size(); i += 2) {
            outcome.stops.push_back({outcome.parts.size(), stops[i], stops[i + 1]});
            addPart(stops[i], stops[i + 1],
                    stops[i + 1] < 60.0 ? trial::Ending::fellOff : trial::Ending::timedOut);
        }
        trial::Termination termination;
        termination.until = 60.0;
        QList<double> found;
        for (const study::Jam& jam : study::findJams(outcome, termination)) {
            found << jam.from << jam.to;
            QCOMPARE(jam.cleared, jam.to < 60.0);
        }
        QCOMPARE(found, jams);
    }

    // Against the law's own numbers: gaps are exponential.
    void ratesAndShares() {
        const study::StudyInputs inputs = crowdInputs();
        base::RunControl control;
        const auto streams = study::measureStreams(inputs, makeTrack(inputs), {2, 3}, std::nullopt,
                                                   {120.0, 20.0, 120.0}, control);
        VERIFY_OK(streams);
        QCOMPARE(control.done(), std::int64_t{80});
        QCOMPARE(streams->results.size(), std::size_t{2});
        for (const study::StreamResult& result : streams->results) {
            const double inflow = result.partsPerMinute;
            const double perSecond = inflow / 60.0;
            QVERIFY(isNear(result.rate(&StreamCounts::offered), inflow));
            QVERIFY(isNear(result.rate(&StreamCounts::fellOff), inflow * -std::expm1(-0.1 * perSecond)));
            QVERIFY(isNear(result.rate(&StreamCounts::success), inflow * std::exp(-0.5 * perSecond)));
            const auto share = result.successShare();
            QVERIFY(share && isNear(*share, std::exp(-0.5 * perSecond) / std::exp(-0.1 * perSecond)));
            QVERIFY(std::abs(result.transit - kTransit) < 1e-9);
            QVERIFY(std::abs(result.spacing - std::log(2.0) / perSecond) < 0.3 / perSecond);
            QVERIFY(result.countFull() == 0 && result.jammedShare() == 0.0);
            const StreamCounts sum = result.sum();
            QVERIFY(sum.arrived() == sum.success + sum.wrong && sum.arrived() > 0);
        }
        QCOMPARE(streams->findBest()->partsPerMinute, 120.0);
        const QString table = QString::fromStdString(study::formatStreams(*streams));
        QVERIFY(table.contains("      20 ") && table.contains("     120 "));
    }

    // What falls where parts come again is not lost, and counts in the efficiency alike.
    void fallenPartsComeAgain() {
        study::StudyInputs inputs = crowdInputs();
        const auto measure = [&] {
            return study::measureStreams(inputs, makeTrack(inputs), {2, 3}, std::nullopt, {20.0, 120.0}, {})
                .value()
                .results.back();
        };
        const study::StreamResult lost = measure();
        inputs.settings.track.returns = trial::Returns::anywhere;
        const study::StreamResult returned = measure();
        QVERIFY(lost.sum().fellOff > 100 && lost.sum().returned == 0);
        QCOMPARE(returned.sum().returned, lost.sum().fellOff);
        QCOMPARE(returned.sum().fellOff, 0);
        QVERIFY(returned.successShare()->mean == lost.successShare()->mean);
        QVERIFY(returned.efficiency()->mean == lost.efficiency()->mean);
        // Of all that leave the track those are right that come half a second after the one before.
        QVERIFY2(std::abs(lost.efficiency()->mean - std::exp(-0.5 * 2.0)) < 0.02,
                 qPrintable(QString::number(lost.efficiency()->mean)));
        QVERIFY(lost.efficiency()->interval.high - lost.efficiency()->interval.low < 0.06);
    }

    // The same arrivals for all tracks of a generation, others in the next; the step of learning.
    void streamsOfLearning() {
        study::StudyInputs inputs = crowdInputs();
        inputs.settings.evolution.streamsEach = 3;
        inputs.settings.stream.partsPerMinute = 80.0;
        const study::Specimens specimens = study::makeSpecimens(inputs.settings, inputs.part);
        const auto track = makeTrack(inputs);
        const auto batch = study::makeLearningStreams(inputs.settings, specimens, track, 4);
        QCOMPARE(batch.trials.size(), std::size_t{3});
        QCOMPARE(batch.step, study::chooseLearningStep(inputs.settings));
        const auto next = study::makeLearningStreams(inputs.settings, specimens, track, 5);
        QVERIFY(batch.trials[0].parts[0].time != next.trials[0].parts[0].time);
        QVERIFY(batch.trials[0].place && batch.trials[0].contact);
        inputs.settings.evolution.conditions = study::TrialConditions::nominal;
        QVERIFY(!study::makeLearningStreams(inputs.settings, specimens, track, 4).trials[0].place);
        // None of them is one of the streams that judge.
        QVERIFY(batch.trials[0].stream.purpose != makeBatch(inputs, 80.0).trials[0].stream.purpose);
        std::vector<trial::Outcome> outcomes;
        for (const trial::TrialSpec& spec : batch.trials)
            outcomes.push_back(crowdLaw(batch, spec));
        const stats::Count count = study::countThroughput(inputs.settings.stream, {}, inputs.part->symmetry,
                                                          25.0 * base::kDegree, batch, outcomes);
        // 80 a minute come for three minutes.
        QVERIFY(count.trials > 180 && count.trials < 300);
        QVERIFY(std::abs(count.share() - std::exp(-0.5 * 80.0 / 60.0)) < 0.1);
    }

    // All right in every stream: the streams alone would say that it is certain.
    void aFlawlessShareHasABound() {
        study::StreamResult result{60.0, 60.0, {}, 0.0, 0.0, 0.0};
        result.streams.assign(5, {20, 20, 20, 0, 0, 0, 0, 0, 0.0});
        const auto share = result.successShare();
        QVERIFY(share && share->mean == 1.0 && share->interval.high == 1.0);
        QVERIFY(std::abs(share->interval.low - (1.0 - 0.0362)) < 1e-3);  // Clopper and Pearson, 100 of 100
        result.streams[0].success = 0;
        result.streams[0].wrong = 20;
        QVERIFY(result.successShare()->interval.low < 0.5);  // one bad stream of five
        result.streams.assign(3, {});
        QVERIFY(!result.successShare());
        result.streams.assign(3, {100, 90, 90, 0, 0, 0, 0, 0, 0.0});
        QCOMPARE(result.countFull(), 3);
    }

    void badInputIsNamed() {
        study::StudyInputs inputs = crowdInputs();
        const auto track = makeTrack(inputs);
        const auto reason = [&](std::vector<double> inflows) {
            return fake::messageOf(
                study::measureStreams(inputs, track, {}, std::nullopt, std::move(inflows), {}));
        };
        QVERIFY(reason({}).contains("at least one inflow"));
        QVERIFY(reason({30.0, 0.0}).contains("0 parts a minute; 0.1 to 10000"));
        QVERIFY(reason({5000.0}).contains("6250 parts come in a stream of 75 s, and no more than 3600 can"));
        base::RunControl control;
        control.cancel();
        QVERIFY(!study::measureStreams(inputs, track, {}, std::nullopt, {30.0}, control).ok());
    }

    void jsonComesBack() {
        study::Streams streams;
        streams.settings.duration = 1.0 / 3.0 + 20.0;
        streams.settings.contact.kineticFriction = 0.3;
        streams.results = {{30.0,
                            20.0,
                            {{9, 8, 7, 1, 3, 0, 1, 1, 2.0 / 3.0}, {1, 1, 1, 0, 0, 0, 0, 0, 0.0}},
                            4.0,
                            2.0,
                            1.0}};
        const std::string text = study::streamsToJson(streams);
        const auto back = study::streamsFromJson(text);
        VERIFY_OK(back);
        QVERIFY(back->settings == streams.settings && back->results == streams.results);
        QVERIFY(back->goal == streams.goal);
        // As programs wrote it that knew no returns.
        std::string older = text;
        for (const auto& [from, to] : {std::pair("1,1,3]", "1,1]"), {"0,0,0]", "0,0]"}}) {
            QVERIFY(older.find(from) != std::string::npos);
            older.replace(older.find(from), std::string(from).size(), to);
        }
        const auto old = study::streamsFromJson(older);
        VERIFY_OK(old);
        QCOMPARE(old->results[0].sum().returned, 0);
        QCOMPARE(old->results[0].sum().success, 8);
        for (const char* damaged : {"", "{}", "[1]", R"({"goal": 1})"})
            QVERIFY(!study::streamsFromJson(damaged).ok());
        for (const auto& [from, to] : {std::pair("[9,8,", "[-9,8,"), {"[9,8,7,", "[9,"}, {":4.0", ":-4.0"}}) {
            std::string changed = text;
            QVERIFY(changed.find(from) != std::string::npos);
            changed.replace(changed.find(from), std::string(from).size(), to);
            QVERIFY2(!study::streamsFromJson(changed).ok(), to);
        }
    }
};

QTEST_APPLESS_MAIN(StreamTest)
#include "stream_test.moc"
