#pragma once

#include <QPointer>
#include <QWidget>
#include <string>

#include "ui/feeder/report.h"

class QLabel;
class QPushButton;

namespace trapwright::session {
class StudySession;
}

namespace trapwright::feeder {

class PlacingScene;
class TrialGuide;

/// Writes the report on the validation that is chosen.
class ReportCard : public QWidget {
    Q_OBJECT
 public:
    /// `program`: name and version.
    ReportCard(TrialGuide& guide, PlacingScene& placing, const std::string& program, QWidget* parent);

    void setSession(const session::StudySession* session);
    /// As if the user had chosen this file.
    void write(const std::filesystem::path& pdf);

 signals:
    void failed(const QString& what, const QString& message);

 private:
    [[nodiscard]] Report makeReport() const;
    void askAndWrite();
    void update();

    TrialGuide& guide_;
    PlacingScene& placing_;
    const std::string program_;
    QPointer<const session::StudySession> session_;
    QPushButton* save_;
    QLabel* text_;
};

}  // namespace trapwright::feeder
