#include "ui/scene/actors.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkProperty.h>

#include "ui/scene/meshes.h"

namespace trapwright::scene {

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
