#pragma once

#include <QElapsedTimer>
#include <QPointer>
#include <QWidget>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/calibration/half_stroke.h"
#include "core/study/settings.h"
#include "ui/feeder/calibration_texts.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QTreeWidget;

namespace trapwright::session {
class StudyFeeder;
}

namespace trapwright::feeder {

class DriveLink;

/// Guided measurements on the real feeder that set the simulation's parameters: how to measure, repeated
/// readings with their mean and interval, and what would change in the settings.
class CalibratePanel : public QWidget {
    Q_OBJECT
 public:
    CalibratePanel(DriveLink& link, QWidget* parent);

    void setFeeder(session::StudyFeeder* feeder);

    /// Keeps settings for the fork of this study that is about to be opened.
    void carry(const study::Settings& settings);
    /// Those for the study that is open now, if it is that fork.
    std::optional<study::Settings> takeCarried();

 signals:
    /// The settings shall change by what was kept.
    void applyWanted();

 private:
    struct Carried {
        study::Settings from;
        study::Settings to;
    };

    QWidget* makeReadings();
    QWidget* makeResult();
    [[nodiscard]] const MethodText& method() const;
    /// Those of the method that is chosen.
    [[nodiscard]] calibration::Readings& readings();
    [[nodiscard]] std::optional<base::Result<calibration::Estimate>> estimate();
    void showMethod();
    void showReadings();
    void showResult();
    void showChanges();
    void addReading();
    void removeReading();
    void toggleWatch();
    void keep();

    DriveLink& link_;
    QPointer<session::StudyFeeder> feeder_;
    const std::vector<MethodText> methods_;
    std::map<calibration::Method, calibration::Readings> readings_;  // not kept yet
    std::optional<calibration::SpeedTable> speeds_;
    std::optional<Carried> carried_;
    QElapsedTimer watch_;
    QComboBox* list_;
    QLabel* how_ = nullptr;
    std::array<QLabel*, 3> titles_{};
    std::array<QDoubleSpinBox*, 3> fields_{};
    QPushButton* add_ = nullptr;
    QPushButton* watchButton_ = nullptr;
    QTreeWidget* table_ = nullptr;
    QPushButton* remove_ = nullptr;
    QLabel* result_ = nullptr;
    QLabel* detail_ = nullptr;
    QPushButton* keep_ = nullptr;
    QLabel* changes_ = nullptr;
    QPushButton* apply_ = nullptr;
};

}  // namespace trapwright::feeder
