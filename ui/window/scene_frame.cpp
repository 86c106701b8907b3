#include "ui/window/scene_frame.h"

#include <QAction>
#include <QEvent>
#include <QStackedWidget>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/look/icon.h"
#include "ui/look/message_bar.h"
#include "ui/look/theme.h"
#include "ui/window/welcome.h"

namespace trapwright::window {

namespace {

constexpr int kToolIcon = 18;

/// The scene's actions that have a button, by their keys; the others are in the menu alone.
struct ToolFace {
    Qt::Key key;
    const char* icon;
};
constexpr ToolFace kTools[] = {{Qt::Key_F, "fit"},        {Qt::Key_0, "view-iso"},  {Qt::Key_2, "view-top"},
                               {Qt::Key_1, "view-front"}, {Qt::Key_3, "view-side"}, {Qt::Key_H, "height"},
                               {Qt::Key_E, "edges"},      {Qt::Key_C, "follow"}};

}  // namespace

SceneFrame::SceneFrame(QWidget* parent)
    : QWidget(parent),
      messages_(new look::MessageBar(this)),
      stack_(new QStackedWidget(this)),
      welcome_(new Welcome(this)),
      scene_(new scene::SceneView(this)),
      layout_(new QVBoxLayout(this)) {
    setObjectName("sceneFrame");
    scene_->setObjectName("scene");
    scene_->setAccessibleName(tr("3D scene"));
    scene_->setMinimumSize(320, 200);

    auto* withTools = new QWidget(this);
    auto* tools = new QVBoxLayout(withTools);
    tools->setContentsMargins(0, 0, 0, 0);
    tools->setSpacing(0);
    tools->addWidget(makeTools());
    tools->addWidget(scene_, 1);
    stack_->addWidget(welcome_);
    stack_->addWidget(withTools);

    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(0);
    layout_->addWidget(messages_);
    layout_->addWidget(stack_, 1);
    colour();
}

void SceneFrame::showWelcome(bool welcome) {
    stack_->setCurrentIndex(welcome ? 0 : 1);
    // Unseen it must not keep the scene wide.
    const QSizePolicy::Policy policy = welcome ? QSizePolicy::Preferred : QSizePolicy::Ignored;
    welcome_->setSizePolicy(policy, policy);
}

void SceneFrame::addBar(const QString& page, QWidget* bar) {
    layout_->addWidget(bar);
    bar->hide();
    bars_.insert(page, bar);
}

void SceneFrame::showBar(const QString& page) {
    for (auto bar = bars_.cbegin(); bar != bars_.cend(); ++bar)
        bar.value()->setVisible(bar.key() == page);
}

void SceneFrame::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) colour();
}

QWidget* SceneFrame::makeTools() {
    auto* bar = new QToolBar(tr("Views"), this);
    bar->setObjectName("sceneTools");
    bar->setIconSize({kToolIcon, kToolIcon});
    bar->setToolButtonStyle(Qt::ToolButtonIconOnly);
    bar->setStyleSheet(
        "#sceneTools { border: none; border-bottom: 1px solid palette(mid); padding: 2px 6px; }");
    const QList<QAction*> actions = scene_->viewActions();
    for (const ToolFace& face : kTools) {
        const auto action = std::find_if(actions.begin(), actions.end(), [&](const QAction* one) {
            return one->shortcut() == QKeySequence(face.key);
        });
        if (action == actions.end()) continue;
        (*action)->setIcon(look::icon(face.icon));
        if ((*action)->isCheckable() && bar->findChild<QToolButton*>("switch") == nullptr)
            bar->addSeparator();
        bar->addAction(*action);
        auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(*action));
        if ((*action)->isCheckable()) button->setObjectName("switch");
        button->setFocusPolicy(Qt::TabFocus);
        button->setAccessibleName((*action)->text());
    }
    return bar;
}

void SceneFrame::colour() {
    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    scene_->setTheme(dark ? scene::SceneTheme::dark() : scene::SceneTheme::light());
}

}  // namespace trapwright::window
