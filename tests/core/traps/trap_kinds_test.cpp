// What every kind of trap must do, whichever it is, and what is a step's own.

#include <QtTest>
#include <array>
#include <cmath>
#include <set>

#include "core/geometry/mesh_check.h"
#include "core/geometry/print_check.h"
#include "core/track/track_builder.h"
#include "core/track/track_solid.h"
#include "core/traps/groove.h"
#include "core/traps/ledge.h"
#include "core/traps/narrowed.h"
#include "core/traps/step.h"
#include "core/traps/trap_chain.h"

using namespace trapwright;
using traps::TrapChain;
using traps::TrapParameters;

namespace {

search::Design drawDesign(const search::DesignSpace& space, std::uint64_t seed) {
    base::Random random({.seed = seed});
    search::Design design;
    for (const search::Dimension& dimension : space.dimensions)
        design.push_back(search::roundToBits(random.uniform(), dimension.bits));
    return design;
}

QString messageOf(const base::Result<TrapChain>& chain) {
    return QString::fromStdString(chain.ok() ? "" : chain.error().message);
}

}  // namespace

class TrapKindsTest : public QObject {
    Q_OBJECT

 private slots:
    void everyKindGivesATrack_data() {
        QTest::addColumn<QString>("chain");
        for (const traps::TrapKind& kind : traps::trapKinds())
            QTest::newRow(kind.key.data()) << QString::fromUtf8(kind.key.data());
        QTest::newRow("several") << "step, free-form,step, groove, drop,drop, cut-out, narrowed, cut-out, "
                                    "gap, slot, narrowed, notched, 2 x notched, ledge, 2 x ledge";
    }
    void everyKindGivesATrack() {
        QFETCH(QString, chain);
        const auto read = traps::readTraps(chain.toStdString());
        QVERIFY2(read.ok(), qPrintable(messageOf(read)));
        const TrapParameters parameters;
        const search::DesignSpace space = traps::designSpace(*read, parameters);
        std::set<std::string> keys;
        for (const search::Dimension& dimension : space.dimensions) {
            keys.insert(dimension.key);
            QVERIFY(dimension.low < dimension.high && !dimension.unit.empty() && dimension.line >= 0);
        }
        QCOMPARE(keys.size(), space.dimensions.size());
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const search::Design design = drawDesign(space, seed);
            const auto sections = traps::build(*read, parameters, design);
            double before = 0.0;
            for (const track::CrossSection& section : sections) {
                QVERIFY(section.x > before);
                before = section.x;
                QCOMPARE(section.points.size(), std::size_t{8});
                for (const base::Vec2& point : section.points)
                    QVERIFY(std::abs(point.x()) <= 30e-3 + 1e-15 && point.y() >= 0.0 && point.y() <= 30e-3);
            }
            QVERIFY(before <= traps::calcLongest(*read, parameters) + 1e-12);
            const auto track = track::buildTrack({}, sections);
            QVERIFY(track.ok());
            QVERIFY(geometry::checkMesh(track->solid).isSolid());
            if (space.smooth) {
                base::Random random({.seed = seed});
                QVERIFY(space.smooth(design, 0.0, random) == design);
                QVERIFY(space.check(space.smooth(design, 0.5, random)).ok());
            }
        }
        const std::vector<double> places = traps::layOut(*read, parameters);
        QCOMPARE(places.size(), traps::build(*read, parameters, drawDesign(space, 1)).size());
        QVERIFY(std::is_sorted(places.begin(), places.end()) && places.front() > 0.0);
    }

    void aStepIsWhatItsNumbersSay() {
        const traps::TrapKind step = traps::step();
        const TrapParameters parameters;
        const auto dimensions = step.dimensions(parameters);
        QCOMPARE(dimensions.size(), std::size_t{3});
        QCOMPARE(dimensions[0].low, -15.0);
        QCOMPARE(dimensions[0].high, 15.0);
        // 5 mm up, half of the lengths, 10 degrees down to the outer edge.
        const std::vector<double> numbers = {20.0 / 30.0, 0.5, 40.0 / 60.0};
        const auto sections = step.build(parameters, traps::levelSection(parameters, 0.0), numbers);
        QCOMPARE(sections.size(), std::size_t{2});
        QVERIFY(std::abs(sections[0].x - 1e-3) < 1e-12);
        QVERIFY(std::abs(sections[1].x - 26.5e-3) < 1e-12);
        for (const track::CrossSection& section : sections) {
            for (const base::Vec2& point : section.points) {
                const double expected = 20e-3 - std::tan(10.0 * base::kDegree) * point.x();
                QVERIFY(std::abs(point.y() - expected) < 1e-12);
            }
        }
        QCOMPARE(sections[0].points.front().x(), -30e-3);
        QCOMPARE(sections[0].points.back().x(), 30e-3);
        // Cut off at the box.
        const auto steep =
            step.build(parameters, traps::levelSection(parameters, 0.0), std::vector<double>{1.0, 0.0, 1.0});
        QCOMPARE(steep[0].points.front().y(), 30e-3);
        QVERIFY(step.smooth == nullptr);
    }

    void aDropIsWhatItsNumbersSay() {
        const traps::TrapKind drop = traps::drop();
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const auto dimensions = drop.dimensions(parameters);
        // 22.5 mm long, falling by 8 degrees, walls of 21 degrees; 6 mm down over 0.5 mm; walls of 42 degrees
        // around y = 5 mm, leaning by 45 degrees outwards, 15 mm long, rising by 6 degrees.
        const std::vector<double> numbers = {7.5 / 21.0, 0.5,  0.5, 0.5, 6.0 / 18.0, 0.0,
                                             1.0,        0.75, 1.0, 0.0, 0.0};
        QCOMPARE(dimensions.size(), numbers.size());
        QCOMPARE(dimensions[4].high, 18.0);
        const double entry = 120e-3;
        const track::CrossSection before = traps::levelSection(parameters, entry);
        const auto sections = drop.build(parameters, before, numbers);
        QCOMPARE(sections.size(), std::size_t{5});
        const double rest = 0.5 * (15e-3 + 36e-3);
        const double xs[] = {22.5e-3, 23e-3, 38e-3, 38e-3 + 0.5 * rest, 38e-3 + rest};
        const double first = entry - 22.5e-3 * std::tan(8.0 * base::kDegree);
        const double behind = first - 6e-3 + 15e-3 * std::tan(6.0 * base::kDegree);
        const double slip = 0.5 * rest * std::tan(traps::kRestingFall);
        const double bottoms[] = {first, first - 6e-3, behind, behind - slip, behind - 2.0 * slip};
        for (std::size_t i = 0; i < 5; ++i) {
            QVERIFY(std::abs(sections[i].x - xs[i]) < 1e-12);
            const base::Vec2 bottom = sections[i].points[4];
            QVERIFY2(std::abs(bottom.y() - bottoms[i]) < 1e-12, qPrintable(QString::number(i)));
            QVERIFY(std::abs(bottom.x() - (i == 1 || i == 2 ? 5e-3 : 0.0)) < 1e-12);
            QCOMPARE(sections[i].points.front().x(), -30e-3);
            QVERIFY(std::abs(sections[i].points.back().x() - 30e-3) < 1e-15);
        }
        const double wall = std::tan(21.0 * base::kDegree);
        QVERIFY(std::abs(sections[0].points.front().y() - (first + 30e-3 * wall)) < 1e-12);
        // Leaning by more than its walls are steep: the inner wall is the higher one by far.
        const double inner = std::tan(42.0 * base::kDegree) + std::tan(45.0 * base::kDegree);
        QVERIFY(std::abs(sections[1].points.front().y() - (bottoms[1] + 35e-3 * inner)) < 1e-12);
        const double resting = std::tan(traps::kRestingWall);
        QVERIFY(std::abs(sections[4].points.back().y() - (bottoms[4] + 30e-3 * resting)) < 1e-12);
        // Cut off at the box.
        for (const track::CrossSection& section :
             drop.build(parameters, traps::levelSection(parameters, 1e-3), numbers)) {
            for (const base::Vec2& point : section.points)
                QVERIFY(point.y() >= 0.0);
        }
    }

    void aCutOutIsWhatItsNumbersSay() {
        const traps::TrapKind cutOut = traps::cutOut();
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const auto dimensions = cutOut.dimensions(parameters);
        QCOMPARE(dimensions.size(), std::size_t{7});
        QCOMPARE(dimensions[4].low, -40.0);
        QCOMPARE(dimensions[4].high, 40.0);
        // 15 mm long, falling by 8 degrees, a wall of 30 degrees, a floor that falls outwards by 10; 20 mm
        // cut away from the outer edge over 18.25 mm.
        std::vector<double> numbers = {0.0, 0.5, 0.5, 0.75, 0.75, 0.5, 0.5};
        const double entry = 120e-3;
        const track::CrossSection before = traps::levelSection(parameters, entry);
        const auto sections = cutOut.build(parameters, before, numbers);
        QCOMPARE(sections.size(), std::size_t{6});
        const double rest = 0.5 * (15e-3 + 36e-3);
        const double xs[] = {15e-3, 15.5e-3, 33.75e-3, 34.25e-3, 34.25e-3 + 0.5 * rest, 34.25e-3 + rest};
        const double outers[] = {30e-3, 10e-3, 10e-3, 30e-3, 30e-3, 30e-3};
        const double fall = std::tan(8.0 * base::kDegree);
        const double wall = std::tan(30.0 * base::kDegree);
        const double floor = std::tan(10.0 * base::kDegree);
        for (std::size_t i = 0; i < 6; ++i) {
            QVERIFY(std::abs(sections[i].x - xs[i]) < 1e-12);
            QVERIFY(std::abs(sections[i].points.back().x() - outers[i]) < 1e-12);
            QCOMPARE(sections[i].points.front().x(), -30e-3);
            if (i > 3) continue;
            // What is left of the surface is what it was.
            for (const base::Vec2& point : sections[i].points) {
                const double y = point.x();
                const double across = y < 0.0 ? -wall * y : -floor * y;
                QVERIFY(std::abs(point.y() - (entry - fall * xs[i] + across)) < 1e-12);
            }
            QVERIFY(std::abs(sections[i].points[4].x()) < 1e-15);
        }
        // From the other side, and beyond the wall's foot: a strip of the wall is left.
        numbers[4] = 0.0;
        const auto inner = cutOut.build(parameters, before, numbers);
        QVERIFY(std::abs(inner[1].points.front().x() - 10e-3) < 1e-12);
        QVERIFY(std::abs(inner[2].points.back().x() - 30e-3) < 1e-12);
        QVERIFY(std::abs(inner[1].points[4].x() - 20e-3) < 1e-12);
        QVERIFY(std::abs(inner[1].points[4].y() - (entry - fall * xs[1] + wall * 20e-3)) < 1e-12);
        // Not cut at all.
        numbers[4] = 0.5;
        for (const track::CrossSection& section : cutOut.build(parameters, before, numbers))
            QVERIFY(section.points.front().x() == -30e-3 &&
                    std::abs(section.points.back().x() - 30e-3) < 1e-15);
    }

    void aGapIsACutOutWithAStep() {
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const traps::TrapKind gap = traps::gap();
        const auto dimensions = gap.dimensions(parameters);
        QCOMPARE(dimensions.size(), std::size_t{8});
        QCOMPARE(dimensions[7].low, -18.0);
        QCOMPARE(dimensions[7].high, 18.0);
        const std::vector<double> numbers = {0.0, 0.5, 0.5, 0.75, 0.75, 0.5, 0.5};
        const double entry = 120e-3;
        const track::CrossSection before = traps::levelSection(parameters, entry);
        const auto level = traps::cutOut().build(parameters, before, numbers);
        const double fall = std::tan(8.0 * base::kDegree);
        const double half = 0.25e-3;
        // The step, the first section that it lowers, and over how many halves of an edge.
        struct Case {
            double step;
            std::size_t first;
            double halves;
        };
        const Case cases[] = {{0.0, 7, 0.0}, {9e-3, 3, 1.0}, {-9e-3, 1, 2.0}};
        for (const Case& one : cases) {
            std::vector<double> stepped = numbers;
            stepped.push_back(0.5 + one.step / 36e-3);
            const auto sections = gap.build(parameters, before, stepped);
            QCOMPARE(sections.size(), level.size() + 1);
            const auto lower = [&](std::size_t i) {
                return i < one.first ? 0.0 : std::abs(one.step) - one.halves * half * fall;
            };
            // The one that the cut-out has not: behind the cut, and as narrow.
            QVERIFY(std::abs(sections[3].x - level[2].x - half) < 1e-12);
            for (std::size_t k = 0; k < sections[3].points.size(); ++k) {
                QVERIFY(std::abs(sections[3].points[k].x() - level[2].points[k].x()) < 1e-12);
                QVERIFY(std::abs(level[2].points[k].y() - sections[3].points[k].y() - lower(3) -
                                 half * fall) < 1e-9);
            }
            for (std::size_t i = 0; i < level.size(); ++i) {
                const std::size_t j = i < 3 ? i : i + 1;
                QVERIFY(std::abs(sections[j].x - level[i].x) < 1e-12);
                for (std::size_t k = 0; k < sections[j].points.size(); ++k) {
                    QVERIFY(std::abs(sections[j].points[k].x() - level[i].points[k].x()) < 1e-12);
                    QVERIFY(std::abs(level[i].points[k].y() - sections[j].points[k].y() - lower(j)) < 1e-9);
                }
            }
        }
    }

    void aGapWithAStepCanBePrinted() {
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const track::CrossSection before = traps::levelSection(parameters, 120e-3);
        for (const double step : {0.75, 0.25}) {
            for (const double cut : {0.75, 0.25}) {
                std::vector<track::CrossSection> sections = traps::gap().build(
                    parameters, before, std::vector<double>{0.0, 0.5, 0.5, 0.75, cut, 0.5, 0.5, step});
                sections.insert(sections.begin(), before);
                const track::FeederShape linear;
                const auto solid = track::buildTrackSolid(linear, sections, 20e-3);
                for (const geometry::SharpRidge& ridge : geometry::findSharpRidges(solid.mesh, {}))
                    QVERIFY2(false, qPrintable(QString("%1 degrees over %2 mm, step %3, cut %4")
                                                   .arg(ridge.angle / base::kDegree)
                                                   .arg(1e3 * ridge.length)
                                                   .arg(step)
                                                   .arg(cut)));
                QVERIFY(geometry::findThinWalls(solid.mesh, {}).empty());
            }
        }
    }

    void aSlotOpensBetweenTwoRails() {
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const traps::TrapKind slot = traps::slot();
        const auto dimensions = slot.dimensions(parameters);
        QCOMPARE(dimensions.size(), std::size_t{9});
        QCOMPARE(dimensions[3].high, 12.0);
        QCOMPARE(dimensions[4].high, 36.0);
        // 25.5 mm before it, falling by 8 degrees, walls of 21; 5 mm wide and 18 deep, open after 18.25 mm,
        // for 43.5; shut again after 18.25 mm, 9 mm lower.
        const std::vector<double> numbers = {0.5, 0.5, 0.5, 5.0 / 12.0, 0.5, 0.5, 0.5, 0.5, 0.25};
        const double entry = 120e-3;
        const auto sections = slot.build(parameters, traps::levelSection(parameters, entry), numbers);
        QCOMPARE(sections.size(), std::size_t{6});
        const double fall = std::tan(8.0 * base::kDegree);
        const double wall = std::tan(21.0 * base::kDegree);
        const std::array<double, 4> xs = {25.5e-3, 43.75e-3, 87.25e-3, 105.5e-3};
        for (std::size_t i = 0; i < xs.size(); ++i) {
            const bool isOpen = i == 1 || i == 2;
            const double rails = entry - fall * xs[std::min<std::size_t>(i, 2)] - (i == 3 ? 9e-3 : 0.0);
            QVERIFY(std::abs(sections[i].x - xs[i]) < 1e-12);
            QCOMPARE(sections[i].points.front().x(), -30e-3);
            QCOMPARE(sections[i].points.back().x(), 30e-3);
            for (std::size_t j = 0; j < 9; ++j) {
                const base::Vec2& point = sections[i].points[j];
                const bool isFloor = j >= 3 && j <= 5;
                const double high = isFloor ? (isOpen ? -18e-3 : wall * 2.5e-3) : wall * std::abs(point.x());
                QVERIFY(std::abs(point.y() - rails - high) < 1e-12);
            }
            for (const std::size_t side : {3, 5})
                QVERIFY(std::abs(std::abs(sections[i].points[side].x()) - 2.5e-3) < 1e-12);
            for (const std::size_t side : {2, 6})
                QVERIFY(std::abs(std::abs(sections[i].points[side].x()) - 2.6e-3) < 1e-12);
        }
        // No width: a groove.
        std::vector<double> shut = numbers;
        shut[3] = 0.0;
        for (const track::CrossSection& section :
             slot.build(parameters, traps::levelSection(parameters, entry), shut))
            QCOMPARE(section.points[4].y(), traps::findLowest(section));
    }

    void railsAreASlotThatDoesNotEnd() {
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const track::CrossSection before = traps::levelSection(parameters, 120e-3);
        const std::vector<double> numbers = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.25};
        const auto slot = traps::slot().build(parameters, before, numbers);
        QCOMPARE(traps::rails().dimensions(parameters).size(), std::size_t{7});
        const auto rails = traps::rails().build(parameters, before, std::span(numbers).first(7));
        QCOMPARE(rails.size(), std::size_t{3});
        for (std::size_t i = 0; i < rails.size(); ++i)
            QVERIFY(rails[i].x == slot[i].x && rails[i].points == slot[i].points);
        QVERIFY(traps::readTraps("groove, groove, slot, rails").ok());
        for (const char* text : {"rails, groove", "groove, 2 x rails", "narrow rails, groove"}) {
            const auto read = traps::readTraps(text);
            QVERIFY(!read.ok());
            QVERIFY(read.error().message.find("they come last") != std::string::npos);
        }
    }

    // Rails, and then of the track two level ones alone, as wide as is said.
    void narrowRailsAreCutFromBothSides() {
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const track::CrossSection before = traps::levelSection(parameters, 120e-3);
        const std::vector<double> numbers(11, 0.5);
        QCOMPARE(traps::narrowRails().dimensions(parameters).size(), numbers.size());
        const auto rails = traps::rails().build(parameters, before, std::span(numbers).first(7));
        const auto narrow = traps::narrowRails().build(parameters, before, numbers);
        QCOMPARE(narrow.size(), rails.size() + 3);
        for (std::size_t i = 0; i < rails.size(); ++i)
            QVERIFY(narrow[i].x == rails[i].x && narrow[i].points == rails[i].points);
        const double foot = rails.back().points[5].x();
        QVERIFY(foot > 0.0);
        // Beside it walls come down.
        QCOMPARE(narrow[rails.size()].points.back().x(), 0.5 * parameters.segmentWidth);
        for (std::size_t i = rails.size() + 1; i < narrow.size(); ++i) {
            const std::vector<base::Vec2>& points = narrow[i].points;
            QVERIFY(std::abs(points.back().x() - foot - 0.5 * (1.5e-3 + parameters.segmentWidth / 12.0)) <
                    1e-12);
            QCOMPARE(points.front().x(), -points.back().x());
            // Beside the slot as much lower as the track has fallen, and from there on a roof.
            const double fallen = rails.back().points[4].y() - points[4].y();
            QVERIFY(std::abs(points[6].y() - (rails.back().points[6].y() - fallen)) < 0.2e-3);
            const double roof =
                std::atan2(points[6].y() - points.back().y(), points.back().x() - points[6].x());
            QVERIFY(std::abs(roof - 28.5 * base::kDegree) < 1e-9);
            QVERIFY(std::abs(points.front().y() - points.back().y()) < 1e-12);
        }
    }

    void narrowRailsBetweenWallsCanBePrinted() {
        TrapParameters parameters;
        parameters.segmentWidth = 32e-3;
        parameters.segmentHeight = 120e-3;
        parameters.walls = {6e-3, 6e-3};
        parameters.pointsPerSection = 9;
        const traps::TrapKind kind = traps::narrowRails();
        for (const double narrowing : {0.0, 0.5, 1.0}) {
            std::vector<double> numbers(kind.dimensions(parameters).size(), 0.5);
            numbers[7] = narrowing;
            const auto sections = kind.build(parameters, traps::levelSection(parameters, 60e-3), numbers);
            const track::Track track = *track::buildTrack(parameters, sections);
            const auto walls = geometry::findThinWalls(track.solid, {});
            QVERIFY2(walls.empty(),
                     qPrintable(QString("%1 walls, narrowing %2").arg(walls.size()).arg(narrowing)));
        }
    }

    void aSlotCanBePrinted() {
        TrapParameters parameters;
        parameters.segmentHeight = 200e-3;
        parameters.pointsPerSection = 9;
        const track::CrossSection before = traps::levelSection(parameters, 120e-3);
        for (const double end : {0.0, 1.0}) {
            for (const double step : {0.0, 0.5, 1.0}) {
                std::vector<track::CrossSection> sections = traps::slot().build(
                    parameters, before, std::vector<double>{0.5, 0.5, 0.5, 0.5, 0.5, 0.0, 0.5, end, step});
                sections.insert(sections.begin(), before);
                const track::FeederShape linear;
                const auto solid = track::buildTrackSolid(linear, sections, 20e-3);
                for (const geometry::SharpRidge& ridge : geometry::findSharpRidges(solid.mesh, {}))
                    QVERIFY2(false, qPrintable(QString("%1 degrees over %2 mm, end %3, step %4")
                                                   .arg(ridge.angle / base::kDegree)
                                                   .arg(1e3 * ridge.length)
                                                   .arg(end)
                                                   .arg(step)));
                QVERIFY(geometry::findThinWalls(solid.mesh, {}).empty());
            }
        }
    }

    // What follows a trap that falls begins where that one ends.
    void trapsFollowEachOtherDown() {
        TrapParameters parameters;
        parameters.segmentHeight = 400e-3;
        const auto chain = traps::readTraps("groove, 3 x drop");
        QVERIFY(chain.ok());
        const search::Design typical(traps::designSpace(*chain, parameters).dimensions.size(), 0.5);
        const auto sections = traps::build(*chain, parameters, typical);
        QCOMPARE(sections.size(), std::size_t{1 + 3 * 5});
        const auto bottom = [&](std::size_t i) { return sections[i].points[4].y(); };
        QVERIFY(bottom(0) < 200e-3);
        const double fall = bottom(0) - bottom(5);
        QVERIFY(fall > 9e-3);
        QVERIFY(std::abs(bottom(5) - bottom(10) - fall) < 1e-12);
        QVERIFY(std::abs(bottom(10) - bottom(15) - fall) < 1e-12);
    }

    void aNarrowedTrackGoesOnCutAway() {
        const traps::TrapKind narrowed = traps::narrowed();
        const TrapParameters parameters;
        track::CrossSection before{0.0, {}};
        for (int j = 0; j < 8; ++j)
            before.points.emplace_back(60e-3 * (j / 7.0 - 0.5), 10e-3 + 1e-3 * (j % 3));
        // Not inclined, cut by 10 mm from the inner edge, not at all from the outer, for 18.25 mm.
        const std::vector<double> numbers = {0.5, 0.625, 0.3, 0.5, 0.5};
        const auto sections = narrowed.build(parameters, before, numbers);
        QCOMPARE(sections.size(), std::size_t{4});
        const double begin = 0.5 * (15e-3 + 36e-3);
        const double length = 0.5 * (0.5e-3 + 36e-3);
        const std::array<double, 4> xs = {begin, begin + 0.5e-3, begin + 0.5e-3 + length,
                                          begin + 1e-3 + length};
        for (std::size_t i = 0; i < 4; ++i) {
            const bool isCut = i == 1 || i == 2;
            QVERIFY(std::abs(sections[i].x - xs[i]) < 1e-12);
            QVERIFY(std::abs(sections[i].points.front().x() - (isCut ? -20e-3 : -30e-3)) < 1e-12);
            QVERIFY(std::abs(sections[i].points.back().x() - 30e-3) < 1e-12);
            for (const base::Vec2& point : sections[i].points)
                QVERIFY(std::abs(point.y() - traps::heightAt(before, point.x())) < 1e-12);
            if (!isCut) QVERIFY(sections[i].points == before.points);
        }
        // Inclined by 10 degrees, down to the outer edge.
        const auto inclined =
            narrowed.build(parameters, before, std::vector<double>{0.5, 0.0, 0.0, 0.5, 0.75});
        for (std::size_t j = 0; j < 8; ++j) {
            const base::Vec2& point = before.points[j];
            const double z = point.y() - std::tan(10.0 * base::kDegree) * point.x();
            QVERIFY(std::abs(inclined[2].points[j].y() - z) < 1e-12);
        }
        // Something is left where both cuts would meet.
        const auto least = narrowed.build(parameters, before, std::vector<double>{0.5, 1.0, 1.0, 0.5, 0.5});
        QVERIFY(std::abs(least[1].points.front().x() + 1.5e-3) < 1e-12);
        QVERIFY(std::abs(least[1].points.back().x() - 1.5e-3) < 1e-12);
    }

    void aNotchedTrackIsWhatItsNumbersSay() {
        const traps::TrapKind notched = traps::notched();
        const TrapParameters parameters;
        // A groove with its bottom at y = 0, z = 10 mm, and walls of 45 degrees.
        track::CrossSection before{0.0, {}};
        for (const double y : {-12.0, -6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0})
            before.points.emplace_back(1e-3 * y, 10e-3 + 1e-3 * std::abs(y));
        const auto lip = [](double millimetres) { return (millimetres + 6.0) / 21.0; };
        // Falls by 4.5 degrees, an inner lip of 4 mm, no outer notch, 5 mm lower behind it, not inclined.
        const auto upright = notched.build(
            parameters, before, std::vector<double>{0.5, 0.5, lip(4.0), 1.0, 0.0, 0.5, 1.0, 0.5, 0.25, 0.5});
        QCOMPARE(upright.size(), std::size_t{4});
        const double begin = 0.5 * (15e-3 + 36e-3);
        const double fall = begin * std::tan(4.5 * base::kDegree);
        const std::array<double, 4> xs = {begin, begin + 0.5e-3, begin + 0.5e-3 + 18.25e-3,
                                          begin + 0.5e-3 + 18.25e-3 + 18e-3};
        for (std::size_t i = 0; i < 4; ++i) {
            QVERIFY(std::abs(upright[i].x - xs[i]) < 1e-12);
            const bool isCut = i == 1 || i == 2;
            QVERIFY(std::abs(upright[i].points.front().x() - (isCut ? -4e-3 : -12e-3)) < 1e-12);
            QVERIFY(std::abs(upright[i].points.back().x() - 12e-3) < 1e-12);
            const double lower = fall + (i == 3 ? 5e-3 : 0.0);
            for (const base::Vec2& point : upright[i].points)
                QVERIFY(std::abs(point.y() - traps::heightAt(before, point.x()) + lower) < 1e-12);
        }
        // Cut 2 mm beyond the lowest point, an outer lip of 7 mm, lower by more than there is room for.
        const auto beyond =
            notched.build(parameters, before,
                          std::vector<double>{0.5, 0.5, lip(-2.0), lip(7.0), 0.5, 0.5, 0.5, 0.0, 0.0, 0.5});
        QVERIFY(std::abs(beyond[1].points.front().x() - 2e-3) < 1e-12);
        QVERIFY(std::abs(beyond[1].points.back().x() - 7e-3) < 1e-12);
        QVERIFY(std::abs(beyond[3].points[3].y()) < 1e-12);
        for (std::size_t j = 0; j < 8; ++j)
            QVERIFY(std::abs(beyond[3].points[j].y() - before.points[j].y() + 10e-3) < 1e-12);
        // Something is left where both cuts would meet; a rise beside the notch.
        const auto least = notched.build(
            parameters, before, std::vector<double>{0.5, 0.5, 0.0, 0.0, 0.5, 0.5, 0.5, 0.75, 0.5, 0.5});
        QVERIFY(std::abs(least[1].points.front().x() + 0.6e-3) < 1e-12);
        QVERIFY(std::abs(least[1].points.back().x() - 0.6e-3) < 1e-12);
        QVERIFY(std::abs(least[1].points.front().y() - (10e-3 + 0.6e-3 - fall + 5e-3)) < 1e-12);
    }

    /// Points that a cut leaves stay where and which they are: what lies on them goes on as if there were
    /// none. The others share what is left of the way to the cut edge.
    void aCutLeavesTheRestAsItIs() {
        const TrapParameters parameters;
        track::CrossSection before{0.0, {}};
        for (int j = 0; j < 8; ++j)
            before.points.emplace_back(60e-3 * (j / 7.0 - 0.5), 10e-3 + 1e-3 * (j % 3));
        for (int inner = 0; inner <= 127; inner += 3) {
            for (int outer = 0; outer <= 127; outer += 7) {
                const auto sections = traps::narrowed().build(
                    parameters, before, std::vector<double>{0.5, inner / 127.0, outer / 127.0, 0.5, 0.5});
                const std::vector<base::Vec2>& points = sections[1].points;
                const double first = points.front().x();
                const double last = points.back().x();
                QVERIFY(last - first >= 3e-3 - 1e-12);
                for (std::size_t j = 0; j < 8; ++j) {
                    QVERIFY(std::abs(points[j].y() - traps::heightAt(before, points[j].x())) < 1e-12);
                    if (j > 0) QVERIFY(points[j].x() > points[j - 1].x() + 1e-7);
                    const double y = before.points[j].x();
                    if (y > first + 11e-6 && y < last - 11e-6) QCOMPARE(points[j], before.points[j]);
                }
                QVERIFY(track::buildTrack({}, sections).ok());
            }
        }
    }

    // Points anywhere make sections that go back across the track; also of those something is left.
    void aNarrowedTrackFollowsAnySection() {
        TrapParameters parameters;
        parameters.encoding = traps::PointEncoding::free;
        const auto chain = traps::readTraps("free-form, narrowed").value();
        const search::DesignSpace space = traps::designSpace(chain, parameters);
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto sections = traps::build(chain, parameters, drawDesign(space, seed));
            for (const track::CrossSection& section : sections) {
                QCOMPARE(section.points.size(), std::size_t{8});
                for (const base::Vec2& point : section.points)
                    QVERIFY(std::abs(point.x()) <= 30e-3 + 1e-15 && point.y() >= 0.0 && point.y() <= 30e-3);
            }
            QVERIFY(track::buildTrack({}, sections).ok());
        }
        const track::CrossSection upright{0.0, std::vector(8, base::Vec2(5e-3, 5e-3))};
        const auto cut =
            traps::narrowed().build(parameters, upright, std::vector<double>{0.5, 1.0, 1.0, 0.5, 0.5});
        for (const track::CrossSection& section : cut)
            QVERIFY(section.points == upright.points);
    }

    /// Where a cut takes the wall along: neither what is left of the wall nor the neck.
    void aLedgeWithoutItsWallIsThickEnoughToPrint() {
        TrapParameters parameters;
        parameters.spiral = {20e-3, 10e-3, 10.0 * base::kDegree};
        const track::CrossSection before = track::makeLeadIn(parameters, 0.0, 8);
        const auto cut = [](double millimetres) { return 0.5 + millimetres / 40.0; };
        // Down to 1.2 mm at the beginning, 4 mm from the wall; from there wider, along the wall.
        const std::vector<track::CrossSection> sections = traps::ledge().build(
            parameters, before,
            std::vector<double>{0.5, 0.4, cut(19.0), cut(4.0), 0.8, cut(5.0), 0.5, 0.4, 0.5});
        const track::FeederShape linear;
        const auto solid = track::buildTrackSolid(linear, sections, 20e-3);
        for (const geometry::ThinWall& wall : geometry::findThinWalls(solid.mesh, {}))
            QVERIFY2(false,
                     qPrintable(QString("%1 mm over %2 mm2").arg(1e3 * wall.thickness).arg(1e6 * wall.area)));
    }

    void aLedgeIsWhatItsNumbersSay() {
        const traps::TrapKind ledge = traps::ledge();
        TrapParameters parameters;
        parameters.spiral = {20e-3, 10e-3, 10.0 * base::kDegree};
        const auto dimensions = ledge.dimensions(parameters);
        QCOMPARE(dimensions.size(), std::size_t{9});
        QCOMPARE(dimensions[2].low, -20.0);
        QCOMPARE(dimensions[2].high, 20.0);
        const track::CrossSection before = track::makeLeadIn(parameters, 0.0, 8);
        const double fall = std::tan(10.0 * base::kDegree);
        const double foot = 15e-3 - 10e-3 * fall;
        const auto isOnLedge = [&](const base::Vec2& point, double below) {
            return std::abs(point.y() - (foot - below + fall * (10e-3 - point.x()))) < 1e-12;
        };
        const auto cut = [](double millimetres) { return 0.5 + millimetres / 40.0; };
        // 10 mm of its width at the beginning; 15 mm and, with the wall, 2 mm at the end; then 3 mm lower.
        const auto narrow =
            ledge.build(parameters, before,
                        std::vector<double>{0.5, 0.0, cut(10.0), 0.5, 0.5, cut(15.0), cut(2.0), 1.0, 0.75});
        QCOMPARE(narrow.size(), std::size_t{6});
        const std::array<double, 6> xs = {25.5e-3, 26e-3, 26.5e-3, 44.75e-3, 45.25e-3, 63.25e-3};
        const std::array<double, 6> inners = {-10e-3, 0.0, 0.0, 5e-3, 5e-3, -10e-3};
        for (std::size_t i = 0; i < 6; ++i) {
            const double below = i == 5 ? 3e-3 : 0.0;
            const bool hasWall = i < 3 || i == 5;
            const std::vector<base::Vec2>& points = narrow[i].points;
            QVERIFY(std::abs(narrow[i].x - xs[i]) < 1e-12);
            QCOMPARE(points.size(), std::size_t{8});
            QVERIFY(std::abs(points.front().x() - inners[i]) < 1e-12);
            for (std::size_t j = 0; j < (hasWall ? 6 : 8); ++j)
                QVERIFY(isOnLedge(points[j], below));
            if (!hasWall) {
                // The wall is as low as the ledge, and as thick as can be printed.
                QVERIFY(std::abs(points[5].x() - 8e-3) < 1e-12);
                QVERIFY(std::abs(points[6].x() - 8.2e-3) < 1e-12);
                QVERIFY(std::abs(points[7].x() - 9.4e-3) < 1e-12);
                continue;
            }
            QVERIFY(std::abs(points[5].x() - 10e-3) < 1e-12);
            for (const base::Vec2& top : {points[6], points[7]})
                QVERIFY(std::abs(top.y() - (foot - below + 10e-3)) < 1e-12);
            QVERIFY(std::abs(points[6].x() - 10.2e-3) < 1e-12 && std::abs(points[7].x() - 12.2e-3) < 1e-12);
        }
        // What is left at the wall and what is left at the inner edge have nothing in common: a gap, between
        // whose edges there is nothing but a thread far below.
        const auto gap =
            ledge.build(parameters, before,
                        std::vector<double>{0.5, 0.0, cut(20.0), 0.5, 0.5, 0.5, cut(16.0), 1.0, 0.25});
        QVERIFY(std::abs(gap[1].points.front().x() - 9.7e-3) < 1e-12);
        QVERIFY(isOnLedge(gap[1].points.front(), 3e-3));
        for (const std::size_t i : {2, 3}) {
            QVERIFY(std::abs(gap[i].points.front().x() + 10e-3) < 1e-12);
            QVERIFY(std::abs(gap[i].points.back().x() + 7.4e-3) < 1e-12);
            QVERIFY(gap[i].points.front().y() < foot - 9e-3);
        }
        QVERIFY(std::abs(gap[4].points[5].x() + 6e-3) < 1e-12);
        QVERIFY(isOnLedge(gap[4].points.back(), 3e-3) && isOnLedge(gap[5].points.front(), 3e-3));
    }

    // All in the middle, as it is rounded to bits, is the spiral as it was.
    void aLedgeThatIsNotCutGoesOnWithTheSpiral() {
        TrapParameters parameters;
        parameters.spiral = {20e-3, 10e-3, 10.0 * base::kDegree};
        const track::CrossSection before = track::makeLeadIn(parameters, 0.0, 8);
        std::vector<double> numbers;
        for (const search::Dimension& dimension : traps::ledge().dimensions(parameters))
            numbers.push_back(dimension.isRelief ? search::roundToBits(0.5, dimension.bits) : 0.3);
        for (const track::CrossSection& section : traps::ledge().build(parameters, before, numbers)) {
            for (std::size_t j = 0; j < 8; ++j)
                QVERIFY((section.points[j] - before.points[j]).norm() < 0.05e-3);
        }
    }

    // Its wall's foot is at the lowest point of what comes before: of a groove its bottom; of a level track
    // as far out as there is room for a wall.
    void aLedgeFollowsWhateverComesBefore() {
        TrapParameters parameters;
        track::CrossSection groove{0.0, {}};
        for (const double y : {-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 25.0, 30.0})
            groove.points.emplace_back(1e-3 * y, 5e-3 + 0.5e-3 * std::abs(y));
        const std::vector<double> whole(9, 0.5);
        const auto behindGroove = traps::ledge().build(parameters, groove, whole);
        QCOMPARE(behindGroove.front().points.front().x(), -30e-3);
        QVERIFY((behindGroove.front().points[5] - base::Vec2(0.0, 5e-3)).norm() < 1e-12);
        const auto behindLevel =
            traps::ledge().build(parameters, traps::levelSection(parameters, 15e-3), whole);
        QVERIFY((behindLevel.front().points[5] - base::Vec2(27.8e-3, 15e-3)).norm() < 1e-12);
    }

    void chainsAreReadFromText() {
        const auto chain = traps::readTraps(" step,free-form ");
        QVERIFY(chain.ok());
        QCOMPARE(chain->size(), std::size_t{2});
        QCOMPARE((*chain)[0]->key, std::string_view("step"));
        QCOMPARE(traps::describe(*chain), std::string("Step, free form"));
        QVERIFY(
            messageOf(traps::readTraps("shelf"))
                .contains("no kind of trap named \"shelf\". The kinds are: free-form, step, groove, drop, "
                          "cut-out"));
        const auto repeated = traps::readTraps("groove, 2 x drop, drop, 1xstep");
        QVERIFY2(repeated.ok(), qPrintable(messageOf(repeated)));
        QCOMPARE(repeated->size(), std::size_t{5});
        QCOMPARE(traps::describe(*repeated), std::string("Groove, 3 x drop, step"));
        QVERIFY(traps::readTraps("100 x step").ok());
        QVERIFY(messageOf(traps::readTraps("step, 100 x step")).contains("makes more traps; a track may"));
        QVERIFY(messageOf(traps::readTraps("0 x step")).contains("makes no traps"));
        for (const char* wrong : {"3 x", "3 drop", "x drop", "-1 x drop", "99999999999999999999999 x drop"})
            QVERIFY2(messageOf(traps::readTraps(wrong)).contains("no kind of trap"), wrong);
        QVERIFY(messageOf(traps::readTraps("")).contains("named \"\""));
        QVERIFY(messageOf(traps::readTraps("step,")).contains("named \"\""));
        const search::DesignSpace space = traps::designSpace(*chain, {});
        QCOMPARE(space.dimensions[0].key, std::string("trap 1: height"));
        QCOMPARE(space.dimensions[3].key, std::string("trap 2: section 1, point 1, y"));
        QVERIFY(space.dimensions[3].line > space.dimensions[2].line);
        // A step has nothing to be smoothed, what follows it has.
        base::Random random({.seed = 4});
        const search::Design design = drawDesign(space, 2);
        const search::Design smoothed = space.smooth(design, 1.0, random);
        QVERIFY(std::equal(design.begin(), design.begin() + 3, smoothed.begin()));
        QVERIFY(design != smoothed);
        QVERIFY(!traps::designSpace({(*chain)[0]}, {}).smooth);
    }
};

QTEST_APPLESS_MAIN(TrapKindsTest)
#include "trap_kinds_test.moc"
