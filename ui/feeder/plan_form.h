#pragma once

#include <QPointer>
#include <QWidget>

#include "core/study/physical_validation.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::feeder {

class PlanCards;

/// What a new validation on the real feeder is asked: which track was printed, which poses how often and in
/// which order, and by whom.
class PlanForm : public QWidget {
    Q_OBJECT
 public:
    explicit PlanForm(QWidget* parent);

    void setRuns(const session::StudyRuns* runs);
    /// With the study's final track and all poses.
    void reset();
    /// There are other tracks to choose from.
    void listTracks();

 signals:
    void wanted(const trapwright::study::PhysicalValidation& validation);
    void cancelled();

 private:
    void showTotal();
    void begin();

    QPointer<const session::StudyRuns> runs_;
    QComboBox* track_;
    PlanCards* cards_;
    QSpinBox* repetitions_;
    QComboBox* order_;
    QLineEdit* operator_;
    QLineEdit* note_;
    QLabel* total_;
    QPushButton* begin_;
};

}  // namespace trapwright::feeder
