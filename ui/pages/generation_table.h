#pragma once

#include <QPointer>

#include "ui/models/generation_model.h"
#include "ui/pages/record_table.h"

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

/// All generations of the open study, newest first; grows while it learns.
class GenerationTable : public QWidget {
    Q_OBJECT
 public:
    explicit GenerationTable(QWidget* parent = nullptr);

    void setRuns(const session::StudyRuns* runs);
    /// -1: none.
    void setCurrent(int generation);

 signals:
    void picked(int generation);
    void failed(const QString& what, const QString& message);

 private:
    QWidget* makeHead();

    QPointer<const session::StudyRuns> runs_;
    models::GenerationModel model_;
    RecordTable* table_;
};

}  // namespace trapwright::pages
