#pragma once

#include <QDateTime>
#include <QImage>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/measurement.h"
#include "core/part/part.h"
#include "core/study/physical_table.h"
#include "core/study/settings.h"

namespace trapwright::feeder {

/// All that a report on a validation tells, as values.
struct Report {
    QString study;  // its file's name
    std::shared_ptr<const part::Part> part;
    study::Settings settings;
    study::PhysicalValidation physical;
    std::optional<study::ValidationRecord> simulated;
    study::PhysicalTable table;
    std::vector<calibration::Calibration> calibrations;
    QImage track;                     // a picture of it; null: none
    std::optional<trial::Goal> goal;  // how parts are to end
    QImage expected;                  // of a part that leaves as expected; null: not known
    std::vector<QImage> poses;        // pictures by pose
    QString program;                  // that writes the report, and its version
    QDateTime written;
};

/// Width and height of the pictures, in pixels, at 150 dpi in print.
inline constexpr QSize kTrackPicture(500, 330);
inline constexpr QSize kExpectedPicture(500, 330);
inline constexpr QSize kPosePicture(120, 92);
inline constexpr QSize kChartPicture(1020, 350);

/// "Validation on the real feeder: cuboid"; of trials with the virtual feeder it says so.
QString reportTitle(const Report& report);
/// "Real feeder", "Virtual feeder" or "Mixed feeders": what the trials were made with.
QString reportFeeder(const Report& report);
/// For the head of every page: that the feeder was the virtual one; empty if it was not.
QString reportWarning(const Report& report);
/// The report as pieces of HTML, each of which stays on one page, with pictures by the names "track",
/// "expected", "pose1", "success", "course".
std::vector<QString> reportPieces(const Report& report);
/// Writes it as PDF (A4, head and numbered foot on every page), beside it NAME-table.csv and NAME-trials.csv.
/// Errors name the file.
base::Status writeReport(const Report& report, const std::filesystem::path& pdf);

}  // namespace trapwright::feeder
