#pragma once

#include <QDialog>

#include "core/workflow/cluster_job.h"

class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QStackedWidget;

namespace trapwright::session {
class StudyRuns;
class StudySession;
}  // namespace trapwright::session

namespace trapwright::pages {

/// Has a study learned as a job of a cluster. Where there is an sbatch it asks for what the job is to have,
/// submits it and goes; elsewhere it writes the job's folder, tells what to do with that, and takes what was
/// learned in it.
class ClusterDialog : public QDialog {
    Q_OBJECT
 public:
    ClusterDialog(session::StudySession& session, QWidget* parent);

 private:
    QWidget* makeForm();
    QWidget* makeWritten();
    void setDefault();
    void showForm();
    void showWritten(const workflow::ClusterJob& job);
    void submit();
    void take();
    void tell(const QString& message, bool isBad);
    [[nodiscard]] workflow::JobPlan plan() const;

    session::StudySession& session_;
    session::StudyRuns& runs_;
    bool canSubmit_;
    bool isAsked_ = false;   // what was asked for goes on
    std::size_t known_ = 0;  // generations, when it was
    workflow::ClusterJob job_;
    QStackedWidget* stack_;
    QSpinBox* ranks_ = nullptr;
    QDoubleSpinBox* hours_ = nullptr;
    QLineEdit* options_ = nullptr;
    QLineEdit* program_ = nullptr;
    QLabel* time_ = nullptr;
    QPushButton* submit_ = nullptr;
    QLabel* folder_ = nullptr;
    QLineEdit* command_ = nullptr;
    QPushButton* take_ = nullptr;
    QLabel* said_;
};

}  // namespace trapwright::pages
