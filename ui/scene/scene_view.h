#pragma once

#include <QFuture>
#include <QImage>
#include <QList>
#include <QWidget>
#include <memory>
#include <optional>
#include <span>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"

class QAction;

namespace trapwright::scene {

/// The 3D scene: tracks, parts and what is known of their motion. Everything in it is a value set from
/// outside; VTK stays behind it. Pictures are drawn in the background (SceneRenderer): the newest contents
/// are seen as soon as they are drawn, and nothing waits for them. GUI thread only. Left drag turns, right or
/// middle drag moves, the wheel zooms at the cursor; with a part that can be turned, left drag turns that,
/// right drag the view.
class SceneView : public QWidget {
    Q_OBJECT

 public:
    explicit SceneView(QWidget* parent = nullptr);
    ~SceneView() override;

    [[nodiscard]] const SceneContents& contents() const;
    [[nodiscard]] const Camera& camera() const;
    void setTheme(const SceneTheme& theme);

    /// An empty scene, but for the theme and the switches below.
    void clear();
    /// Each of these three takes the place of the others. The view is fitted when the kind of subject changes
    /// or while the user has not moved the camera. Null shows none. Traces and contacts on the track of
    /// before are gone.
    void showTrack(std::shared_ptr<const track::Track> track, const TrackMarks& marks = {});
    void showSolid(std::shared_ptr<const geometry::TriangleMesh> solid);
    /// `shares`: of parts that land in each group of alike poses, for the labels; empty: the part's own.
    void showStablePoses(std::shared_ptr<const part::Part> part, std::vector<double> shares = {});

    /// The parts as they lie now. Cheap: made for 60 calls a second. While the first is the same as before it
    /// stays in view; with another, or none, traces and contacts are gone.
    void setParts(std::vector<PartInScene> parts);
    void setTraces(std::vector<Trace> traces);
    void setContacts(std::span<const ContactArrow> contacts);
    void setForceLegend(bool on);  // arrows of round forces with their sizes in N
    void setHighlights(std::vector<Highlight> highlights);

    void setHeightShading(bool on);  // with a legend in mm
    void setEdges(bool on);          // silhouettes and sharp edges as thin lines
    void setFollow(bool on);         // the camera goes with the first part
    /// The view is fitted to the first part and this much around its centre [m], instead of to the subject.
    void setCloseUp(std::optional<double> radius);
    /// Left drag and arrow keys turn the first part instead of the view: whoever set it is asked to.
    void setTurnable(bool on);
    void setView(StandardView view);
    void fitView();

    /// Standard views, fit, height shading, edges, follow: with names, shortcuts and state, for menus.
    [[nodiscard]] QList<QAction*> viewActions() const;

    /// Whether what is seen is what was set, with smooth edges.
    [[nodiscard]] bool isSettled() const;
    /// The scene as it is set now, drawn in the background at this size; labels are as large as on a screen
    /// of this pixel ratio. Null if there is no OpenGL. For whenReady().
    [[nodiscard]] QFuture<QImage> picture(QSize pixels, double pixelRatio = 1.0);

 signals:
    void failed(const QString& message);  // no OpenGL to draw with
    /// The user has turned the first part so, about its centre, in the axes of the room.
    void partTurned(const trapwright::base::Quaternion& turn);

 protected:
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::scene
