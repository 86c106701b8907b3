#include "ui/pages/print_findings.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"
#include "ui/pages/part_files.h"
#include "ui/pages/print_row.h"

namespace trapwright::pages {

namespace {

using look::numberText;
using look::Tone;

// Of the Okabe-Ito palette; the list says which is which.
const QColor kThinWall(0xd5, 0x5e, 0x00);
const QColor kRidge(0xe6, 0x9f, 0x00);
const QColor kOverhang(0xcc, 0x79, 0xa7);
constexpr int kMostFlaws = 200;  // that are listed; nobody reads more
constexpr int kMostLines = 6;    // of the list before it scrolls
constexpr int kSignSize = 16;
constexpr auto kLeastSetting = "print/leastSuccess";
constexpr double kLeastSuccess = 0.9;

QString placeText(const base::Vec3& place) {
    return PrintFindings::tr("at %1, %2, %3 mm")
        .arg(std::lround(place.x() * 1e3))
        .arg(std::lround(place.y() * 1e3))
        .arg(std::lround(place.z() * 1e3));
}

QString degrees(double angle) {
    return QString::number(std::lround(angle / base::kDegree)) + "°";
}

/// "12.3 mm too long in x" and so on, for what does not fit.
QString excessText(const geometry::BedFit& fit) {
    const QString texts[] = {PrintFindings::tr("%1 mm too large in x"),
                             PrintFindings::tr("%1 mm too large in y"), PrintFindings::tr("%1 mm too high")};
    QStringList parts;
    for (int axis = 0; axis < 3; ++axis) {
        if (fit.excess[axis] > 0.0) parts << texts[axis].arg(fit.excess[axis] * 1e3, 0, 'f', 1);
    }
    return parts.join(", ");
}

const char* iconOf(Tone tone) {
    return tone == Tone::good ? "good" : tone == Tone::warning ? "warning" : "error";
}

/// These triangles of a mesh alone.
std::shared_ptr<const geometry::TriangleMesh> takeOut(const geometry::TriangleMesh& mesh,
                                                      const std::vector<int>& triangles) {
    auto patch = std::make_shared<geometry::TriangleMesh>();
    for (const int number : triangles) {
        const int first = static_cast<int>(patch->vertices.size());
        for (const int vertex : mesh.triangles[static_cast<std::size_t>(number)])
            patch->vertices.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
        patch->triangles.push_back({first, first + 1, first + 2});
    }
    return patch;
}

}  // namespace

QString successText(const study::TrackSuccess& success) {
    const bool weighted = success.source == study::TrackSuccess::Source::validation;
    const stats::Interval bounds = success.calcInterval();
    if (success.ofArriving) {
        return (weighted ? PrintFindings::tr("%1 (%2 %) correct, weighted, of %L3 parts that arrived")
                         : PrintFindings::tr("%1 (%2 %) correct of %L3 parts that arrived"))
            .arg(models::successWord(std::optional(success.rate)),
                 models::boundsText(bounds, success.finished))
            .arg(success.finished);
    }
    return (weighted ? PrintFindings::tr("%1 (%2 %), weighted, of %L3 parts")
                     : PrintFindings::tr("%1 (%2 %) of %L3 parts"))
        .arg(models::successWord(std::optional(success.rate)),
             models::boundsText(bounds, success.count.trials))
        .arg(success.count.trials);
}

PrintFindings::PrintFindings(QWidget* parent)
    : QWidget(parent),
      leastSuccess_(QSettings().value(kLeastSetting, kLeastSuccess).toDouble()),
      least_(
          new PrintRow({"leastSuccess", tr("Ask below"), tr("%"),
                        tr("A track of which fewer parts finish in the expected orientation is exported only "
                           "after a question."),
                        0, 100},
                       this)),
      list_(new QListWidget(this)) {
    list_->setObjectName("print.flaws");
    list_->setAccessibleName(tr("Thin walls, ridges and overhangs"));
    list_->setIconSize({kSignSize, kSignSize});
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setTextElideMode(Qt::ElideRight);
    connect(list_, &QListWidget::itemSelectionChanged, this, &PrintFindings::highlightsChanged);
    // A second click on the picked one shows all again.
    connect(list_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
        picked_ = list_->row(item) == picked_ ? -1 : list_->row(item);
        if (picked_ < 0) list_->clearSelection();
    });

    auto* grid = new QGridLayout;
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(6);
    grid->setColumnStretch(2, 1);
    checks_ = {addCheck(*grid, "success", tr("Success")), addCheck(*grid, "solid", tr("Solid")),
               addCheck(*grid, "walls", tr("Walls")), addCheck(*grid, "overhangs", tr("Overhangs")),
               addCheck(*grid, "bed", tr("Printer"))};
    checks_[success].text->setToolTip(tr(
        "Share of the parts that finished in the expected orientation (where what falls off comes again: of "
        "those that arrived), in the last validation, else comparison, else while learning, with its 95 % "
        "bounds"));
    least_->show(100.0 * leastSuccess_, 100.0 * kLeastSuccess);
    connect(least_, &PrintRow::attended, this, &PrintFindings::attended);
    connect(least_, &PrintRow::edited, this, [this](double percent) {
        leastSuccess_ = std::clamp(0.01 * percent, 0.0, 1.0);
        QSettings().setValue(kLeastSetting, leastSuccess_);
        least_->show(100.0 * leastSuccess_, 100.0 * kLeastSuccess);
        judgeSuccess();
        colour();
    });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addLayout(grid);
    layout->addWidget(least_);
    layout->addWidget(list_);
    clear();
}

PrintFindings::Check PrintFindings::addCheck(QGridLayout& grid, const QString& key, const QString& name) {
    const int row = grid.rowCount();
    Check check{new QLabel(this), new QLabel(this)};
    check.sign->setObjectName("print.sign." + key);
    check.sign->setFixedSize(kSignSize, kSignSize);
    auto* label = new QLabel(name, this);
    label->setForegroundRole(QPalette::PlaceholderText);
    check.text->setObjectName("print.check." + key);
    check.text->setWordWrap(true);
    check.text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    check.text->setAccessibleName(name);
    grid.addWidget(check.sign, row, 0, Qt::AlignTop);
    grid.addWidget(label, row, 1, Qt::AlignTop);
    grid.addWidget(check.text, row, 2, Qt::AlignTop);
    return check;
}

void PrintFindings::show(const session::PrintedTrack& printed,
                         const std::optional<study::TrackSuccess>& counted, const PrintChoice& choice,
                         const track::Printer& printer) {
    setVisible(true);
    success_ = counted;
    judgeSuccess();
    judgeSolid(printed.report);
    judgeWalls(printed.report, choice.limits);
    judgeBed(printed, printer);
    listFlaws(printed);
    colour();
    emit highlightsChanged();
}

void PrintFindings::clear() {
    setVisible(false);
    flaws_.clear();
    list_->clear();
    emit highlightsChanged();
}

std::vector<scene::Highlight> PrintFindings::highlights() const {
    const int picked = list_->selectedItems().isEmpty() ? -1 : list_->row(list_->selectedItems().front());
    if (picked < 0) return flaws_;
    return {flaws_[static_cast<std::size_t>(picked)]};
}

void PrintFindings::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) colour();
}

void PrintFindings::judge(Subject subject, Tone tone, const QString& text) {
    checks_[subject].tone = tone;
    checks_[subject].text->setText(text);
}

void PrintFindings::judgeSuccess() {
    if (!success_)
        return judge(success, Tone::warning, tr("not known: select the final track, or validate this one"));
    if (success_->rate >= leastSuccess_) return judge(success, Tone::good, successText(*success_));
    judge(success, Tone::bad,
          tr("%1: below %2 %").arg(successText(*success_), numberText(100.0 * leastSuccess_)));
}

void PrintFindings::judgeSolid(const geometry::PrintReport& report) {
    if (!report.closed) return judge(solid, Tone::bad, tr("not closed: it cannot be printed"));
    const QString size = tr("%1, %2 cm³").arg(sizeText(report.size), numberText(report.volume * 1e6));
    if (report.overlappingTriangles > 0) {
        return judge(solid, Tone::warning,
                     tr("%1; closed, but crosses itself in %2 triangles: look at it before you print it")
                         .arg(size)
                         .arg(report.overlappingTriangles));
    }
    judge(solid, Tone::good, tr("closed, %1").arg(size));
}

void PrintFindings::judgeWalls(const geometry::PrintReport& report, const geometry::PrintLimits& limits) {
    QStringList parts;
    if (!report.thinWalls.empty()) {
        double thinnest = report.thinWalls.front().thickness;
        for (const geometry::ThinWall& wall : report.thinWalls)
            thinnest = std::min(thinnest, wall.thickness);
        parts << tr("%n thin, the thinnest %1 mm", nullptr, static_cast<int>(report.thinWalls.size()))
                     .arg(numberText(thinnest * 1e3));
    }
    if (!report.ridges.empty()) {
        double sharpest = report.ridges.front().angle;
        for (const geometry::SharpRidge& ridge : report.ridges)
            sharpest = std::min(sharpest, ridge.angle);
        parts << (report.ridges.size() == 1 ? tr("1 sharp ridge of %1").arg(degrees(sharpest))
                                            : tr("%1 sharp ridges, the sharpest %2")
                                                  .arg(report.ridges.size())
                                                  .arg(degrees(sharpest)));
    }
    judge(walls, parts.isEmpty() ? Tone::good : Tone::warning,
          parts.isEmpty() ? tr("none below %1 mm, no edge sharper than %2")
                                .arg(numberText(limits.thinnestWall * 1e3), degrees(geometry::kSharpestEdge))
                          : parts.join("; "));

    if (report.overhangs.empty())
        return judge(overhangs, Tone::good, tr("none beyond %1").arg(degrees(limits.steepestOverhang)));
    double steepest = 0.0;
    for (const geometry::Overhang& overhang : report.overhangs)
        steepest = std::max(steepest, overhang.angle);
    judge(overhangs, Tone::warning,
          report.overhangs.size() == 1
              ? tr("1 of %1: it needs supports").arg(degrees(steepest))
              : tr("%1, up to %2: they need supports").arg(report.overhangs.size()).arg(degrees(steepest)));
}

void PrintFindings::judgeBed(const session::PrintedTrack& printed, const track::Printer& printer) {
    const QString name = QString::fromStdString(printer.title);
    if (printed.fitsPrinter()) {
        if (printed.isCut())
            return judge(bed, Tone::good,
                         tr("each of the %1 pieces fits %2").arg(printed.pieces.size()).arg(name));
        const double turn = printed.fits.front().turn / base::kDegree;
        return judge(
            bed, Tone::good,
            turn < 0.05 ? tr("fits %1").arg(name) : tr("fits %1, turned by %2°").arg(name, numberText(turn)));
    }
    QStringList parts;
    for (std::size_t i = 0; i < printed.fits.size(); ++i) {
        if (printed.fits[i].fits) continue;
        const QString excess = excessText(printed.fits[i]);
        parts << (printed.isCut() ? tr("piece %1: %2").arg(i + 1).arg(excess) : excess);
    }
    const QString advice =
        printed.isCut() || printed.splitProblem ? QString() : tr(". Cut it into pieces below");
    judge(bed, Tone::bad, tr("too large for %1: %2%3").arg(name, parts.join("; "), advice));
}

void PrintFindings::addFlaw(scene::Highlight highlight, const base::Vec3& place, const QString& text) {
    flaws_.push_back(std::move(highlight));
    if (list_->count() >= kMostFlaws) return flaws_.pop_back();
    auto* item = new QListWidgetItem(
        look::signPixmap("warning", flaws_.back().colour, kSignSize, devicePixelRatioF()), text, list_);
    item->setToolTip(text + ", " + placeText(place));
}

void PrintFindings::listFlaws(const session::PrintedTrack& printed) {
    const geometry::PrintReport& report = printed.report;
    const QSignalBlocker quiet(list_);
    flaws_.clear();
    picked_ = -1;
    list_->clear();
    for (const geometry::ThinWall& wall : report.thinWalls) {
        addFlaw({std::make_shared<geometry::TriangleMesh>(wall.patch), {}, kThinWall}, wall.centre,
                tr("Thin wall, %1 mm over %2 mm²")
                    .arg(numberText(wall.thickness * 1e3), numberText(wall.area * 1e6)));
    }
    for (const geometry::SharpRidge& ridge : report.ridges) {
        scene::Highlight highlight{nullptr, {}, kRidge};
        for (const auto& [from, to] : ridge.edges)
            highlight.lines.push_back({from, to});
        addFlaw(
            std::move(highlight), ridge.centre,
            tr("Ridge of %1, %2 mm long, thin for %3 mm")
                .arg(degrees(ridge.angle), numberText(ridge.length * 1e3), numberText(ridge.lost * 1e3, 2)));
    }
    for (const geometry::Overhang& overhang : report.overhangs) {
        addFlaw({takeOut(*printed.solid, overhang.triangles), {}, kOverhang}, overhang.centre,
                tr("Overhang, %1 over %2 mm²").arg(degrees(overhang.angle), numberText(overhang.area * 1e6)));
    }
    const int lines = std::min(list_->count(), kMostLines);
    list_->setVisible(lines > 0);
    if (lines > 0) list_->setFixedHeight(lines * list_->sizeHintForRow(0) + 2 * list_->frameWidth());
}

void PrintFindings::colour() {
    for (const Check& check : checks_) {
        check.sign->setPixmap(look::signPixmap(iconOf(check.tone), look::toneColour(check.tone, palette()),
                                               kSignSize, devicePixelRatioF()));
        check.sign->setAccessibleName(check.tone == Tone::good ? tr("good") : tr("problem"));
    }
}

}  // namespace trapwright::pages
