#pragma once

#include <QColor>

#include <functional>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/geometry/triangle_mesh.h"

template <class T>
class vtkSmartPointer;
class vtkPolyData;

class vtkActor;

namespace trapwright::scene {

/// VTK draws in millimetres: depth and clipping work better near 1.
inline constexpr double kDrawn = 1e3;

/// Every triangle flat, in a colour of its own.
vtkSmartPointer<vtkPolyData> makeFlatMesh(const geometry::TriangleMesh& mesh,
                                          const std::function<QColor(std::size_t triangle)>& colour);

/// Round where neighbouring faces meet at less than 30 degrees, with sharp edges elsewhere.
vtkSmartPointer<vtkPolyData> makeCreasedMesh(const geometry::TriangleMesh& mesh);

/// The mesh as it is, for edges to be found.
vtkSmartPointer<vtkPolyData> makePlainMesh(const geometry::TriangleMesh& mesh);

/// A line in a colour.
struct ColouredLine {
    std::vector<base::Vec3> points;  // [m]
    QColor colour;
};
vtkSmartPointer<vtkPolyData> makeLines(std::span<const ColouredLine> lines);

/// Tubes of this radius around lines. [m]
vtkSmartPointer<vtkPolyData> makeTubes(std::span<const ColouredLine> lines, double radius);

/// An arrow from `tail` to `head`. [m]
struct Arrow {
    base::Vec3 tail;
    base::Vec3 head;
    double radius = 0.0;  // of the shaft [m]
};
vtkSmartPointer<vtkPolyData> makeArrows(std::span<const Arrow> arrows);

/// A level slab with rounded corners under `top`, the box of what shall lie on it. [m]
geometry::TriangleMesh makeSlab(const geometry::Box& top, double thickness, double rounding);

void setColour(vtkActor& actor, const QColor& colour);

/// Places an actor whose mesh is in millimetres. The pose is in metres, as everywhere.
void setPose(vtkActor& actor, const base::Pose& pose);

}  // namespace trapwright::scene
