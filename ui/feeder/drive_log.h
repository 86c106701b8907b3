#pragma once

#include <QPointer>
#include <QWidget>
#include <vector>

#include "core/drive/log_entry.h"

class QLineEdit;
class QStackedLayout;
class QTreeWidget;

namespace trapwright::session {
class StudyFeeder;
}

namespace trapwright::feeder {

class DriveLink;

/// What happened to the drive since the study was opened, and the operator's remarks on it. Commands and
/// readings, which come many times a second, are in the CSV alone.
class DriveLog : public QWidget {
    Q_OBJECT
 public:
    DriveLog(DriveLink& link, QWidget* parent);

    /// Begins anew.
    void setFeeder(const session::StudyFeeder* feeder);

 signals:
    void failed(const QString& what, const QString& message);

 private:
    void add(const std::vector<drive::LogEntry>& entries);
    void askAndSave();

    DriveLink& link_;
    QPointer<const session::StudyFeeder> feeder_;
    QTreeWidget* list_;
    QStackedLayout* stack_;
    QLineEdit* remark_;
};

}  // namespace trapwright::feeder
