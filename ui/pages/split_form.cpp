#include "ui/pages/split_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/pages/print_row.h"

namespace trapwright::pages {

using base::kMillimetre;
using session::SplitMode;

namespace {

constexpr int kMostLines = 6;  // of the list of sections before it scrolls

}  // namespace

SplitForm::SplitForm(QWidget* parent)
    : QWidget(parent),
      mode_(new QComboBox(this)),
      list_(new QListWidget(this)),
      result_(new QLabel(this)),
      problem_(new QLabel(this)),
      apart_(new QCheckBox(tr("Show the pieces apart"), this)) {
    mode_->setObjectName("print.split");
    mode_->setAccessibleName(tr("Pieces"));
    mode_->addItem(tr("In one piece"), static_cast<int>(SplitMode::whole));
    mode_->addItem(tr("As few pieces as fit the printer"), static_cast<int>(SplitMode::fit));
    mode_->addItem(tr("Cut at sections that I choose"), static_cast<int>(SplitMode::chosen));
    list_->setObjectName("print.cuts");
    list_->setAccessibleName(tr("Sections at which the track is cut"));
    result_->setObjectName("print.pieces");
    result_->setWordWrap(true);
    problem_->setObjectName("print.splitProblem");
    problem_->setWordWrap(true);
    problem_->setTextFormat(Qt::PlainText);
    problem_->hide();
    apart_->setObjectName("print.apart");

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(mode_);
    column->addWidget(list_);
    column->addWidget(result_);
    column->addWidget(problem_);
    column->addWidget(apart_);
    addRows();
    connect(mode_, &QComboBox::activated, this, [this] {
        showFields();
        emit edited();
    });
    connect(list_, &QListWidget::itemChanged, this, [this] {
        options_.cuts.clear();
        for (int i = 0; i < list_->count(); ++i) {
            if (list_->item(i)->checkState() == Qt::Checked) options_.cuts.push_back(i + 1);
        }
        emit edited();
    });
    connect(apart_, &QCheckBox::toggled, this, &SplitForm::apartChanged);
    showFields();
}

void SplitForm::addRows() {
    const auto add = [this](const PrintField& field, double& target) {
        auto* row = new PrintRow(field, this);
        layout()->addWidget(row);
        values_.push_back({row, &target, target});
        connect(row, &PrintRow::attended, this, &SplitForm::attended);
        connect(row, &PrintRow::edited, this, [this, &target](double value) {
            target = value * kMillimetre;
            showFields();
            emit edited();
        });
    };
    add({"dowelDiameter", tr("Dowels"), tr("mm"),
         tr("Diameter of the pins, two in each cut, that hold the pieces together; 0 for no holes."), 0, 30},
        options_.dowelDiameter);
    add({"dowelDepth", tr("Depth"), tr("mm"), tr("Of a pin in each of the two faces."), 1, 50},
        options_.dowelDepth);
    add({"dowelClearance", tr("Clearance"), tr("mm"),
         tr("Holes are wider and deeper than their pins by this."), 0, 2},
        options_.dowelClearance);
}

session::SplitMode SplitForm::mode() const {
    return static_cast<SplitMode>(mode_->currentData().toInt());
}

bool SplitForm::apart() const {
    return apart_->isChecked() && mode() != SplitMode::whole;
}

void SplitForm::show(const session::PrintedTrack& printed) {
    fillSections(printed.design.track);
    const auto& problem = printed.splitProblem;
    const bool isOfRow = problem && std::any_of(values_.begin(), values_.end(), [&](const Value& value) {
                             return value.row->field().key == QString::fromStdString(problem->option);
                         });
    for (const Value& value : values_) {
        const bool isMeant = problem && value.row->field().key == QString::fromStdString(problem->option);
        value.row->setProblem(isMeant ? QString::fromStdString(problem->message) : QString());
    }
    problem_->setVisible(problem && !isOfRow);
    problem_->setText(problem ? QString::fromStdString(problem->message) : QString());
    look::colourText(*problem_, look::Tone::bad);

    QStringList cuts;
    for (std::size_t i = 0; i + 1 < printed.pieces.size(); ++i) {
        const int section = printed.pieces[i].sections.last;
        const track::Track& track = printed.design.track;
        const double x = track.sections[static_cast<std::size_t>(section)].x - track.begin();
        cuts << tr("section %1 (%2 mm)").arg(section).arg(std::lround(x / kMillimetre));
    }
    result_->setVisible(mode() != SplitMode::whole && !problem);
    result_->setText(cuts.isEmpty()
                         ? (mode() == SplitMode::fit ? tr("It fits in one piece.") : tr("Choose a section."))
                         : tr("%1 pieces, cut at %2.").arg(printed.pieces.size()).arg(cuts.join(", ")));
    apart_->setEnabled(printed.isCut());
}

void SplitForm::fillSections(const track::Track& track) {
    std::vector<double> sections;
    for (std::size_t i = 1; i + 1 < track.sections.size(); ++i)
        sections.push_back(track.sections[i].x - track.begin());
    if (sections == sections_) return;
    const QSignalBlocker quiet(list_);
    // Another track has other sections.
    if (sections.size() != sections_.size()) options_.cuts.clear();
    sections_ = sections;
    list_->clear();
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        auto* item = new QListWidgetItem(
            tr("Section %1, at %2 mm").arg(number).arg(std::lround(sections[i] / kMillimetre)), list_);
        const bool isCut = std::count(options_.cuts.begin(), options_.cuts.end(), number) > 0;
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
        item->setCheckState(isCut ? Qt::Checked : Qt::Unchecked);
    }
    const int lines = std::min(list_->count(), kMostLines);
    if (lines > 0) list_->setFixedHeight(lines * list_->sizeHintForRow(0) + 2 * list_->frameWidth());
}

void SplitForm::showFields() {
    const bool any = mode() != SplitMode::whole;
    list_->setVisible(mode() == SplitMode::chosen);
    apart_->setVisible(any);
    if (!any) {
        result_->hide();
        problem_->hide();
    }
    for (const Value& value : values_) {
        value.row->show(*value.target / kMillimetre, value.fallback / kMillimetre);
        value.row->setVisible(any &&
                              (value.target == &options_.dowelDiameter || options_.dowelDiameter > 0.0));
    }
}

}  // namespace trapwright::pages
