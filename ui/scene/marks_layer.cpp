#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>

#include "ui/scene/layers.h"
#include "ui/scene/meshes.h"
#include "ui/scene/surface_places.h"

namespace trapwright::scene {

namespace {

using base::Vec3;

constexpr double kFinishRadius = 0.55e-3;  // of the finish line [m]
constexpr double kAbove = 0.25e-3;         // of flat marks above the lead-in [m]
constexpr double kSpanWidth = 1.2;         // of dimension lines, in logical pixels
constexpr int kRingSides = 48;

/// A ring around the start point.
void addStart(geometry::TriangleMesh& mesh, const track::Track& track) {
    const double inner = 0.035 * track.width;
    const double outer = 0.06 * track.width;
    const auto first = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i < kRingSides; ++i) {
        const double angle = 2.0 * base::kPi * i / kRingSides;
        for (const double radius : {inner, outer}) {
            const Vec3 place =
                surfacePoint(track, track.start + radius * std::cos(angle), radius * std::sin(angle));
            mesh.vertices.push_back(place + kAbove * Vec3::UnitZ());
        }
    }
    for (int i = 0; i < kRingSides; ++i) {
        const int here = first + 2 * i;
        const int next = first + 2 * ((i + 1) % kRingSides);
        mesh.triangles.push_back({here, here + 1, next});
        mesh.triangles.push_back({next, here + 1, next + 1});
    }
}

/// A flat arrow on the lead-in, from behind the start point towards it.
void addConveyingArrow(geometry::TriangleMesh& mesh, const track::Track& track) {
    const double room = track.start - track.begin() - 0.08 * track.width;
    const double length = std::min(0.75 * room, 0.7 * track.width);
    if (length <= 0.0) return;
    const double tail = track.begin() + 0.5 * (room - length);
    const double neck = tail + 0.62 * length;
    const double shaft = 0.055 * track.width;
    const double wide = 0.13 * track.width;
    const auto at = [&](double x, double y) {
        const Vec3 place = surfacePoint(track, x, y) + kAbove * Vec3::UnitZ();
        mesh.vertices.push_back(place);
        return static_cast<int>(mesh.vertices.size()) - 1;
    };
    // In slices, so that it bends with a bowl.
    constexpr int kSlices = 8;
    int left = at(tail, shaft);
    int right = at(tail, -shaft);
    for (int i = 1; i <= kSlices; ++i) {
        const double x = tail + (neck - tail) * i / kSlices;
        const int nextLeft = at(x, shaft);
        const int nextRight = at(x, -shaft);
        mesh.triangles.push_back({right, nextRight, left});
        mesh.triangles.push_back({left, nextRight, nextLeft});
        left = nextLeft;
        right = nextRight;
    }
    mesh.triangles.push_back({at(neck, -wide), at(tail + length, 0.0), at(neck, wide)});
}

/// Marks lie flat: what turns them over in the room (an anticlockwise bowl) must not turn their light.
void faceUp(geometry::TriangleMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (geometry::triangleNormal(mesh, i).z() < 0.0)
            std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    }
}

}  // namespace

struct MarksLayer::State {
    vtkNew<vtkActor> flat;
    vtkNew<vtkActor> finish;
    vtkNew<vtkPolyDataMapper> flatMapper;
    vtkNew<vtkPolyDataMapper> finishMapper;
    vtkNew<vtkActor> spans;  // dimension lines of the three parts
    vtkNew<vtkPolyDataMapper> spanMapper;
    Vec3 spanPlace = Vec3::Constant(1e300);  // tells on which side they lie
    std::shared_ptr<const track::Track> track;
    TrackMarks marks;
    SceneTheme theme;

    void showSpans(const SceneContents& contents, const Camera& camera, double pixelRatio) {
        spans->SetVisibility(contents.track && contents.marks.sectionNames);
        if (!spans->GetVisibility()) return;
        const std::vector<SectionSpan> wanted = sectionSpans(*contents.track, camera);
        spans->GetProperty()->SetLineWidth(static_cast<float>(kSpanWidth * pixelRatio));
        if (contents.track == track && contents.theme == theme && wanted.front().middle == spanPlace) return;
        spanPlace = wanted.front().middle;
        std::vector<ColouredLine> lines;
        for (const SectionSpan& span : wanted) {
            lines.push_back({span.line, contents.theme.faintText});
            for (std::size_t i = 0; i + 1 < span.ticks.size(); i += 2)
                lines.push_back({{span.ticks[i], span.ticks[i + 1]}, contents.theme.faintText});
        }
        spanMapper->SetInputData(makeLines(lines));
    }
};

MarksLayer::MarksLayer(vtkRenderer& renderer) : state_(std::make_unique<State>()) {
    state_->flat->SetMapper(state_->flatMapper);
    state_->finish->SetMapper(state_->finishMapper);
    for (vtkActor* actor : {state_->flat.Get(), state_->finish.Get()}) {
        actor->VisibilityOff();
        setSurfaceShading(*actor, SurfaceKind::plain);
        renderer.AddActor(actor);
    }
    setInFront(*state_->flat);
    state_->spans->SetMapper(state_->spanMapper);
    state_->spans->GetProperty()->LightingOff();
    state_->spans->VisibilityOff();
    renderer.AddActor(state_->spans);
}

MarksLayer::~MarksLayer() = default;

void MarksLayer::show(const SceneContents& contents, const Camera& camera, double pixelRatio) {
    State& state = *state_;
    state.showSpans(contents, camera, pixelRatio);
    if (state.track == contents.track && state.marks == contents.marks && state.theme == contents.theme)
        return;
    state.track = contents.track;
    state.marks = contents.marks;
    state.theme = contents.theme;
    const QColor& accent = contents.theme.accent;
    geometry::TriangleMesh mesh;
    if (state.track && state.marks.startPoint) addStart(mesh, *state.track);
    if (state.track && state.marks.conveyingArrow) addConveyingArrow(mesh, *state.track);
    faceUp(mesh);
    state.flatMapper->SetInputData(makeFlatMesh(mesh, [&](std::size_t) { return accent; }));
    state.flat->SetVisibility(!mesh.triangles.empty());
    const bool line = state.track && state.marks.finishLine;
    if (line) {
        std::vector<ColouredLine> lines = {{lineAcross(*state.track, state.track->finish), accent}};
        for (Vec3& point : lines.front().points)
            point.z() += 0.4 * kFinishRadius;
        state.finishMapper->SetInputData(makeTubes(lines, kFinishRadius));
    }
    state.finish->SetVisibility(line);
}

void MarksLayer::setCamera(const Camera& camera) {
    setLights(*state_->flat, camera);
    setLights(*state_->finish, camera);
}

}  // namespace trapwright::scene
