#include "ui/scene/scene_view.h"

#include <QLinearGradient>
#include <QPainter>

#include "ui/scene/overlay.h"
#include "ui/scene/scene_view_state.h"
#include "ui/scene/subject.h"

namespace trapwright::scene {

namespace {

/// What the fitted subject leaves free on every side for its labels: a share of the screen, and at least so
/// much.
constexpr double kFitMargin = 0.09;
constexpr double kLabelHeight = 44.0;  // [px]

}  // namespace

void SceneView::State::fit() {
    if (screen().isEmpty()) return;
    geometry::Box box;
    double margin = kFitMargin;
    if (closeUp && !contents.parts.empty()) {
        const base::Vec3& centre = contents.parts.front().pose.position;
        box.include(centre - base::Vec3::Constant(*closeUp));
        box.include(centre + base::Vec3::Constant(*closeUp));
    } else {
        box = boxOf(contents);
        margin = std::clamp(kLabelHeight / screen().height(), kFitMargin, 2.0 * kFitMargin);
    }
    camera = fitted(camera, box, screen(), margin);
    moved = false;
    change();
}

void SceneView::State::setSubject(Subject subject) {
    const bool wasPoses = contents.stablePoses != nullptr;
    const bool wasEmpty = isEmpty(contents);
    contents.track = std::move(subject.track);
    contents.solid = std::move(subject.solid);
    contents.stablePoses = std::move(subject.stablePoses);
    heightShading->setEnabled(contents.track || contents.solid);
    // A track and the solid made of it lie in the same place.
    if (wasEmpty || wasPoses != (contents.stablePoses != nullptr)) {
        camera = homeCamera(contents);
        moved = false;
    }
    camera.tilt = tiltOf(contents);
    fitUnlessMoved();
}

void SceneView::State::fitUnlessMoved() {
    if (!moved) fit();
    change();
}

void SceneView::State::moveTo(const Camera& wanted) {
    camera = wanted;
    moved = true;
    change();
}

void SceneView::State::change() {
    frames.change();
}

SceneView::SceneView(QWidget* parent) : QWidget(parent), state_(std::make_unique<State>(*this)) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(240, 160);
    setAccessibleName(tr("3D scene"));
    setAccessibleDescription(tr("The track, the part on it, and what is known of its motion"));
    state_->makeActions();
    connect(&state_->frames, &SceneFrames::failed, this, &SceneView::failed);
}

SceneView::~SceneView() = default;

const SceneContents& SceneView::contents() const {
    return state_->contents;
}

const Camera& SceneView::camera() const {
    return state_->camera;
}

void SceneView::setTheme(const SceneTheme& theme) {
    state_->contents.theme = theme;
    state_->change();
}

void SceneView::clear() {
    SceneContents empty;
    empty.theme = state_->contents.theme;
    empty.heightShading = state_->contents.heightShading;
    empty.edges = state_->contents.edges;
    state_->contents = empty;
    state_->closeUp.reset();
    setTurnable(false);
    state_->moved = false;
    state_->change();
}

void SceneView::showTrack(std::shared_ptr<const track::Track> track, const TrackMarks& marks) {
    state_->contents.marks = marks;
    state_->contents.traces.clear();
    state_->contents.contacts.clear();
    state_->setSubject({.track = std::move(track)});
}

void SceneView::showSolid(std::shared_ptr<const geometry::TriangleMesh> solid) {
    state_->setSubject({.solid = std::move(solid)});
}

void SceneView::showStablePoses(std::shared_ptr<const part::Part> part, std::vector<double> shares) {
    state_->contents.poseShares = std::move(shares);
    state_->setSubject({.stablePoses = std::move(part)});
}

void SceneView::setParts(std::vector<PartInScene> parts) {
    SceneContents& contents = state_->contents;
    const bool same =
        !parts.empty() && !contents.parts.empty() && parts.front().part == contents.parts.front().part;
    if (!same) {
        contents.traces.clear();
        contents.contacts.clear();
    }
    if (state_->follow && !parts.empty()) {
        const base::Vec3& to = parts.front().pose.position;
        Camera& camera = state_->camera;
        camera.focus = same ? camera.focus + to - contents.parts.front().pose.position : to;
    }
    contents.parts = std::move(parts);
    // What is turned by hand stays on a ground that stays.
    if (!same || (state_->closeUp && !state_->turnable)) state_->fitUnlessMoved();
    state_->change();
}

void SceneView::setTraces(std::vector<Trace> traces) {
    state_->contents.traces = std::move(traces);
    state_->change();
}

void SceneView::setContacts(std::span<const ContactArrow> contacts) {
    state_->contents.contacts.assign(contacts.begin(), contacts.end());
    state_->change();
}

void SceneView::setForceLegend(bool on) {
    state_->contents.forceLegend = on;
    state_->change();
}

void SceneView::setHighlights(std::vector<Highlight> highlights) {
    state_->contents.highlights = std::move(highlights);
    state_->change();
}

void SceneView::setHeightShading(bool on) {
    state_->contents.heightShading = on;
    state_->heightShading->setChecked(on);
    state_->change();
}

void SceneView::setEdges(bool on) {
    state_->contents.edges = on;
    state_->edges->setChecked(on);
    state_->change();
}

void SceneView::setFollow(bool on) {
    state_->follow = on;
    state_->followPart->setChecked(on);
    if (on && !state_->contents.parts.empty()) {
        Camera camera = state_->camera;
        camera.focus = state_->contents.parts.front().pose.position;
        state_->moveTo(camera);
    }
}

void SceneView::setCloseUp(std::optional<double> radius) {
    if (radius == state_->closeUp) return;
    state_->closeUp = radius;
    state_->camera = homeCamera(state_->contents);
    state_->fit();
}

void SceneView::setTurnable(bool on) {
    state_->turnable = on;
    setCursor(on ? Qt::OpenHandCursor : Qt::ArrowCursor);
}

void SceneView::setView(StandardView view) {
    state_->camera =
        view == StandardView::home ? homeCamera(state_->contents) : turnedTo(state_->camera, view);
    state_->fit();
    state_->change();
}

void SceneView::fitView() {
    state_->fit();
}

QList<QAction*> SceneView::viewActions() const {
    return state_->actions;
}

bool SceneView::isSettled() const {
    return state_->frames.isSettled();
}

QFuture<QImage> SceneView::picture(QSize pixels, double pixelRatio) {
    return state_->frames.picture(pixels, pixelRatio);
}

void SceneView::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    state_->change();
}

void SceneView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (!state_->moved) state_->fit();
    state_->change();
}

void SceneView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const Frame* const frame = state_->frames.newest();
    if (frame == nullptr) {
        QLinearGradient background(0.0, 0.0, 0.0, height());
        background.setColorAt(0.0, state_->contents.theme.backgroundTop);
        background.setColorAt(1.0, state_->contents.theme.backgroundBottom);
        painter.fillRect(rect(), background);
        return;
    }
    if (frame->pixelRatio != devicePixelRatioF()) state_->change();
    // Until the picture of a new size is drawn, that of the old one is stretched.
    painter.setRenderHint(QPainter::SmoothPixmapTransform, frame->screen != QSizeF(size()));
    painter.scale(width() / frame->screen.width(), height() / frame->screen.height());
    painter.drawImage(QRectF(QPointF(), frame->screen), frame->image);
    paintOverlay(painter, overlayOf(*frame->contents, frame->camera, frame->screen, state_->hovered));
}

}  // namespace trapwright::scene
