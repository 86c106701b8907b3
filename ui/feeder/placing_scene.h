#pragma once

#include <QObject>
#include <QPointer>
#include <memory>
#include <optional>

#include "core/study/physical_validation.h"
#include "core/track/track.h"
#include "ui/feeder/expected_pose.h"
#include "ui/session/track_build.h"

namespace trapwright::scene {
class SceneView;
}
namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::feeder {

/// The pose in which the part is placed for one trial: lying as told, its heading drawn for each trial anew,
/// as in a simulated validation; the same for the same plan and trial. Part frame to room.
base::Pose placingPose(const track::Track& track, const part::Part& part, const study::PhysicalPlan& plan,
                       int pose, int trial);

/// How to place the part for the next trial, near by on the printed track.
class PlacingScene : public QObject {
    Q_OBJECT
 public:
    explicit PlacingScene(QObject* parent);

    void setRuns(const session::StudyRuns* runs);
    /// None: the page is not shown.
    void setScene(scene::SceneView* scene);
    /// The next trial of this validation; null: none is chosen.
    void show(const study::PhysicalValidation* validation);
    /// Of the validation that is shown; null until it is built.
    [[nodiscard]] std::shared_ptr<const track::Track> track() const { return track_; }
    /// How its parts are to leave, as far as is known; without a part if no track is shown.
    [[nodiscard]] ExpectedExit expected() const;

 signals:
    void built();
    void failed(const QString& what, const QString& message);

 private:
    struct Placing {
        study::PhysicalPlan plan;
        int trial = 0;
        std::optional<int> pose;
    };
    void build(const study::IndividualId& printed);
    void draw();

    QPointer<const session::StudyRuns> runs_;
    scene::SceneView* scene_ = nullptr;
    session::TrackBuild build_;
    std::shared_ptr<const track::Track> track_;
    std::optional<study::IndividualId> printed_;  // what track_ is, or is being built
    std::optional<Placing> placing_;
};

}  // namespace trapwright::feeder
