#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>

#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"
#include "ui/scene/subject.h"

namespace trapwright::scene {

namespace {

constexpr double kGhostOpacity = 0.75;

}  // namespace

struct PartLayer::State {
    /// What all drawings of one part share.
    struct Shape {
        std::shared_ptr<const part::Part> part;
        vtkNew<vtkPolyDataMapper> solid;
        vtkNew<vtkPolyDataMapper> ghost;  // the same mesh
        base::Vec3 middle;                // of the part's box, in the part frame [m]
        base::Vec3 halfSize;              // [m]
        bool isBox = true;                // rather than an ellipsoid, for its shadow

        explicit Shape(std::shared_ptr<const part::Part> drawn) : part(std::move(drawn)) {
            const auto mesh = makeCreasedMesh(part->mesh);
            solid->SetInputData(mesh);
            ghost->SetInputData(mesh);
            const geometry::Box box = geometry::calcBoundingBox(part->mesh);
            middle = 0.5 * (box.low + box.high);
            halfSize = 0.5 * box.size();
            // An ellipsoid fills 52 % of its box.
            isBox = part->massProperties.volume > 0.75 * box.size().prod();
        }
    };

    /// Those left over stay for later and are not seen.
    struct Actors {
        std::vector<vtkSmartPointer<vtkActor>> all;
        std::size_t used = 0;
    };

    vtkRenderer* renderer = nullptr;
    std::vector<std::unique_ptr<Shape>> shapes;
    Actors solids;
    Actors ghosts;
    std::shared_ptr<const part::Part> rowOf;
    std::vector<PartInScene> row;  // of the stable poses of rowOf
    std::vector<Shade> shades;

    const Shape& shapeOf(const std::shared_ptr<const part::Part>& part) {
        const auto known = std::ranges::find(shapes, part, [](const auto& shape) { return shape->part; });
        return known != shapes.end() ? **known : *shapes.emplace_back(std::make_unique<Shape>(part));
    }

    vtkActor& nextActor(bool ghost) {
        Actors& actors = ghost ? ghosts : solids;
        if (actors.used == actors.all.size()) {
            auto actor = vtkSmartPointer<vtkActor>::New();
            setSurfaceShading(*actor, ghost ? SurfaceKind::ghost : SurfaceKind::plain);
            if (ghost) {
                actor->GetProperty()->SetOpacity(kGhostOpacity);
                // Blended in the order they come, after the track: VTK's own translucent pass costs a frame
                // buffer and mixes colours too bright.
                actor->ForceOpaqueOn();
                actor->GetProperty()->BackfaceCullingOn();
            }
            renderer->AddActor(actor);
            actors.all.push_back(actor);
        }
        return *actors.all[actors.used++];
    }

    void add(const PartInScene& shown, const QColor& colour) {
        const Shape& shape = shapeOf(shown.part);
        vtkActor& actor = nextActor(shown.ghost);
        actor.SetMapper(shown.ghost ? shape.ghost : shape.solid);
        setPose(actor, shown.pose);
        setColour(actor, shown.colour.isValid() ? shown.colour : colour);
        actor.VisibilityOn();
        if (shown.ghost) return;
        const base::Mat3 toUnit = (1.0 / (kDrawn * shape.halfSize.array())).matrix().asDiagonal() *
                                  shown.pose.rotation.toRotationMatrix().transpose();
        shades.push_back({toUnit, shown.pose.apply(shape.middle) * kDrawn, shape.isBox});
    }
};

PartLayer::PartLayer(vtkRenderer& renderer) : state_(std::make_unique<State>()) {
    state_->renderer = &renderer;
}

PartLayer::~PartLayer() = default;

void PartLayer::show(const SceneContents& contents) {
    State& state = *state_;
    if (contents.stablePoses && state.rowOf != contents.stablePoses) state.row = partsOf(contents);
    state.rowOf = contents.stablePoses;
    const std::vector<PartInScene>& parts = contents.stablePoses ? state.row : contents.parts;
    state.shades.clear();
    state.solids.used = 0;
    state.ghosts.used = 0;
    for (const PartInScene& shown : parts)
        state.add(shown, contents.theme.part);
    for (const State::Actors* actors : {&state.solids, &state.ghosts}) {
        for (std::size_t i = actors->used; i < actors->all.size(); ++i)
            actors->all[i]->VisibilityOff();
    }
    if (parts.empty()) return;
    std::erase_if(state.shapes, [&](const auto& shape) {
        return std::ranges::none_of(parts,
                                    [&](const PartInScene& shown) { return shown.part == shape->part; });
    });
}

void PartLayer::setCamera(const Camera& camera) {
    for (const auto* actors : {&state_->solids, &state_->ghosts}) {
        for (const auto& actor : actors->all)
            setLights(*actor, camera);
    }
}

const std::vector<Shade>& PartLayer::shades() const {
    return state_->shades;
}

}  // namespace trapwright::scene
