#include "ui/feeder/placing_scene.h"

#include "core/study/physical_table.h"
#include "core/study/target.h"
#include "core/trial/start.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::feeder {

namespace {

// Around the part, in its radii: large, and enough of the track to see where it lies.
constexpr double kCloseUp = 1.0;
// Before there is a track: its lead-in and lead-out alone.
constexpr study::IndividualId kLayout{-1, -1};

}  // namespace

base::Pose placingPose(const track::Track& track, const part::Part& part, const study::PhysicalPlan& plan,
                       int pose, int trial) {
    const trial::StartPolicy lying{part.stablePoses[static_cast<std::size_t>(pose)].rotation, 0.0, 0.0};
    const base::StreamKey stream{plan.seed, 0, 0, static_cast<std::uint32_t>(trial),
                                 base::Purpose::validation};
    return trial::drawTrial(track, part, lying, stream).parts.front().pose;
}

PlacingScene::PlacingScene(QObject* parent) : QObject(parent), build_(this) {
    connect(&build_, &session::TrackBuild::built, this,
            [this](const std::shared_ptr<const track::Track>& track) {
                track_ = track;
                draw();
                emit built();
            });
    connect(&build_, &session::TrackBuild::failed, this,
            [this](const QString& message) { emit failed(tr("The track cannot be shown"), message); });
}

void PlacingScene::setRuns(const session::StudyRuns* runs) {
    runs_ = runs;
    build_.cancel();
    printed_.reset();
    placing_.reset();
    track_.reset();
}

ExpectedExit PlacingScene::expected() const {
    if (!runs_ || !printed_ || *printed_ == kLayout) return {};
    const session::StudyDesign& design = runs_->design();
    return {track_, design.part(),
            study::findExpected(runs_->validations(), runs_->selections(), *printed_,
                                study::findWanted(design.settings(), *design.part()))};
}

void PlacingScene::setScene(scene::SceneView* scene) {
    if (scene_ != nullptr) scene_->setCloseUp(std::nullopt);
    scene_ = scene;
    draw();
}

void PlacingScene::show(const study::PhysicalValidation* validation) {
    placing_.reset();
    if (!runs_) return;
    study::IndividualId printed = kLayout;
    if (validation != nullptr) {
        placing_ = Placing{validation->plan, static_cast<int>(validation->trials.size()),
                           study::nextPose(*validation)};
        printed = *validation;
    } else if (const auto chosen = runs_->chosen()) {
        printed = *chosen;
    }
    if (printed_ == printed) return draw();
    build(printed);
}

void PlacingScene::build(const study::IndividualId& printed) {
    printed_ = printed;
    track_.reset();
    const study::TrackSettings& settings = runs_->design().settings().track;
    if (printed == kLayout) return build_.buildLayout(settings);
    const auto winner = runs_->loadIndividual(printed);
    if (winner) return build_.buildIndividual(settings, winner->record.design);
    emit failed(tr("The track cannot be shown"), QString::fromStdString(winner.error().message));
}

void PlacingScene::draw() {
    if (scene_ == nullptr || !runs_) return;
    scene::TrackMarks marks = scene::TrackMarks::none();
    marks.conveyingArrow = true;
    const std::shared_ptr<const part::Part> part = runs_->design().part();
    // A study that was changed elsewhere may name a pose that the part does not have.
    const bool known = placing_ && placing_->pose && *placing_->pose >= 0 &&
                       static_cast<std::size_t>(*placing_->pose) < part->stablePoses.size();
    if (!track_ || !known) {
        scene_->setCloseUp(std::nullopt);
        scene_->showTrack(track_, scene::TrackMarks());
        scene_->setParts({});
        return;
    }
    scene_->showTrack(track_, marks);
    scene_->setParts({{part, placingPose(*track_, *part, placing_->plan, *placing_->pose, placing_->trial)}});
    scene_->setTraces({});
    scene_->setContacts({});
    scene_->setCloseUp(kCloseUp * part->boundingRadius);
}

}  // namespace trapwright::feeder
