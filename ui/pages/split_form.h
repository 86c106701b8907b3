#pragma once

#include <QWidget>
#include <vector>

#include "ui/session/print_build.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;

namespace trapwright::pages {

class PrintRow;

/// Into which pieces the track is cut, and the dowels that hold them together.
class SplitForm : public QWidget {
    Q_OBJECT
 public:
    explicit SplitForm(QWidget* parent);

    [[nodiscard]] session::SplitMode mode() const;
    /// The cuts are those of the mode SplitMode::chosen.
    [[nodiscard]] const track::SplitOptions& options() const { return options_; }
    /// Whether the pieces shall be seen apart.
    [[nodiscard]] bool apart() const;
    /// What became of it: the pieces, or why there are none.
    void show(const session::PrintedTrack& printed);

 signals:
    void edited();
    void apartChanged();
    /// Help on the field at which the user is.
    void attended(const QString& label, const QString& help);

 private:
    void addRows();
    void fillSections(const track::Track& track);
    void showFields();

    struct Value {
        PrintRow* row;
        double* target;  // in options_
        double fallback;
    };

    track::SplitOptions options_;
    std::vector<double> sections_;  // x of those that can be cut at, as listed [m]
    QComboBox* mode_;
    QListWidget* list_;
    QLabel* result_;
    QLabel* problem_;
    QCheckBox* apart_;
    std::vector<Value> values_;
};

}  // namespace trapwright::pages
