#include "ui/pages/print_findings.h"

#include <QEvent>
#include <QLabel>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/pages/fact_list.h"
#include "ui/pages/part_files.h"

namespace trapwright::pages {

namespace {

using look::numberText;

// Of the Okabe-Ito palette; the list says which is which.
const QColor kThinWall(0xd5, 0x5e, 0x00);
const QColor kOverhang(0xcc, 0x79, 0xa7);
constexpr int kMostFlaws = 200;  // that are listed; nobody reads more
constexpr int kMostLines = 6;    // of the list before it scrolls
constexpr int kSignSize = 16;

QString placeText(const base::Vec3& place) {
    return PrintFindings::tr("at %1, %2, %3 mm")
        .arg(std::lround(place.x() * 1e3))
        .arg(std::lround(place.y() * 1e3))
        .arg(std::lround(place.z() * 1e3));
}

}  // namespace

PrintFindings::PrintFindings(QWidget* parent)
    : QWidget(parent), facts_(new FactList(this)), verdict_(new QLabel(this)), list_(new QListWidget(this)) {
    verdict_->setObjectName("print.verdict");
    verdict_->setWordWrap(true);
    list_->setObjectName("print.flaws");
    list_->setAccessibleName(tr("Thin walls and overhangs"));
    list_->setIconSize({kSignSize, kSignSize});
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setTextElideMode(Qt::ElideRight);
    connect(list_, &QListWidget::itemSelectionChanged, this, &PrintFindings::highlightsChanged);
    // A second click on the picked one shows all again.
    connect(list_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
        picked_ = list_->row(item) == picked_ ? -1 : list_->row(item);
        if (picked_ < 0) list_->clearSelection();
    });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(facts_);
    layout->addWidget(verdict_);
    layout->addWidget(list_);
    clear();
}

void PrintFindings::show(const geometry::PrintReport& report) {
    report_ = report;
    setVisible(true);
    fill();
}

void PrintFindings::clear() {
    report_ = {};
    setVisible(false);
    fill();
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

void PrintFindings::addFlaw(const geometry::PrintFlaw& flaw, const QColor& colour, const QString& text) {
    flaws_.push_back({flaw.triangles, colour});
    if (list_->count() >= kMostFlaws) {
        flaws_[kMostFlaws - 1].triangles.insert(flaws_[kMostFlaws - 1].triangles.end(),
                                                flaw.triangles.begin(), flaw.triangles.end());
        flaws_.pop_back();
        return;
    }
    auto* item =
        new QListWidgetItem(look::signPixmap("warning", colour, kSignSize, devicePixelRatioF()), text, list_);
    item->setToolTip(text + ", " + placeText(flaw.centre));
}

void PrintFindings::fill() {
    flaws_.clear();
    picked_ = -1;
    {
        const QSignalBlocker quiet(list_);
        list_->clear();
        for (const geometry::PrintFlaw& flaw : report_.thinWalls) {
            addFlaw(flaw, kThinWall,
                    tr("Thin wall, %1 mm over %2 mm²")
                        .arg(numberText(flaw.worst * 1e3), numberText(flaw.area * 1e6)));
        }
        for (const geometry::PrintFlaw& flaw : report_.overhangs) {
            addFlaw(flaw, kOverhang,
                    tr("Overhang, %1° over %2 mm²")
                        .arg(std::lround(flaw.worst / base::kDegree))
                        .arg(numberText(flaw.area * 1e6)));
        }
    }
    facts_->show({{tr("Size"), sizeText(report_.size)},
                  {tr("Volume"), tr("%1 cm³").arg(numberText(report_.volume * 1e6))}});
    const int lines = std::min(list_->count(), kMostLines);
    list_->setVisible(lines > 0);
    if (lines > 0) list_->setFixedHeight(lines * list_->sizeHintForRow(0) + 2 * list_->frameWidth());

    tone_ = look::Tone::warning;
    if (!report_.closed) {
        tone_ = look::Tone::bad;
        verdict_->setText(tr("The solid is not closed and cannot be printed."));
    } else if (report_.overlappingTriangles > 0) {
        verdict_->setText(
            tr("Closed, but the surface crosses itself in %1 triangles. Look at it before you print it.")
                .arg(report_.overlappingTriangles));
    } else if (!flaws_.empty()) {
        verdict_->setText(tr("Closed. The places below may print badly."));
    } else {
        tone_ = look::Tone::good;
        verdict_->setText(tr("Closed, no thin walls, no overhangs."));
    }
    colour();
    emit highlightsChanged();
}

void PrintFindings::colour() {
    look::colourText(*verdict_, tone_);
}

}  // namespace trapwright::pages
