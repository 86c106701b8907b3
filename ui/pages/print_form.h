#pragma once

#include <QWidget>
#include <vector>

#include "core/geometry/print_check.h"
#include "core/track/print_solid.h"
#include "core/track/printer.h"

class QCheckBox;

namespace trapwright::look {
class FoldingGroup;
}
namespace trapwright::session {
struct PrintedTrack;
}

namespace trapwright::pages {

class PrinterChoice;
class PrintRow;
class SplitForm;
struct PrintField;

/// What is printed around a surface, and what the printer can do.
struct PrintChoice {
    track::PrintOptions options;
    geometry::PrintLimits limits;  // at first the printer's
};

/// Edits a PrintChoice in groups, in mm and degrees.
class PrintForm : public QWidget {
    Q_OBJECT
 public:
    explicit PrintForm(QWidget* parent);

    [[nodiscard]] const PrintChoice& choice() const { return choice_; }
    /// What the study says: the base's thickness [m], whether the feeder is a bowl, whether the track has
    /// walls.
    void setDesign(double baseThickness, bool bowl, bool walled);
    [[nodiscard]] const track::Printer& printer() const;
    [[nodiscard]] const SplitForm& split() const { return *split_; }
    /// What became of the choice.
    void show(const session::PrintedTrack& printed);
    /// Marks the option that cannot be made; an empty reason marks none.
    void setProblem(const QString& option, const QString& reason);

 signals:
    void edited();
    /// Whether the pieces shall be seen apart.
    void apartChanged();
    void failed(const QString& what, const QString& message);
    /// Help on the field at which the user is.
    void attended(const QString& label, const QString& help);

 private:
    struct Value {
        PrintRow* row;
        double* target;  // in choice_
        double fallback;
        double unit;
    };

    look::FoldingGroup* addGroup(const QString& name, const QString& title);
    PrintRow* addRow(look::FoldingGroup& group, const PrintField& field, double& target, double unit);
    void takePrinter();
    void showValues();

    PrintChoice choice_;
    double designBase_ = 0.0;
    double base_ = 0.0;  // the thickness that is shown
    std::vector<Value> values_;
    std::vector<PrintRow*> wallRows_;
    std::vector<PrintRow*> flangeRows_;
    PrintRow* insertRow_;
    QCheckBox* flange_;
    bool bowl_ = false;
    bool walled_ = false;
    PrinterChoice* printer_;
    SplitForm* split_;
};

}  // namespace trapwright::pages
