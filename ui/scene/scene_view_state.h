#pragma once

#include <QAction>
#include <QPointF>
#include <optional>

#include "ui/scene/scene_frames.h"
#include "ui/scene/scene_view.h"

namespace trapwright::scene {

/// What a scene is about: one of these.
struct Subject {
    std::shared_ptr<const track::Track> track = nullptr;
    std::shared_ptr<const geometry::TriangleMesh> solid = nullptr;
    std::shared_ptr<const part::Part> stablePoses = nullptr;
};

/// What a view holds; shared by its drawing (scene_view.cpp) and its input (scene_input.cpp).
struct SceneView::State {
    explicit State(SceneView& owner) : view(owner), frames(owner, contents, camera) {}

    SceneView& view;
    SceneContents contents;
    Camera camera = turnedTo(Camera(), StandardView::home);
    bool moved = false;  // by the user, since the view was last fitted
    bool follow = false;
    bool turnable = false;
    std::optional<double> closeUp;  // radius about the first part [m]
    SceneFrames frames;

    QPointF pressedAt;
    QPointF lastMouse;
    bool dragged = false;
    std::optional<StandardView> hovered;  // face of the orbit cube

    QList<QAction*> actions;
    QAction* heightShading = nullptr;
    QAction* edges = nullptr;
    QAction* followPart = nullptr;

    [[nodiscard]] QSizeF screen() const { return view.size(); }
    void setSubject(Subject subject);
    void fit();
    void fitUnlessMoved();
    /// Contents or camera are others than before.
    void change();
    /// A camera that the user chose.
    void moveTo(const Camera& wanted);
    void drag(const QPointF& by, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers);
    void makeActions();
};

}  // namespace trapwright::scene
