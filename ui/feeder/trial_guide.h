#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QString>
#include <optional>
#include <vector>

#include "core/study/physical_validation.h"

namespace trapwright::session {
class StudyFeeder;
}

namespace trapwright::feeder {

class DriveLink;

enum class Stage {
    none,     // no validation is chosen
    placing,  // the part is to be placed for the next trial
    running,  // a trial runs; how it ends is to be told
    paused,
    done  // all trials of the plan
};

/// Goes through a validation on the real feeder, trial by trial: starts the drive where it rests, takes the
/// time and the outcome, and keeps both in the study. A trial in which the drive stopped does not count.
class TrialGuide : public QObject {
    Q_OBJECT
 public:
    TrialGuide(DriveLink& link, QObject* parent);

    /// Chooses the last validation that is not complete, or else the last one.
    void setFeeder(session::StudyFeeder* feeder);
    /// Begins a new one.
    void begin(const study::PhysicalValidation& validation);
    /// Goes on with one of the study; none: with no one.
    void choose(std::optional<int> validation);

    /// Null if none is chosen.
    [[nodiscard]] const study::PhysicalValidation* validation() const;
    [[nodiscard]] Stage stage() const { return stage_; }
    /// To be placed; none when the plan is done.
    [[nodiscard]] std::optional<int> pose() const;
    /// That one and those that look the same; none if there is no next trial.
    [[nodiscard]] std::vector<int> alikePoses() const;
    /// Of the plan; 0 without one.
    [[nodiscard]] int total() const;
    /// Of the plan that were made.
    [[nodiscard]] int made() const;
    /// Since the trial was started; 0 if none runs.
    [[nodiscard]] double seconds() const;
    /// Why the last trial broke off or could not be started; empty if all is well.
    [[nodiscard]] const QString& trouble() const { return trouble_; }
    /// Of the trial that runs, or else of the last one.
    [[nodiscard]] QString note() const;

    /// Whether the drive rests while a part is placed.
    void setRestBetween(bool rest) { restBetween_ = rest; }

    void start();
    void finish(trial::Verdict outcome);
    /// Of the trial that runs, or else the last one is taken back.
    void undo();
    void pause();
    void setNote(const QString& note);

 signals:
    /// Another validation.
    void chosen();
    /// Stage, number of trials or trouble.
    void changed();

 private:
    void watchDrive();
    void breakOff(const QString& why);
    void settle(Stage stage, const QString& trouble = {});
    [[nodiscard]] Stage nextStage() const;
    /// What keeps the feeder that is there now out of this validation; empty if nothing does. Trials of the
    /// virtual feeder and of a real one are never counted together.
    [[nodiscard]] QString findMixture() const;
    [[nodiscard]] QString findObstacle() const;

    DriveLink& link_;
    QPointer<session::StudyFeeder> feeder_;
    std::optional<int> index_;
    Stage stage_ = Stage::none;
    QString trouble_;
    QString note_;
    bool restBetween_ = false;
    QElapsedTimer clock_;
    bool driven_ = false;  // the trial that runs needs the drive,
    bool moved_ = false;   // which was seen to move
};

}  // namespace trapwright::feeder
