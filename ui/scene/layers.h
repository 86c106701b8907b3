#pragma once

#include <memory>
#include <vector>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"
#include "ui/scene/surface_shader.h"

class vtkActor;
class vtkRenderer;

namespace trapwright::scene {

/// What a scene is made of. Each layer puts its actors into a renderer once and then changes only what
/// differs in the contents it is shown.

/// The track, the printable solid or the flat under stable poses, with the shadow on the floor.
class SubjectLayer {
 public:
    explicit SubjectLayer(vtkRenderer& renderer);
    ~SubjectLayer();
    void show(const SceneContents& contents, std::span<const Shade> shades);
    void setCamera(const Camera& camera);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Start point, finish line, conveying arrow and the sections' dimension lines.
class MarksLayer {
 public:
    explicit MarksLayer(vtkRenderer& renderer);
    ~MarksLayer();
    void show(const SceneContents& contents, const Camera& camera, double pixelRatio);
    void setCamera(const Camera& camera);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Regions and lines on the subject that are to be looked at.
class HighlightLayer {
 public:
    explicit HighlightLayer(vtkRenderer& renderer);
    ~HighlightLayer();
    void show(const SceneContents& contents, double pixelRatio);
    void setCamera(const Camera& camera);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The part in all its poses, or in its stable poses.
class PartLayer {
 public:
    explicit PartLayer(vtkRenderer& renderer);
    ~PartLayer();
    void show(const SceneContents& contents);
    void setCamera(const Camera& camera);
    /// What the solid parts throw on the track.
    [[nodiscard]] const std::vector<Shade>& shades() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Traces and contact forces.
class MotionLayer {
 public:
    explicit MotionLayer(vtkRenderer& renderer);
    ~MotionLayer();
    void show(const SceneContents& contents, double pixelRatio);
    void setCamera(const Camera& camera);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Silhouettes and sharp edges of the subject and the solid parts.
class EdgeLayer {
 public:
    explicit EdgeLayer(vtkRenderer& renderer);
    ~EdgeLayer();
    void show(const SceneContents& contents, const Camera& camera, double pixelRatio);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
