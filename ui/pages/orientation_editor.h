#pragma once

#include <QWidget>
#include <memory>

#include "core/part/part.h"
#include "core/track/track.h"

class QHBoxLayout;
class QLabel;
class QPushButton;

namespace trapwright::scene {
class SceneView;
}

namespace trapwright::pages {

/// An orientation that the user makes by hand: the part in the scene, on a flat with the conveying arrow,
/// turned by dragging, with the arrow keys and in quarters of a turn, and laid down as it would rest. Has the
/// scene to itself from begin() until chosen() or ended().
class OrientationEditor : public QWidget {
    Q_OBJECT
 public:
    explicit OrientationEditor(QWidget* parent);

    /// `orientation`: to begin with, part frame to the track's tangent frame. An end that is farther than
    /// `tolerance` [rad] from how the part rests is told to be.
    void begin(scene::SceneView& scene, std::shared_ptr<const part::Part> part,
               const base::Quaternion& orientation, double tolerance);
    /// Gives the scene back without a choice; nothing if it has not begun.
    void end();
    [[nodiscard]] bool hasBegun() const { return scene_ != nullptr; }
    [[nodiscard]] const base::Quaternion& orientation() const { return orientation_; }

 signals:
    void chosen(const trapwright::base::Quaternion& orientation);
    /// The scene is free again, after a choice too.
    void ended();

 private:
    void addQuarter(const QString& name, const QString& text, const QString& tip, const base::Vec3& axis,
                    QHBoxLayout& row);
    void turn(const base::Quaternion& turn);
    void layDown();
    void showPart();

    scene::SceneView* scene_ = nullptr;  // while it has one
    std::shared_ptr<const part::Part> part_;
    std::shared_ptr<const track::Track> flat_;
    base::Quaternion orientation_ = base::Quaternion::Identity();
    double tolerance_ = 0.0;
    QLabel* told_;
    QPushButton* layDown_;
};

}  // namespace trapwright::pages
