#include "ui/feeder/report.h"

#include <QAbstractTextDocumentLayout>
#include <QBuffer>
#include <QCoreApplication>
#include <QLocale>
#include <QPageLayout>
#include <QPainter>
#include <QPdfWriter>
#include <QTextDocument>
#include <QUrl>
#include <memory>

#include "core/base/file.h"
#include "ui/feeder/report_charts.h"

namespace trapwright::feeder {

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(Report)
};

constexpr int kResolution = 300;               // [dots per inch], of the layout
constexpr QMarginsF kMargins(18, 14, 18, 12);  // [mm]
constexpr double kFoot = 8.0;                  // [mm]
constexpr double kHead = 10.0;                 // [mm]
constexpr double kBand = 6.0;                  // of a warning in the head [mm]
constexpr double kGap = 3.5;                   // between pieces [mm]
constexpr double kInch = 25.4;                 // [mm]
const QColor kFaint(0x55, 0x5b, 0x61);
const QColor kRule(0xc4, 0xc9, 0xce);
const QColor kWarning(0xf0, 0xb4, 0x29);

constexpr double toDots(double millimetres) {
    return millimetres / kInch * kResolution;
}

struct Charts {
    QImage success;
    QImage course;
};

void addPictures(QTextDocument& document, const Report& report, const Charts& charts) {
    const auto add = [&](const QString& name, const QImage& image) {
        document.addResource(QTextDocument::ImageResource, QUrl(name), image);
    };
    if (!report.track.isNull()) add("track", report.track);
    if (!report.expected.isNull()) add("expected", report.expected);
    for (std::size_t i = 0; i < report.poses.size(); ++i)
        add(QString("pose%1").arg(i + 1), report.poses[i]);
    add("success", charts.success);
    add("course", charts.course);
}

void setFont(QPainter& painter, double points, bool bold = false) {
    QFont font = painter.font();
    font.setPointSizeF(points);
    font.setBold(bold);
    painter.setFont(font);
}

/// What the report is of, on every page: also a page alone tells that the feeder was virtual.
void drawHead(QPainter& painter, const QRectF& page, const Report& report) {
    const QString warning = reportWarning(report);
    const QRectF head(page.left(), page.top(), page.width(), toDots(kBand));
    if (!warning.isEmpty()) {
        painter.fillRect(head, kWarning);
        setFont(painter, 9.0, true);
        painter.setPen(Qt::black);
        painter.drawText(head, Qt::AlignCenter, warning);
        return;
    }
    setFont(painter, 7.5);
    painter.setPen(kFaint);
    painter.drawText(head, Qt::AlignLeft | Qt::AlignVCenter, reportTitle(report));
    painter.drawText(head, Qt::AlignRight | Qt::AlignVCenter, report.study);
    painter.setPen(QPen(kRule, 2.0));
    painter.drawLine(head.bottomLeft(), head.bottomRight());
}

void drawFoot(QPainter& painter, const QRectF& page, const Report& report, int number, int pages) {
    setFont(painter, 7.5);
    painter.setPen(kFaint);
    painter.drawText(
        page, Qt::AlignLeft | Qt::AlignBottom,
        Texts::tr("%1, %2").arg(report.program, QLocale().toString(report.written, "d MMMM yyyy, hh:mm")));
    painter.drawText(page, Qt::AlignRight | Qt::AlignBottom,
                     Texts::tr("Page %1 of %2").arg(number).arg(pages));
}

/// A piece of the report where it belongs.
struct Placed {
    std::unique_ptr<QTextDocument> text;
    int page = 0;
    double top = 0.0;     // below the head, in dots
    double height = 0.0;  // likewise
};

/// Pieces one below the other; one that does not fit goes to the next page as a whole.
std::vector<Placed> placePieces(const Report& report, QPaintDevice& device, const QSizeF& body) {
    const Charts charts{successChart(report.table, reportFeeder(report), kChartPicture),
                        courseChart(report.physical, kChartPicture)};
    std::vector<Placed> pieces;
    int page = 0;
    double top = 0.0;
    for (const QString& html : reportPieces(report)) {
        auto text = std::make_unique<QTextDocument>();
        text->documentLayout()->setPaintDevice(&device);
        text->setDocumentMargin(0.0);
        addPictures(*text, report, charts);
        text->setHtml(html);
        text->setTextWidth(body.width());
        const double height = text->documentLayout()->documentSize().height();
        if (top > 0.0 && top + height > body.height()) {
            ++page;
            top = 0.0;
        }
        pieces.push_back({std::move(text), page, top, height});
        top += height + toDots(kGap);
    }
    return pieces;
}

QByteArray makePdf(const Report& report) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    QPdfWriter writer(&buffer);
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setPageMargins(kMargins, QPageLayout::Millimeter);
    writer.setResolution(kResolution);
    writer.setTitle(reportTitle(report));
    writer.setCreator(report.program);

    const QRectF page(QPointF(), writer.pageLayout().paintRectPixels(kResolution).size());
    const QRectF body = page.adjusted(0.0, toDots(kHead), 0.0, -toDots(kFoot));
    const std::vector<Placed> pieces = placePieces(report, writer, body.size());
    const int pages = pieces.back().page + 1;
    QPainter painter(&writer);
    for (int number = 0; number < pages; ++number) {
        if (number > 0) writer.newPage();
        drawHead(painter, page, report);
        for (const Placed& piece : pieces) {
            if (piece.page != number) continue;
            painter.save();
            painter.translate(body.left(), body.top() + piece.top);
            QAbstractTextDocumentLayout::PaintContext context;
            context.palette.setColor(QPalette::Text, Qt::black);
            piece.text->documentLayout()->draw(&painter, context);
            painter.restore();
        }
        drawFoot(painter, page, report, number + 1, pages);
    }
    painter.end();
    return buffer.data();
}

}  // namespace

base::Status writeReport(const Report& report, const std::filesystem::path& pdf) {
    const QByteArray content = makePdf(report);
    const auto beside = [&](const char* ending) {
        std::filesystem::path path = pdf;
        return path.replace_filename(pdf.stem().string() + ending);
    };
    const std::pair<std::filesystem::path, std::string> files[] = {
        {pdf, content.toStdString()},
        {beside("-table.csv"), study::physicalTableCsv(report.table)},
        {beside("-trials.csv"), study::physicalTrialsCsv(report.physical)}};
    for (const auto& [path, text] : files) {
        base::Status written = base::writeFile(path, text);
        if (!written) return written;
    }
    return base::success();
}

}  // namespace trapwright::feeder
