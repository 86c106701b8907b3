#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataSilhouette.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>

#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"
#include "ui/scene/subject.h"

namespace trapwright::scene {

namespace {

constexpr double kEdgeWidth = 1.1;     // logical pixels
constexpr double kTrackCrease = 12.0;  // [deg]
constexpr double kPartCrease = 30.0;   // [deg]

/// The edges of one mesh in one place: its creases, and what is its rim as the camera sees it.
struct Outline {
    vtkNew<vtkPolyDataSilhouette> silhouette;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;

    Outline(vtkRenderer& renderer, double crease) {
        silhouette->SetCamera(renderer.GetActiveCamera());
        silhouette->SetEnableFeatureAngle(1);
        silhouette->SetFeatureAngle(crease);
        silhouette->BorderEdgesOn();
        silhouette->SetProp3D(actor);
        mapper->SetInputConnection(silhouette->GetOutputPort());
        mapper->ScalarVisibilityOff();
        actor->SetMapper(mapper);
        actor->GetProperty()->LightingOff();
        actor->VisibilityOff();
        setInFront(*actor);
        renderer.AddActor(actor);
    }
};

}  // namespace

struct EdgeLayer::State {
    vtkRenderer* renderer = nullptr;
    std::unique_ptr<Outline> subject;
    struct PartOutline {
        std::unique_ptr<Outline> outline;
        std::shared_ptr<const part::Part> part;  // what it was made of
    };
    std::vector<PartOutline> parts;
    std::shared_ptr<const geometry::TriangleMesh> subjectMesh;  // what the outline was made of

    void placeParts(std::span<const PartInScene> shown) {
        while (parts.size() < shown.size())
            parts.push_back({std::make_unique<Outline>(*renderer, kPartCrease), nullptr});
        for (std::size_t i = 0; i < parts.size(); ++i) {
            PartOutline& own = parts[i];
            own.outline->actor->SetVisibility(i < shown.size());
            if (i >= shown.size()) continue;
            if (own.part != shown[i].part) {
                own.part = shown[i].part;
                own.outline->silhouette->SetInputData(makePlainMesh(own.part->mesh));
            }
            setPose(*own.outline->actor, shown[i].pose);
        }
    }
};

EdgeLayer::EdgeLayer(vtkRenderer& renderer) : state_(std::make_unique<State>()) {
    state_->renderer = &renderer;
    state_->subject = std::make_unique<Outline>(renderer, kTrackCrease);
}

EdgeLayer::~EdgeLayer() = default;

void EdgeLayer::show(const SceneContents& contents, const Camera& camera, double pixelRatio) {
    State& state = *state_;
    const auto mesh =
        contents.track ? std::shared_ptr<const geometry::TriangleMesh>(contents.track, &contents.track->solid)
                       : contents.solid;
    state.subject->actor->SetVisibility(contents.edges && mesh != nullptr);
    if (!contents.edges) {
        state.placeParts({});
        return;
    }
    if (mesh && mesh != state.subjectMesh) state.subject->silhouette->SetInputData(makePlainMesh(*mesh));
    state.subjectMesh = mesh;
    std::vector<PartInScene> solids;
    for (const PartInScene& shown : partsOf(contents))
        if (!shown.ghost) solids.push_back(shown);
    state.placeParts(solids);
    const QColor& colour = contents.theme.edge;
    const auto finish = [&](Outline& outline) {
        if (camera.parallel) {
            outline.silhouette->SetDirectionToCameraVector();
        } else {
            outline.silhouette->SetDirectionToCameraOrigin();
        }
        setColour(*outline.actor, colour);
        outline.actor->GetProperty()->SetLineWidth(static_cast<float>(kEdgeWidth * pixelRatio));
    };
    finish(*state.subject);
    for (const State::PartOutline& own : state.parts)
        finish(*own.outline);
}

}  // namespace trapwright::scene
