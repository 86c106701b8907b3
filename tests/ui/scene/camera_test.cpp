#include "ui/scene/camera.h"

#include <QTest>
#include <random>

#include "core/track/feeder_shape.h"

using namespace trapwright;
using base::Vec3;
using scene::Camera;
using scene::StandardView;

class CameraTest : public QObject {
    Q_OBJECT

    const QSizeF screen_{1280.0, 720.0};

    static Camera anyCamera(std::mt19937& random) {
        const auto draw = [&random](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        Camera camera;
        camera.focus = {draw(-0.2, 0.2), draw(-0.2, 0.2), draw(-0.1, 0.1)};
        camera.azimuth = draw(-3.1, 3.1);
        camera.elevation = draw(-1.5, 1.5);
        camera.distance = draw(0.05, 1.0);
        camera.parallel = draw(0.0, 1.0) < 0.5;
        return camera;
    }

 private slots:
    void axesAreRightHandedAndUnit() {
        std::mt19937 random(1);
        for (int i = 0; i < 100; ++i) {
            const Camera camera = anyCamera(random);
            QVERIFY((camera.right().cross(camera.up()) + camera.forward()).norm() < 1e-12);
            QVERIFY(std::abs(camera.forward().norm() - 1.0) < 1e-12);
            QVERIFY(camera.up().z() >= 0.0);  // upright
        }
    }

    // On a feeder that climbs by 10 degrees what is plumb there is upright on the screen, and the track's
    // x axis climbs by as much in the view from the front.
    void whatIsPlumbIsUpright() {
        track::FeederShape shape;
        shape.slope = 10.0 * base::kDegree;
        Camera camera;
        camera.tilt = shape.slope;
        QVERIFY((camera.right().cross(camera.up()) + camera.forward()).norm() < 1e-12);
        QVERIFY(std::abs(camera.right().dot(shape.down())) < 1e-12);
        camera = turnedTo(camera, StandardView::front);
        QVERIFY((camera.up() + shape.down()).norm() < 1e-12);
        const auto middle = *camera.project(camera.focus, screen_);
        const auto ahead = *camera.project(camera.focus + 0.05 * Vec3::UnitX(), screen_);
        const double climb = std::atan2(middle.y() - ahead.y(), ahead.x() - middle.x());
        QVERIFY2(std::abs(climb - shape.slope) < 1e-9, qPrintable(QString::number(climb)));
    }

    void focusIsInTheMiddle() {
        std::mt19937 random(2);
        const Camera camera = anyCamera(random);
        const auto place = camera.project(camera.focus, screen_);
        QVERIFY(place);
        QCOMPARE(*place, QPointF(640.0, 360.0));
    }

    void scaleHoldsAtTheFocus() {
        std::mt19937 random(4);
        for (int i = 0; i < 20; ++i) {
            const Camera camera = anyCamera(random);
            const double scale = camera.metresPerPixel(screen_);
            const auto place = camera.project(camera.focus + 100.0 * scale * camera.right(), screen_);
            QVERIFY(std::abs(place->x() - 740.0) < 1e-6);
        }
    }

    void zoomKeepsThePlaceUnderTheCursor() {
        std::mt19937 random(5);
        const QPointF cursor(1000.0, 200.0);
        for (int i = 0; i < 20; ++i) {
            const Camera camera = anyCamera(random);
            const double scale = camera.metresPerPixel(screen_);
            const Vec3 under = camera.focus + 360.0 * scale * camera.right() + 160.0 * scale * camera.up();
            const auto place = zoomed(camera, 1.7, cursor, screen_).project(under, screen_);
            QVERIFY(std::hypot(place->x() - cursor.x(), place->y() - cursor.y()) < 1e-6);
        }
    }

    void panFollowsTheDrag() {
        std::mt19937 random(6);
        const Camera camera = anyCamera(random);
        const auto place = panned(camera, {37.0, -21.0}, screen_).project(camera.focus, screen_);
        QVERIFY(std::hypot(place->x() - 677.0, place->y() - 339.0) < 1e-6);
    }

    void standardViewsLookAlongTheAxes_data() {
        QTest::addColumn<StandardView>("view");
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("y");
        QTest::addColumn<double>("z");
        QTest::newRow("top") << StandardView::top << 0.0 << 0.0 << -1.0;
        QTest::newRow("bottom") << StandardView::bottom << 0.0 << 0.0 << 1.0;
        QTest::newRow("front") << StandardView::front << 0.0 << 1.0 << 0.0;
        QTest::newRow("back") << StandardView::back << 0.0 << -1.0 << 0.0;
        QTest::newRow("left") << StandardView::left << 1.0 << 0.0 << 0.0;
        QTest::newRow("right") << StandardView::right << -1.0 << 0.0 << 0.0;
    }

    void standardViewsLookAlongTheAxes() {
        QFETCH(StandardView, view);
        QFETCH(double, x);
        QFETCH(double, y);
        QFETCH(double, z);
        const Camera camera = turnedTo(Camera(), view);
        QVERIFY((camera.forward() - Vec3(x, y, z)).norm() < 1e-12);
        QVERIFY(camera.parallel);
        // Conveying goes to the right, seen from the front and from above.
        if (view == StandardView::top || view == StandardView::front)
            QVERIFY((camera.right() - Vec3::UnitX()).norm() < 1e-12);
    }

    void fittedBoxFillsTheScreen_data() {
        QTest::addColumn<bool>("parallel");
        QTest::newRow("perspective") << false;
        QTest::newRow("parallel") << true;
    }

    void fittedBoxFillsTheScreen() {
        QFETCH(bool, parallel);
        std::mt19937 random(7);
        const geometry::Box box{{-0.02, -0.03, -0.003}, {0.27, 0.03, 0.03}};
        for (int i = 0; i < 50; ++i) {
            Camera camera = anyCamera(random);
            camera.parallel = parallel;
            camera = fitted(camera, box, screen_, 0.1);
            double left = 1e9;
            double right = -1e9;
            double top = 1e9;
            double bottom = -1e9;
            for (int corner = 0; corner < 8; ++corner) {
                const auto place = camera.project({(corner & 1) != 0 ? box.high.x() : box.low.x(),
                                                   (corner & 2) != 0 ? box.high.y() : box.low.y(),
                                                   (corner & 4) != 0 ? box.high.z() : box.low.z()},
                                                  screen_);
                QVERIFY(place);
                left = std::min(left, place->x());
                right = std::max(right, place->x());
                top = std::min(top, place->y());
                bottom = std::max(bottom, place->y());
            }
            QVERIFY(left > 127.0 && right < 1153.0 && top > 71.0 && bottom < 649.0);
            QVERIFY(right - left > 0.93 * 1024.0 || bottom - top > 0.93 * 576.0);
        }
    }

    void aTurnedThingFollowsTheDrag() {
        std::mt19937 random(11);
        for (int i = 0; i < 50; ++i) {
            const Camera camera = anyCamera(random);
            // The side that is seen, near the focus.
            const base::Vec3 seen = camera.focus - 1e-3 * camera.forward();
            const auto moved = [&](const QPointF& drag) {
                const base::Vec3 there =
                    camera.focus + scene::turnedAlong(camera, drag) * (seen - camera.focus);
                return *camera.project(there, screen_) - *camera.project(seen, screen_);
            };
            const QPointF right = moved({20.0, 0.0});
            const QPointF down = moved({0.0, 20.0});
            // Sideways is about the vertical: from straight above that goes nowhere.
            if (std::abs(camera.forward().z()) < 0.95) QVERIFY(right.x() > 2.0 * std::abs(right.y()));
            QVERIFY(down.y() > 0.0 && std::abs(down.x()) < 0.1 * down.y());
        }
    }

    void emptyBoxLeavesTheCamera() { QCOMPARE(fitted(Camera(), geometry::Box(), screen_), Camera()); }
};

QTEST_APPLESS_MAIN(CameraTest)
#include "camera_test.moc"
