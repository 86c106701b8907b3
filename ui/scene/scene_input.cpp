#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <array>
#include <cmath>

#include "ui/scene/orbit_cube.h"
#include "ui/scene/scene_view_state.h"

namespace trapwright::scene {

namespace {

constexpr double kClickReach = 4.0;     // a press that moves less is a click [pixels]
constexpr double kKeyStep = 40.0;       // of an arrow key, as if dragged [pixels]
constexpr double kZoomPerNotch = 1.15;  // of the wheel

}  // namespace

void SceneView::State::makeActions() {
    const auto add = [this](const QString& text, const QKeySequence& shortcut, auto&& call) {
        auto* action = new QAction(text, &view);
        // Wherever the focus is: a field in which text is typed keeps its letters to itself.
        action->setShortcut(shortcut);
        view.addAction(action);
        actions.append(action);
        connect(action, &QAction::triggered, &view, call);
        return action;
    };
    // The digits are those of FreeCAD.
    const std::array<std::tuple<QString, Qt::Key, StandardView>, 7> views = {{
        {SceneView::tr("View from the corner"), Qt::Key_0, StandardView::home},
        {SceneView::tr("View from the front"), Qt::Key_1, StandardView::front},
        {SceneView::tr("View from the top"), Qt::Key_2, StandardView::top},
        {SceneView::tr("View from the right"), Qt::Key_3, StandardView::right},
        {SceneView::tr("View from the back"), Qt::Key_4, StandardView::back},
        {SceneView::tr("View from the bottom"), Qt::Key_5, StandardView::bottom},
        {SceneView::tr("View from the left"), Qt::Key_6, StandardView::left},
    }};
    for (const auto& entry : views) {
        const StandardView wanted = std::get<2>(entry);
        add(std::get<0>(entry), std::get<1>(entry), [this, wanted] { view.setView(wanted); });
    }
    add(SceneView::tr("Fit the view"), Qt::Key_F, [this] { view.fitView(); });
    const auto addSwitch = [&](const QString& text, Qt::Key key, auto&& call) {
        QAction* action = add(text, key, call);
        action->setCheckable(true);
        return action;
    };
    heightShading = addSwitch(SceneView::tr("Colour by height"), Qt::Key_H,
                              [this](bool on) { view.setHeightShading(on); });
    edges = addSwitch(SceneView::tr("Draw edges"), Qt::Key_E, [this](bool on) { view.setEdges(on); });
    followPart =
        addSwitch(SceneView::tr("Follow the part"), Qt::Key_C, [this](bool on) { view.setFollow(on); });
}

void SceneView::State::drag(const QPointF& by, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers) {
    const bool right = buttons.testFlag(Qt::RightButton);
    if (buttons.testFlag(Qt::MiddleButton) || modifiers.testFlag(Qt::ShiftModifier) || (right && !turnable))
        return moveTo(panned(camera, by, screen()));
    if (turnable && !right && !contents.parts.empty()) {
        emit view.partTurned(turnedAlong(camera, by));
        return;
    }
    moveTo(orbited(camera, by));
}

void SceneView::mousePressEvent(QMouseEvent* event) {
    state_->pressedAt = event->position();
    state_->lastMouse = event->position();
    state_->dragged = false;
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
    State& state = *state_;
    const QPointF drag = event->position() - state.lastMouse;
    if (event->buttons() == Qt::NoButton) {
        const auto face = orbitCubeFaceAt(state.camera, state.screen(), event->position());
        if (face != state.hovered) {
            state.hovered = face;
            update();
        }
        return;
    }
    if (!state.dragged && (event->position() - state.pressedAt).manhattanLength() < kClickReach) return;
    state.dragged = true;
    state.lastMouse = event->position();
    state.drag(drag, event->buttons(), event->modifiers());
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
    State& state = *state_;
    if (state.dragged || event->button() != Qt::LeftButton) return;
    if (const auto face = orbitCubeFaceAt(state.camera, state.screen(), event->position())) setView(*face);
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (!orbitCubeArea(state_->screen()).contains(event->position())) fitView();
}

void SceneView::wheelEvent(QWheelEvent* event) {
    const double factor = std::pow(kZoomPerNotch, event->angleDelta().y() / 120.0);
    state_->moveTo(zoomed(state_->camera, factor, event->position(), state_->screen()));
    event->accept();
}

void SceneView::keyPressEvent(QKeyEvent* event) {
    State& state = *state_;
    const QPointF middle(0.5 * width(), 0.5 * height());
    QPointF drag;
    switch (event->key()) {
        case Qt::Key_Left:
            drag = {-kKeyStep, 0.0};
            break;
        case Qt::Key_Right:
            drag = {kKeyStep, 0.0};
            break;
        case Qt::Key_Up:
            drag = {0.0, -kKeyStep};
            break;
        case Qt::Key_Down:
            drag = {0.0, kKeyStep};
            break;
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            state.moveTo(zoomed(state.camera, kZoomPerNotch, middle, state.screen()));
            return;
        case Qt::Key_Minus:
            state.moveTo(zoomed(state.camera, 1.0 / kZoomPerNotch, middle, state.screen()));
            return;
        default:
            QWidget::keyPressEvent(event);
            return;
    }
    state.drag(drag, Qt::LeftButton, event->modifiers());
}

void SceneView::leaveEvent(QEvent* /*event*/) {
    state_->hovered = std::nullopt;
    update();
}

}  // namespace trapwright::scene
