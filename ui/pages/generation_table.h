#pragma once

#include <QPointer>

#include "ui/models/generation_model.h"
#include "ui/pages/record_table.h"

namespace trapwright::session {
class StudySession;
}

namespace trapwright::pages {

/// All generations of the open study, newest first; grows while it learns.
class GenerationTable : public QWidget {
    Q_OBJECT
 public:
    explicit GenerationTable(QWidget* parent = nullptr);

    void setSession(session::StudySession* session);
    /// -1: none.
    void setCurrent(int generation);

 signals:
    void picked(int generation);
    void failed(const QString& what, const QString& message);

 private:
    QWidget* makeHead();

    QPointer<session::StudySession> session_;
    models::GenerationModel model_;
    RecordTable* table_;
};

}  // namespace trapwright::pages
