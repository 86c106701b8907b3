#include "sim/contact/contact_body.h"
#include "sim/contact/contact_track.h"

#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/geometry/convex_hull.h"
#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "sim/contact/formulas/scalar.h"

using namespace trapwright;
using base::Vec2;
using base::Vec3;
using contact::BodyEdge;
using contact::BodyPiece;
using contact::ContactBody;
using geometry::ConvexPolytope;

namespace {

/// In units of the scenes below, which are of 1 to 10 mm.
constexpr double kUnit = base::kMillimetre;
constexpr double kNear = 1e-9;

using Profile = std::vector<Vec2>;

struct Edge {
    Vec3 from, to;
    std::array<Vec3, 2> into;
};

/// Convex pieces and the features that their union has.
struct Solid {
    std::vector<ConvexPolytope> pieces;
    std::vector<Vec3> vertices;
    std::vector<Edge> edges;

    void addHull(std::vector<Vec3> points) {
        for (Vec3& point : points)
            point *= kUnit;
        pieces.push_back(geometry::computeConvexHull(points).value());
    }
    void addPrism(const Profile& profile, double low, double high) {
        std::vector<Vec3> points;
        for (const Vec2& p : profile)
            points.insert(points.end(), {{p.x(), p.y(), low}, {p.x(), p.y(), high}});
        addHull(points);
    }
    void addBox(const Vec3& low, const Vec3& high) {
        addPrism({{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}},
                 low.z(), high.z());
    }

    enum Ends { kTop = 1, kBottom = 2, kBoth = 3 };
    /// What is expected of a prism, or of a hole if its profile goes round clockwise: the edges at its ends,
    /// those along it where the profile turns left, and their corners.
    void expectPrism(const Profile& profile, double low, double high, Ends ends = kBoth) {
        const std::size_t count = profile.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2& corner = profile[i];
            const Vec2 before = (corner - profile[(i + count - 1) % count]).normalized();
            const Vec2& next = profile[(i + 1) % count];
            const Vec2 along = (next - corner).normalized();
            const bool convex = before.x() * along.y() - before.y() * along.x() > 0.0;
            const auto at = [](const Vec2& p, double z) { return Vec3(kUnit * Vec3(p.x(), p.y(), z)); };
            const Vec3 inside(-along.y(), along.x(), 0.0);
            for (const double z : {low, high}) {
                if ((ends & (z == high ? kTop : kBottom)) == 0) continue;
                edges.push_back(
                    {at(corner, z), at(next, z), {inside, Vec3(0.0, 0.0, z == high ? -1.0 : 1.0)}});
                if (convex) vertices.push_back(at(corner, z));
            }
            if (convex)
                edges.push_back({at(corner, low),
                                 at(corner, high),
                                 {Vec3(along.x(), along.y(), 0.0), Vec3(-before.x(), -before.y(), 0.0)}});
        }
    }

    void turn(const base::Pose& pose) {
        for (ConvexPolytope& piece : pieces) {
            std::vector<Vec3> points;
            for (const Vec3& vertex : piece.vertices)
                points.push_back(pose.apply(vertex));
            piece = geometry::computeConvexHull(points).value();
        }
        for (Vec3& vertex : vertices)
            vertex = pose.apply(vertex);
        for (Edge& edge : edges) {
            edge.from = pose.apply(edge.from);
            edge.to = pose.apply(edge.to);
            for (Vec3& into : edge.into)
                into = pose.rotation * into;
        }
    }
};

Profile rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}
Profile hole(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}};
}

Solid makeTwoCubes() {
    Solid solid;
    solid.addBox({0, 0, 0}, {1, 1, 1});
    solid.addBox({1, 0, 0}, {2, 1, 1});
    solid.expectPrism(rectangle(0, 0, 2, 1), 0, 1);
    return solid;
}
Solid makeEightBoxes() {
    Solid solid;
    for (int i = 0; i < 8; ++i) {
        const auto low = [&](int bit, double cut) { return (i & bit) != 0 ? cut : 0.0; };
        const auto high = [&](int bit, double cut, double end) { return (i & bit) != 0 ? end : cut; };
        solid.addBox({low(1, 3), low(2, 1), low(4, 2)}, {high(1, 3, 8), high(2, 1, 5), high(4, 2, 3)});
    }
    solid.expectPrism(rectangle(0, 0, 8, 5), 0, 3);
    return solid;
}
/// One half is cut again: corners of the quarters lie amid edges of the half.
Solid makeHalfAndQuarters() {
    Solid solid;
    solid.addBox({0, 0, 0}, {4, 5, 3});
    solid.addBox({4, 0, 0}, {8, 2, 3});
    solid.addBox({4, 2, 0}, {8, 5, 3});
    solid.expectPrism(rectangle(0, 0, 8, 5), 0, 3);
    return solid;
}
/// The cut goes lengthwise through two edges of the box.
Solid makeCutThroughEdges() {
    Solid solid;
    solid.addPrism({{0, 0}, {8, 0}, {8, 5}}, 0, 3);
    solid.addPrism({{0, 0}, {8, 5}, {0, 5}}, 0, 3);
    solid.expectPrism(rectangle(0, 0, 8, 5), 0, 3);
    return solid;
}
/// The same, but only along a part of one of them, in three pieces about one edge.
Solid makeFanAboutAnEdge() {
    Solid solid;
    solid.addPrism({{0, 0}, {8, 0}, {8, 2}}, 0, 3);
    solid.addPrism({{0, 0}, {8, 2}, {8, 5}, {4, 5}}, 0, 3);
    solid.addPrism({{0, 0}, {4, 5}, {0, 5}}, 0, 1);
    solid.addPrism({{0, 0}, {4, 5}, {0, 5}}, 1, 3);
    solid.expectPrism(rectangle(0, 0, 8, 5), 0, 3);
    return solid;
}
Solid makeObliqueCut() {
    Solid solid;
    solid.addHull({{0, 0, 0}, {2, 0, 0}, {0, 5, 0}, {3, 5, 0}, {0, 0, 3}, {5, 0, 3}, {0, 5, 3}, {6, 5, 3}});
    solid.addHull({{8, 0, 0}, {2, 0, 0}, {8, 5, 0}, {3, 5, 0}, {8, 0, 3}, {5, 0, 3}, {8, 5, 3}, {6, 5, 3}});
    solid.expectPrism(rectangle(0, 0, 8, 5), 0, 3);
    return solid;
}
Solid makeL() {
    Solid solid;
    solid.addBox({0, 0, 0}, {6, 1, 4});
    solid.addBox({0, 1, 0}, {1, 5, 4});
    solid.expectPrism({{0, 0}, {6, 0}, {6, 1}, {1, 1}, {1, 5}, {0, 5}}, 0, 4);
    return solid;
}
Solid makeT() {
    Solid solid;
    solid.addBox({0, 0, 0}, {6, 1, 4});
    solid.addBox({2, 1, 0}, {3, 5, 4});
    solid.expectPrism({{0, 0}, {6, 0}, {6, 1}, {3, 1}, {3, 5}, {2, 5}, {2, 1}, {0, 1}}, 0, 4);
    return solid;
}
Solid makeU() {
    Solid solid;
    solid.addBox({0, 0, 0}, {6, 1, 2});
    solid.addBox({0, 1, 0}, {1, 5, 2});
    solid.addBox({5, 1, 0}, {6, 4, 2});
    solid.expectPrism({{0, 0}, {6, 0}, {6, 4}, {5, 4}, {5, 1}, {1, 1}, {1, 5}, {0, 5}}, 0, 2);
    return solid;
}
Solid makeThroughHole() {
    Solid solid;
    solid.addBox({0, 0, 0}, {8, 1, 2});
    solid.addBox({0, 4, 0}, {8, 6, 2});
    solid.addBox({0, 1, 0}, {3, 4, 2});
    solid.addBox({5, 1, 0}, {8, 4, 2});
    solid.expectPrism(rectangle(0, 0, 8, 6), 0, 2);
    solid.expectPrism(hole(3, 1, 5, 4), 0, 2);
    return solid;
}
/// A box that is open above.
Solid makePocket() {
    Solid solid = makeThroughHole();
    solid.addBox({0, 0, -1}, {8, 6, 0});
    solid.vertices.clear();
    solid.edges.clear();
    solid.expectPrism(rectangle(0, 0, 8, 6), -1, 2);
    solid.expectPrism(hole(3, 1, 5, 4), 0, 2, Solid::kTop);
    return solid;
}
Solid makeBoss() {
    Solid solid;
    solid.addBox({0, 0, 0}, {8, 6, 1});
    solid.addBox({2, 2, 1}, {5, 4, 3});
    solid.expectPrism(rectangle(0, 0, 8, 6), 0, 1);
    solid.expectPrism(rectangle(2, 2, 5, 4), 1, 3, Solid::kTop);
    return solid;
}
/// The two boxes have a side in one plane, half of which the bigger one goes on beside.
Solid makeStep() {
    Solid solid;
    solid.addBox({0, 0, 0}, {8, 6, 1});
    solid.addBox({0, 0, 1}, {3, 6, 3});
    // As a profile in x and z, along -y.
    solid.expectPrism({{0, 0}, {8, 0}, {8, 1}, {3, 1}, {3, 3}, {0, 3}}, -6, 0);
    base::Mat3 upright;
    upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    std::vector<ConvexPolytope> pieces = std::move(solid.pieces);
    solid.pieces.clear();
    solid.turn({base::Quaternion(upright), Vec3::Zero()});
    solid.pieces = std::move(pieces);
    return solid;
}

double distanceToSegment(const Vec3& point, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    return (from + std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0) * along - point)
        .norm();
}

std::vector<BodyEdge> allEdges(const ContactBody& body) {
    std::vector<BodyEdge> edges;
    for (const BodyPiece& piece : body.pieces)
        for (const BodyEdge& edge : piece.edges)
            edges.push_back(edge);
    return edges;
}
std::vector<Vec3> allVertices(const ContactBody& body) {
    std::vector<Vec3> vertices;
    for (const BodyPiece& piece : body.pieces)
        for (const contact::BodyVertex& vertex : piece.vertices)
            vertices.push_back(vertex.position);
    return vertices;
}

/// How far a point is outside; negative inside, but no farther than its piece is thick. [m]
double calcHeight(const ContactBody& body, const Vec3& point) {
    double least = 1e300;
    for (const BodyPiece& piece : body.pieces) {
        double height = -1e300;
        for (const contact::BodyFace& face : piece.faces)
            height = std::max(height, face.normal.dot(point) - face.offset);
        least = std::min(least, height);
    }
    return least;
}

bool hasInto(const BodyEdge& edge, const std::array<Vec3, 2>& into) {
    const auto same = [&](int a, int b) {
        return (edge.into[0] - into[a]).norm() < 1e-6 && (edge.into[1] - into[b]).norm() < 1e-6;
    };
    return same(0, 1) || same(1, 0);
}

std::vector<ConvexPolytope> piecesOf(const QByteArray& name, ConvexPolytope& hull) {
    auto built = part::buildPart(part::makeBundledShape(name.constData()), {.name = name.toStdString()});
    hull = built.value().part.hull;
    return built.value().part.pieces;
}

}  // namespace

/// Which features a part has for contact: those of the union of its convex pieces.
class ContactBodyTest : public QObject {
    Q_OBJECT

 private slots:
    void aConvexPartKeepsAllFeatures() {
        for (const char* name : {"cuboid", "cone", "screw"}) {
            ConvexPolytope hull;
            piecesOf(name, hull);
            const ContactBody body = contact::prepareBody({hull});
            const BodyPiece& piece = body.pieces.front();
            QCOMPARE(piece.vertices.size(), hull.vertices.size());
            QCOMPARE(piece.vertexEdges.size(), 2 * hull.edges.size());
            QCOMPARE(piece.edges.size(), hull.edges.size());
            QCOMPARE(piece.faces.size(), hull.faces.size());
            for (std::size_t v = 0; v < hull.vertices.size(); ++v)
                QCOMPARE(piece.vertices[v].position, hull.vertices[v]);
            // Ends are taken off where no other edge goes on: all of a cuboid's, not those of a rim.
            int taken = 0;
            for (std::size_t e = 0; e < hull.edges.size(); ++e) {
                const double less = (piece.edges[e].from - hull.vertices[hull.edges[e].from]).norm();
                QVERIFY(less == 0.0 || std::abs(less - contact::scalar::kBorder) < 1e-12);
                taken += less > 0.0 ? 1 : 0;
            }
            QVERIFY(taken > 0);
            QCOMPARE(taken == static_cast<int>(hull.edges.size()), std::string_view(name) == "cuboid");
        }
    }

    void aUnionHasItsOwnFeatures_data() {
        QTest::addColumn<std::shared_ptr<Solid>>("solid");
        const base::Pose askew{base::Quaternion(0.3, -0.5, 0.7, 0.4).normalized(), Vec3(1e-3, -2e-3, 0.5e-3)};
        const auto add = [&](const char* name, Solid solid) {
            QTest::newRow(name) << std::make_shared<Solid>(solid);
            solid.turn(askew);
            QTest::addRow("%s, turned", name) << std::make_shared<Solid>(solid);
        };
        add("two cubes", makeTwoCubes());
        add("box in eight", makeEightBoxes());
        add("box in a half and quarters", makeHalfAndQuarters());
        add("box cut through edges", makeCutThroughEdges());
        add("box in a fan about an edge", makeFanAboutAnEdge());
        add("box cut obliquely", makeObliqueCut());
        add("L", makeL());
        add("T", makeT());
        add("U", makeU());
        add("through-hole", makeThroughHole());
        add("pocket", makePocket());
        add("boss", makeBoss());
        add("step", makeStep());
    }
    void aUnionHasItsOwnFeatures() {
        QFETCH(std::shared_ptr<Solid>, solid);
        const ContactBody body = contact::prepareBody(solid->pieces);
        const std::vector<Vec3> vertices = allVertices(body);
        QCOMPARE(vertices.size(), solid->vertices.size());
        for (const Vec3& expected : solid->vertices)
            QCOMPARE(std::count_if(vertices.begin(), vertices.end(),
                                   [&](const Vec3& v) { return (v - expected).norm() < kNear; }),
                     1);
        // A part at rest on a face is held at a corner if the whole cone there is above: box corners have
        // three edges, of which none leads along a cut.
        for (const BodyPiece& piece : body.pieces) {
            for (const contact::BodyVertex& vertex : piece.vertices) {
                QCOMPARE(vertex.edgeCount, 3);
                for (int e = 0; e < 3; ++e) {
                    const Vec3& away = piece.vertexEdges[vertex.firstEdge + e];
                    QVERIFY(std::any_of(solid->edges.begin(), solid->edges.end(), [&](const Edge& edge) {
                        return distanceToSegment(vertex.position + 1e-4 * away, edge.from, edge.to) < kNear;
                    }));
                }
            }
        }

        // Each place of an expected edge is on one kept edge, with the faces of the union; where edges end
        // inside the union or go on as another they are longer, and near there it may be on two.
        const std::vector<BodyEdge> edges = allEdges(body);
        double length = 0.0;
        double expectedLength = 0.0;
        for (const BodyEdge& edge : edges) {
            length += edge.length;
            QVERIFY((edge.from + edge.length * edge.direction - edge.to).norm() < kNear);
        }
        for (const Edge& expected : solid->edges) {
            expectedLength += (expected.to - expected.from).norm();
            for (const double share : {0.013, 0.237, 0.519, 0.771, 0.987}) {
                const Vec3 place = expected.from + share * (expected.to - expected.from);
                const auto isOn = [&](const BodyEdge& edge) {
                    return distanceToSegment(place, edge.from, edge.to) < kNear &&
                           hasInto(edge, expected.into);
                };
                const auto isInMiddle = [&](const BodyEdge& edge) {
                    const double toEnd = std::min((place - edge.from).norm(), (place - edge.to).norm());
                    return isOn(edge) && toEnd > 2.0 * contact::kCornerSlack;
                };
                QVERIFY(std::any_of(edges.begin(), edges.end(), isOn));
                QVERIFY(std::count_if(edges.begin(), edges.end(), isInMiddle) <= 1);
            }
        }
        const double slack = 2.0 * contact::kCornerSlack * static_cast<double>(edges.size());
        const double taken = 2.0 * contact::scalar::kBorder * static_cast<double>(edges.size());
        QVERIFY(length > (1.0 - 1e-4) * expectedLength - taken);
        QVERIFY(length < (1.0 + 1e-4) * expectedLength + slack);
    }

    void aPartKeepsWhatItsHullHas_data() {
        QTest::addColumn<QByteArray>("name");
        for (const char* name : {"bracket", "clip", "housing", "d-shaft", "washer", "cup", "bolt", "screw",
                                 "plate", "holed-bracket"})
            QTest::newRow(name) << QByteArray(name);
    }
    void aPartKeepsWhatItsHullHas() {
        QFETCH(QByteArray, name);
        ConvexPolytope hull;
        const auto pieces = piecesOf(name, hull);
        const ContactBody body = contact::prepareBody(pieces);
        QCOMPARE(body.pieces.size(), pieces.size());
        const std::vector<Vec3> vertices = allVertices(body);
        for (const Vec3& corner : hull.vertices)
            QCOMPARE(std::count_if(vertices.begin(), vertices.end(),
                                   [&](const Vec3& v) { return (v - corner).norm() < kNear; }),
                     1);
        const std::vector<BodyEdge> edges = allEdges(body);
        for (const geometry::PolytopeEdge& edge : hull.edges) {
            const Vec3& from = hull.vertices[edge.from];
            const Vec3& to = hull.vertices[edge.to];
            for (const double share : {0.03, 0.21, 0.47, 0.78, 0.97}) {
                const Vec3 place = from + share * (to - from);
                // Some edges of the hull lead over what is open.
                if (calcHeight(body, place) >= kNear) continue;
                // Near their ends two edges may both be there.
                std::ptrdiff_t on = 0;
                std::ptrdiff_t inMiddle = 0;
                for (const BodyEdge& kept : edges) {
                    if (distanceToSegment(place, kept.from, kept.to) >= kNear) continue;
                    const double toEnd = std::min((place - kept.from).norm(), (place - kept.to).norm());
                    ++on;
                    if (toEnd > 2.0 * contact::kCornerSlack) ++inMiddle;
                }
                QVERIFY(on >= 1 && inMiddle <= 1);
            }
        }
    }

    void whatIsKeptIsOnTheSurface_data() { aPartKeepsWhatItsHullHas_data(); }
    void whatIsKeptIsOnTheSurface() {
        QFETCH(QByteArray, name);
        constexpr double kAside = 1e-6;
        ConvexPolytope hull;
        const ContactBody body = contact::prepareBody(piecesOf(name, hull));
        for (const BodyEdge& edge : allEdges(body)) {
            const Vec3 middle = 0.5 * (edge.from + edge.to);
            for (const Vec3& into : edge.into) {
                QVERIFY(std::abs(into.norm() - 1.0) < 1e-9 && std::abs(into.dot(edge.direction)) < 1e-9);
                QVERIFY(std::abs(calcHeight(body, middle + kAside * into)) < kNear);
            }
            const Vec3 inside = (edge.into[0] + edge.into[1]).normalized();
            QVERIFY(calcHeight(body, middle - kAside * inside) > 0.01 * kAside);
            QVERIFY(calcHeight(body, middle + kAside * inside) < -0.01 * kAside);
        }
        // A feature is looked for only where its piece is, and slack acts only near it.
        for (const BodyPiece& piece : body.pieces) {
            for (const contact::BodyVertex& vertex : piece.vertices)
                QVERIFY((vertex.position - piece.centre).norm() < piece.radius + kNear);
            for (const BodyEdge& edge : piece.edges)
                for (const contact::BodyFace& face : piece.faces)
                    QVERIFY(std::max(face.normal.dot(edge.from), face.normal.dot(edge.to)) <
                            face.offset + contact::kCornerSlack + kNear);
        }
    }
};

QTEST_APPLESS_MAIN(ContactBodyTest)
#include "contact_body_test.moc"
