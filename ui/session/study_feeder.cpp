#include "ui/session/study_feeder.h"

#include <QDateTime>

#include "core/verify/conveying.h"
#include "ui/session/study_state.h"

namespace trapwright::session {

namespace {

std::string currentUtc() {
    return QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString();
}

calibration::Parameters parametersOf(const study::Settings& settings) {
    return {settings.simulation.contact, settings.simulation.drive, settings.box};
}

}  // namespace

StudyFeeder::StudyFeeder(StudyState& state, const StudyRuns& runs) : state_(&state), runs_(runs) {}

const std::vector<study::PhysicalValidation>& StudyFeeder::physicalValidations() const {
    return state_->physicalValidations;
}

int StudyFeeder::startPhysicalValidation(study::PhysicalValidation validation) {
    validation.number = static_cast<int>(state_->physicalValidations.size());
    validation.program = state_->environment.program;
    validation.started = currentUtc();
    validation.trials.clear();
    state_->note([validation](store::StudyFile& file) { return file.addPhysicalValidation(validation); });
    state_->physicalValidations.push_back(validation);
    emit physicalValidationChanged(validation.number);
    return validation.number;
}

void StudyFeeder::addPhysicalTrial(int validation, study::PhysicalTrial trial) {
    study::PhysicalValidation& whole = state_->physicalValidations.at(static_cast<std::size_t>(validation));
    const auto pose = study::nextPose(whole);
    if (!pose) return;
    trial.number = static_cast<int>(whole.trials.size());
    trial.pose = *pose;
    if (trial.time.empty()) trial.time = currentUtc();
    state_->note(
        [validation, trial](store::StudyFile& file) { return file.addPhysicalTrial(validation, trial); });
    whole.trials.push_back(std::move(trial));
    emit physicalValidationChanged(validation);
}

void StudyFeeder::undoPhysicalTrial(int validation) {
    study::PhysicalValidation& whole = state_->physicalValidations.at(static_cast<std::size_t>(validation));
    if (whole.trials.empty()) return;
    state_->note([validation](store::StudyFile& file) { return file.removeLastPhysicalTrial(validation); });
    whole.trials.pop_back();
    emit physicalValidationChanged(validation);
}

void StudyFeeder::appendDriveLog(std::vector<drive::LogEntry> entries) {
    if (entries.empty()) return;
    state_->note(
        [entries = std::move(entries)](store::StudyFile& file) { return file.appendDriveLog(entries); });
}

base::Result<std::vector<drive::LogEntry>> StudyFeeder::loadDriveLog(double from, double to) const {
    if (!state_->reader) return state_->cannotRead();
    return state_->reader->loadDriveLog(from, to);
}

const std::vector<calibration::Calibration>& StudyFeeder::calibrations() const {
    return state_->calibrations;
}

void StudyFeeder::addCalibration(calibration::Calibration calibration) {
    calibration.number = static_cast<int>(state_->calibrations.size());
    if (calibration.time.empty()) calibration.time = currentUtc();
    state_->note([calibration](store::StudyFile& file) { return file.addCalibration(calibration); });
    state_->calibrations.push_back(std::move(calibration));
    emit calibrationAdded(state_->calibrations.back().number);
}

std::vector<calibration::Change> StudyFeeder::calibrationChanges(double setPoint) const {
    return calibration::findChanges(parametersOf(state_->settings), state_->calibrations, setPoint);
}

study::Settings StudyFeeder::calibratedSettings(std::span<const calibration::Change> changes) const {
    study::Settings settings = state_->settings;
    const calibration::Parameters after = calibration::applyChanges(parametersOf(settings), changes);
    settings.simulation.contact = after.contact;
    settings.simulation.drive = after.drive;
    settings.box = after.box;
    return settings;
}

void StudyFeeder::requestSpeedTable() {
    state_->speedTable.cancel();
    state_->speedTable = base::RunControl();
    state_->postSimulation(
        tr("The conveying speeds could not be simulated"), state_->speedTable,
        [this, settings = calibratedSettings(calibrationChanges(0.0)), part = state_->part.part,
         control = state_->speedTable]() -> Deliver {
            const trial::EngineRegistry& engines = state_->environment.engines;
            auto engine = engines.make(
                engines.nameFor(settings.simulation.engine, trial::EngineUse::learning), {1, 0.0});
            if (!engine) return engine.error();
            verify::ConveyingScene scene;
            scene.part = part;
            scene.drive = trial::seenFromTrack(settings.simulation.drive, settings.track.shape);
            scene.slope = settings.track.shape.slope;
            scene.contact = settings.simulation.contact;
            auto table = verify::measureSpeedTable(**engine, scene, control);
            if (!table) return table.error();
            return std::function([this, table = std::move(*table)] { emit speedTableReady(table); });
        });
}

}  // namespace trapwright::session
