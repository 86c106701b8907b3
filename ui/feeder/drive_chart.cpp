#include "ui/feeder/drive_chart.h"

#include "ui/feeder/drive_link.h"

namespace trapwright::feeder {

using charts::ChartSheet;
using charts::Curve;
using charts::CurveStyle;
using charts::PlotSheet;
using charts::SeriesColour;
using drive::LogEntry;
using drive::LogKind;

namespace {

constexpr double kSpan = 60.0;  // [s]
constexpr int kRedraw = 250;    // [ms]
constexpr double kPercent = 100.0;

const CurveStyle kTold{SeriesColour::first, Qt::SolidLine};
const CurveStyle kReadBack{SeriesColour::second, Qt::DashLine};
const CurveStyle kAcceleration{SeriesColour::third, Qt::SolidLine};

}  // namespace

DriveChart::DriveChart(DriveLink& link, QWidget* parent)
    : CurveChart("drive", tr("Drive"), parent), link_(link) {
    setEmptyText(tr("Connect a drive: its set-point and its motion in the last minute are drawn here."));
    delay_.setSingleShot(true);
    delay_.setInterval(kRedraw);
    connect(&delay_, &QTimer::timeout, this, &DriveChart::draw);
    connect(&link_, &DriveLink::logged, this, &DriveChart::add);
    draw();
}

void DriveChart::add(const std::vector<LogEntry>& entries) {
    for (const LogEntry& entry : entries) {
        if (entry.kind == LogKind::connected) {
            entries_.clear();
            start_ = entry.time;
        }
        if (entry.kind == LogKind::command || entry.kind == LogKind::reading) entries_.push_back(entry);
    }
    if (entries_.empty()) return;
    while (entries_.front().time < entries_.back().time - kSpan)
        entries_.pop_front();
    if (isVisible() && !delay_.isActive()) delay_.start();
}

void DriveChart::draw() {
    Curve told{tr("Set-point"), tr("Set-point [%]"), {"told"}, kTold, {}};
    Curve readBack{tr("Read back"), tr("Set-point read back [%]"), {"readBack"}, kReadBack, {}};
    Curve acceleration{tr("Acceleration"), tr("Acceleration [m/s²]"), {"acceleration"}, kAcceleration, {}};
    for (const LogEntry& entry : entries_) {
        const double x = entry.time - start_;
        if (entry.kind == LogKind::command) {
            if (entry.setPoint) told.points.emplace_back(x, kPercent * *entry.setPoint);
        } else {
            if (entry.setPoint) readBack.points.emplace_back(x, kPercent * *entry.setPoint);
            if (entry.acceleration) acceleration.points.emplace_back(x, *entry.acceleration);
        }
    }
    PlotSheet setPoint;
    setPoint.key = "setPoint";
    setPoint.xTitle = tr("Time since connecting [s]");
    setPoint.yTitle = tr("Set-point [%]");
    setPoint.decimals = 1;
    setPoint.yIncluded = {0.0, kPercent};
    setPoint.leastWidth = kSpan;
    setPoint.curves = {told, readBack};
    PlotSheet measured = setPoint;
    measured.key = "acceleration";
    measured.yTitle = tr("Peak <i>a</i> [m/s²]");
    measured.yIncluded = {0.0};
    measured.leastHeight = 1.0;
    measured.curves = {acceleration};

    ChartSheet sheet;
    sheet.xColumn = tr("Time [s]");
    sheet.legend = {{"told", tr("Set-point"), tr("The set-point that was sent to the drive."), kTold},
                    {"readBack", tr("Read back"), tr("The set-point as the drive has it."), kReadBack},
                    {"acceleration", tr("Acceleration"), tr("Peak acceleration that the drive measures."),
                     kAcceleration}};
    sheet.plots = {setPoint, measured};
    setSheet(std::move(sheet));
}

}  // namespace trapwright::feeder
