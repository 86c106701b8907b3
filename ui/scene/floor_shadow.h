#pragma once

#include <memory>

#include "core/geometry/triangle_mesh.h"
#include "ui/scene/camera.h"

class vtkRenderer;

namespace trapwright::scene {

/// The soft shadow of a subject on an unseen floor below it.
class FloorShadow {
 public:
    explicit FloorShadow(vtkRenderer& renderer);
    ~FloorShadow();

    /// The shadow of this mesh on the level of its lowest point.
    void make(const geometry::TriangleMesh& mesh);
    void hide();
    /// A floor is not seen from below.
    void setCamera(const Camera& camera);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
