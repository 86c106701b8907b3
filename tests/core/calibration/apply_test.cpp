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
        QCOMPARE(changes.size(), std::size_t{4});
        QCOMPARE(changes[0].key, std::string("simulation.contact.staticFriction"));
        QCOMPARE(changes[0].before, 0.5);
        QCOMPARE(changes[3].key, std::string("simulation.drive.halfStroke_mm"));
        QVERIFY(std::abs(changes[3].after.low - 0.55e-3) < 1e-12);
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
