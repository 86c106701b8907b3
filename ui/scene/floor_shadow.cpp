#include "ui/scene/floor_shadow.h"

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <QImage>
#include <QPainter>
#include <algorithm>
#include <vector>

#include "ui/scene/meshes.h"

namespace trapwright::scene {

namespace {

constexpr int kLongest = 192;       // texels
constexpr double kDarkness = 0.34;  // in the middle of the shadow

/// One pass of a mean over 2 * radius + 1 values along a line of `count` values, `stride` apart.
void smear(std::vector<float>& values, std::size_t start, std::size_t stride, int count, int radius) {
    std::vector<float> line(static_cast<std::size_t>(count));
    float sum = 0.0F;
    const auto at = [&](int i) {
        return i < 0 || i >= count ? 0.0F : values[start + stride * static_cast<std::size_t>(i)];
    };
    for (int i = -radius; i < radius; ++i)
        sum += at(i);
    for (int i = 0; i < count; ++i) {
        sum += at(i + radius) - at(i - radius - 1);
        line[static_cast<std::size_t>(i)] = sum / static_cast<float>(2 * radius + 1);
    }
    for (int i = 0; i < count; ++i)
        values[start + stride * static_cast<std::size_t>(i)] = line[static_cast<std::size_t>(i)];
}

/// What the mesh covers seen from above, blurred by three passes of a mean, which is close to a Gaussian.
std::vector<float> blurredFootprint(const geometry::TriangleMesh& mesh, const QRectF& room, QSize texels,
                                    int radius) {
    QImage footprint(texels, QImage::Format_Grayscale8);
    footprint.fill(0);
    QPainter painter(&footprint);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Qt::white);
    painter.scale(texels.width() / room.width(), texels.height() / room.height());
    painter.translate(-room.topLeft());
    for (const geometry::Triangle& triangle : mesh.triangles) {
        QPolygonF corners;
        for (const int vertex : triangle) {
            const base::Vec3& place = mesh.vertices[static_cast<std::size_t>(vertex)];
            corners << QPointF(place.x(), place.y());
        }
        painter.drawPolygon(corners);
    }
    painter.end();
    std::vector<float> values;
    for (int row = 0; row < texels.height(); ++row) {
        const uchar* line = footprint.constScanLine(row);
        values.insert(values.end(), line, line + texels.width());
    }
    const auto width = static_cast<std::size_t>(texels.width());
    for (int pass = 0; pass < 3; ++pass) {
        for (int row = 0; row < texels.height(); ++row)
            smear(values, static_cast<std::size_t>(row) * width, 1, texels.width(), radius);
        for (int column = 0; column < texels.width(); ++column)
            smear(values, static_cast<std::size_t>(column), width, texels.height(), radius);
    }
    return values;
}

}  // namespace

struct FloorShadow::State {
    vtkNew<vtkActor> actor;
    vtkNew<vtkPlaneSource> plane;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkTexture> texture;
    bool made = false;
};

FloorShadow::FloorShadow(vtkRenderer& renderer) : state_(std::make_unique<State>()) {
    state_->mapper->SetInputConnection(state_->plane->GetOutputPort());
    state_->actor->SetMapper(state_->mapper);
    state_->actor->SetTexture(state_->texture);
    state_->actor->GetProperty()->LightingOff();
    state_->actor->ForceOpaqueOn();
    state_->actor->PickableOff();
    state_->texture->InterpolateOn();
    state_->texture->RepeatOff();
    state_->texture->SetColorModeToDirectScalars();
    state_->actor->VisibilityOff();
    renderer.AddActor(state_->actor);
}

FloorShadow::~FloorShadow() = default;

void FloorShadow::make(const geometry::TriangleMesh& mesh) {
    const geometry::Box box = geometry::calcBoundingBox(mesh);
    const base::Vec3 size = box.size();
    const double shortest = std::min(size.x(), size.y());
    // As wide as a track's shadow on a near floor, also where a bowl's box is wide.
    const double margin = std::min(0.5 * shortest, 0.12 * std::max(size.x(), size.y()));
    const QRectF room(box.low.x() - margin, box.low.y() - margin, size.x() + 2.0 * margin,
                      size.y() + 2.0 * margin);
    const double texel = std::max(room.width(), room.height()) / kLongest;
    const QSize texels(std::max(8, static_cast<int>(room.width() / texel)),
                       std::max(8, static_cast<int>(room.height() / texel)));
    const int radius = std::max(1, static_cast<int>(margin / texel / 4.0));
    const std::vector<float> values = blurredFootprint(mesh, room, texels, radius);

    vtkNew<vtkImageData> image;
    image->SetDimensions(texels.width(), texels.height(), 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
    auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
    for (std::size_t i = 0; i < values.size(); ++i) {
        pixels[4 * i] = pixels[4 * i + 1] = pixels[4 * i + 2] = 0;
        pixels[4 * i + 3] = static_cast<unsigned char>(kDarkness * values[i]);
    }
    state_->texture->SetInputData(image);
    const double z = box.low.z() * kDrawn;
    state_->plane->SetOrigin(room.left() * kDrawn, room.top() * kDrawn, z);
    state_->plane->SetPoint1(room.right() * kDrawn, room.top() * kDrawn, z);
    state_->plane->SetPoint2(room.left() * kDrawn, room.bottom() * kDrawn, z);
    state_->made = true;
    state_->actor->VisibilityOn();
}

void FloorShadow::hide() {
    state_->made = false;
    state_->actor->VisibilityOff();
}

void FloorShadow::setCamera(const Camera& camera) {
    state_->actor->SetVisibility(state_->made && camera.elevation > 0.0);
}

}  // namespace trapwright::scene
