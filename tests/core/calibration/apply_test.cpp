#include "core/calibration/apply.h"

#include <QtTest>
#include <vector>

using namespace trapwright;
using calibration::Calibration;
using calibration::Method;

namespace {

Calibration measured(Method method, double value, double half = 0.01) {
    Calibration calibration;
    calibration.method = method;
    calibration.result = {value, value - half, value + half};
    return calibration;
}

calibration::Parameters parameters() {
    calibration::Parameters parameters;
    parameters.contact = {0.5, 0.45, 0.2};
    parameters.drive.halfStroke = 0.8e-3;
    return parameters;
}

calibration::Parameters applied(const std::vector<Calibration>& calibrations, double setPoint) {
    return calibration::applyChanges(parameters(),
                                     calibration::findChanges(parameters(), calibrations, setPoint));
}

}  // namespace

class ApplyTest : public QObject {
    Q_OBJECT

 private slots:
    void nothingMeasuredChangesNothing() { QVERIFY(calibration::findChanges(parameters(), {}, 0.5).empty()); }

    void newestOfEachKindCounts() {
        const std::vector<Calibration> calibrations = {
            measured(Method::tiltUntilSliding, 0.9), measured(Method::bounceHeight, 0.3),
            measured(Method::tiltUntilSliding, 0.6), measured(Method::tiltWhileSliding, 0.4),
            measured(Method::bounceTime, 0.35),      measured(Method::conveyingSpeed, 1.2e-3, 0.1e-3)};
        const calibration::Parameters after = applied(calibrations, 0.5);
        QCOMPARE(after.contact.staticFriction, 0.6);
        QCOMPARE(after.contact.kineticFriction, 0.4);
        QCOMPARE(after.contact.restitution, 0.35);
        QCOMPARE(after.drive.halfStroke, 0.6e-3);
        QCOMPARE(after.drive.frequency, parameters().drive.frequency);
        // Without a set-point the drive is left alone.
        QCOMPARE(applied(calibrations, 0.0).drive.halfStroke, 0.8e-3);
        const auto changes = calibration::findChanges(parameters(), calibrations, 0.5);
        QCOMPARE(changes.size(), std::size_t{6});  // two of them of the operating box
        QCOMPARE(changes[0].key, std::string("simulation.contact.staticFriction"));
        QCOMPARE(changes[0].before, 0.5);
        QCOMPARE(changes.back().key, std::string("simulation.drive.halfStroke_mm"));
        QVERIFY(std::abs(changes.back().after.low - 0.55e-3) < 1e-12);
    }

    // Student's interval of one more reading is sqrt(n + 1) times that of the mean of n.
    void readingsNarrowTheOperatingBox() {
        Calibration sliding = measured(Method::tiltWhileSliding, 0.45, 0.03);
        sliding.readings = std::vector<calibration::Tilt>(8);
        Calibration bounce = measured(Method::bounceTime, 0.2, 1e-4);
        bounce.readings = std::vector<calibration::BounceTimes>(3);
        // Kinetic friction alone says nothing of static friction, and the box holds both.
        QCOMPARE(applied({sliding}, 0.0).box.friction, parameters().box.friction);
        Calibration resting = measured(Method::tiltUntilSliding, 0.5, 0.05);
        resting.readings = std::vector<calibration::Tilt>(8);
        const calibration::Parameters after = applied({sliding, resting, bounce}, 0.0);
        QVERIFY(std::abs(after.box.friction - 0.15) < 1e-12);
        QCOMPARE(after.box.restitution, 0.02);
        QCOMPARE(after.box.halfStroke, parameters().box.halfStroke);
        QVERIFY(calibration::findChanges(after, std::vector{sliding, resting, bounce}, 0.0).empty());

        // No range becomes wider.
        resting.result = {0.5, 0.4, 0.6};
        QCOMPARE(applied({sliding, resting}, 0.0).box.friction, parameters().box.friction);
    }

    // study::findProblems refuses settings in which kinetic friction is more than static.
    void kineticFrictionIsNeverMoreThanStatic() {
        for (const std::vector<Calibration>& calibrations :
             {std::vector{measured(Method::tiltUntilSliding, 0.3)},
              std::vector{measured(Method::tiltWhileSliding, 0.7)},
              std::vector{measured(Method::tiltWhileSliding, 0.45)},
              std::vector{measured(Method::tiltUntilSliding, 0.3),
                          measured(Method::tiltWhileSliding, 0.32)}}) {
            const calibration::Parameters after = applied(calibrations, 0.0);
            QVERIFY(after.contact.kineticFriction <= after.contact.staticFriction);
        }
        QCOMPARE(applied({measured(Method::tiltWhileSliding, 0.45)}, 0.0).contact.staticFriction, 0.5);
        QCOMPARE(applied({measured(Method::tiltUntilSliding, 0.3)}, 0.0).contact.kineticFriction, 0.3);
    }
};

QTEST_APPLESS_MAIN(ApplyTest)
#include "apply_test.moc"
