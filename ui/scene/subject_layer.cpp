#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <algorithm>
#include <cstring>

#include "ui/scene/floor_shadow.h"
#include "ui/scene/layers.h"
#include "ui/scene/light_map.h"
#include "ui/scene/meshes.h"
#include "ui/scene/pose_row.h"
#include "ui/scene/subject.h"
#include "ui/scene/surface_places.h"

namespace trapwright::scene {

namespace {

using geometry::TriangleMesh;

constexpr double kFlatThickness = 0.12;  // of the flat under stable poses, as a share of its depth

/// Triangles [from, to) of a mesh, with all its vertices.
TriangleMesh cutOut(const TriangleMesh& mesh, std::size_t from, std::size_t to) {
    TriangleMesh piece{mesh.vertices, {}};
    piece.triangles.assign(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(from),
                           mesh.triangles.begin() + static_cast<std::ptrdiff_t>(to));
    return piece;
}

/// Where the light map's texels are for each corner of each surface triangle.
vtkSmartPointer<vtkFloatArray> lightMapPlaces(const track::Track& track) {
    const std::vector<base::Vec3> places = surfaceInTrackCoordinates(track);
    auto coordinates = vtkSmartPointer<vtkFloatArray>::New();
    coordinates->SetName("lightMapPlace");
    coordinates->SetNumberOfComponents(2);
    for (std::size_t i = 0; i < track.surfaceTriangles; ++i) {
        for (const int vertex : track.solid.triangles[i]) {
            const base::Vec3& place = places[static_cast<std::size_t>(vertex)];
            coordinates->InsertNextTuple2((place.x() - track.begin()) / (track.end() - track.begin()),
                                          place.y() / track.width + 0.5);
        }
    }
    return coordinates;
}

vtkSmartPointer<vtkImageData> toImage(const LightMap& map) {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(map.columns, map.rows, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
    for (std::size_t i = 0; i < map.values.size() / 2; ++i) {
        pixels[3 * i] = map.values[2 * i];
        pixels[3 * i + 1] = map.values[2 * i + 1];
        pixels[3 * i + 2] = 0;
    }
    return image;
}

}  // namespace

struct SubjectLayer::State {
    vtkNew<vtkActor> surface;  // what parts move on
    vtkNew<vtkActor> body;     // everything else of the subject
    vtkNew<vtkOpenGLPolyDataMapper> surfaceMapper;
    vtkNew<vtkPolyDataMapper> bodyMapper;
    vtkNew<vtkTexture> lightMap;
    FloorShadow shadow;

    SceneContents shown;  // what the actors were made of
    bool made = false;

    explicit State(vtkRenderer& renderer) : shadow(renderer) {
        surface->SetMapper(surfaceMapper);
        body->SetMapper(bodyMapper);
        for (vtkActor* actor : {surface.Get(), body.Get()}) {
            actor->VisibilityOff();
            renderer.AddActor(actor);
        }
        // The shader needs places as they are.
        surfaceMapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
        lightMap->InterpolateOn();
        lightMap->RepeatOff();
        lightMap->EdgeClampOn();
        lightMap->SetColorModeToDirectScalars();
        surface->GetProperty()->SetTexture("lightMap", lightMap);
        setSurfaceShading(*surface, SurfaceKind::track);
        setSurfaceShading(*body, SurfaceKind::plain);
    }

    [[nodiscard]] bool isShown(const SceneContents& contents) const {
        return made && shown.track == contents.track && shown.solid == contents.solid &&
               shown.stablePoses == contents.stablePoses && shown.theme == contents.theme;
    }

    void makeTrack(const SceneContents& contents) {
        const track::Track& track = *contents.track;
        const SceneTheme& theme = contents.theme;
        const TriangleMesh& solid = track.solid;
        const std::vector<base::Vec3> places = surfaceInTrackCoordinates(track);
        const double trapBegin = track.sections[static_cast<std::size_t>(track.firstTrapSection)].x;
        const double trapEnd = track.sections[static_cast<std::size_t>(track.lastTrapSection)].x;
        const auto surfaceColour = [&](std::size_t i) {
            double x = 0.0;
            for (const int vertex : solid.triangles[i])
                x += places[static_cast<std::size_t>(vertex)].x() / 3.0;
            return x > trapBegin && x < trapEnd ? theme.trap : theme.leadIn;
        };
        const auto bodyColour = [&](std::size_t) { return theme.side; };
        const auto surfaceData = makeFlatMesh(cutOut(solid, 0, track.surfaceTriangles), surfaceColour);
        surfaceData->GetPointData()->SetTCoords(lightMapPlaces(track));
        surfaceMapper->SetInputData(surfaceData);
        bodyMapper->SetInputData(
            makeFlatMesh(cutOut(solid, track.surfaceTriangles, solid.triangles.size()), bodyColour));
        if (!made || shown.track != contents.track) lightMap->SetInputData(toImage(calcLightMap(track)));
        setRise(*surface, track.shape.rise(track.begin()) * kDrawn, track.shape.rise(track.end()) * kDrawn);
        surface->VisibilityOn();
        body->VisibilityOn();
        shadow.make(solid);
    }

    void makeSolid(const SceneContents& contents) {
        showFullyLit(*contents.solid, contents.theme.leadIn);
        shadow.make(*contents.solid);
    }

    /// As a surface without a light map.
    void showFullyLit(const TriangleMesh& mesh, const QColor& colour) {
        const auto data = makeFlatMesh(mesh, [&](std::size_t) { return colour; });
        vtkNew<vtkFloatArray> everywhereLight;
        everywhereLight->SetNumberOfComponents(2);
        everywhereLight->SetNumberOfTuples(data->GetNumberOfPoints());
        everywhereLight->Fill(0.5);
        data->GetPointData()->SetTCoords(everywhereLight);
        surfaceMapper->SetInputData(data);
        lightMap->SetInputData(toImage({1, 1, {255, 255}}));
        setRise(*surface, 0.0, 0.0);
        surface->VisibilityOn();
    }

    void makeFlat(const SceneContents& contents) {
        const PoseRow row = makePoseRow(*contents.stablePoses);
        const double depth = row.flat.size().y();
        const TriangleMesh slab = makeSlab(row.flat, kFlatThickness * depth, 0.18 * depth);
        showFullyLit(slab, contents.theme.leadIn);
        shadow.make(slab);
    }
};

SubjectLayer::SubjectLayer(vtkRenderer& renderer) : state_(std::make_unique<State>(renderer)) {}
SubjectLayer::~SubjectLayer() = default;

void SubjectLayer::show(const SceneContents& contents, std::span<const Shade> shades) {
    if (!state_->isShown(contents)) {
        state_->surface->VisibilityOff();
        state_->body->VisibilityOff();
        state_->shadow.hide();
        if (contents.track) {
            state_->makeTrack(contents);
        } else if (contents.solid) {
            state_->makeSolid(contents);
        } else if (contents.stablePoses) {
            state_->makeFlat(contents);
        }
        state_->shown.track = contents.track;
        state_->shown.solid = contents.solid;
        state_->shown.stablePoses = contents.stablePoses;
        state_->shown.theme = contents.theme;
        state_->made = true;
    }
    const HeightRange range = heightRangeOf(contents);
    setHeightRange(*state_->surface, isShadedByHeight(contents), range.low * kDrawn, range.high * kDrawn);
    setShades(*state_->surface, shades);
}

void SubjectLayer::setCamera(const Camera& camera) {
    setLights(*state_->surface, camera);
    setLights(*state_->body, camera);
    state_->shadow.setCamera(camera);
}

}  // namespace trapwright::scene
