#include "core/study/operating_box.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/part/specimen.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/trial/start.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;
using trial::BoxPlace;
using trial::Condition;

namespace {

constexpr auto kPart = static_cast<std::size_t>(Condition::part);

study::Settings variedSettings() {
    study::Settings settings = fake::waveInputs().settings;
    settings.evolution.conditions = study::TrialConditions::varied;
    settings.validation.conditions = study::TrialConditions::varied;
    return settings;
}

study::BoxPlaces placesOf(const study::Settings& settings, std::uint32_t generation = 0) {
    return {settings.simulation, settings.box, {7, generation, 0, 0, base::Purpose::conditions}};
}

/// Smooth, and different in every direction.
double integrand(const BoxPlace& at) {
    return at[0] * at[1] + std::sin(2.0 * at[2]) + 0.5 * at[kPart] * at[kPart];
}

double meanOf(const std::vector<BoxPlace>& places) {
    double sum = 0.0;
    for (const BoxPlace& place : places)
        sum += integrand(place);
    return sum / static_cast<double>(places.size());
}

double deviationOf(const std::vector<double>& values) {
    double mean = 0.0;
    for (const double value : values)
        mean += value / static_cast<double>(values.size());
    double squares = 0.0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace

class OperatingBoxTest : public QObject {
    Q_OBJECT

 private slots:
    // Of 2^k places one lies in each of 2^k equal slices of every condition, wherever a block begins.
    void placesFillEveryCondition() {
        const std::vector<BoxPlace> places = placesOf(variedSettings()).draw(31, 32);
        for (const Condition condition :
             {Condition::friction, Condition::restitution, Condition::halfStroke, Condition::part}) {
            std::vector<int> slices;
            slices.reserve(places.size());
            for (const BoxPlace& place : places)
                slices.push_back(static_cast<int>(32.0 * place[static_cast<std::size_t>(condition)]));
            std::sort(slices.begin(), slices.end());
            for (int i = 0; i < 32; ++i)
                QCOMPARE(slices[static_cast<std::size_t>(i)], i);
        }
    }

    // What does not vary is in the middle; any trial has its place whatever is drawn with it; generations
    // have places of their own.
    void placesBelongToTheirTrials() {
        const study::Settings settings = variedSettings();
        const std::vector<BoxPlace> all = placesOf(settings).draw(0, 100);
        for (const BoxPlace& place : all) {
            QCOMPARE(place[static_cast<std::size_t>(Condition::frequency)], 0.5);
            QCOMPARE(place[static_cast<std::size_t>(Condition::angle)], 0.5);
        }
        for (const int first : {1, 10, 63, 64, 99})
            QVERIFY(placesOf(settings).draw(first, 1).front() == all[static_cast<std::size_t>(first)]);
        QVERIFY(placesOf(settings, 1).draw(0, 1).front() != all.front());
    }

    // Three of ten trials are in corners, evenly among the others; each of the 16 is met as often as
    // any other or nearly so. The others are where they are without, and any trial has its place whatever is
    // drawn with it.
    void aShareOfThePlacesIsInCorners() {
        const study::Settings settings = variedSettings();
        const base::StreamKey key{7, 0, 0, 0, base::Purpose::conditions};
        const study::BoxPlaces mixed(settings.simulation, settings.box, key, 0.3);
        const std::vector<BoxPlace> places = mixed.draw(0, 1600);
        std::vector<BoxPlace> corners;
        std::vector<BoxPlace> others;
        for (std::size_t i = 0; i < places.size(); ++i) {
            (trial::isCorner(places[i]) ? corners : others).push_back(places[i]);
            QVERIFY(std::abs(static_cast<double>(corners.size()) - 0.3 * static_cast<double>(i + 1)) <= 1.0);
        }
        QCOMPARE(corners.size(), std::size_t{480});
        QVERIFY(others == placesOf(settings).draw(0, 1120));
        std::map<BoxPlace, int> met;
        for (const BoxPlace& corner : corners)
            ++met[corner];
        QCOMPARE(met.size(), std::size_t{16});
        for (const auto& [corner, times] : met)
            QVERIFY2(times >= 28 && times <= 32, qPrintable(QString::number(times)));
        for (const int first : {1, 9, 10, 63, 799})
            QVERIFY(mixed.draw(first, 1).front() == places[static_cast<std::size_t>(first)]);
        const study::BoxPlaces all(settings.simulation, settings.box, key, 1.0);
        QVERIFY(std::ranges::all_of(all.draw(0, 32), trial::isCorner));
        QVERIFY(!trial::isCorner(trial::kMiddle));
    }

    // 100 of them tell a mean more exactly than 1000 at random.
    void placesSayMoreThanRandomOnes() {
        const study::Settings settings = variedSettings();
        std::vector<double> even;
        std::vector<double> random;
        for (std::uint32_t i = 0; i < 200; ++i) {
            even.push_back(meanOf(placesOf(settings, i).draw(0, 100)));
            base::Random numbers({3, i});
            std::vector<BoxPlace> places(100);
            for (BoxPlace& place : places)
                for (double& at : place)
                    at = numbers.uniform();
            random.push_back(meanOf(places));
        }
        const double ratio = deviationOf(even) / deviationOf(random);
        QVERIFY2(ratio < std::sqrt(0.1), qPrintable(QString::number(ratio)));
    }

    // Twice the standard deviation at the ends: of the cut-off normal distribution it is 0.8796 sigma.
    void normalConditionsAreCutOff() {
        study::Settings settings = variedSettings();
        settings.box.distribution = trial::BoxDistribution::normal;
        std::vector<double> at;
        for (const BoxPlace& place : placesOf(settings).draw(0, 4096))
            at.push_back(place.front());
        QVERIFY(*std::min_element(at.begin(), at.end()) >= 0.0);
        QVERIFY(*std::max_element(at.begin(), at.end()) <= 1.0);
        QVERIFY(std::abs(deviationOf(at) / 0.25 - 0.8796) < 0.002);
    }

    void conditionsStayPhysical_data() {
        QTest::addColumn<int>("condition");
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::newRow("friction 0.5") << int(Condition::friction) << 0.3 << 0.7;
        QTest::newRow("restitution 0.1") << int(Condition::restitution) << 0.0 << 0.3;
        QTest::newRow("half-stroke") << int(Condition::halfStroke) << 0.704e-3 << 0.896e-3;
        QTest::newRow("frequency") << int(Condition::frequency) << 50.0 << 50.0;
        QTest::newRow("part") << int(Condition::part) << -0.1e-3 << 0.1e-3;
        QTest::newRow("start offset") << int(Condition::startOffset) << -3e-3 << 3e-3;
        QTest::newRow("start speed") << int(Condition::startSpeed) << 0.0 << 0.2;
        QTest::newRow("roughness") << int(Condition::roughness) << 0.0 << 0.1;
    }
    void conditionsStayPhysical() {
        QFETCH(const int, condition);
        QFETCH(const double, low);
        QFETCH(const double, high);
        study::SimulationSettings simulation;
        simulation.contact.restitution = 0.1;
        const auto at = [&](double share) {
            trial::OperatingBox box;
            box.startOffset = 3e-3;
            box.startSpeed = 0.2;
            box.roughness = 0.1;
            return study::conditionAt(simulation, box, static_cast<Condition>(condition), share);
        };
        QVERIFY(std::abs(at(0.0) - low) < 1e-12);
        QVERIFY(std::abs(at(1.0) - high) < 1e-12);
        QVERIFY(std::abs(at(0.25) - (0.75 * low + 0.25 * high)) < 1e-12);
    }

    void aTrialGetsWhatItsPlaceIs() {
        study::SimulationSettings simulation;
        simulation.contact = {0.6, 0.5, 0.2};
        const study::StudyInputs inputs = fake::waveInputs();
        const search::Design design(study::designSpace(inputs.settings.track).dimensions.size(), 0.5);
        const track::Track track = study::decodeTrack(inputs.settings.track, design).value();
        const trial::TrialSpec drawn = trial::drawTrial(track, *inputs.part, simulation.start, {5, 0, 0, 3});
        trial::TrialSpec spec = drawn;
        study::putAt(simulation, {}, {0.0, 1.0, 0.25, 0.9, 0.9, 0.5, 0.9, 0.9, 0.9}, track, spec);
        QVERIFY(std::abs(spec.contact->kineticFriction - 0.3) < 1e-12);
        QVERIFY(std::abs(spec.contact->staticFriction - 0.4) < 1e-12);  // as much more as it is known to be
        QVERIFY(std::abs(spec.contact->restitution - 0.4) < 1e-12);
        QVERIFY(std::abs(spec.drive->halfStroke - 0.752e-3) < 1e-12);
        // Known: bit for bit.
        QCOMPARE(spec.drive->frequency, simulation.drive.frequency);
        QCOMPARE(spec.drive->angle, simulation.drive.angle);
        QCOMPARE(spec.parts.front().pose.position, drawn.parts.front().pose.position);
        QCOMPARE(spec.parts.front().velocity, base::Vec3(base::Vec3::Zero()));
        QCOMPARE(spec.contact->roughness, 0.0);
    }

    // Beside the middle and on its way in the track's own directions, on a surface of its own.
    void aTrialStartsAsItsPlaceSays() {
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.track.shape.type = track::FeederType::bowl;
        trial::OperatingBox box;
        box.startOffset = 3e-3;
        box.startSpeed = 0.2;
        box.roughness = 0.1;
        const search::Design design(study::designSpace(inputs.settings.track).dimensions.size(), 0.5);
        const track::Track track = study::decodeTrack(inputs.settings.track, design).value();
        const study::SimulationSettings& simulation = inputs.settings.simulation;
        const auto putAt = [&](std::uint32_t trial) {
            trial::TrialSpec spec = trial::drawTrial(track, *inputs.part, simulation.start, {5, 0, 0, trial});
            study::putAt(simulation, box, {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1.0, 0.25, 0.5}, track, spec);
            return spec;
        };
        const trial::PartStart drawn =
            trial::drawTrial(track, *inputs.part, simulation.start, {5, 0, 0, 3}).parts.front();
        const trial::TrialSpec spec = putAt(3);
        const base::Mat3 axes = track.shape.tangentFrame(track.start);
        const base::Vec3 moved = axes.transpose() * (spec.parts.front().pose.position - drawn.pose.position);
        QVERIFY((moved - base::Vec3(0.0, 3e-3, 0.0)).norm() < 1e-12);
        QVERIFY((axes.transpose() * spec.parts.front().velocity - base::Vec3(0.05, 0.0, 0.0)).norm() < 1e-12);
        QVERIFY(std::abs(spec.contact->roughness - 0.05) < 1e-12);
        QVERIFY(spec.contact->surface != putAt(4).contact->surface);
        QCOMPARE(spec.contact->surface, putAt(3).contact->surface);
    }

    void specimensStandForTheRange() {
        const study::Settings settings = variedSettings();
        const auto drawn = fake::waveInputs().part;
        const study::Specimens specimens = study::makeSpecimens(settings, drawn);
        QCOMPARE(specimens.drawn, drawn);
        QCOMPARE(specimens.varied.size(), std::size_t{study::kSpecimens});
        double sum = 0.0;
        double before = -1.0;
        for (const auto& specimen : specimens.varied) {
            const double longer = part::calcExtents(*specimen).x() - part::calcExtents(*drawn).x();
            QVERIFY(longer > before);
            before = longer;
            sum += longer;
        }
        QVERIFY(std::abs(sum) < 1e-12);  // as many smaller as larger
        study::Settings exact = settings;
        exact.box.sizeBelow = exact.box.sizeAbove = 0.0;
        QCOMPARE(study::makeSpecimens(exact, drawn).varied, std::vector{drawn});
    }

    // The starts are those of nominal trials; all individuals of a generation meet the same conditions, each
    // trial has them whatever is simulated with it, and judging has others than learning.
    void batchesVaryOverTheBox() {
        const study::StudyInputs inputs = fake::waveInputs();
        const study::Settings settings = variedSettings();
        const search::Design design(study::designSpace(settings.track).dimensions.size(), 0.5);
        const auto track =
            std::make_shared<const track::Track>(study::decodeTrack(settings.track, design).value());
        study::Settings asSet = settings;
        asSet.evolution.conditions = asSet.validation.conditions = study::TrialConditions::nominal;
        const study::TrialScene nominal = study::makeScene(asSet, inputs.part, track);
        const study::TrialScene varied = study::makeScene(settings, inputs.part, track);
        const trial::TrialBatch plain = study::makeLearningBatch(nominal, {2, 3}, 40);
        const trial::TrialBatch first = study::makeLearningBatch(varied, {2, 3}, 40);
        const trial::TrialBatch other = study::makeLearningBatch(varied, {2, 4}, 10, 20);
        QVERIFY(study::listPlaces(plain).empty());
        const std::vector<BoxPlace> places = study::listPlaces(first);
        QCOMPARE(places.size(), std::size_t{40});
        QVERIFY(std::equal(places.begin() + 20, places.begin() + 30, study::listPlaces(other).begin()));
        QCOMPARE(first.parts.size(), std::size_t{study::kSpecimens});
        for (std::size_t i = 0; i < 40; ++i) {
            QVERIFY(first.trials[i].stream == plain.trials[i].stream);
            QCOMPARE(first.trials[i].phase, plain.trials[i].phase);
            QVERIFY(first.trials[i].parts[0].pose.rotation.coeffs() ==
                    plain.trials[i].parts[0].pose.rotation.coeffs());
            // The eighth of the range that the specimen stands for.
            QCOMPARE(static_cast<double>(first.trials[i].parts[0].part),
                     std::floor(study::kSpecimens * places[i][kPart]));
            QVERIFY(first.contactOf(first.trials[i]).kineticFriction !=
                    plain.contactOf(plain.trials[i]).kineticFriction);
        }
        // Corners from a generation on: before it all is as without them.
        study::Settings later = settings;
        later.evolution.cornerShare = 0.6;
        later.evolution.cornersFrom = 3;
        const study::TrialScene cornered = study::makeScene(later, inputs.part, track);
        QVERIFY(study::listPlaces(study::makeLearningBatch(cornered, {2, 3}, 40)) == places);
        const std::vector<BoxPlace> in = study::listPlaces(study::makeLearningBatch(cornered, {3, 3}, 40));
        QCOMPARE(std::ranges::count_if(in, trial::isCorner), 24);
        const trial::TrialBatch judged = study::makeSelectionBatch(varied, {2, 3}, 40);
        QVERIFY(study::listPlaces(judged) != places);
        QVERIFY(study::listPlaces(study::makeSelectionBatch(nominal, {2, 3}, 40)).empty());
        // Validation goes on over the poses.
        const std::vector<BoxPlace> second =
            study::listPlaces(study::makeValidationBatch(varied, {2, 3}, 1, 16));
        QVERIFY(second != study::listPlaces(study::makeValidationBatch(varied, {2, 3}, 0, 16)));
    }
};

QTEST_APPLESS_MAIN(OperatingBoxTest)
#include "operating_box_test.moc"
