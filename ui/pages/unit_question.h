#pragma once

#include <QFrame>
#include <vector>

#include "core/work/part_source.h"

class QLabel;
class QVBoxLayout;

namespace trapwright::pages {

/// Asks for the unit of a part file that does not tell it: one button for each, with the size that it means.
class UnitQuestion : public QFrame {
    Q_OBJECT
 public:
    explicit UnitQuestion(QWidget* parent);

    void ask(const work::PartRequest& request, const std::vector<work::UnitCandidate>& candidates);

 signals:
    /// The same request with the unit in it.
    void answered(const trapwright::work::PartRequest& request);
    void cancelled();

 private:
    QLabel* text_;
    QWidget* buttons_;
    QVBoxLayout* list_;
};

}  // namespace trapwright::pages
