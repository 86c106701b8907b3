#include <QCoreApplication>
#include <QLocale>
#include <algorithm>

#include "ui/feeder/calibration_texts.h"
#include "ui/feeder/drive_texts.h"
#include "ui/feeder/outcome_look.h"
#include "ui/feeder/report.h"
#include "ui/look/text.h"
#include "ui/models/numbers.h"
#include "ui/models/verdict_look.h"

namespace trapwright::feeder {

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(Report)
};

constexpr double kMillimetre = 1e3;
// Pictures are drawn for 150 dpi, and HTML counts in pixels of 96 dpi.
constexpr double kHtmlPixel = 96.0 / 150.0;
constexpr std::size_t kMostNotes = 60;

using Rows = std::vector<std::pair<QString, QString>>;

QString inHtml(const std::string& text) {
    return QString::fromStdString(text).toHtmlEscaped();
}

QString dateText(const std::string& utc) {
    const QDateTime time = QDateTime::fromString(QString::fromStdString(utc), Qt::ISODate).toLocalTime();
    return QLocale().toString(time, "d MMMM yyyy, hh:mm");
}

QString imageTag(const QString& name, QSize pixels) {
    return QString("<img src=\"%1\" width=\"%2\" height=\"%3\">")
        .arg(name)
        .arg(qRound(pixels.width() * kHtmlPixel))
        .arg(qRound(pixels.height() * kHtmlPixel));
}

QString factTable(const Rows& rows) {
    QString html = "<table cellspacing=\"0\" cellpadding=\"2\">";
    for (const auto& [name, value] : rows) {
        if (value.isEmpty()) continue;
        html += QString("<tr><td class=\"name\">%1&nbsp;&nbsp;</td><td>%2</td></tr>").arg(name, value);
    }
    return html + "</table>";
}

QString sizeText(const part::Part& part) {
    const geometry::Box box = geometry::calcBoundingBox(part.mesh);
    const base::Vec3 size = kMillimetre * box.size();
    return Texts::tr("%1 × %2 × %3 mm, %4 g")
        .arg(look::numberText(size.x()), look::numberText(size.y()), look::numberText(size.z()),
             look::numberText(1e3 * part.massProperties.mass));
}

QString setPointText(const study::PhysicalValidation& physical) {
    double low = 1.0;
    double high = 0.0;
    for (const study::PhysicalTrial& trial : physical.trials) {
        if (trial.setPoint <= 0.0) continue;
        low = std::min(low, trial.setPoint);
        high = std::max(high, trial.setPoint);
    }
    if (high == 0.0) return Texts::tr("unknown: driven by other means");
    if (low == high) return shareText(low);
    return Texts::tr("%1 to %2").arg(shareText(low), shareText(high));
}

QString secondsText(const study::PhysicalValidation& physical) {
    std::vector<double> times;
    for (const study::PhysicalTrial& trial : physical.trials)
        if (trial.outcome == study::PhysicalOutcome::success && trial.seconds > 0.0)
            times.push_back(trial.seconds);
    if (times.empty()) return {};
    std::sort(times.begin(), times.end());
    return Texts::tr("median %1 s, %2 to %3 s")
        .arg(look::numberText(times[times.size() / 2]), look::numberText(times.front()),
             look::numberText(times.back()));
}

QString aboutHtml(const Report& report) {
    const study::PhysicalValidation& physical = report.physical;
    const Rows track = {
        {Texts::tr("Part"), inHtml(report.part->name)},
        {Texts::tr("Size, mass"), sizeText(*report.part)},
        {Texts::tr("Study"), report.study.toHtmlEscaped()},
        {Texts::tr("Track"),
         Texts::tr("generation %1, individual %2").arg(physical.generation).arg(physical.individual)},
        {Texts::tr("Printed"), inHtml(physical.track)},
        {Texts::tr("Operator"), inHtml(physical.operatorName)},
        {Texts::tr("Begun"), dateText(physical.started)},
        {Texts::tr("Last trial"),
         physical.trials.empty() ? QString() : dateText(physical.trials.back().time)},
        {Texts::tr("Program"), inHtml(physical.program)}};
    return QString("<table width=\"100%\"><tr><td>%1</td><td align=\"right\">%2</td></tr></table>")
        .arg(factTable(track), report.track.isNull() ? QString() : imageTag("track", kTrackPicture));
}

QString settingsHtml(const Report& report) {
    const study::PhysicalValidation& physical = report.physical;
    const trial::Drive& drive = report.settings.simulation.drive;
    const trial::ContactParameters& contact = report.settings.simulation.contact;
    const double frequency = physical.trials.empty() ? 0.0 : physical.trials.back().frequency;
    const Rows real = {
        {Texts::tr("Drive"), physical.drive.empty() ? Texts::tr("none connected") : inHtml(physical.drive)},
        {Texts::tr("Set-point"), setPointText(physical)},
        {Texts::tr("Limit of the study"), shareText(report.settings.feeder.highestSetPoint)},
        {Texts::tr("Frequency"), frequency > 0.0 ? readingText(frequency, 1.0, "Hz") : QString()},
        {Texts::tr("Order"), physical.plan.shuffled ? Texts::tr("shuffled (seed %1)").arg(physical.plan.seed)
                                                    : Texts::tr("pose after pose")},
        {Texts::tr("Time to success"), secondsText(physical)}};
    const Rows simulated = {
        {Texts::tr("Engine"),
         report.simulated ? inHtml(report.simulated->engine) : Texts::tr("not simulated yet")},
        {Texts::tr("Frequency"), readingText(drive.frequency, 1.0, "Hz")},
        {Texts::tr("Half-stroke"), readingText(drive.halfStroke, kMillimetre, "mm")},
        {Texts::tr("Vibration angle"), readingText(drive.angle, 1.0 / base::kDegree, "°")},
        {Texts::tr("Friction"),
         Texts::tr("%1 static, %2 kinetic")
             .arg(look::numberText(contact.staticFriction), look::numberText(contact.kineticFriction))},
        {Texts::tr("Restitution"), look::numberText(contact.restitution)},
        {Texts::tr("Tolerance"),
         report.simulated ? readingText(report.simulated->tolerance, 1.0 / base::kDegree, "°") : QString()}};
    return QString(
               "<table width=\"100%\"><tr><td width=\"50%\"><h3>%1</h3>%2</td><td><h3>%3</h3>%4</td></tr>"
               "</table>")
        .arg(Texts::tr("Real feeder"), factTable(real), Texts::tr("Simulation"), factTable(simulated));
}

QString cells(const study::SuccessCount& count) {
    if (count.trials == 0) return "<td>–</td><td>–</td><td>–</td><td>–</td>";
    return QString("<td>%1</td><td>%2</td><td><b>%3</b></td><td>%4</td>")
        .arg(count.trials)
        .arg(count.failures)
        .arg(models::percent(count.successes(), count.trials),
             models::boundsText(count.clopperPearson, count.trials));
}

QString resultRow(const study::PhysicalRow& row) {
    const bool total = row.pose < 0;
    const QString first = total ? "<b>" + Texts::tr("Total") + "</b>"
                                : QString("%1<br>%2")
                                      .arg(imageTag(QString("pose%1").arg(row.pose + 1), kPosePicture * 0.62))
                                      .arg(row.pose + 1);
    const study::SuccessCount& real = row.physical;
    return QString("<tr%1><td>%2</td>%3%4<td>%5</td><td>%6</td><td>%7</td><td>%8</td></tr>")
        .arg(total ? " class=\"total\"" : "", first, cells(row.simulated), cells(real))
        .arg(real.wrongOrientation)
        .arg(real.stuck)
        .arg(real.fellOff)
        .arg(!row.p           ? QStringLiteral("–")
             : *row.p < 0.001 ? "&lt; 0.001"
                              : models::fixed(*row.p, 3));
}

QString resultsHtml(const Report& report) {
    QString html = QString(
        "<table class=\"grid\" width=\"100%\" border=\"1\" cellspacing=\"0\" cellpadding=\"3\"><thead>"
        "<tr><th rowspan=\"2\">%1</th><th colspan=\"4\">%2</th><th colspan=\"7\">%3</th><th "
        "rowspan=\"2\"><i>p</i></th></tr>"
        "<tr><th>T</th><th>F</th><th>P [%]</th><th>95 % [%]</th><th>T</th><th>F</th><th>P [%]</th>"
        "<th>95 % [%]</th><th>%4</th><th>%5</th><th>%6</th></tr></thead>");
    html = html.arg(Texts::tr("Pose"), Texts::tr("Simulated"), Texts::tr("Real feeder"), Texts::tr("Wrong"),
                    Texts::tr("Stuck"), Texts::tr("Fell"));
    for (const study::PhysicalRow& row : report.table.rows)
        html += resultRow(row);
    html += resultRow(report.table.total) + "</table>";
    return html + "<p class=\"small\">" +
           Texts::tr(
               "T trials, F failures, P successes over trials; 95 %: bounds by Clopper and Pearson. "
               "p: how probable a difference as large as this one would be if both rates were equal; "
               "Boschloo's exact test for a pose, adjusted for the number of poses (Holm), and "
               "Fisher's with the poses as strata for the total.") +
           "</p>";
}

QString calibrationHtml(const Report& report) {
    if (report.calibrations.empty()) return {};
    QString html = "<h2>" + Texts::tr("Calibration") + "</h2>";
    Rows rows;
    for (const calibration::Calibration& one : report.calibrations) {
        for (const MethodText& method : methodTexts()) {
            if (method.method != one.method) continue;
            rows.emplace_back(method.title,
                              Texts::tr("%1: %2, %3 readings, %4")
                                  .arg(method.result, estimateText(one.result, method.factor, method.unit))
                                  .arg(one.readings.size())
                                  .arg(dateText(one.time)));
        }
    }
    return html + factTable(rows);
}

QString notesHtml(const study::PhysicalValidation& physical) {
    Rows rows;
    for (const study::PhysicalTrial& trial : physical.trials) {
        if (trial.note.empty()) continue;
        rows.emplace_back(Texts::tr("Trial %1, pose %2").arg(trial.number + 1).arg(trial.pose + 1),
                          models::verdictText(verdictOf(trial.outcome)) + ": " + inHtml(trial.note));
    }
    if (rows.empty()) return {};
    const std::size_t more = rows.size() > kMostNotes ? rows.size() - kMostNotes : 0;
    rows.resize(rows.size() - more);
    QString html = "<h2>" + Texts::tr("Notes") + "</h2>" + factTable(rows);
    if (more > 0) html += "<p>" + Texts::tr("%1 more are in the file of the trials.").arg(more) + "</p>";
    return html;
}

}  // namespace

QString reportHtml(const Report& report) {
    const int planned = report.table.total.planned;
    const int made = report.table.total.physical.trials;
    QString html =
        "<style>body { font-size: 9pt; } h1 { font-size: 17pt; } h2 { font-size: 12pt; margin-top: 14px; } "
        "h3 { font-size: 10pt; } .name { color: #555b61; } .small { font-size: 7.5pt; color: #555b61; } "
        ".verdict { font-size: 11pt; margin-bottom: 10px; } .page { page-break-before: always; } .grid td { "
        "text-align: center; vertical-align: middle; } "
        ".grid th { background-color: #eef0f2; } .total td { background-color: #f6f7f8; }</style>";
    html += "<h1>" + Texts::tr("Validation on the real feeder: %1").arg(inHtml(report.part->name)) + "</h1>";
    if (made < planned)
        html += "<p><b>" + Texts::tr("Not complete: %1 of %2 trials.").arg(made).arg(planned) + "</b></p>";
    html += "<p class=\"verdict\">" + inHtml(report.table.verdict) + "</p>";
    html += aboutHtml(report);
    html += "<h2>" + Texts::tr("Results") + "</h2>" + resultsHtml(report);
    // Pictures stand in tables: a line with a picture alone gets twice its height.
    html += QString(
                "<h2 class=\"page\">%1</h2><table cellspacing=\"0\" cellpadding=\"3\"><tr><td>%2</td></tr>"
                "<tr><td>%3</td></tr><tr><td>%4</td></tr><tr><td>%5</td></tr></table>")
                .arg(Texts::tr("Charts"),
                     Texts::tr("Success by start pose, with 95 % bounds (Clopper and Pearson):"),
                     imageTag("success", kChartPicture),
                     Texts::tr("Success on the real feeder in the course of the trials, with 95 % bounds "
                               "(Wilson):"),
                     imageTag("course", kChartPicture));
    html += "<h2>" + Texts::tr("Settings") + "</h2>" + settingsHtml(report);
    return html + calibrationHtml(report) + notesHtml(report.physical);
}

}  // namespace trapwright::feeder
