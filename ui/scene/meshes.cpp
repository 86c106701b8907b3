#include "ui/scene/meshes.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace trapwright::scene {

namespace {

using base::Vec3;

constexpr double kCrease = 30.0;  // [deg]
constexpr int kArrowSides = 12;

void addPoint(vtkPoints* points, const Vec3& point) {
    points->InsertNextPoint(point.x() * kDrawn, point.y() * kDrawn, point.z() * kDrawn);
}

vtkSmartPointer<vtkUnsignedCharArray> makeColours(vtkIdType expected) {
    auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colours->SetName("colour");
    colours->SetNumberOfComponents(3);
    colours->Allocate(3 * expected);
    return colours;
}

void addColour(vtkUnsignedCharArray* colours, const QColor& colour) {
    colours->InsertNextTuple3(colour.red(), colour.green(), colour.blue());
}

/// The ring of points round a shaft, `along` its axis.
Vec3 onRing(const Vec3& centre, const Vec3& along, double radius, int index) {
    const Vec3 side = along.unitOrthogonal();
    const double angle = 2.0 * base::kPi * index / kArrowSides;
    return centre + radius * (std::cos(angle) * side + std::sin(angle) * along.cross(side));
}

void addArrow(geometry::TriangleMesh& mesh, const Arrow& arrow) {
    const double length = (arrow.head - arrow.tail).norm();
    if (length <= 0.0) return;
    const Vec3 along = (arrow.head - arrow.tail) / length;
    const double tip = std::min(6.0 * arrow.radius, 0.6 * length);
    const Vec3 neck = arrow.head - tip * along;
    const auto add = [&mesh](const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<int>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < kArrowSides; ++i) {
        const Vec3 tail0 = onRing(arrow.tail, along, arrow.radius, i);
        const Vec3 tail1 = onRing(arrow.tail, along, arrow.radius, i + 1);
        const Vec3 neck0 = onRing(neck, along, arrow.radius, i);
        const Vec3 neck1 = onRing(neck, along, arrow.radius, i + 1);
        const Vec3 wide0 = onRing(neck, along, 2.5 * arrow.radius, i);
        const Vec3 wide1 = onRing(neck, along, 2.5 * arrow.radius, i + 1);
        add(arrow.tail, tail1, tail0);
        add(tail0, tail1, neck0);
        add(tail1, neck1, neck0);
        add(neck0, neck1, wide0);
        add(neck1, wide1, wide0);
        add(wide0, wide1, arrow.head);
    }
}

}  // namespace

vtkSmartPointer<vtkPolyData> makeFlatMesh(const geometry::TriangleMesh& mesh,
                                          const std::function<QColor(std::size_t triangle)>& colour) {
    const auto count = static_cast<vtkIdType>(mesh.triangles.size());
    vtkNew<vtkPoints> points;
    points->Allocate(3 * count);
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    normals->Allocate(9 * count);
    const auto colours = makeColours(3 * count);
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Vec3 normal = geometry::triangleNormal(mesh, i);
        const QColor paint = colour(i);
        cells->InsertNextCell(3);
        for (const int vertex : mesh.triangles[i]) {
            cells->InsertCellPoint(points->GetNumberOfPoints());
            addPoint(points, mesh.vertices[static_cast<std::size_t>(vertex)]);
            normals->InsertNextTuple3(normal.x(), normal.y(), normal.z());
            addColour(colours, paint);
        }
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    data->GetPointData()->SetNormals(normals);
    data->GetPointData()->SetScalars(colours);
    return data;
}

vtkSmartPointer<vtkPolyData> makePlainMesh(const geometry::TriangleMesh& mesh) {
    vtkNew<vtkPoints> points;
    for (const Vec3& vertex : mesh.vertices)
        addPoint(points, vertex);
    vtkNew<vtkCellArray> cells;
    for (const geometry::Triangle& triangle : mesh.triangles)
        cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    return data;
}

vtkSmartPointer<vtkPolyData> makeCreasedMesh(const geometry::TriangleMesh& mesh) {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(makePlainMesh(mesh));
    normals->SetFeatureAngle(kCrease);
    normals->SplittingOn();
    normals->ConsistencyOff();
    normals->Update();
    return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> makeLines(std::span<const ColouredLine> lines) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    const auto colours = makeColours(0);
    for (const ColouredLine& line : lines) {
        if (line.points.size() < 2) continue;
        cells->InsertNextCell(static_cast<int>(line.points.size()));
        for (const Vec3& point : line.points) {
            cells->InsertCellPoint(points->GetNumberOfPoints());
            addPoint(points, point);
            addColour(colours, line.colour);
        }
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetLines(cells);
    data->GetPointData()->SetScalars(colours);
    return data;
}

vtkSmartPointer<vtkPolyData> makeTubes(std::span<const ColouredLine> lines, double radius) {
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(makeLines(lines));
    tubes->SetRadius(radius * kDrawn);
    tubes->SetNumberOfSides(12);
    tubes->CappingOn();
    tubes->Update();
    return tubes->GetOutput();
}

vtkSmartPointer<vtkPolyData> makeArrows(std::span<const Arrow> arrows) {
    geometry::TriangleMesh mesh;
    for (const Arrow& arrow : arrows)
        addArrow(mesh, arrow);
    auto data = makeFlatMesh(mesh, [](std::size_t) { return QColor(Qt::white); });
    data->GetPointData()->SetScalars(nullptr);
    return data;
}

geometry::TriangleMesh makeSlab(const geometry::Box& top, double thickness, double rounding) {
    constexpr int kPerCorner = 8;
    geometry::TriangleMesh mesh;
    const std::array<base::Vec2, 4> corners = {{{top.high.x(), top.high.y()},
                                                {top.low.x(), top.high.y()},
                                                {top.low.x(), top.low.y()},
                                                {top.high.x(), top.low.y()}}};
    for (int corner = 0; corner < 4; ++corner) {
        const base::Vec2 inward(corner == 0 || corner == 3 ? -rounding : rounding,
                                corner < 2 ? -rounding : rounding);
        const base::Vec2 centre = corners[static_cast<std::size_t>(corner)] + inward;
        for (int i = 0; i <= kPerCorner; ++i) {
            const double angle = 0.5 * base::kPi * (corner + static_cast<double>(i) / kPerCorner);
            const base::Vec2 rim = centre + rounding * base::Vec2(std::cos(angle), std::sin(angle));
            mesh.vertices.emplace_back(rim.x(), rim.y(), top.low.z());
            mesh.vertices.emplace_back(rim.x(), rim.y(), top.low.z() - thickness);
        }
    }
    const auto rim = static_cast<int>(mesh.vertices.size());
    const base::Vec3 middle = 0.5 * (top.low + top.high);
    mesh.vertices.emplace_back(middle.x(), middle.y(), top.low.z());
    mesh.vertices.emplace_back(middle.x(), middle.y(), top.low.z() - thickness);
    for (int i = 0; i < rim; i += 2) {
        const int next = (i + 2) % rim;
        mesh.triangles.push_back({rim, i, next});
        mesh.triangles.push_back({rim + 1, next + 1, i + 1});
        mesh.triangles.push_back({i, i + 1, next});
        mesh.triangles.push_back({next, i + 1, next + 1});
    }
    return mesh;
}

void setColour(vtkActor& actor, const QColor& colour) {
    actor.GetProperty()->SetColor(colour.redF(), colour.greenF(), colour.blueF());
}

void setPose(vtkActor& actor, const base::Pose& pose) {
    vtkNew<vtkMatrix4x4> matrix;
    const base::Mat3 rotation = pose.rotation.toRotationMatrix();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            matrix->SetElement(row, column, rotation(row, column));
        matrix->SetElement(row, 3, pose.position[row] * kDrawn);
    }
    actor.SetUserMatrix(matrix);
}

}  // namespace trapwright::scene
