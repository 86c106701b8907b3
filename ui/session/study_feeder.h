#pragma once

#include <QObject>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/apply.h"
#include "core/calibration/half_stroke.h"
#include "core/calibration/measurement.h"
#include "core/drive/log_entry.h"
#include "core/study/physical_validation.h"
#include "core/study/settings.h"
#include "ui/session/study_runs.h"

namespace trapwright::session {

/// What is noted and measured at the real feeder of the open study: validations with real parts, the log of
/// the drive, and calibrations. What is added here is saved at once by a thread of its own, also while the
/// study learns. What cannot be saved is told by StudySession::failed(), kept, and tried again with the next
/// record and on closing.
class StudyFeeder : public QObject {
    Q_OBJECT

 public:
    StudyFeeder(StudyState& state, const StudyRuns& runs);

    /// What is compared with the feeder.
    [[nodiscard]] const StudyRuns& runs() const { return runs_; }
    [[nodiscard]] const StudyDesign& design() const { return runs_.design(); }

    /// Validations on the real feeder, oldest first; number = place in the list.
    [[nodiscard]] const std::vector<study::PhysicalValidation>& physicalValidations() const;
    /// Begins one, without trials; its number, program and time are set here. Returns the number.
    int startPhysicalValidation(study::PhysicalValidation validation);
    /// Adds the next trial of the plan; its number, pose and, if it has none, time are set here. Nothing
    /// happens if the plan is done.
    void addPhysicalTrial(int validation, study::PhysicalTrial trial);
    /// Takes the last trial back, if there is one.
    void undoPhysicalTrial(int validation);

    /// Adds to the log of the drive. Best some at a time, as every call is synced to the disk.
    void appendDriveLog(std::vector<drive::LogEntry> entries);
    /// What was logged in [from, to) [s since 1970, UTC] and is saved.
    [[nodiscard]] base::Result<std::vector<drive::LogEntry>> loadDriveLog(double from, double to) const;

    /// Measurements on the real feeder, oldest first.
    [[nodiscard]] const std::vector<calibration::Calibration>& calibrations() const;
    /// Its number and, if it has none, time are set here.
    void addCalibration(calibration::Calibration calibration);
    /// What the newest measurements would change in the settings, for a feeder driven at `setPoint` (share of
    /// full; 0: leaves the half-stroke alone).
    [[nodiscard]] std::vector<calibration::Change> calibrationChanges(double setPoint) const;
    /// Simulates how quickly the part is conveyed at which half-stroke, with the friction and restitution
    /// that were measured. Ends with speedTableReady() or failed().
    void requestSpeedTable();
    /// The settings with these changes: for StudyDesign::changeSettings(), or for a fork where the study is
    /// locked.
    [[nodiscard]] study::Settings calibratedSettings(std::span<const calibration::Change> changes) const;

 signals:
    /// It was begun, or has a trial more or less.
    void physicalValidationChanged(int validation);
    void calibrationAdded(int calibration);
    void speedTableReady(const trapwright::calibration::SpeedTable& table);

 private:
    StudyState* const state_;
    const StudyRuns& runs_;
};

}  // namespace trapwright::session
