#pragma once

#include <QPointer>

#include "core/study/records.h"
#include "ui/models/individual_model.h"
#include "ui/pages/record_table.h"

class QLabel;
class QSpinBox;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

/// The individuals of one generation of the open study, best first. Reads them from the file, and only while
/// it is seen.
class IndividualTable : public QWidget {
    Q_OBJECT
 public:
    explicit IndividualTable(QWidget* parent = nullptr);

    void setRuns(const session::StudyRuns* runs);
    /// The generation with this individual as the current one; a generation of -1: none.
    void setCurrent(int generation, int individual);

 signals:
    void picked(const trapwright::study::Individual& individual);
    /// The generation's best is to be shown.
    void generationPicked(int generation);
    void failed(const QString& what, const QString& message);

 protected:
    void showEvent(QShowEvent* event) override;

 private:
    QWidget* makeHead();
    void load();

    QPointer<const session::StudyRuns> runs_;
    models::IndividualModel model_;
    RecordTable* table_;
    QSpinBox* spin_;
    QLabel* count_;
    int generation_ = -1;  // wanted
    int individual_ = -1;
    int loaded_ = -1;  // generation
};

}  // namespace trapwright::pages
