#pragma once

#include <QColor>

#include "core/base/math.h"

class vtkActor;

namespace trapwright::scene {

void setColour(vtkActor& actor, const QColor& colour);

/// Places an actor whose mesh is in millimetres. The pose is in metres, as everywhere.
void setPose(vtkActor& actor, const base::Pose& pose);

}  // namespace trapwright::scene
