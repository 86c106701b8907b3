#include "ui/feeder/trial_guide.h"

#include <algorithm>

#include "core/part/stable_poses.h"
#include "ui/feeder/drive_link.h"
#include "ui/feeder/drive_texts.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"

namespace trapwright::feeder {

using drive::State;
using session::StudyFeeder;

namespace {

constexpr double kStartPatience = 2.0;  // [s] until the drive must have begun to move

}  // namespace

TrialGuide::TrialGuide(DriveLink& link, QObject* parent) : QObject(parent), link_(link) {
    connect(&link_, &DriveLink::polled, this, &TrialGuide::watchDrive);
    connect(&link_, &DriveLink::stateChanged, this, &TrialGuide::watchDrive);
}

void TrialGuide::setFeeder(StudyFeeder* feeder) {
    if (feeder_) feeder_->disconnect(this);
    feeder_ = feeder;
    std::optional<int> last;
    if (feeder_) {
        connect(feeder_, &StudyFeeder::physicalValidationChanged, this, [this](int validation) {
            if (index_ == validation) emit changed();
        });
        for (const study::PhysicalValidation& one : feeder_->physicalValidations()) {
            if (!last || study::nextPose(one)) last = one.number;
        }
    }
    choose(last);
}

void TrialGuide::begin(const study::PhysicalValidation& validation) {
    if (feeder_) choose(feeder_->startPhysicalValidation(validation));
}

void TrialGuide::choose(std::optional<int> validation) {
    if (stage_ == Stage::running) link_.stop();
    index_ = validation;
    note_.clear();
    // What is gone on with begins when the operator says so.
    const bool begun = this->validation() != nullptr && !this->validation()->trials.empty();
    stage_ = nextStage() == Stage::placing && begun ? Stage::paused : nextStage();
    trouble_.clear();
    emit chosen();
    emit changed();
}

const study::PhysicalValidation* TrialGuide::validation() const {
    if (!feeder_ || !index_) return nullptr;
    const auto& all = feeder_->physicalValidations();
    const auto place = static_cast<std::size_t>(*index_);
    return place < all.size() ? &all[place] : nullptr;
}

std::vector<int> TrialGuide::alikePoses() const {
    const std::optional<int> next = pose();
    if (!next) return {};
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(*feeder_->design().part());
    const int group = part::findPoseGroup(groups, *next);
    return group < 0 ? std::vector{*next} : groups[static_cast<std::size_t>(group)].poses;
}

std::optional<int> TrialGuide::pose() const {
    const study::PhysicalValidation* now = validation();
    return now != nullptr ? study::nextPose(*now) : std::nullopt;
}

int TrialGuide::total() const {
    const study::PhysicalValidation* now = validation();
    return now != nullptr ? static_cast<int>(now->plan.poses.size()) * now->plan.repetitions : 0;
}

int TrialGuide::made() const {
    const study::PhysicalValidation* now = validation();
    return now != nullptr ? static_cast<int>(now->trials.size()) : 0;
}

double TrialGuide::seconds() const {
    return stage_ == Stage::running ? 1e-3 * static_cast<double>(clock_.elapsed()) : 0.0;
}

QString TrialGuide::note() const {
    if (stage_ == Stage::running) return note_;
    const study::PhysicalValidation* now = validation();
    return now == nullptr || now->trials.empty() ? QString()
                                                 : QString::fromStdString(now->trials.back().note);
}

QString TrialGuide::findMixture() const {
    const study::FeederCount feeders = study::countFeeders(*validation());
    const bool virtualNow = driven_ && link_.profile().isVirtual;
    // What is mixed already is told as such, and may go on.
    if (feeders.mixed()) return {};
    if (virtualNow && feeders.physical() > 0) {
        return tr(
            "This validation was made on a real feeder so far. Plan another one for the virtual "
            "feeder, or disconnect it.");
    }
    if (!virtualNow && feeders.virtualFeeder > 0) {
        return tr(
            "This validation was made with the virtual feeder so far. Plan another one for the real "
            "feeder, or connect the virtual one.");
    }
    return {};
}

QString TrialGuide::findObstacle() const {
    const State state = link_.snapshot().state;
    if (state == State::faulted) return tr("Acknowledge the fault of the drive first.");
    if (state == State::disconnected) return tr("The drive is not reached yet; wait, or disconnect it.");
    if (state == State::stopping) return tr("Wait until the drive rests.");
    if (link_.target() <= 0.0) return tr("Choose a set-point of the drive first.");
    return {};
}

void TrialGuide::start() {
    if (stage_ != Stage::placing && stage_ != Stage::paused) return;
    // Without a drive here the operator moves the feeder by other means.
    driven_ = link_.linked();
    moved_ = false;
    const QString mixture = findMixture();
    if (!mixture.isEmpty()) return settle(stage_, mixture);
    if (driven_) {
        const QString obstacle = findObstacle();
        if (!obstacle.isEmpty()) return settle(stage_, obstacle);
    }
    note_.clear();
    clock_.start();
    settle(Stage::running);
    if (driven_ && !link_.moves()) link_.start();
}

void TrialGuide::finish(trial::Verdict outcome) {
    const std::optional<int> pose = this->pose();
    if (stage_ != Stage::running || !pose) return;
    study::PhysicalTrial trial;
    trial.pose = *pose;
    trial.outcome = outcome;
    trial.seconds = seconds();
    trial.note = note_.toStdString();
    trial.feeder = study::FeederKind::unconnected;
    if (driven_) {
        const calibration::DriveSetting setting = link_.setting();
        trial.feeder = link_.profile().isVirtual ? study::FeederKind::virtualFeeder : study::FeederKind::real;
        trial.drive = link_.profile().title;
        trial.setPoint = link_.target();
        trial.frequency = setting.frequency.value_or(0.0);
        trial.halfStroke = setting.halfStroke.value_or(0.0);
    }
    feeder_->addPhysicalTrial(*index_, trial);
    settle(nextStage());
    if (driven_ && (restBetween_ || stage_ == Stage::done)) link_.stop();
}

void TrialGuide::undo() {
    if (stage_ == Stage::running) return settle(Stage::placing);
    if (made() == 0) return;
    feeder_->undoPhysicalTrial(*index_);
    settle(stage_ == Stage::paused ? Stage::paused : Stage::placing);
}

void TrialGuide::pause() {
    if (stage_ != Stage::placing && stage_ != Stage::running) return;
    settle(Stage::paused);
    link_.stop();
}

void TrialGuide::setNote(const QString& note) {
    if (stage_ == Stage::running) {
        note_ = note;
        return;
    }
    const study::PhysicalValidation* now = validation();
    if (now == nullptr || now->trials.empty()) return;
    study::PhysicalTrial trial = now->trials.back();
    trial.note = note.toStdString();
    feeder_->undoPhysicalTrial(*index_);
    feeder_->addPhysicalTrial(*index_, trial);
}

void TrialGuide::watchDrive() {
    if (stage_ != Stage::running || !driven_) return;
    if (link_.moves()) {
        moved_ = true;
        return;
    }
    const drive::Snapshot& now = link_.snapshot();
    if (!now.fault.empty()) return breakOff(QString::fromStdString(now.fault));
    if (moved_) return breakOff(tr("The drive was stopped."));
    if (!now.refusal.empty()) return breakOff(QString::fromStdString(now.refusal));
    if (seconds() > kStartPatience) breakOff(tr("The drive did not start."));
}

void TrialGuide::breakOff(const QString& why) {
    settle(Stage::placing, tr("The trial does not count; place the part once more. %1").arg(asSentence(why)));
}

void TrialGuide::settle(Stage stage, const QString& trouble) {
    stage_ = stage;
    trouble_ = trouble;
    emit changed();
}

Stage TrialGuide::nextStage() const {
    if (validation() == nullptr) return Stage::none;
    return pose() ? Stage::placing : Stage::done;
}

}  // namespace trapwright::feeder
