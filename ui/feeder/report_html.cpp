#include <QCoreApplication>
#include <QLocale>
#include <algorithm>

#include "ui/feeder/calibration_texts.h"
#include "ui/feeder/drive_match.h"
#include "ui/feeder/drive_texts.h"
#include "ui/feeder/expected_pose.h"
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
constexpr std::size_t kNotesTogether = 12;  // on one page
constexpr std::size_t kMostRows = 10;       // of the results on one page

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

/// The lowest and the highest of what trials note and is known of them (above 0).
struct Range {
    double low = 0.0;
    double high = 0.0;

    [[nodiscard]] bool known() const { return high > 0.0; }
};

Range rangeOf(const study::PhysicalValidation& physical, double study::PhysicalTrial::*value) {
    Range range;
    for (const study::PhysicalTrial& trial : physical.trials) {
        const double one = trial.*value;
        if (one <= 0.0) continue;
        range.low = range.known() ? std::min(range.low, one) : one;
        range.high = std::max(range.high, one);
    }
    return range;
}

/// Of what is known of them.
double medianOf(const study::PhysicalValidation& physical, double study::PhysicalTrial::*value) {
    std::vector<double> values;
    for (const study::PhysicalTrial& trial : physical.trials)
        if (trial.*value > 0.0) values.push_back(trial.*value);
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

QString rangeText(const Range& range, double factor, const QString& unit) {
    if (!range.known()) return Texts::tr("not known");
    const QString low = readingText(range.low, factor, unit);
    const QString high = readingText(range.high, factor, unit);
    return low == high ? low : Texts::tr("%1 to %2").arg(low, high);
}

QString setPointText(const study::PhysicalValidation& physical) {
    const Range range = rangeOf(physical, &study::PhysicalTrial::setPoint);
    if (!range.known()) return Texts::tr("not known: no drive was connected");
    if (range.low == range.high) return shareText(range.low);
    return Texts::tr("%1 to %2").arg(shareText(range.low), shareText(range.high));
}

/// Every drive that was used, and how often if there were several.
QString driveText(const study::PhysicalValidation& physical) {
    std::vector<std::pair<QString, int>> drives;
    for (const study::PhysicalTrial& trial : physical.trials) {
        QString name = inHtml(trial.drive);
        if (trial.feeder == study::FeederKind::unconnected) name = Texts::tr("none connected");
        if (trial.feeder == study::FeederKind::unknown) {
            name = physical.drive.empty() ? Texts::tr("not noted")
                                          : Texts::tr("%1 when it was begun").arg(inHtml(physical.drive));
        }
        const auto known =
            std::find_if(drives.begin(), drives.end(), [&](const auto& one) { return one.first == name; });
        if (known != drives.end()) {
            ++known->second;
        } else {
            drives.emplace_back(name, 1);
        }
    }
    if (drives.empty()) return physical.drive.empty() ? Texts::tr("none connected") : inHtml(physical.drive);
    if (drives.size() == 1) return drives.front().first;
    QStringList names;
    for (const auto& [name, trials] : drives)
        names << Texts::tr("%1 (trials: %2)").arg(name).arg(trials);
    return names.join(", ");
}

/// The drive of the trials beside the simulated one, in words.
QString driveDifference(const Report& report) {
    const trial::Vibration& simulated = report.settings.simulation.drive;
    const Range strokes = rangeOf(report.physical, &study::PhysicalTrial::halfStroke);
    const Range frequencies = rangeOf(report.physical, &study::PhysicalTrial::frequency);
    calibration::DriveComparison comparison;
    // Of most trials: the first ones may have begun before the drive had settled.
    if (strokes.known()) {
        comparison.halfStroke = calibration::Deviation{
            medianOf(report.physical, &study::PhysicalTrial::halfStroke), simulated.halfStroke};
    }
    if (frequencies.known()) {
        comparison.frequency = calibration::Deviation{
            medianOf(report.physical, &study::PhysicalTrial::frequency), simulated.frequency};
    }
    const QString differences = differenceText(comparison);
    QString unknown = strokes.known()
                          ? QString()
                          : Texts::tr(
                                "The half-stroke of the drive was not known: it was neither measured nor "
                                "calibrated, so it cannot be compared with the simulated one.");
    if (!differences.isEmpty()) {
        return "<b>" + Texts::tr("Drive and simulation differ.") + "</b> " + differences + ' ' + unknown;
    }
    if (!strokes.known()) return unknown;
    return Texts::tr("The drive agreed with the simulated one within 5 %.");
}

QString secondsText(const study::PhysicalValidation& physical) {
    std::vector<double> times;
    for (const study::PhysicalTrial& trial : physical.trials)
        if (trial.outcome == trial::Verdict::success && trial.seconds > 0.0) times.push_back(trial.seconds);
    if (times.empty()) return {};
    std::sort(times.begin(), times.end());
    return Texts::tr("median %1 s (%2 to %3 s)")
        .arg(look::numberText(times[times.size() / 2]), look::numberText(times.front()),
             look::numberText(times.back()));
}

QString twoColumns(const QString& left, const QString& right) {
    return QString(
               "<table width=\"100%\" cellspacing=\"0\" cellpadding=\"0\"><tr><td width=\"50%\">%1</td>"
               "<td width=\"50%\">%2</td></tr></table>")
        .arg(left, right);
}

QString aboutPiece(const Report& report) {
    const study::PhysicalValidation& physical = report.physical;
    const Rows part = {
        {Texts::tr("Part"), inHtml(report.part->name)},
        {Texts::tr("Size, mass"), sizeText(*report.part)},
        {Texts::tr("Study"), report.study.toHtmlEscaped()},
        {Texts::tr("Track"),
         Texts::tr("generation %1, individual %2").arg(physical.generation).arg(physical.individual)},
        {Texts::tr("Printed"), inHtml(physical.track)}};
    const Rows trials = {{Texts::tr("Operator"), inHtml(physical.operatorName)},
                         {Texts::tr("Begun"), dateText(physical.started)},
                         {Texts::tr("Last trial"),
                          physical.trials.empty() ? QString() : dateText(physical.trials.back().time)},
                         {Texts::tr("Drive"), driveText(physical)},
                         {Texts::tr("Program"), inHtml(physical.program)}};
    return twoColumns(factTable(part), factTable(trials));
}

QString picturesPiece(const Report& report) {
    const auto captioned = [](const QString& picture, const QString& caption) {
        return QString(
                   "<table cellspacing=\"0\" cellpadding=\"0\"><tr><td>%1</td></tr><tr><td "
                   "class=\"small\">%2</td></tr></table>")
            .arg(picture, caption);
    };
    QString expected;
    if (report.expected.isNull()) {
        expected =
            "<p class=\"small\">" +
            Texts::tr("The expected pose is not known: this track has not been validated in simulation.") +
            "</p>";
    } else {
        QString words = Texts::tr(
            "A success: the part as it leaves the track, seen from the operator's side. "
            "The arrow is the conveying direction.");
        const QString alike = report.goal ? alikeText(report.part->symmetry, *report.goal) : QString();
        if (!alike.isEmpty()) words += ' ' + alike;
        expected = captioned(imageTag("expected", kExpectedPicture), words);
    }
    if (report.track.isNull()) return expected;
    return twoColumns(captioned(imageTag("track", kTrackPicture), Texts::tr("The track")), expected);
}

QString settingsPiece(const Report& report) {
    const study::PhysicalValidation& physical = report.physical;
    const trial::Vibration& drive = report.settings.simulation.drive;
    const trial::ContactParameters& contact = report.settings.simulation.contact;
    const Rows real = {
        {Texts::tr("Half-stroke"),
         rangeText(rangeOf(physical, &study::PhysicalTrial::halfStroke), kMillimetre, "mm")},
        {Texts::tr("Frequency"), rangeText(rangeOf(physical, &study::PhysicalTrial::frequency), 1.0, "Hz")},
        {Texts::tr("Set-point"), setPointText(physical)},
        {Texts::tr("Limit of the study"), shareText(report.settings.feeder.highestSetPoint)},
        {Texts::tr("Order of trials"), physical.plan.shuffled
                                           ? Texts::tr("shuffled (seed %1)").arg(physical.plan.seed)
                                           : Texts::tr("pose after pose")},
        {Texts::tr("Time to success"), secondsText(physical)}};
    const Rows simulated = {
        {Texts::tr("Half-stroke"), readingText(drive.halfStroke, kMillimetre, "mm")},
        {Texts::tr("Frequency"), readingText(drive.frequency, 1.0, "Hz")},
        {Texts::tr("Vibration angle"), readingText(drive.angle, 1.0 / base::kDegree, "°")},
        {Texts::tr("Friction"),
         Texts::tr("%1 static, %2 kinetic")
             .arg(look::numberText(contact.staticFriction), look::numberText(contact.kineticFriction))},
        {Texts::tr("Restitution"), look::numberText(contact.restitution)},
        {Texts::tr("Tolerance"),
         report.simulated ? readingText(report.simulated->tolerance, 1.0 / base::kDegree, "°") : QString()},
        {Texts::tr("Engine"),
         report.simulated ? inHtml(report.simulated->engine) : Texts::tr("not simulated yet")}};
    const auto side = [](const QString& title, const Rows& rows) {
        return "<h3>" + title + "</h3>" + factTable(rows);
    };
    return "<h2>" + Texts::tr("Settings") + "</h2>" +
           twoColumns(side(reportFeeder(report), real), side(Texts::tr("Simulation"), simulated)) + "<p>" +
           driveDifference(report) + "</p>";
}

QString cells(const study::SuccessCount& count, bool weighted) {
    if (count.tally.trials() == 0) return "<td>–</td><td>–</td><td>–</td><td>–</td>";
    return QString("<td>%1</td><td>%2</td><td><b>%3</b></td><td>%4</td>")
        .arg(weighted ? QString() : QString::number(count.tally.trials()),
             weighted ? QString() : QString::number(count.tally.failures()), models::percent(count.rate),
             models::boundsText(count.bounds, count.tally.trials()).replace(u' ', QChar::Nbsp));
}

QString resultRow(const study::PhysicalRow& row) {
    const bool total = row.poses.empty();
    const QString first =
        row.weighted ? "<b>" + Texts::tr("Total, weighted") + "</b>"
        : total      ? "<b>" + Texts::tr("All trials alike") + "</b>"
                     : QString("%2&nbsp;%1<br>%3 %")
                      .arg(imageTag(QString("pose%1").arg(row.poses.front() + 1), kPosePicture * 0.62),
                           models::poseNumbers(row.poses), models::percent(row.weight));
    const auto number = [&](int count) { return row.weighted ? QString() : QString::number(count); };
    const study::SuccessCount& real = row.physical;
    return QString("<tr%1><td>%2</td>%3%4<td>%5</td><td>%6</td><td>%7</td><td>%8</td></tr>")
        .arg(total ? " class=\"total\"" : "", first, cells(row.simulated, row.weighted),
             cells(real, row.weighted))
        .arg(number(real.tally.wrongOrientation), number(real.tally.stuck), number(real.tally.fellOff))
        .arg(row.weighted     ? QString()
             : !row.p         ? QStringLiteral("–")
             : *row.p < 0.001 ? "&lt; 0.001"
                              : models::fixed(*row.p, 3));
}

QString tableOf(const Report& report, const QString& rows) {
    return QString(
               "<table class=\"grid\" width=\"100%\" border=\"1\" cellspacing=\"0\" cellpadding=\"3\" "
               "style=\"border-collapse: collapse; border-style: solid; border-color: #c4c9ce;\"><thead>"
               "<tr><th rowspan=\"2\">%1</th><th colspan=\"4\">%2</th><th colspan=\"7\">%3</th><th "
               "rowspan=\"2\"><i>p</i></th></tr>"
               "<tr><th>T</th><th>F</th><th>P [%]</th><th>95 % [%]</th><th>T</th><th>F</th><th>P [%]</th>"
               "<th>95 % [%]</th><th>%4</th><th>%5</th><th>%6</th></tr></thead>")
               .arg(Texts::tr("Pose"), Texts::tr("Simulated"), reportFeeder(report), Texts::tr("Wrong"),
                    Texts::tr("Stuck"), Texts::tr("Fell")) +
           rows + "</table>";
}

/// As many tables as pages need; the total stands in the last one.
void addResults(std::vector<QString>& pieces, const Report& report) {
    QString rows;
    const std::size_t count = report.table.rows.size();
    for (std::size_t i = 0; i < count; ++i) {
        rows += resultRow(report.table.rows[i]);
        if ((i + 1) % kMostRows != 0 || i + 1 == count) continue;
        pieces.push_back((i + 1 == kMostRows ? "<h2>" + Texts::tr("Results") + "</h2>" : QString()) +
                         tableOf(report, rows));
        rows.clear();
    }
    pieces.push_back(
        (count <= kMostRows ? "<h2>" + Texts::tr("Results") + "</h2>" : QString()) +
        tableOf(report, rows + resultRow(report.table.weighted) + resultRow(report.table.total)) +
        "<p class=\"small\">" +
        Texts::tr("Poses that look the same are one; below their picture how often parts land so, which the "
                  "weighted total goes by (bounds: exact profile limits, Kabaila and Lloyd 2000). "
                  "T trials, F failures, P successes over trials; 95 %: bounds by Clopper and Pearson. "
                  "p: how probable a difference as large as this one would be if both rates were equal; "
                  "Boschloo's exact test for a pose, adjusted for the number of poses (Holm), and "
                  "Fisher's with the poses as strata for the total.") +
        "</p>");
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
                                  .arg(calibration::countReadings(one.readings))
                                  .arg(dateText(one.time)));
        }
    }
    return html + factTable(rows);
}

void addNotes(std::vector<QString>& pieces, const study::PhysicalValidation& physical) {
    Rows rows;
    for (const study::PhysicalTrial& trial : physical.trials) {
        if (trial.note.empty()) continue;
        rows.emplace_back(Texts::tr("Trial %1, pose %2").arg(trial.number + 1).arg(trial.pose + 1),
                          models::verdictText(trial.outcome) + ": " + inHtml(trial.note));
    }
    const std::size_t more = rows.size() > kMostNotes ? rows.size() - kMostNotes : 0;
    rows.resize(rows.size() - more);
    for (std::size_t i = 0; i < rows.size(); i += kNotesTogether) {
        const auto first = rows.begin() + static_cast<std::ptrdiff_t>(i);
        const auto last =
            rows.begin() + static_cast<std::ptrdiff_t>(std::min(i + kNotesTogether, rows.size()));
        pieces.push_back((i == 0 ? "<h2>" + Texts::tr("Notes") + "</h2>" : QString()) +
                         factTable(Rows(first, last)));
    }
    if (more > 0)
        pieces.push_back("<p>" + Texts::tr("%1 more are in the file of the trials.").arg(more) + "</p>");
}

/// Pictures stand in tables: a line with a picture alone gets twice its height.
QString chartPiece(const QString& title, const QString& text, const QString& picture) {
    return QString(
               "<h2>%1</h2><table cellspacing=\"0\" cellpadding=\"0\"><tr><td class=\"small\">%2</td></tr>"
               "<tr><td>%3</td></tr></table>")
        .arg(title, text, imageTag(picture, kChartPicture));
}

QString titlePiece(const Report& report) {
    const int planned = report.table.total.planned;
    const int made = report.table.total.physical.tally.trials();
    QString html = "<h1>" + reportTitle(report).toHtmlEscaped() + "</h1>";
    if (!report.table.notice.empty()) {
        html += "<table width=\"100%\" cellspacing=\"0\" cellpadding=\"6\"><tr><td class=\"notice\">" +
                inHtml(report.table.notice) + "</td></tr></table>";
    }
    if (made < planned)
        html += "<p><b>" + Texts::tr("Not complete: %1 of %2 trials.").arg(made).arg(planned) + "</b></p>";
    return html + "<p class=\"verdict\">" + inHtml(report.table.verdict) + "</p>";
}

/// For those who made and those who release it.
QString signaturePiece(const Report& report) {
    const auto row = [](const QString& role, const QString& name) {
        return QString(
                   "<tr><td width=\"18%\">%1</td><td width=\"32%\">%2<br></td><td width=\"20%\"></td><td "
                   "width=\"30%\"></td></tr>")
            .arg(role, name);
    };
    return "<h2>" + Texts::tr("Release") +
           "</h2><table class=\"sign\" width=\"100%\" border=\"1\" cellspacing=\"0\" cellpadding=\"5\" "
           "style=\"border-collapse: collapse; border-style: solid; border-color: "
           "#c4c9ce;\"><tr><th></th><th>" +
           Texts::tr("Name") + "</th><th>" + Texts::tr("Date") + "</th><th>" + Texts::tr("Signature") +
           "</th></tr>" + row(Texts::tr("Tested by"), inHtml(report.physical.operatorName)) +
           row(Texts::tr("Released by"), QString()) + "</table>";
}

const QString kStyle =
    "<style>body { font-size: 9pt; } h1 { font-size: 17pt; margin: 0px 0px 4px 0px; } h2 { font-size: 12pt; "
    "margin: 4px 0px 4px 0px; } h3 { font-size: 10pt; margin: 0px 0px 2px 0px; } p { margin: 4px 0px 0px "
    "0px; } "
    ".name { color: #555b61; } .small { font-size: 7.5pt; color: #555b61; } .verdict { font-size: 11pt; } "
    ".notice { background-color: #fdf0cf; font-size: 10pt; font-weight: bold; } "
    ".grid td { border-bottom: 1px solid #c4c9ce; text-align: center; vertical-align: middle; } .grid th { "
    "background-color: #eef0f2; } "
    ".sign th { background-color: #eef0f2; text-align: left; } .total td { background-color: #f6f7f8; "
    "}</style>";

}  // namespace

QString reportFeeder(const Report& report) {
    const study::FeederCount& feeders = report.table.feeders;
    if (feeders.mixed()) return Texts::tr("Mixed feeders");
    return feeders.virtualFeeder > 0 ? Texts::tr("Virtual feeder") : Texts::tr("Real feeder");
}

QString reportTitle(const Report& report) {
    const study::FeederCount& feeders = report.table.feeders;
    const QString part = QString::fromStdString(report.part->name);
    if (feeders.mixed()) return Texts::tr("Trials on the virtual feeder and others, mixed: %1").arg(part);
    if (feeders.virtualFeeder > 0) return Texts::tr("Training with the virtual feeder: %1").arg(part);
    if (feeders.unknown > 0) return Texts::tr("Validation on the feeder: %1").arg(part);
    return Texts::tr("Validation on the real feeder: %1").arg(part);
}

QString reportWarning(const Report& report) {
    const study::FeederCount& feeders = report.table.feeders;
    if (feeders.virtualFeeder == 0) return {};
    return feeders.mixed() ? Texts::tr("PARTLY WITH THE VIRTUAL FEEDER: no proof of a printed track")
                           : Texts::tr("VIRTUAL FEEDER: training, no proof of a printed track");
}

std::vector<QString> reportPieces(const Report& report) {
    std::vector<QString> pieces = {titlePiece(report), aboutPiece(report), picturesPiece(report),
                                   settingsPiece(report), signaturePiece(report)};
    addResults(pieces, report);
    pieces.push_back(chartPiece(Texts::tr("Success by start pose"),
                                Texts::tr("With 95 % bounds (Clopper and Pearson)."), "success"));
    pieces.push_back(
        chartPiece(Texts::tr("Success in the course of the trials"),
                   Texts::tr("%1, with 95 % bounds (Clopper and Pearson). A mark on the axis is a "
                             "failure.")
                       .arg(reportFeeder(report)),
                   "course"));
    const QString calibration = calibrationHtml(report);
    if (!calibration.isEmpty()) pieces.push_back(calibration);
    addNotes(pieces, report.physical);
    for (QString& piece : pieces)
        piece.prepend(kStyle);
    return pieces;
}

}  // namespace trapwright::feeder
