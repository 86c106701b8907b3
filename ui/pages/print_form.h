#pragma once

#include <QWidget>
#include <vector>

#include "core/geometry/print_check.h"
#include "core/track/print_solid.h"

class QCheckBox;

namespace trapwright::look {
class FoldingGroup;
}

namespace trapwright::pages {

class PrintRow;
struct PrintField;

/// What is printed around a surface, and what the printer can do.
struct PrintChoice {
    track::PrintOptions options;
    geometry::PrintLimits limits;
};

/// Edits a PrintChoice in groups, in mm and degrees.
class PrintForm : public QWidget {
    Q_OBJECT
 public:
    explicit PrintForm(QWidget* parent);

    [[nodiscard]] const PrintChoice& choice() const { return choice_; }
    /// What the study says: the base's thickness [m], and whether the feeder is a bowl.
    void setDesign(double baseThickness, bool bowl);
    /// Marks the option that cannot be made; an empty reason marks none.
    void setProblem(const QString& option, const QString& reason);

 signals:
    void edited();
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
};

}  // namespace trapwright::pages
