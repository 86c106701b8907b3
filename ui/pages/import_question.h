#pragma once

#include <QFrame>
#include <vector>

#include "core/geometry/mesh_check.h"
#include "core/workflow/part_source.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace trapwright::pages {

/// What only the user can say about a part file: its unit, and whether large holes in it shall be closed.
class ImportQuestion : public QFrame {
    Q_OBJECT
 public:
    explicit ImportQuestion(QWidget* parent);

    /// One button for each unit, with the size that it means.
    void askUnit(const workflow::PartRequest& request,
                 const std::vector<workflow::UnitCandidate>& candidates);
    /// What is wrong with the mesh, and the offer to mend it.
    void askRepair(const workflow::PartRequest& request, const geometry::MeshReport& found,
                   const QString& message);

 signals:
    /// The same request with the answer in it.
    void answered(const trapwright::workflow::PartRequest& request);
    void cancelled();

 private:
    void begin(const QString& question, const QString& text);
    QPushButton* addAnswer(const QString& name, const QString& text, const workflow::PartRequest& answer);
    void end();

    QLabel* text_;
    QWidget* buttons_;
    QVBoxLayout* list_;
};

}  // namespace trapwright::pages
