#include "ui/pages/orientation_editor.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/part/stable_poses.h"
#include "core/track/track_solid.h"
#include "ui/look/text.h"
#include "ui/models/numbers.h"
#include "ui/scene/scene_view.h"

namespace trapwright::pages {

namespace {

using base::Vec3;

/// Nearer than this to a pose it lies in it. [rad]
constexpr double kSame = 0.5 * base::kDegree;

// Of the flat, in radii of the part.
constexpr double kBehind = 4.5;
constexpr double kAhead = 3.0;
constexpr double kHalfWidth = 2.5;
constexpr double kArrowEnd = 1.3;
constexpr double kThickness = 0.3;
constexpr double kAround = 2.1;  // what is in view

/// A flat on which the part is conveyed along x, with its arrow behind the origin.
std::shared_ptr<const track::Track> makeFlat(double radius) {
    auto flat = std::make_shared<track::Track>();
    const double half = kHalfWidth * radius;
    for (const double x : {-kBehind * radius, kAhead * radius})
        flat->sections.push_back({x, {{-half, 0.0}, {half, 0.0}}});
    flat->lastTrapSection = 1;
    flat->width = 2.0 * half;
    flat->baseThickness = kThickness * radius;
    flat->start = -kArrowEnd * radius;
    flat->finish = kAhead * radius;
    track::TrackSolid solid = track::buildTrackSolid(flat->shape, flat->sections, flat->baseThickness);
    flat->solid = std::move(solid.mesh);
    flat->surfaceTriangles = solid.surfaceTriangles;
    return flat;
}

/// The part on that flat, touching it.
base::Pose placeOnFlat(const part::Part& part, const base::Quaternion& orientation) {
    double lowest = 0.0;
    for (const Vec3& vertex : part.hull.vertices)
        lowest = std::min(lowest, (orientation * vertex).z());
    return {orientation, -lowest * Vec3::UnitZ()};
}

}  // namespace

OrientationEditor::OrientationEditor(QWidget* parent)
    : QWidget(parent), told_(new QLabel(this)), layDown_(new QPushButton(tr("Lay it down"), this)) {
    setObjectName("orientationEditor");
    auto* how =
        new QLabel(tr("Drag the part in the scene until it lies as it shall leave the track: the arrow "
                      "shows which way parts go. Right drag turns the view."),
                   this);
    how->setWordWrap(true);
    told_->setObjectName("orientation.told");
    told_->setWordWrap(true);

    auto* quarters = new QHBoxLayout;
    addQuarter("orientation.turn", tr("Turn 90°"), tr("About the vertical, anticlockwise seen from above"),
               Vec3::UnitZ(), *quarters);
    addQuarter("orientation.tip", tr("Tip 90°"), tr("Forward, over its leading edge"), Vec3::UnitY(),
               *quarters);
    addQuarter("orientation.roll", tr("Roll 90°"), tr("Sideways, about the way in which parts go"),
               Vec3::UnitX(), *quarters);

    layDown_->setObjectName("orientation.layDown");
    layDown_->setToolTip(tr("Turns it no farther than it takes to rest on the flat."));
    connect(layDown_, &QPushButton::clicked, this, &OrientationEditor::layDown);
    auto* cancel = new QPushButton(tr("Cancel"), this);
    cancel->setObjectName("orientation.cancel");
    connect(cancel, &QPushButton::clicked, this, &OrientationEditor::end);
    auto* want = new QPushButton(tr("Want this"), this);
    want->setObjectName("orientation.want");
    connect(want, &QPushButton::clicked, this, [this] {
        emit chosen(orientation_);
        end();
    });
    auto* answers = new QHBoxLayout;
    answers->addWidget(layDown_);
    answers->addStretch(1);
    answers->addWidget(cancel);
    answers->addWidget(want);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(how);
    layout->addLayout(quarters);
    layout->addWidget(told_);
    layout->addLayout(answers);
    hide();
}

void OrientationEditor::addQuarter(const QString& name, const QString& text, const QString& tip,
                                   const Vec3& axis, QHBoxLayout& row) {
    auto* button = new QToolButton(this);
    button->setObjectName(name);
    button->setText(text);
    button->setToolTip(tip);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(button, &QToolButton::clicked, this,
            [this, axis] { turn(base::Quaternion(Eigen::AngleAxisd(0.5 * base::kPi, axis))); });
    row.addWidget(button);
}

void OrientationEditor::begin(scene::SceneView& scene, std::shared_ptr<const part::Part> part,
                              const base::Quaternion& orientation, double tolerance) {
    end();
    scene_ = &scene;
    part_ = std::move(part);
    orientation_ = orientation;
    tolerance_ = tolerance;
    flat_ = makeFlat(part_->boundingRadius);
    scene::TrackMarks marks = scene::TrackMarks::none();
    marks.conveyingArrow = true;
    scene.clear();
    scene.showTrack(flat_, marks);
    showPart();
    scene.setCloseUp(kAround * part_->boundingRadius);
    scene.setTurnable(true);
    connect(&scene, &scene::SceneView::partTurned, this, &OrientationEditor::turn);
    setVisible(true);
    scene.setFocus();
}

void OrientationEditor::end() {
    if (scene_ == nullptr) return;
    disconnect(scene_, nullptr, this, nullptr);
    scene_->clear();
    scene_ = nullptr;
    hide();
    emit ended();
}

void OrientationEditor::turn(const base::Quaternion& turn) {
    orientation_ = (turn * orientation_).normalized();
    showPart();
}

void OrientationEditor::layDown() {
    orientation_ = part::layDown(*part_, orientation_);
    showPart();
}

void OrientationEditor::showPart() {
    scene_->setParts({{part_, placeOnFlat(*part_, orientation_)}});
    const part::NearestPose nearest = part::findStablePose(*part_, orientation_);
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(*part_);
    const int group = part::findPoseGroup(groups, static_cast<int>(nearest.index));
    const QString pose = models::poseName(groups[static_cast<std::size_t>(group)].poses);
    layDown_->setEnabled(nearest.angle > kSame);
    const QString angle = look::numberText(nearest.angle / base::kDegree, 2);
    if (nearest.angle <= kSame)
        told_->setText(tr("It lies in %1.").arg(pose));
    else if (nearest.angle <= tolerance_)
        told_->setText(tr("It is %1° from %2, within the %3° that count as success.")
                           .arg(angle, pose, look::numberText(tolerance_ / base::kDegree)));
    else
        told_->setText(tr("It is %1° from %2: parts do not rest like this, so the end of the track has to "
                          "hold them.")
                           .arg(angle, pose));
}

}  // namespace trapwright::pages
