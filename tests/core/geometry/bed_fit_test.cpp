#include "core/geometry/bed_fit.h"

#include <QTest>
#include <cmath>

#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

constexpr double kMm = base::kMillimetre;

TriangleMesh makeBlock(double x, double y, double z) {
    return shapes::makeBox({0, 0, 0}, {x * kMm, y * kMm, z * kMm});
}

BuildSpace makeSpace(double x, double y, double height) {
    return {x * kMm, y * kMm, height * kMm};
}

/// The least share of the bed by trying many turns.
double searchShare(const TriangleMesh& mesh, const BuildSpace& space) {
    double least = 1e9;
    for (int i = 0; i < 18000; ++i) {
        const double turn = i * 0.01 * base::kDegree;
        base::Vec2 low(1e9, 1e9);
        base::Vec2 high = -low;
        for (const base::Vec3& v : mesh.vertices) {
            const base::Vec2 p(v.x() * std::cos(turn) - v.y() * std::sin(turn),
                               v.x() * std::sin(turn) + v.y() * std::cos(turn));
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        least = std::min(least, std::max((high - low).x() / space.x, (high - low).y() / space.y));
    }
    return least;
}

}  // namespace

class BedFitTest : public QObject {
    Q_OBJECT

 private slots:
    void blocks_data() {
        QTest::addColumn<double>("length");
        QTest::addColumn<double>("width");
        QTest::addColumn<double>("height");
        QTest::addColumn<bool>("fits");
        QTest::newRow("as it is") << 200.0 << 60.0 << 30.0 << true;
        QTest::newRow("exactly") << 250.0 << 210.0 << 220.0 << true;
        QTest::newRow("a quarter turn") << 210.0 << 250.0 << 30.0 << true;
        // A bar of width w fits at 40 degrees up to about 275 - w: corner to corner is 326 mm.
        QTest::newRow("corner to corner") << 300.0 << 10.0 << 30.0 << true;
        QTest::newRow("the example's track") << 279.0 << 60.0 << 36.0 << false;
        QTest::newRow("too wide") << 212.0 << 211.0 << 30.0 << false;
        QTest::newRow("too high") << 100.0 << 60.0 << 220.1 << false;
    }

    void blocks() {
        QFETCH(double, length);
        QFETCH(double, width);
        QFETCH(double, height);
        QFETCH(bool, fits);
        const BuildSpace space = makeSpace(250, 210, 220);
        const TriangleMesh block = makeBlock(length, width, height);
        const BedFit fit = fitOnBed(block, space);
        QCOMPARE(fit.fits, fits);
        QCOMPARE(fit.excess.isZero(), fits);
        // The box is that of the turned block.
        const double c = std::abs(std::cos(fit.turn));
        const double s = std::abs(std::sin(fit.turn));
        QVERIFY((fit.size - base::Vec3(length * c + width * s, length * s + width * c, height) * kMm).norm() <
                1e-9);
        // What fits as it lies is left so; the shares are the least ones where it has to be turned.
        if (length <= 250.0 && width <= 210.0) {
            QCOMPARE(fit.turn, 0.0);
        } else if (length <= 210.0 && width <= 250.0) {
            QCOMPARE(fit.turn, 0.5 * base::kPi);
        } else {
            const double share = std::max(fit.size.x() / space.x, fit.size.y() / space.y);
            QVERIFY(std::abs(share - searchShare(block, space)) < 2e-4);
        }
    }

    void anglesOfRoundFootprints() {
        // A sector of a ring, as a bowl's track is: against all turns tried.
        std::vector<base::Vec2> outline;
        for (int i = 0; i <= 20; ++i) {
            const double angle = i * 4.5 * base::kDegree;
            outline.emplace_back(205 * kMm * std::cos(angle), 205 * kMm * std::sin(angle));
        }
        outline.emplace_back(0.0, 145 * kMm);
        outline.emplace_back(145 * kMm, 0.0);
        std::rotate(outline.begin(), outline.end() - 1, outline.end());
        const TriangleMesh sector = shapes::makePrism(outline, 30 * kMm);
        for (const BuildSpace& space : {makeSpace(250, 200, 220), makeSpace(180, 180, 180)}) {
            const BedFit fit = fitOnBed(sector, space);
            const double share = std::max(fit.size.x() / space.x, fit.size.y() / space.y);
            const double searched = searchShare(sector, space);
            QVERIFY2(share <= searched + 1e-12 && share > searched - 2e-4,
                     qPrintable(QString("%1 %2").arg(share).arg(searched)));
        }
    }

    void footprintIsConvexAndCounterClockwise() {
        const std::vector<base::Vec2> hull = computeFootprint(shapes::makeL());
        QCOMPARE(hull.size(), 5U);
        double doubleArea = 0.0;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const base::Vec2& a = hull[i];
            const base::Vec2& b = hull[(i + 1) % hull.size()];
            doubleArea += a.x() * b.y() - a.y() * b.x();
        }
        QVERIFY(std::abs(0.5 * doubleArea - 68 * kMm * kMm) < 1e-12);  // 100 less half of 8 x 8
    }
};

QTEST_APPLESS_MAIN(BedFitTest)
#include "bed_fit_test.moc"
