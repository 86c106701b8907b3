#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "core/verify/scenes.h"
#include "sim/native/near_pairs.h"
#include "sim/native/packed_body.h"
#include "sim/native/packed_track.h"

using namespace trapwright;
using base::Vec3;
using native::PackedBody;
using native::PackedPiece;
using native::PackedTrack;

namespace {

contact::ContactBody makeBody(const char* name) {
    const auto built = part::buildPart(part::makeBundledShape(name), {.name = name});
    return contact::prepareBody(built.value().part.pieces);
}

Vec3 column(const native::FloatRows& rows, int first, int c) {
    return {rows.row(first)[c], rows.row(first + 1)[c], rows.row(first + 2)[c]};
}

/// Largest over all faces, padding and all, of how far a point is beyond them.
double findSeparation(const PackedPiece& piece, const Vec3& p) {
    double most = -std::numeric_limits<double>::infinity();
    for (int f = 0; f < piece.faces.stride(); ++f)
        most = std::max(most, column(piece.faces, 0, f).dot(p) + piece.faces.row(3)[f]);
    return most;
}

}  // namespace

/// Parts and tracks as arrays: nothing is lost, and what fills them up to whole vectors never touches
/// anything.
class PackingTest : public QObject {
    Q_OBJECT

 private slots:
    void aBodyKeepsItsFeatures_data() {
        QTest::addColumn<QByteArray>("name");
        for (const char* name : {"cuboid", "cone", "bracket", "cup"})
            QTest::newRow(name) << QByteArray(name);
    }
    void aBodyKeepsItsFeatures() {
        QFETCH(QByteArray, name);
        const contact::ContactBody body = makeBody(name.constData());
        const PackedBody packed(body);
        QCOMPARE(packed.pieces.size(), body.pieces.size());
        for (std::size_t p = 0; p < packed.pieces.size(); ++p) {
            const PackedPiece& piece = packed.pieces[p];
            const contact::BodyPiece& source = body.pieces[p];
            QCOMPARE(piece.vertexCount, static_cast<int>(source.vertices.size()));
            QCOMPARE(piece.firstEdge.size(), source.vertices.size() + 1);
            QCOMPARE(piece.vertexEdges.size(), 3 * source.vertexEdges.size());
            // Vertices lie on the surface, their edges lead along it.
            for (int v = 0; v < piece.vertexCount; ++v) {
                const Vec3 vertex = column(piece.vertices, 0, v);
                QVERIFY(std::abs(findSeparation(piece, vertex)) < 1e-8);
                for (int e = piece.firstEdge[v]; e < piece.firstEdge[v + 1]; ++e) {
                    const Vec3 away =
                        Eigen::Map<const Eigen::Vector3f>(&piece.vertexEdges[3 * e]).cast<double>();
                    QVERIFY(std::abs(away.norm() - 1.0) < 1e-6);
                    QVERIFY(std::abs(findSeparation(piece, vertex + 1e-5 * away)) < 2e-8);
                }
            }
        }
    }

    // As vertices it repeats the first, as edges it has no length, as faces everything is far inside.
    void paddingOfABodyTouchesNothing() {
        for (const char* name : {"cuboid", "cone", "bracket"}) {
            const contact::ContactBody body = makeBody(name);
            const PackedBody packed(body);
            for (std::size_t p = 0; p < packed.pieces.size(); ++p) {
                const PackedPiece& piece = packed.pieces[p];
                QCOMPARE(piece.vertices.stride() % native::kWidestVector, 0);
                for (int v = piece.vertexCount; v < piece.vertices.stride(); ++v)
                    QCOMPARE(column(piece.vertices, 0, v), column(piece.vertices, 0, 0));
                for (int e = static_cast<int>(body.pieces[p].edges.size()); e < piece.edges.stride(); ++e)
                    QVERIFY(piece.edges.row(native::kLength)[e] < 0.0F);
                for (int f = static_cast<int>(body.pieces[p].faces.size()); f < piece.faces.stride(); ++f)
                    QVERIFY(column(piece.faces, 0, f).norm() < 1.1 && piece.faces.row(3)[f] < -1e3F);
            }
        }
    }

    void aGroupHoldsWhatLiesTogether_data() { aBodyKeepsItsFeatures_data(); }
    void aGroupHoldsWhatLiesTogether() {
        QFETCH(QByteArray, name);
        const PackedBody packed(makeBody(name.constData()));
        const Vec3 middle(packed.centre[0], packed.centre[1], packed.centre[2]);
        const auto check = [&](const native::FeatureGroups& groups, native::FloatRows PackedPiece::*rowsOf,
                               int rows, std::size_t expected) {
            // All, each once.
            std::set<std::pair<std::uint32_t, std::uint32_t>> found;
            for (std::size_t g = 0; g < groups.counts.size(); ++g) {
                const int number = static_cast<int>(g);
                const Vec3 centre = column(groups.balls, 0, number);
                const double radius = groups.balls.row(3)[number];
                QVERIFY(groups.counts[g] > 0 && groups.counts[g] <= native::kWidestVector);
                for (int i = 0; i < groups.counts[g]; ++i) {
                    const int place = number * native::kWidestVector + i;
                    const std::uint32_t index = groups.indices[place] & ~native::kManyEdges;
                    found.emplace(groups.pieces[place], index);
                    const PackedPiece& piece = packed.pieces[groups.pieces[place]];
                    for (int r = 0; r < rows; ++r)
                        QCOMPARE(groups.features.row(r)[place], (piece.*rowsOf).row(r)[index]);
                    const Vec3 from = column(groups.features, 0, place);
                    QVERIFY((from - centre).norm() <= radius);
                    if (rows < native::kEdgeRows) {
                        const bool many =
                            piece.firstEdge[index + 1] - piece.firstEdge[index] > native::kConeEdges;
                        QCOMPARE((groups.indices[place] & native::kManyEdges) != 0, many);
                        continue;
                    }
                    const Vec3 to = from + groups.features.row(native::kLength)[place] *
                                               column(groups.features, native::kDirectionX, place);
                    QVERIFY((to - centre).norm() <= radius);
                }
            }
            QCOMPARE(found.size(), expected);
            for (int g = static_cast<int>(groups.counts.size()); g < groups.balls.stride(); ++g)
                QVERIFY(groups.balls.row(3)[g] < -1e3F);
            // No more than they need by far.
            QVERIFY(groups.counts.size() <= 1 + 2 * expected / native::kWidestVector);
        };
        std::size_t vertices = 0;
        std::size_t edges = 0;
        for (const PackedPiece& piece : packed.pieces) {
            vertices += piece.vertexCount;
            for (int e = 0; e < piece.edges.stride(); ++e)
                edges += piece.edges.row(native::kLength)[e] >= 0.0F ? 1 : 0;
            QVERIFY((Vec3(piece.centre[0], piece.centre[1], piece.centre[2]) - middle).norm() +
                        piece.radius <=
                    packed.reach);
        }
        check(packed.vertices, &PackedPiece::vertices, 3, vertices);
        check(packed.edges, &PackedPiece::edges, native::kEdgeRows, edges);
    }

    void aTrackKeepsItsFeatures() {
        const contact::ContactTrack track = contact::prepareTrack(verify::makeRough()->solid);
        const PackedTrack packed(track);
        QCOMPARE(packed.triangles.size(), track.triangles.size());
        QCOMPARE(packed.edges.size(), track.edges.size());
        QCOMPARE(packed.vertices.size(), track.vertices.size());
        for (std::size_t t = 0; t < packed.triangles.size(); ++t) {
            const native::PackedTriangle& triangle = packed.triangles[t];
            const Vec3 centre = track.triangles[t].centre;
            const auto distance = [&](int plane, const Vec3& p) {
                const Vec3 away = p - Eigen::Map<const Vec3>(triangle.corner);
                return triangle.nx[plane] * away.x() + triangle.ny[plane] * away.y() +
                       triangle.nz[plane] * away.z() + triangle.offset[plane];
            };
            const Vec3 normal = track.triangles[t].normal;
            // A point above the triangle's plane is as far from it, wherever it is along it.
            QVERIFY(std::abs(distance(0, Eigen::Map<const Vec3>(triangle.corner) + 3e-3 * normal) - 3e-3) <
                    1e-9);
            for (int c = 0; c < 3; ++c) {
                const Vec3& side = track.triangles[t].edgeNormal[c];
                const double expected = side.dot(centre) - track.triangles[t].edgeOffset[c];
                QVERIFY(std::abs(distance(1 + c, centre) - expected) < 1e-8);
            }
        }
    }

    // Whatever a part can be near, it is not near the balls that fill up the arrays.
    void paddingOfATrackIsFarAway() {
        const PackedTrack packed(contact::prepareTrack(verify::makeRough()->solid));
        for (const native::FeatureBalls* features :
             {&packed.triangleBalls, &packed.edgeBalls, &packed.vertexBalls}) {
            for (const native::BallArrays* balls : {&features->balls, &features->blocks}) {
                QVERIFY(balls->count > 0);
                const auto size = static_cast<int>(balls->x.size());
                QCOMPARE(size, native::padToVectors(balls->count));
                QCOMPARE(balls->radius.size(), balls->x.size());
                for (int b = balls->count; b < size; ++b)
                    QVERIFY(balls->x[b] - balls->radius[b] > 1e3F);
            }
            // A block holds the balls of its vector.
            for (int b = 0; b < features->balls.count; ++b) {
                const auto centreOf = [](const native::BallArrays& balls, int i) {
                    return Vec3(balls.x[i], balls.y[i], balls.z[i]);
                };
                const int block = b / native::kWidestVector;
                const double away = (centreOf(features->balls, b) - centreOf(features->blocks, block)).norm();
                QVERIFY(away + features->balls.radius[b] <= features->blocks.radius[block]);
            }
        }
    }

    void arraysBeginAtVectors() {
        for (const int count : {1, 15, 16, 17, 40}) {
            const native::FloatRows rows(3, count);
            QVERIFY(rows.stride() >= count && rows.stride() < count + native::kWidestVector);
            for (int r = 0; r < 3; ++r)
                QCOMPARE(reinterpret_cast<std::uintptr_t>(rows.row(r)) % 64, 0U);
        }
    }
};

QTEST_APPLESS_MAIN(PackingTest)
#include "packing_test.moc"
