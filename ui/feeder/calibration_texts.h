#pragma once

#include <QString>
#include <vector>

#include "core/calibration/apply.h"
#include "core/calibration/measurement.h"

/// The measurements on the real feeder as the operator is told of them.
namespace trapwright::feeder {

/// A number of a reading.
struct ReadingField {
    QString title;
    QString unit;
    double factor = 1.0;  // from SI to the unit
    double high = 0.0;    // in the unit
    int decimals = 1;
};

struct MethodText {
    calibration::Method method = calibration::Method::tiltUntilSliding;
    QString title;                     // "Tilt: static friction"
    QString how;                       // how to measure, in two sentences
    std::vector<ReadingField> fields;  // in the order of calibration::numbersOf
    QString result;                    // what comes out
    QString unit;
    double factor = 1.0;  // of the result, from SI to the unit
};

/// In the order in which they are done.
std::vector<MethodText> methodTexts();

/// "0.34 (0.31 … 0.37)"
QString estimateText(const calibration::Estimate& estimate, double factor, const QString& unit);
/// "Static friction: 0.30 becomes 0.34"
QString changeText(const calibration::Change& change);

}  // namespace trapwright::feeder
