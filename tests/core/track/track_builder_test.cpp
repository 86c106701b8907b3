#include "core/track/track_builder.h"

#include <QtTest>
#include <map>
#include <set>

#include "track_scenes.h"

using namespace trapwright;
using track::Conveying;
using track::CrossSection;
using track::FeederShape;
using track::TrackParameters;
using traps::PointEncoding;
using traps::TrapParameters;

Q_DECLARE_METATYPE(FeederShape)
Q_DECLARE_METATYPE(TrapParameters)
Q_DECLARE_METATYPE(TrackParameters)

namespace {

double calcVolume(const geometry::TriangleMesh& mesh) {
    double volume = 0.0;
    for (const auto& t : mesh.triangles) {
        const auto& v = mesh.vertices;
        volume += v[static_cast<std::size_t>(t[0])].dot(
                      v[static_cast<std::size_t>(t[1])].cross(v[static_cast<std::size_t>(t[2])])) /
                  6.0;
    }
    return volume;
}

// Every edge belongs to two triangles that run through it in opposite directions.
bool isClosedManifold(const geometry::TriangleMesh& mesh) {
    std::map<std::pair<int, int>, int> edges;
    std::set<int> used;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] == t[(k + 1) % 3]) return false;
            ++edges[{t[k], t[(k + 1) % 3]}];
            used.insert(t[k]);
        }
    }
    for (const auto& [edge, count] : edges) {
        const auto opposite = edges.find({edge.second, edge.first});
        if (count != 1 || opposite == edges.end()) return false;
    }
    // A ball: V - E + F = 2.
    const auto v = static_cast<int>(used.size());
    const auto e = static_cast<int>(edges.size()) / 2;
    const auto f = static_cast<int>(mesh.triangles.size());
    return v == static_cast<int>(mesh.vertices.size()) && v - e + f == 2;
}

track::Track build(const TrackParameters& parameters, const std::vector<CrossSection>& trap) {
    auto result = track::buildTrack(parameters, trap);
    if (!result.ok()) qFatal("%s", result.error().message.c_str());
    return *result;
}

std::vector<CrossSection> flatTrap(double z, double length) {
    CrossSection section{length, {}};
    for (const double y : {-30e-3, -10e-3, 10e-3, 30e-3})
        section.points.emplace_back(y, z);
    return {section};
}

}  // namespace

class TrackBuilderTest : public QObject {
    Q_OBJECT

    static void addShapes() {
        QTest::addColumn<FeederShape>("shape");
        QTest::newRow("linear") << FeederShape{};
        QTest::newRow("clockwise") << testing::makeBowl(Conveying::clockwise);
        QTest::newRow("anticlockwise") << testing::makeBowl(Conveying::anticlockwise);
    }

 private slots:
    void layout() {
        const auto trap = testing::drawTrap({}, 7);
        const auto track = build({}, trap);
        QCOMPARE(track.sections.size(), std::size_t{2 + 5 + 2});
        QCOMPARE(track.begin(), 0.0);
        QCOMPARE(track.firstTrapSection, 1);
        QCOMPARE(track.lastTrapSection, 6);
        QCOMPARE(track.sections[1].x, 80e-3);
        QCOMPARE(track.start, 60e-3);
        for (std::size_t i = 0; i < 2; ++i) {
            for (const auto& point : track.sections[i].points)
                QCOMPARE(point.y(), 15e-3);
            QCOMPARE(track.sections[i].points.front().x(), -30e-3);
            QCOMPARE(track.sections[i].points.back().x(), 30e-3);
        }
        for (std::size_t i = 0; i < trap.size(); ++i) {
            QCOMPARE(track.sections[2 + i].x, 80e-3 + trap[i].x);
            QCOMPARE(track.sections[2 + i].points, trap[i].points);
        }
        for (const std::size_t i : {7U, 8U}) {
            QCOMPARE(track.sections[i].points, trap.back().points);
            QVERIFY(std::abs(track.sections[i].x - track.sections[i - 1].x - 36e-3) < 1e-15);
        }
        QVERIFY(std::abs(track.finish - 0.5 * (track.sections[7].x + track.sections[8].x)) < 1e-15);
        // 8 segments of 7 quads each.
        QCOMPARE(track.surfaceTriangles, std::size_t{8 * 7 * 2});
    }

    void splitsQuadsAsFigure2() {
        const auto track = build({}, testing::drawTrap(TrapParameters{}, 7));
        const auto& mesh = track.solid;
        const auto point = [&](std::size_t i, std::size_t j) {
            const auto& section = track.sections[i];
            return base::Vec3(section.x, section.points[j].x(), section.points[j].y());
        };
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t j = 0; j < 7; ++j) {
                const std::array expected = {point(i, j),     point(i + 1, j), point(i, j + 1),
                                             point(i, j + 1), point(i + 1, j), point(i + 1, j + 1)};
                const std::size_t first = 2 * (i * 7 + j);
                for (std::size_t k = 0; k < 6; ++k) {
                    const int vertex = mesh.triangles[first + k / 3][k % 3];
                    QCOMPARE(mesh.vertices[static_cast<std::size_t>(vertex)], expected[k]);
                }
            }
        }
    }

    void solidIsClosed_data() {
        QTest::addColumn<FeederShape>("shape");
        QTest::addColumn<TrapParameters>("form");
        const std::pair<const char*, FeederShape> shapes[] = {
            {"linear", {}},
            {"clockwise", testing::makeBowl(Conveying::clockwise)},
            {"anticlockwise", testing::makeBowl(Conveying::anticlockwise)},
            {"clockwise, climbs", testing::makeBowl(Conveying::clockwise, 3.0 * base::kDegree)},
            {"anticlockwise, climbs", testing::makeBowl(Conveying::anticlockwise, 15.0 * base::kDegree)},
            {"clockwise, falls", testing::makeBowl(Conveying::clockwise, -15.0 * base::kDegree)}};
        TrapParameters twoPoints;
        twoPoints.crossSections = 1;
        twoPoints.pointsPerSection = 2;
        for (const auto& [name, shape] : shapes) {
            for (const auto points : {PointEncoding::strip, PointEncoding::free}) {
                TrapParameters form;
                form.encoding = points;
                QTest::addRow("%s, %s", name, points == PointEncoding::strip ? "strip" : "free")
                    << shape << form;
            }
            QTest::addRow("%s, two points", name) << shape << twoPoints;
        }
    }
    void solidIsClosed() {
        QFETCH(FeederShape, shape);
        QFETCH(TrapParameters, form);
        TrackParameters parameters;
        parameters.shape = shape;
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const auto track = build(parameters, testing::drawTrap(form, seed));
            QVERIFY(isClosedManifold(track.solid));
            if (form.encoding == PointEncoding::free) continue;
            QVERIFY(calcVolume(track.solid) > 0.0);
            for (std::size_t t = 0; t < track.solid.triangles.size(); ++t) {
                const base::Vec3 normal = geometry::triangleNormal(track.solid, t);
                QVERIFY(normal.norm() > 0.5);
                if (t < track.surfaceTriangles) QVERIFY(normal.z() > 0.0);
                // Sides and ends are upright, the base looks down.
                if (t >= track.surfaceTriangles)
                    QVERIFY(std::abs(normal.z()) < 1e-9 || normal.z() < -1.0 + 1e-12);
            }
        }
    }

    // The volume under a surface over the triangulated (x, y) plane: prisms down to the base.
    void volumeIsThatUnderTheSurface_data() { addShapes(); }
    void volumeIsThatUnderTheSurface() {
        QFETCH(FeederShape, shape);
        TrackParameters parameters;
        parameters.shape = shape;
        const auto track = build(parameters, testing::drawTrap(TrapParameters{}, 11));
        double volume = 0.0;
        for (std::size_t t = 0; t < track.surfaceTriangles; ++t) {
            const auto& triangle = track.solid.triangles[t];
            base::Vec3 v[3];
            for (std::size_t k = 0; k < 3; ++k)
                v[k] = track.solid.vertices[static_cast<std::size_t>(triangle[k])];
            const double area = 0.5 * (v[1] - v[0]).cross(v[2] - v[0]).z();
            volume += area * ((v[0].z() + v[1].z() + v[2].z()) / 3.0 + parameters.baseThickness);
        }
        QVERIFY(std::abs(calcVolume(track.solid) / volume - 1.0) < 1e-12);
    }

    // A sloped linear track lies in its own axes; only gravity leans.
    void whatIsBelowTheSurface_data() { addShapes(); }
    void whatIsBelowTheSurface() {
        QFETCH(FeederShape, shape);
        // The surface is 20 mm high, over the middle third of its width alone, with an overhang beside it
        // that comes back at 5 mm: below its lip is air.
        CrossSection section{40e-3, {}};
        for (const auto& [y, z] : std::vector<std::pair<double, double>>{
                 {-30e-3, 0.0}, {-10e-3, 0.0}, {-10e-3, 20e-3}, {20e-3, 20e-3}, {10e-3, 5e-3}, {30e-3, 0.0}})
            section.points.emplace_back(y, z);
        TrackParameters parameters;
        parameters.shape = shape;
        CrossSection begin = section;
        begin.x = 1e-3;
        const auto track = build(parameters, {begin, section});
        const double x = track.sections[2].x + 20.1e-3;
        const auto isBelow = [&](double y, double z) {
            return track::isBelowSurface(track, track.shape.toRoom({x, y, z}));
        };
        QVERIFY(isBelow(0.3e-3, 19e-3));
        QVERIFY(isBelow(0.3e-3, -2e-3));
        QVERIFY(isBelow(15.3e-3, 1e-3));
        QVERIFY(isBelow(15.3e-3, 16e-3));
        QVERIFY(!isBelow(15.3e-3, 8e-3));  // below the lip
        QVERIFY(!isBelow(0.3e-3, 21e-3));
        QVERIFY(!isBelow(-20.3e-3, 0.5e-3));
        QVERIFY(isBelow(-20.3e-3, -0.5e-3));
        QVERIFY(!isBelow(31.3e-3, -2e-3));
        QVERIFY(!isBelow(-31.3e-3, -2e-3));
        // On the line that its two halves share, seen from above, too.
        const auto& [a, b, c] = track.solid.triangles[0];
        const base::Vec3 shared = 0.5 * (track.solid.vertices[b] + track.solid.vertices[c]);
        QVERIFY(track::isBelowSurface(track, shared - base::Vec3(0.0, 0.0, 1e-3)));
        QVERIFY(!track::isBelowSurface(track, shared + base::Vec3(0.0, 0.0, 1e-3)));
    }

    void aTiltedFeederHasTheSameSolid() {
        TrackParameters parameters;
        const auto trap = testing::drawTrap(TrapParameters{}, 5);
        const auto level = build(parameters, trap);
        parameters.shape.slope = 10.0 * base::kDegree;
        const auto tilted = build(parameters, trap);
        QCOMPARE(tilted.shape.slope, 10.0 * base::kDegree);
        QCOMPARE(tilted.solid.vertices, level.solid.vertices);
        QCOMPARE(tilted.solid.triangles, level.solid.triangles);
    }

    // On a bowl the surface climbs by x tan(slope), and the base is flat, so thick below its lowest place.
    void aBowlsTrackClimbs_data() {
        QTest::addColumn<Conveying>("conveying");
        QTest::addColumn<double>("degrees");
        for (const double degrees : {3.0, -3.0, 15.0}) {
            QTest::addRow("clockwise, %g deg", degrees) << Conveying::clockwise << degrees;
            QTest::addRow("anticlockwise, %g deg", degrees) << Conveying::anticlockwise << degrees;
        }
    }
    void aBowlsTrackClimbs() {
        QFETCH(Conveying, conveying);
        QFETCH(double, degrees);
        TrackParameters parameters;
        parameters.shape = testing::makeBowl(conveying);
        const auto trap = testing::drawTrap(TrapParameters{}, 5);
        const auto level = build(parameters, trap);
        parameters.shape.slope = degrees * base::kDegree;
        const auto climbing = build(parameters, trap);
        QCOMPARE(climbing.solid.triangles, level.solid.triangles);
        const double pitch = std::tan(degrees * base::kDegree);
        const double lowest = std::min(0.0, pitch * climbing.end());
        double near = 0.0;
        for (std::size_t i = 0; i < level.solid.vertices.size(); ++i) {
            const base::Vec3& before = level.solid.vertices[i];
            const base::Vec3& after = climbing.solid.vertices[i];
            QVERIFY((before - after).head<2>().norm() < 1e-15);
            near = level.shape.toTrack(before, near).x();
            if (2 * i < level.solid.vertices.size()) {
                QVERIFY(std::abs(after.z() - before.z() - pitch * near) < 1e-15);
            } else {
                QCOMPARE(after.z(), lowest - parameters.baseThickness);
            }
        }
    }

    // A wall goes down with the track, behind what is high by 45 degrees, and is as high above it as is said
    // at least.
    void wallsFollowTheSurface() {
        TrackParameters parameters;
        parameters.segmentHeight = 60e-3;  // the lead-in is 80 mm long and 30 high
        parameters.walls = {0.0, 5e-3};
        std::vector<CrossSection> trap;
        for (const auto& [x, z] : {std::pair(20e-3, 30e-3), {21e-3, 12e-3}, {60e-3, 12e-3}, {100e-3, 20e-3}})
            trap.push_back({x, {{-30e-3, z}, {0.0, z}, {30e-3, z}}});
        const auto track = build(parameters, trap);
        const std::map<double, double> expected = {{0.0, 30e-3},    {80e-3, 30e-3},  {100e-3, 30e-3},
                                                   {101e-3, 29e-3}, {140e-3, 12e-3}, {180e-3, 20e-3},
                                                   {216e-3, 20e-3}, {252e-3, 20e-3}};
        std::size_t found = 0;
        for (const base::Vec3& vertex : track.solid.vertices) {
            if (vertex.y() < 31e-3 || vertex.z() < 0.0) continue;  // the wall's outer edge
            ++found;
            const auto at = std::ranges::find_if(
                expected, [&](const auto& place) { return std::abs(place.first - vertex.x()) < 1e-9; });
            QVERIFY(at != expected.end());
            QVERIFY2(std::abs(vertex.z() - at->second - 5e-3) < 1e-12,
                     qPrintable(QString("%1 at %2").arg(vertex.z()).arg(vertex.x())));
        }
        QCOMPARE(found, expected.size());
    }

    // Where a surface is cut back from one side its wall closes that; from both it stands free, and walls are
    // down where that begins.
    void whatIsCutFromBothSidesHasNoWalls_data() {
        QTest::addColumn<FeederShape>("shape");
        QTest::addRow("linear") << FeederShape{};
        QTest::addRow("clockwise") << testing::makeBowl(Conveying::clockwise);
    }
    void whatIsCutFromBothSidesHasNoWalls() {
        QFETCH(FeederShape, shape);
        TrackParameters parameters;
        parameters.shape = shape;
        parameters.walls = {4e-3, 5e-3};
        const auto cut = [&](double inner, double outer) {
            std::vector<CrossSection> trap;
            for (const double x : {10e-3, 20e-3, 40e-3}) {
                const bool isCut = x > 15e-3;
                const double from = isCut ? inner : -30e-3;
                const double to = isCut ? outer : 30e-3;
                trap.push_back({x, {{from, 15e-3}, {0.0, 15e-3}, {to, 15e-3}}});
            }
            return build(parameters, trap);
        };
        const auto highest = [](const track::Track& track) {
            double z = 0.0;
            for (const base::Vec3& vertex : track.solid.vertices)
                if (track.shape.toTrack(vertex, 120e-3).x() > 110e-3) z = std::max(z, vertex.z());
            return z;
        };
        for (const auto& [inner, outer] : {std::pair(-30e-3, 30e-3), {-5e-3, 30e-3}, {-30e-3, 5e-3}}) {
            const auto walled = cut(inner, outer);
            QVERIFY(isClosedManifold(walled.solid));
            QVERIFY(std::abs(highest(walled) - 20e-3) < 1e-9);
        }
        const auto bare = cut(-5e-3, 5e-3);
        QVERIFY(isClosedManifold(bare.solid));
        QVERIFY(std::abs(highest(bare) - 15e-3) < 1e-9);
        for (const base::Vec3& vertex : bare.solid.vertices) {
            const base::Vec3 place = bare.shape.toTrack(vertex, 120e-3);
            if (place.x() > 110e-3) QVERIFY(std::abs(place.y()) < 6e-3);
        }
        QVERIFY(calcVolume(bare.solid) < calcVolume(cut(-5e-3, 30e-3).solid));
    }

    // Walls stand on the borders, as high above the surface's highest point as is said where that is, 2 mm
    // wide at least.
    void wallsArePartOfTheSolid_data() {
        QTest::addColumn<FeederShape>("shape");
        QTest::addColumn<double>("inner");
        QTest::addColumn<double>("outer");
        const std::pair<const char*, FeederShape> shapes[] = {
            {"linear", {}},
            {"clockwise", testing::makeBowl(Conveying::clockwise)},
            {"anticlockwise, climbs", testing::makeBowl(Conveying::anticlockwise, 4.0 * base::kDegree)}};
        for (const auto& [name, shape] : shapes) {
            QTest::addRow("%s, outer", name) << shape << 0.0 << 12e-3;
            QTest::addRow("%s, inner", name) << shape << 5e-3 << 0.0;
            QTest::addRow("%s, both", name) << shape << 5e-3 << 12e-3;
        }
    }
    void wallsArePartOfTheSolid() {
        QFETCH(FeederShape, shape);
        QFETCH(double, inner);
        QFETCH(double, outer);
        TrackParameters parameters;
        parameters.shape = shape;
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const auto trap = testing::drawTrap(TrapParameters{}, seed);
            parameters.walls = {};
            const auto bare = build(parameters, trap);
            parameters.walls = {inner, outer};
            const auto walled = build(parameters, trap);
            QVERIFY(isClosedManifold(walled.solid));
            QVERIFY(walled.walls == parameters.walls);
            // The surface stays as it is: the same triangles, and no others count.
            QCOMPARE(walled.surfaceTriangles, bare.surfaceTriangles);
            for (std::size_t t = 0; t < bare.surfaceTriangles; ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto a = static_cast<std::size_t>(bare.solid.triangles[t][k]);
                    const auto b = static_cast<std::size_t>(walled.solid.triangles[t][k]);
                    QCOMPARE(walled.solid.vertices[b], bare.solid.vertices[a]);
                }
            }
            double highest = 0.0;
            for (const CrossSection& section : bare.sections) {
                for (const base::Vec2& point : section.points)
                    highest = std::max(highest, point.y());
            }
            double sides[2] = {0.0, 0.0};  // how far it reaches inward and outward
            double tops[2] = {0.0, 0.0};   // how high it is at either side
            double near = 0.0;
            for (const base::Vec3& vertex : walled.solid.vertices) {
                const base::Vec3 place = shape.toTrack(vertex, near);
                near = place.x();
                const std::size_t side = place.y() > 0.0 ? 1 : 0;
                sides[side] = std::max(sides[side], std::abs(place.y()));
                tops[side] = std::max(tops[side], place.z());
            }
            const double heights[2] = {inner, outer};
            for (std::size_t side = 0; side < 2; ++side) {
                if (heights[side] == 0.0) {
                    QVERIFY(sides[side] <= 30e-3 + 1e-12 && tops[side] <= highest + 1e-12);
                } else {
                    QVERIFY(std::abs(sides[side] - 32e-3) < 1e-12);
                    QVERIFY(std::abs(tops[side] - highest - heights[side]) < 1e-12);
                }
            }
        }
    }

    void flatTrackIsABlock() {
        const auto track = build({}, flatTrap(15e-3, 30e-3));
        const double length = 80e-3 + 30e-3 + 2 * 36e-3;
        QVERIFY(std::abs(calcVolume(track.solid) - length * 60e-3 * 18e-3) < 1e-15);
    }

    // A bent block: each piece is a trapezoid prism; all together sin(step) / step of the ring sector.
    void flatBowlIsARingOfChords() {
        TrackParameters parameters;
        parameters.shape = testing::makeBowl(Conveying::clockwise);
        const auto track = build(parameters, flatTrap(15e-3, 30e-3));
        const double length = 80e-3 + 30e-3 + 2 * 36e-3;
        QVERIFY(calcVolume(track.solid) < length * 60e-3 * 18e-3);
        // At most 5 degrees per chord: sin(5 deg) / 5 deg.
        QVERIFY(calcVolume(track.solid) > length * 60e-3 * 18e-3 * 0.99873);
        // 80, 30, 36, 36 mm at 15.27 mm each: 6, 2, 3, 3 pieces.
        QCOMPARE(track.surfaceTriangles, std::size_t{14 * 3 * 2});
        QCOMPARE(track.sections.size(), std::size_t{5});
    }

    void sensesMirrorEachOther() {
        TrackParameters parameters;
        const auto trap = testing::drawTrap(TrapParameters{}, 5);
        parameters.shape = testing::makeBowl(Conveying::clockwise);
        const auto clockwise = build(parameters, trap);
        parameters.shape = testing::makeBowl(Conveying::anticlockwise);
        const auto anticlockwise = build(parameters, trap);
        QCOMPARE(clockwise.solid.vertices.size(), anticlockwise.solid.vertices.size());
        for (std::size_t i = 0; i < clockwise.solid.vertices.size(); ++i) {
            const base::Vec3& v = clockwise.solid.vertices[i];
            QVERIFY((base::Vec3(v.x(), -v.y(), v.z()) - anticlockwise.solid.vertices[i]).norm() < 1e-15);
        }
        QVERIFY(std::abs(calcVolume(clockwise.solid) / calcVolume(anticlockwise.solid) - 1.0) < 1e-12);
    }

    // decisions.md#spiral: a ledge in the middle that falls toward an upright wall.
    void spiralIsALedgeBesideAWall() {
        TrackParameters parameters;
        parameters.spiral = {20e-3, 8e-3, 5.0 * base::kDegree};
        const auto trap = testing::drawTrap({}, 7);
        const auto track = build(parameters, trap);
        const double fall = 10e-3 * std::tan(5.0 * base::kDegree);
        for (std::size_t i = 0; i < 2; ++i) {
            const std::vector<base::Vec2>& points = track.sections[i].points;
            QCOMPARE(points.size(), trap.front().points.size());
            QVERIFY((points.front() - base::Vec2(-10e-3, 15e-3 + fall)).norm() < 1e-15);
            QVERIFY((points[points.size() - 3] - base::Vec2(10e-3, 15e-3 - fall)).norm() < 1e-15);
            QVERIFY((points[points.size() - 2] - base::Vec2(10.2e-3, 23e-3 - fall)).norm() < 1e-15);
            QVERIFY((points.back() - base::Vec2(12.2e-3, 23e-3 - fall)).norm() < 1e-15);
        }
        QCOMPARE(track.sections[2].points, trap.front().points);
        const track::Spiral found = track::spiralOf(track);
        QVERIFY(std::abs(found.width - 20e-3) < 1e-15 && std::abs(found.wall - 8e-3) < 1e-15);
        QVERIFY(std::abs(found.inclination - 5.0 * base::kDegree) < 1e-12);
        QCOMPARE(track::spiralOf(build({}, trap)).width, 0.0);
    }

    // decisions.md#chute: the last cross-section goes on, falling, with the finish line in the middle.
    void chuteFallsBehindTheLeadOut() {
        TrackParameters parameters;
        const auto trap = testing::drawTrap({}, 7);
        const auto without = build(parameters, trap);
        parameters.chute = {50e-3, 30.0 * base::kDegree};
        const auto track = build(parameters, trap);
        QCOMPARE(track.sections.size(), without.sections.size() + 1);
        QCOMPARE(track.lastTrapSection, without.lastTrapSection);
        const double fall = 50e-3 * std::tan(30.0 * base::kDegree);
        for (std::size_t j = 0; j < trap.back().points.size(); ++j) {
            const base::Vec2 point = track.sections.back().points[j] + base::Vec2(0.0, fall);
            QVERIFY((point - trap.back().points[j]).norm() < 1e-15);
        }
        QVERIFY(std::abs(track.end() - without.end() - 50e-3) < 1e-15);
        QVERIFY(std::abs(track.finish - without.end() - 25e-3) < 1e-15);
        const track::Chute found = track::chuteOf(track);
        QVERIFY(std::abs(found.length - 50e-3) < 1e-15);
        QVERIFY(std::abs(found.angle - 30.0 * base::kDegree) < 1e-12);
        QCOMPARE(track::chuteOf(without).length, 0.0);
        QCOMPARE(track::chuteFall(track, without.end()), 0.0);
        QVERIFY(std::abs(track::chuteFall(track, track.finish) - 0.5 * fall) < 1e-12);
        // The axes in which orientations are compared go with it, and only on it.
        QCOMPARE(track::orientationFrame(track, track.start), track.shape.tangentFrame(track.start));
        const base::Vec3 ahead = track::orientationFrame(track, track.finish).col(0);
        QVERIFY(std::abs(ahead.z() + 0.5) < 1e-12);
        // From a bowl's track that climbs it falls by as much less: tan 10 - tan 30 deg.
        TrackParameters climbing = parameters;
        climbing.shape = testing::makeBowl(Conveying::clockwise, 10.0 * base::kDegree);
        const auto bowl = build(climbing, trap);
        const base::Vec3 down = track::orientationFrame(bowl, bowl.finish).col(0);
        const double along = std::hypot(down.x(), down.y());
        const double expected = std::tan(10.0 * base::kDegree) - std::tan(30.0 * base::kDegree);
        QVERIFY(std::abs(down.z() / along - expected) < 1e-12);
        // The base lies below its lowest place.
        double lowest = 0.0;
        for (const base::Vec2& point : track.sections.back().points)
            lowest = std::min(lowest, point.y());
        QVERIFY(lowest < -5e-3);
        QVERIFY(std::abs(geometry::calcBoundingBox(track.solid).low.z() - (lowest - 3e-3)) < 1e-15);
    }

    void refusesNamingTheParameter_data() {
        QTest::addColumn<TrackParameters>("parameters");
        QTest::addColumn<QString>("named");
        TrackParameters p;
        p.segmentWidth = -1.0;
        QTest::newRow("width") << p << "segment width";
        p = {};
        p.shape.slope = 15.1 * base::kDegree;
        QTest::newRow("slope") << p << "slope is 15.1 deg";
        p.shape.slope = -0.3;
        QTest::newRow("slope down") << p << "slope";
        p = {};
        p.walls.inner = -1e-3;
        QTest::newRow("inner wall") << p << "inner wall is -1 mm high";
        p.walls = {0.0, 1.5};
        QTest::newRow("outer wall") << p << "outer wall is 1500 mm high";
        p = {};
        p.spiral.width = 56e-3;
        QTest::newRow("spiral too wide") << p << "spiral is 56 mm wide";
        p.spiral.width = -1e-3;
        QTest::newRow("spiral") << p << "spiral is -1 mm wide";
        p.spiral = {20e-3, 17e-3};
        QTest::newRow("spiral's wall") << p << "spiral's wall is 17 mm high";
        p.spiral = {20e-3, 8e-3, 50.0 * base::kDegree};
        QTest::newRow("spiral's inclination") << p << "inclination is 50 deg";
        p = {};
        p.chute.length = -1e-3;
        QTest::newRow("chute") << p << "chute is -1 mm long";
        p.chute = {10e-3, 61.0 * base::kDegree};
        QTest::newRow("chute's angle") << p << "chute falls by 61 deg";
        p = {};
        p.leadInLength = 0.0;
        QTest::newRow("lead-in") << p << "lead-in length";
        p = {};
        p.startFromLeadInEnd = 80e-3;
        QTest::newRow("start") << p << "start's distance";
        p = {};
        p.leadOutSegments = 0;
        QTest::newRow("lead-out") << p << "number of lead-out segments is 0";
        p = {};
        p.baseThickness = 0.0;
        QTest::newRow("base") << p << "base thickness";
        p = {};
        p.shape = {track::FeederType::bowl, 30e-3, Conveying::clockwise};
        QTest::newRow("radius") << p << "bowl radius is 30 mm";
        p.shape.bowlRadius = 31e-3;
        p.leadInLength = 0.2;
        QTest::newRow("circumference") << p << "circumference";
    }
    void refusesNamingTheParameter() {
        QFETCH(TrackParameters, parameters);
        QFETCH(QString, named);
        const auto result = track::buildTrack(parameters, flatTrap(15e-3, 30e-3));
        QVERIFY(!result.ok());
        QVERIFY2(QString::fromStdString(result.error().message).contains(named),
                 result.error().message.c_str());
    }

    void refusesBadTraps() {
        auto trap = testing::drawTrap(TrapParameters{}, 1);
        QVERIFY(!track::buildTrack({}, {}).ok());
        trap[2].x = trap[1].x;
        auto result = track::buildTrack({}, trap);
        QVERIFY(!result.ok());
        QVERIFY(result.error().message.find("Cross-section 3") != std::string::npos);
        trap = testing::drawTrap(TrapParameters{}, 1);
        trap[4].points.pop_back();
        QVERIFY(!track::buildTrack({}, trap).ok());
        trap = {CrossSection{20e-3, {base::Vec2(0.0, 0.0)}}};
        QVERIFY(!track::buildTrack({}, trap).ok());
    }

    void segmentsToFinish_data() {
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("segments");
        // Lead-in 0-80, trap 80-110, lead-out 110-146-182 with the finish at 164 mm.
        QTest::newRow("before the track") << -10e-3 << 3.5;
        QTest::newRow("begin") << 0.0 << 3.5;
        QTest::newRow("start") << 60e-3 << 2.75;
        QTest::newRow("lead-in's end") << 80e-3 << 2.5;
        QTest::newRow("in the trap") << 95e-3 << 2.0;
        QTest::newRow("first duplicate") << 110e-3 << 1.5;
        QTest::newRow("in the last segment") << 155e-3 << 0.25;
        QTest::newRow("finish") << 164e-3 << 0.0;
        QTest::newRow("beyond") << 180e-3 << 0.0;
        QTest::newRow("off the end") << 1.0 << 0.0;
    }
    void segmentsToFinish() {
        QFETCH(double, x);
        QFETCH(double, segments);
        TrackParameters parameters;
        for (const auto& shape : {FeederShape{}, testing::makeBowl(Conveying::clockwise)}) {
            parameters.shape = shape;
            const auto track = build(parameters, flatTrap(15e-3, 30e-3));
            QVERIFY(std::abs(track::segmentsToFinish(track, x) - segments) < 1e-12);
        }
    }
};

QTEST_APPLESS_MAIN(TrackBuilderTest)
#include "track_builder_test.moc"
