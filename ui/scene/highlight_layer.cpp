#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"

namespace trapwright::scene {

namespace {

constexpr double kLineWidth = 3.0;  // logical pixels

/// Lines as one actor.
struct Lines {
    vtkNew<vtkActor> actor;
    vtkNew<vtkPolyDataMapper> mapper;

    explicit Lines(vtkRenderer& renderer) {
        actor->SetMapper(mapper);
        actor->GetProperty()->LightingOff();
        actor->VisibilityOff();
        renderer.AddActor(actor);
    }

    void show(const std::vector<ColouredLine>& lines) {
        mapper->SetInputData(makeLines(lines));
        actor->SetVisibility(!lines.empty());
    }
};

}  // namespace

struct HighlightLayer::State {
    vtkNew<vtkActor> patches;
    vtkNew<vtkPolyDataMapper> patchMapper;
    Lines onSurface;
    Lines through;
    std::vector<Highlight> shown;

    explicit State(vtkRenderer& renderer) : onSurface(renderer), through(renderer) {
        patches->SetMapper(patchMapper);
        patches->VisibilityOff();
        setSurfaceShading(*patches, SurfaceKind::plain);
        renderer.AddActor(patches);
        setInFront(*patches);
        setInFront(*onSurface.actor);
        setBeforeAll(*through.actor);
    }

    void make() {
        geometry::TriangleMesh mesh;
        std::vector<QColor> colours;
        std::vector<ColouredLine> lines;
        std::vector<ColouredLine> hidden;
        for (const Highlight& highlight : shown) {
            for (const std::vector<base::Vec3>& line : highlight.lines)
                (highlight.through ? hidden : lines).push_back({line, highlight.colour});
            if (!highlight.patch) continue;
            const auto first = static_cast<int>(mesh.vertices.size());
            const geometry::TriangleMesh& patch = *highlight.patch;
            mesh.vertices.insert(mesh.vertices.end(), patch.vertices.begin(), patch.vertices.end());
            for (const geometry::Triangle& t : patch.triangles)
                mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
            colours.insert(colours.end(), patch.triangles.size(), highlight.colour);
        }
        patchMapper->SetInputData(makeFlatMesh(mesh, [&](std::size_t i) { return colours[i]; }));
        patches->SetVisibility(!mesh.triangles.empty());
        onSurface.show(lines);
        through.show(hidden);
    }
};

HighlightLayer::HighlightLayer(vtkRenderer& renderer) : state_(std::make_unique<State>(renderer)) {}
HighlightLayer::~HighlightLayer() = default;

void HighlightLayer::show(const SceneContents& contents, double pixelRatio) {
    if (state_->shown != contents.highlights) {
        state_->shown = contents.highlights;
        state_->make();
    }
    for (const Lines* lines : {&state_->onSurface, &state_->through})
        lines->actor->GetProperty()->SetLineWidth(static_cast<float>(kLineWidth * pixelRatio));
}

void HighlightLayer::setCamera(const Camera& camera) {
    setLights(*state_->patches, camera);
}

}  // namespace trapwright::scene
