#include "core/study/track_design.h"

#include <QtTest>
#include <set>

#include "core/traps/trap_chain.h"
#include "fake_engine.h"

using namespace trapwright;

namespace {

study::TrackSettings smallSettings() {
    study::TrackSettings settings;
    settings.crossSections = 3;
    settings.pointsPerSection = 4;
    settings.minSegmentLength = 10e-3;
    settings.maxSegmentLength = 30e-3;
    return settings;
}

search::Design designOf(std::vector<double> points, const std::vector<double>& lengths) {
    points.insert(points.end(), lengths.begin(), lengths.end());
    return points;
}

}  // namespace

class TrackDesignTest : public QObject {
    Q_OBJECT

 private slots:
    void spaceIsThatOfTheTrack() {
        const search::DesignSpace space = study::designSpace(smallSettings());
        QCOMPARE(space.dimensions.size(), std::size_t{27});
        std::set<std::string> keys;
        for (std::size_t i = 0; i < 27; ++i) {
            const search::Dimension& dimension = space.dimensions[i];
            keys.insert(dimension.key);
            QCOMPARE(dimension.bits, 10);
            QCOMPARE(dimension.ofPoint, i < 24);
            QCOMPARE(dimension.unit, std::string("mm"));
        }
        QCOMPARE(keys.size(), std::size_t{27});
        // Strips of 15 mm: the third of them is right of the middle.
        const search::Dimension& y = space.dimensions[4];
        QCOMPARE(y.key, std::string("section 1, point 3, y"));
        QVERIFY(qAbs(y.low) < 1e-12 && qAbs(y.high - 15.0) < 1e-12);
        QCOMPARE(space.dimensions[5].high, 30.0);
        QCOMPARE(space.dimensions[26].low, 10.0);
        QCOMPARE(space.dimensions[26].high, 30.0);
        study::TrackSettings free = smallSettings();
        free.encoding = study::PointEncoding::free;
        QCOMPARE(study::designSpace(free).dimensions[4].low, -30.0);
        QCOMPARE(study::designSpace(free).dimensions[4].high, 30.0);
    }

    void genesBecomePlaces() {
        // z: section s at s/2 of the height; y in the middle of each strip; lengths 0, 1/2 (nearly), 1.
        std::vector<double> points;
        for (const double z : {0.0, 1.0, 1.0}) {
            for (int j = 0; j < 4; ++j)
                points.insert(points.end(), {j % 2 == 0 ? 0.0 : 1.0, z});
        }
        const auto track = study::decodeTrack(smallSettings(), designOf(points, {0.0, 0.0, 1.0}));
        VERIFY_OK(track);
        QCOMPARE(track->firstTrapSection, 1);
        QCOMPARE(track->lastTrapSection, 4);
        const std::vector<double> x = {0.0, 0.080, 0.090, 0.100, 0.130, 0.160, 0.190};
        QCOMPARE(track->sections.size(), x.size());
        for (std::size_t s = 0; s < x.size(); ++s)
            QVERIFY(qAbs(track->sections[s].x - x[s]) < 1e-12);
        QVERIFY(qAbs(track->start - 0.060) < 1e-12);
        QVERIFY(qAbs(track->finish - 0.175) < 1e-12);
        for (std::size_t s = 2; s < 5; ++s) {
            const std::vector<double> y = {-0.030, 0.0, 0.0,
                                           0.030};  // strips of 15 mm: 0, 1, 0, 1 within them
            for (std::size_t j = 0; j < 4; ++j) {
                QVERIFY(qAbs(track->sections[s].points[j].x() - y[j]) < 1e-12);
                QVERIFY(qAbs(track->sections[s].points[j].y() - (s == 2 ? 0.0 : 0.030)) < 1e-12);
            }
        }
    }

    void settingsOfTheTrackArriveThere() {
        study::TrackSettings settings = smallSettings();
        settings.shape = {track::FeederType::bowl, 0.2, track::Conveying::anticlockwise};
        settings.segmentWidth = 50e-3;
        settings.segmentHeight = 20e-3;
        settings.leadOutSegments = 3;
        settings.baseThickness = 5e-3;
        const auto track =
            study::decodeTrack(settings, designOf(std::vector<double>(24, 0.0), std::vector<double>(3, 0.0)));
        VERIFY_OK(track);
        QVERIFY(track->shape.type == track::FeederType::bowl);
        QCOMPARE(track->shape.bowlRadius, 0.2);
        QVERIFY(track->shape.conveying == track::Conveying::anticlockwise);
        QCOMPARE(track->width, 50e-3);
        QCOMPARE(track->height, 20e-3);
        QCOMPARE(track->sections.size(), std::size_t{2 + 3 + 3});
        QVERIFY(qAbs(geometry::calcBoundingBox(track->solid).low.z() + 5e-3) < 1e-12);
    }

    void trapsFollowAGivenOne() {
        const study::TrackSettings settings = smallSettings();
        const auto first =
            study::decodeTrack(settings, designOf(std::vector<double>(24, 0.3), std::vector<double>(3, 0.2)));
        VERIFY_OK(first);
        study::TrackSettings wanted = settings;
        wanted.traps = "cut-out";
        const auto behind = study::placeBehind(*first, wanted);
        VERIFY_OK(behind);
        // Raised by the fall of a typical cut-out, the lead-in as well.
        const double raised = std::ceil(1e3 * study::calcTypicalFall(wanted)) * 1e-3;
        QVERIFY(raised > 5e-3);
        const search::DesignSpace space = study::designSpace(*behind);
        QCOMPARE(space.dimensions.size(), std::size_t{7});
        QCOMPARE(behind->startFromLeadInEnd, settings.startFromLeadInEnd);
        const auto both = study::decodeTrack(*behind, search::Design(7, 0.5));
        VERIFY_OK(both);
        QCOMPARE(both->lastTrapSection, first->lastTrapSection + 6);
        for (std::size_t s = 0; s <= static_cast<std::size_t>(first->lastTrapSection); ++s) {
            QVERIFY(qAbs(both->sections[s].x - first->sections[s].x) < 1e-9);
            for (std::size_t i = 0; i < 4; ++i)
                QVERIFY((both->sections[s].points[i] - first->sections[s].points[i] - base::Vec2(0.0, raised))
                            .norm() < 1e-12);
        }
        // Its own begin where the given one ends, on its lowest point.
        const track::CrossSection& next =
            both->sections[static_cast<std::size_t>(first->lastTrapSection) + 1];
        QVERIFY(next.x > both->sections[static_cast<std::size_t>(first->lastTrapSection)].x + 9e-3);
        const double fall = 8.0 * base::kDegree;  // the middle of -6 to 22
        const double lowest = traps::findLowest(next);
        QVERIFY(qAbs(lowest - (0.3 * 30e-3 - (next.x - first->sections[4].x) * std::tan(fall)) - raised) <
                1e-8);
        QVERIFY(study::calcLongestTrack(*behind) > both->end() - both->begin());
        const auto layout = study::buildLayout(*behind);
        VERIFY_OK(layout);
        QCOMPARE(layout->sections.size(), both->sections.size());
    }

    void sectionsComeBackAsText() {
        const std::vector<track::CrossSection> sections = {{0.1 / 3.0, {{-0.03, 0.1 / 7.0}, {0.03, 0.0}}},
                                                           {0.05, {{-0.02, 0.01}, {1e-9, 0.02}}}};
        const std::string text = study::describeSections(sections);
        const auto back = study::readSections(text);
        VERIFY_OK(back);
        QCOMPARE(back->size(), std::size_t{2});
        for (std::size_t i = 0; i < 2; ++i) {
            QVERIFY((*back)[i].x == sections[i].x);
            QVERIFY((*back)[i].points == sections[i].points);
        }
        QVERIFY(study::readSections(" ")->empty());
        const auto problem = [](const char* wrong) { return fake::messageOf(study::readSections(wrong)); };
        QVERIFY(problem("10 -1 2, 1 2").contains("Cross-section 1 has no colon"));
        QVERIFY(problem("x: -1 2, 1 2").contains("Cross-section 1 has no number"));
        QVERIFY(problem("5: -1 2, 1 2; 5: -1 2, 1 2").contains("Cross-section 2 is not behind"));
        QVERIFY(problem("5: -1 2, 1").contains("has \"1\" where a point should be"));
        QVERIFY(problem("5: -1 2, 1 2; 6: -1 2").contains("Cross-section 2 has not as many points"));
    }

    void layoutTrackIsFlat() {
        study::TrackSettings settings;
        settings.crossSections = 3;
        settings.segmentHeight = 20e-3;
        const auto layout = study::buildLayout(settings);
        VERIFY_OK(layout);
        for (const track::CrossSection& section : layout->sections)
            for (const base::Vec2& point : section.points)
                QCOMPARE(point.y(), 10e-3);
        // Three segments of the mean length between lead-in and lead-out.
        const auto x = [&](int section) { return layout->sections[static_cast<std::size_t>(section)].x; };
        QVERIFY(qAbs(x(layout->lastTrapSection) - x(layout->firstTrapSection) -
                     1.5 * (settings.minSegmentLength + settings.maxSegmentLength)) < 1e-12);
        settings.pointsPerSection = 1;
        QVERIFY(!study::buildLayout(settings).ok());
    }

    // What can be known of a staircase before learning is that it falls.
    void layoutOfTrapsThatFallFalls() {
        study::TrackSettings settings;
        settings.traps = "groove, 2 x drop";
        settings.segmentHeight = 200e-3;
        const auto layout = study::buildLayout(settings);
        VERIFY_OK(layout);
        const auto lowest = [&](const track::CrossSection& section) {
            double least = 1.0;
            for (const base::Vec2& point : section.points)
                least = std::min(least, point.y());
            return least;
        };
        QVERIFY(qAbs(lowest(layout->sections.front()) - 100e-3) < 1e-12);
        QVERIFY(qAbs(lowest(layout->sections.back()) - (100e-3 - study::calcTypicalFall(settings))) < 1e-12);
        QCOMPARE(layout->sections.size(), std::size_t{2 + 1 + 2 * 5 + 2});
    }

    // Ledges have their wall before anything is learned.
    void layoutOfLedgesGoesOnWithTheSpiral() {
        study::TrackSettings settings;
        settings.traps = "2 x ledge";
        settings.spiral = {20e-3, 10e-3, 10.0 * base::kDegree};
        const auto layout = study::buildLayout(settings);
        VERIFY_OK(layout);
        QCOMPARE(layout->sections.size(), std::size_t{2 + 2 * 6 + 2});
        const std::vector<base::Vec2>& spiral = layout->sections.front().points;
        for (const track::CrossSection& section : layout->sections)
            for (std::size_t j = 0; j < spiral.size(); ++j)
                QVERIFY((section.points[j] - spiral[j]).norm() < 1e-12);
    }

    void designsOfAnotherLengthAreRefused() {
        const auto track = study::decodeTrack(
            smallSettings(), designOf(std::vector<double>(26, 0.0), std::vector<double>(3, 0.0)));
        QVERIFY(!track.ok());
        QVERIFY2(track.error().message.find("29 numbers, where these settings need 27") != std::string::npos,
                 track.error().message.c_str());
    }

    void smoothingWorksOnPoints() {
        base::Random random({.seed = 3});
        search::Design before(27);
        for (double& number : before)
            number = random.uniform();
        const search::SmoothDesign smooth = study::designSpace(smallSettings()).smooth;
        QVERIFY(smooth(before, 0.0, random) == before);

        // Probability 1: the bilinear patch of the four corners; lengths stay.
        const search::Design after = smooth(before, 1.0, random);
        QCOMPARE(after.size(), before.size());
        const auto at = [](const std::vector<double>& values, std::size_t section, std::size_t point,
                           std::size_t k) { return values[(section * 4 + point) * 2 + k]; };
        for (std::size_t s = 0; s < 3; ++s) {
            for (std::size_t j = 0; j < 4; ++j) {
                for (std::size_t k = 0; k < 2; ++k) {
                    const double u = static_cast<double>(s) / 2.0;
                    const double v = static_cast<double>(j) / 3.0;
                    const double patch = (1 - u) * (1 - v) * at(before, 0, 0, k) +
                                         (1 - u) * v * at(before, 0, 3, k) +
                                         u * (1 - v) * at(before, 2, 0, k) + u * v * at(before, 2, 3, k);
                    QVERIFY(qAbs(at(after, s, j, k) - patch) <= 1e-12);
                }
            }
            QCOMPARE(after[24 + s], before[24 + s]);
        }
    }

    void evolutionSettingsArriveThere() {
        study::EvolutionSettings settings;
        settings.tournamentSize = 9;
        settings.staticMutation = 0.011;
        settings.smoothingLimit = 0.77;
        settings.mutationFloor = 0.003;
        settings.firstGeneration = search::ga::FirstGeneration::random;
        settings.strategyScope = search::ga::StrategyScope::gene;
        settings.populationSize = 17;
        settings.seed = 99;
        QCOMPARE(study::searchParameters(settings).populationSize, 17);
        QCOMPARE(study::searchParameters(settings).seed, std::uint64_t{99});
        const search::ga::GenerationParameters parameters = study::searchParameters(settings).genetic;
        QCOMPARE(parameters.tournamentSize, 9);
        QCOMPARE(parameters.transition.staticMutation, 0.011);
        QCOMPARE(parameters.transition.smoothingLimit, 0.77);
        QCOMPARE(parameters.transition.mutationFloor, 0.003);
        QVERIFY(parameters.first == search::ga::FirstGeneration::random);
        QVERIFY(parameters.scope == search::ga::StrategyScope::gene);
    }
};

QTEST_APPLESS_MAIN(TrackDesignTest)
#include "track_design_test.moc"
