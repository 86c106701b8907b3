#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "ui/scene/force_legend.h"
#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"

namespace trapwright::scene {

namespace {

constexpr double kTraceWidth = 2.0;  // logical pixels

/// The arrows begin where they push.
std::vector<Arrow> makeContactArrows(const SceneContents& contents) {
    std::vector<Arrow> arrows;
    if (contents.parts.empty()) return arrows;
    const part::Part& part = *contents.parts.front().part;
    for (const ContactArrow& contact : contents.contacts) {
        const double force = contact.force.norm();
        const double length = arrowLength(part, force);
        if (length <= 0.0) continue;
        const base::Vec3 along = contact.force / force;
        arrows.push_back({contact.point, contact.point + length * along, 0.06 * part.boundingRadius});
    }
    return arrows;
}

}  // namespace

struct MotionLayer::State {
    vtkNew<vtkActor> traces;
    vtkNew<vtkActor> contacts;
    vtkNew<vtkPolyDataMapper> traceMapper;
    vtkNew<vtkPolyDataMapper> contactMapper;
    std::vector<Trace> shownTraces;
    std::vector<ContactArrow> shownContacts;
    QColor traceColour;
};

MotionLayer::MotionLayer(vtkRenderer& renderer) : state_(std::make_unique<State>()) {
    state_->traces->SetMapper(state_->traceMapper);
    state_->traces->GetProperty()->LightingOff();
    state_->contacts->SetMapper(state_->contactMapper);
    setSurfaceShading(*state_->contacts, SurfaceKind::plain);
    setBeforeAll(*state_->contacts);
    for (vtkActor* actor : {state_->traces.Get(), state_->contacts.Get()}) {
        actor->VisibilityOff();
        renderer.AddActor(actor);
    }
}

MotionLayer::~MotionLayer() = default;

void MotionLayer::show(const SceneContents& contents, double pixelRatio) {
    State& state = *state_;
    if (state.shownTraces != contents.traces || state.traceColour != contents.theme.trace) {
        state.shownTraces = contents.traces;
        state.traceColour = contents.theme.trace;
        std::vector<ColouredLine> lines;
        for (const Trace& trace : contents.traces)
            lines.push_back({trace.points, trace.colour.isValid() ? trace.colour : state.traceColour});
        state.traceMapper->SetInputData(makeLines(lines));
        state.traces->SetVisibility(!lines.empty());
    }
    state.traces->GetProperty()->SetLineWidth(static_cast<float>(kTraceWidth * pixelRatio));
    if (state.shownContacts != contents.contacts) {
        state.shownContacts = contents.contacts;
        const std::vector<Arrow> arrows = makeContactArrows(contents);
        state.contactMapper->SetInputData(makeArrows(arrows));
        state.contacts->SetVisibility(!arrows.empty());
    }
    setColour(*state.contacts, contents.theme.contact);
}

void MotionLayer::setCamera(const Camera& camera) {
    setLights(*state_->contacts, camera);
}

}  // namespace trapwright::scene
