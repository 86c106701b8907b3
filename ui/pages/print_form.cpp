#include "ui/pages/print_form.h"

#include <QCheckBox>
#include <QVBoxLayout>

#include "ui/look/folding_group.h"
#include "ui/pages/print_row.h"
#include "ui/pages/printer_choice.h"
#include "ui/pages/split_form.h"

namespace trapwright::pages {

using base::kDegree;
using base::kMillimetre;

PrintForm::PrintForm(QWidget* parent)
    : QWidget(parent), printer_(new PrinterChoice(this)), split_(new SplitForm(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);

    look::FoldingGroup& printer = *addGroup("print.limits", tr("Printer"));
    printer.body()->addWidget(printer_);
    addRow(
        printer,
        {"thinnestWall", tr("Thinnest wall"), tr("mm"),
         tr("Walls thinner than this are marked; about three times the nozzle's width prints well. At first "
            "the printer's."),
         0.1, 20},
        choice_.limits.thinnestWall, kMillimetre);
    addRow(printer,
           {"steepestOverhang", tr("Steepest overhang"), tr("°"),
            tr("Undersides that lean further than this from upright are marked: they need supports. 90° is a "
               "ceiling. At first the printer's."),
            0, 90},
           choice_.limits.steepestOverhang, kDegree);
    connect(printer_, &PrinterChoice::changed, this, [this] {
        takePrinter();
        emit edited();
    });
    connect(printer_, &PrinterChoice::failed, this, &PrintForm::failed);

    look::FoldingGroup& pieces = *addGroup("print.split", tr("Pieces"));
    pieces.body()->addWidget(split_);
    connect(split_, &SplitForm::edited, this, &PrintForm::edited);
    connect(split_, &SplitForm::apartChanged, this, &PrintForm::apartChanged);
    connect(split_, &SplitForm::attended, this, &PrintForm::attended);

    look::FoldingGroup& shape = *addGroup("print.shape", tr("Base and walls"));
    addRow(
        shape,
        {"baseThickness", tr("Base thickness"), tr("mm"),
         tr("How thick the track is below its lowest possible valley; at first as in the track's settings."),
         0.5, 100},
        base_, kMillimetre);
    addRow(shape,
           {"wallHeight", tr("Wall height"), tr("mm"),
            tr("How far both side walls rise above what is highest of the surface beside them; those that "
               "the track was "
               "learned with are there at least. They stand outside the surface, which stays as it was."),
            0, 100},
           choice_.options.wallHeight, kMillimetre);
    wallRows_ = {addRow(shape,
                        {"wallThickness", tr("Wall thickness"), tr("mm"),
                         tr("How far the walls reach beyond the track's width."), 0.4, 50},
                        choice_.options.wallThickness, kMillimetre)};
    addRow(
        shape,
        {"rim", tr("Rim"), tr("mm"),
         tr("How far the track goes on level beyond a border to which its surface rises so steeply that the "
            "edge would be too sharp to print, where there is no wall. At first the printer's thinnest "
            "wall; 0 for none."),
         0, 20},
        choice_.options.rim, kMillimetre);

    look::FoldingGroup& mount = *addGroup("print.mount", tr("Mounting"));
    flange_ = new QCheckBox(this);
    flange_->setObjectName("print.flange");
    connect(flange_, &QCheckBox::toggled, this, [this](bool on) {
        choice_.options.flange = on;
        showValues();
        emit edited();
    });
    mount.body()->addWidget(flange_);
    const auto addMount = [&](const PrintField& field, double& target) {
        flangeRows_.push_back(addRow(mount, field, target, kMillimetre));
    };
    addMount({"flangeThickness", tr("Flange thickness"), tr("mm"),
              tr("The plate at the track's foot; at most as thick as the base."), 0.5, 100},
             choice_.options.flangeThickness);
    addMount({"boltDiameter", tr("Bolt holes"), tr("mm"),
              tr("Diameter of the holes: 3.4 for M3, 4.5 for M4, 5.5 for M5; 0 for none."), 0, 30},
             choice_.options.boltDiameter);
    addMount({"boltSpacing", tr("Bolt spacing"), tr("mm"),
              tr("Between the centres of the holes; as many as fit, centred along the length."), 1, 500},
             choice_.options.boltSpacing);
    addMount({"boltEdgeDistance", tr("Distance from edge"), tr("mm"),
              tr("From the centres of the holes to the flange's edge. The flange is twice as wide."), 1, 100},
             choice_.options.boltEdgeDistance);
    addMount({"insertRadius", tr("Bowl radius inside"), tr("mm"),
              tr("Where the bowl's wall is: there the insert is cut round. 0 for the least that leaves room "
                 "for the "
                 "track and the bolts."),
              0, 1000},
             choice_.options.insertRadius);
    insertRow_ = flangeRows_.back();

    takePrinter();
    setDesign(kMillimetre, false, false);
}

look::FoldingGroup* PrintForm::addGroup(const QString& name, const QString& title) {
    auto* group = new look::FoldingGroup(name, title, false, this);
    layout()->addWidget(group);
    return group;
}

PrintRow* PrintForm::addRow(look::FoldingGroup& group, const PrintField& field, double& target, double unit) {
    auto* row = new PrintRow(field, this);
    group.body()->addWidget(row);
    values_.push_back({row, &target, target, unit});
    connect(row, &PrintRow::attended, this, &PrintForm::attended);
    connect(row, &PrintRow::edited, this, [this, &target, unit](double value) {
        target = value * unit;
        // The design's own thickness stays so when the study's settings change.
        if (&target == &base_) {
            choice_.options.baseThickness.reset();
            if (base_ != designBase_) choice_.options.baseThickness = base_;
        }
        showValues();
        emit edited();
    });
    return row;
}

void PrintForm::setDesign(double baseThickness, bool bowl, bool walled) {
    designBase_ = baseThickness;
    bowl_ = bowl;
    walled_ = walled;
    base_ = choice_.options.baseThickness.value_or(baseThickness);
    flange_->setText(bowl ? tr("Insert for the bowl") : tr("Mounting flange"));
    flange_->setToolTip(bowl ? tr("A foot at the outer side that fits into the bowl, with bolt holes")
                             : tr("A plate at both sides of the foot, with bolt holes"));
    showValues();
}

void PrintForm::setProblem(const QString& option, const QString& reason) {
    for (const Value& value : values_)
        value.row->setProblem(value.row->field().key == option ? reason : QString());
}

const track::Printer& PrintForm::printer() const {
    return printer_->printer();
}

void PrintForm::show(const session::PrintedTrack& printed) {
    split_->show(printed);
}

void PrintForm::takePrinter() {
    const track::Printer& printer = printer_->printer();
    choice_.limits.thinnestWall = printer.thinnestWall;
    choice_.limits.steepestOverhang = printer.steepestOverhang;
    choice_.options.rim = printer.thinnestWall;
    for (Value& value : values_) {
        if (value.target == &choice_.limits.thinnestWall ||
            value.target == &choice_.limits.steepestOverhang || value.target == &choice_.options.rim)
            value.fallback = *value.target;
    }
    showValues();
}

void PrintForm::showValues() {
    for (const Value& value : values_) {
        const double fallback = value.target == &base_ ? designBase_ : value.fallback;
        value.row->show(*value.target / value.unit, fallback / value.unit);
    }
    for (PrintRow* row : wallRows_)
        row->setVisible(choice_.options.wallHeight > 0.0 || walled_);
    for (PrintRow* row : flangeRows_)
        row->setVisible(choice_.options.flange && (row != insertRow_ || bowl_));
}

}  // namespace trapwright::pages
