#pragma once

#include <QWidget>
#include <vector>

#include "core/geometry/print_check.h"
#include "ui/look/theme.h"
#include "ui/scene/contents.h"

class QLabel;
class QListWidget;

namespace trapwright::pages {

class FactList;

/// What a printer makes of a solid: size, volume, and a list of thin walls and overhangs. One that is picked
/// is the only one marked in the scene; with none picked all are.
class PrintFindings : public QWidget {
    Q_OBJECT
 public:
    explicit PrintFindings(QWidget* parent);

    void show(const geometry::PrintReport& report);
    void clear();
    /// What is to be marked in the scene now.
    [[nodiscard]] std::vector<scene::Highlight> highlights() const;

 signals:
    void highlightsChanged();

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void addFlaw(const geometry::PrintFlaw& flaw, const QColor& colour, const QString& text);
    void fill();
    void colour();

    geometry::PrintReport report_;
    look::Tone tone_ = look::Tone::good;   // of the verdict
    std::vector<scene::Highlight> flaws_;  // by row of the list
    int picked_ = -1;                      // row of the last click; -1: none
    FactList* facts_;
    QLabel* verdict_;
    QListWidget* list_;
};

}  // namespace trapwright::pages
