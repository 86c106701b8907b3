#include "ui/window/rail.h"

#include <QActionGroup>
#include <QLayout>
#include <QToolButton>

#include "ui/feeder/validate_page.h"
#include "ui/look/icon.h"
#include "ui/pages/evolve_page.h"
#include "ui/pages/export_page.h"
#include "ui/pages/page.h"
#include "ui/pages/part_page.h"
#include "ui/pages/review_page.h"
#include "ui/pages/track_page.h"

namespace trapwright::window {

namespace {

constexpr int kWidth = 76;
constexpr int kButtonHeight = 64;
constexpr int kIcon = 26;

// The page that is shown has a bar of the accent at its left, and bold text: never colour alone.
constexpr auto kStyle =
    "#rail { border: none; border-right: 1px solid palette(mid); background: palette(base); spacing: 0px; "
    "padding: 0px; }"
    "#rail QToolButton { border: none; border-left: 3px solid transparent; border-radius: 0px; padding: 6px "
    "3px 6px 0px; }"
    "#rail QToolButton:hover { background: palette(window); }"
    "#rail QToolButton:focus { border-left-color: palette(mid); background: palette(window); }"
    "#rail QToolButton:checked { border-left-color: palette(highlight); background: palette(window); "
    "font-weight: 600; }";

}  // namespace

std::vector<pages::Page*> makePages(pages::RunActions& run, const session::Environment& environment) {
    return {new pages::PartPage,   new pages::TrackPage(run), new pages::EvolvePage(run),
            new pages::ReviewPage, new pages::ExportPage,     new feeder::ValidatePage(environment)};
}

Rail::Rail(const std::vector<pages::Page*>& pages, QWidget* parent) : QToolBar(tr("Pages"), parent) {
    setObjectName("rail");
    setMovable(false);
    setContextMenuPolicy(Qt::PreventContextMenu);
    setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    setIconSize({kIcon, kIcon});
    setStyleSheet(kStyle);
    layout()->setContentsMargins(0, 0, 0, 0);
    layout()->setSpacing(0);

    auto* group = new QActionGroup(this);
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const pages::PageFace& face = pages[i]->face();
        QAction* action = addAction(look::icon(face.icon), face.title);
        action->setObjectName("page." + face.name + ".show");
        action->setCheckable(true);
        action->setShortcut(QKeySequence(QString("Ctrl+%1").arg(i + 1)));
        action->setToolTip(
            QString("%1 (%2)").arg(face.tip, action->shortcut().toString(QKeySequence::NativeText)));
        group->addAction(action);
        actions_.push_back(action);
        connect(action, &QAction::triggered, this, [this, i] { emit chosen(i); });
        if (auto* button = qobject_cast<QToolButton*>(widgetForAction(action))) {
            button->setObjectName("rail." + face.name);
            button->setAccessibleName(face.title);
            button->setAccessibleDescription(face.tip);
            button->setFixedSize(kWidth, kButtonHeight);
            button->setFocusPolicy(Qt::TabFocus);
        }
    }
}

void Rail::setCurrent(std::size_t page) {
    actions_[page]->setChecked(true);
}

}  // namespace trapwright::window
