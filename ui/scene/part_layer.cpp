#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>

#include "ui/scene/actors.h"
#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"
#include "ui/scene/pose_row.h"

namespace trapwright::scene {

namespace {

constexpr double kGhostOpacity = 0.75;

}  // namespace

struct PartLayer::State {
    vtkRenderer* renderer = nullptr;
    vtkNew<vtkPolyDataMapper> solidMapper;
    vtkNew<vtkPolyDataMapper> ghostMapper;  // the same mesh
    std::vector<vtkSmartPointer<vtkActor>> solids;
    std::vector<vtkSmartPointer<vtkActor>> ghosts;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const part::Part> rowOf;
    std::vector<base::Pose> row;  // stable poses of rowOf
    base::Vec3 middle;            // of the part's box, in the part frame [m]
    base::Vec3 halfSize;          // [m]
    bool isBox = true;            // rather than an ellipsoid, for its shadow
    std::vector<Shade> shades;

    void setPart(const std::shared_ptr<const part::Part>& wanted) {
        if (part == wanted) return;
        part = wanted;
        if (!part) return;
        const auto mesh = makeCreasedMesh(part->mesh);
        solidMapper->SetInputData(mesh);
        ghostMapper->SetInputData(mesh);
        const geometry::Box box = geometry::calcBoundingBox(part->mesh);
        middle = 0.5 * (box.low + box.high);
        halfSize = 0.5 * box.size();
        // An ellipsoid fills 52 % of its box.
        isBox = part->massProperties.volume > 0.75 * box.size().prod();
    }

    /// As many actors as there are poses; those left over stay for later and are not seen.
    void place(std::vector<vtkSmartPointer<vtkActor>>& actors, std::span<const base::Pose> poses,
               bool ghost) {
        while (actors.size() < poses.size()) {
            auto actor = vtkSmartPointer<vtkActor>::New();
            actor->SetMapper(ghost ? ghostMapper : solidMapper);
            setSurfaceShading(*actor, ghost ? SurfaceKind::ghost : SurfaceKind::plain);
            if (ghost) {
                actor->GetProperty()->SetOpacity(kGhostOpacity);
                // Blended in the order they come, after the track: VTK's own translucent pass costs a frame
                // buffer and mixes colours too bright.
                actor->ForceOpaqueOn();
                actor->GetProperty()->BackfaceCullingOn();
            }
            renderer->AddActor(actor);
            actors.push_back(actor);
        }
        for (std::size_t i = 0; i < actors.size(); ++i) {
            actors[i]->SetVisibility(i < poses.size());
            if (i < poses.size()) setPose(*actors[i], poses[i]);
        }
    }

    void addShade(const base::Pose& pose) {
        const base::Mat3 toUnit = (1.0 / (kDrawn * halfSize.array())).matrix().asDiagonal() *
                                  pose.rotation.toRotationMatrix().transpose();
        shades.push_back({toUnit, pose.apply(middle) * kDrawn, isBox});
    }
};

PartLayer::PartLayer(vtkRenderer& renderer) : state_(std::make_unique<State>()) {
    state_->renderer = &renderer;
}

PartLayer::~PartLayer() = default;

void PartLayer::show(const SceneContents& contents) {
    State& state = *state_;
    state.setPart(contents.stablePoses ? contents.stablePoses : contents.part);
    if (state.rowOf != contents.stablePoses) {
        state.rowOf = contents.stablePoses;
        state.row = state.rowOf ? makePoseRow(*state.rowOf).poses : std::vector<base::Pose>();
    }
    std::span<const base::Pose> solids = state.row;
    std::span<const base::Pose> ghosts;
    if (!contents.stablePoses) {
        const std::span<const base::Pose> poses =
            contents.part ? std::span<const base::Pose>(contents.partPoses) : std::span<const base::Pose>();
        solids = poses.first(std::min<std::size_t>(poses.size(), 1));
        ghosts = poses.subspan(solids.size());
    }
    state.place(state.solids, solids, false);
    state.place(state.ghosts, ghosts, true);
    const auto colourOf = [&contents](std::size_t index) {
        const bool given = !contents.stablePoses && index < contents.partColours.size() &&
                           contents.partColours[index].isValid();
        return given ? contents.partColours[index] : contents.theme.part;
    };
    for (std::size_t i = 0; i < solids.size(); ++i)
        setColour(*state.solids[i], colourOf(i));
    for (std::size_t i = 0; i < ghosts.size(); ++i)
        setColour(*state.ghosts[i], colourOf(i + 1));
    state.shades.clear();
    for (const base::Pose& pose : solids)
        state.addShade(pose);
}

void PartLayer::setCamera(const Camera& camera) {
    for (const auto* actors : {&state_->solids, &state_->ghosts}) {
        for (const auto& actor : *actors)
            setLights(*actor, camera);
    }
}

const std::vector<Shade>& PartLayer::shades() const {
    return state_->shades;
}

}  // namespace trapwright::scene
