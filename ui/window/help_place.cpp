#include "ui/window/help_place.h"

#include <QDockWidget>
#include <QStringList>
#include <QToolButton>
#include <algorithm>
#include <vector>

#include "core/study/field_text.h"
#include "ui/help/help_book.h"
#include "ui/look/folding_group.h"
#include "ui/pages/field_texts.h"

namespace trapwright::window {

namespace {

constexpr auto kFirst = "index";

bool isSetting(const std::string& key) {
    static const std::vector<study::FieldInfo> fields = study::listFields();
    return std::any_of(fields.begin(), fields.end(), [&](const auto& field) { return field.key == key; });
}

/// What a group or a panel is called; its section has the same title.
QString titleOf(const QWidget& widget) {
    if (const auto* dock = qobject_cast<const QDockWidget*>(&widget)) return dock->windowTitle();
    if (qobject_cast<const look::FoldingGroup*>(&widget) == nullptr) return {};
    const auto* title = widget.findChild<const QToolButton*>("group.title");
    return title != nullptr ? title->text() : QString();
}

}  // namespace

HelpPlace findHelp(const help::HelpBook& book, const QWidget* focus, const QString& page) {
    if (page.isEmpty()) return {kFirst};
    // The drive's page is the other half of Validate.
    QStringList pages;
    pages << page;
    if (page == "validate") pages << "drive";
    for (const QWidget* widget = focus; widget != nullptr; widget = widget->parentWidget()) {
        const QString name = widget->objectName();
        const QString key = name.section('.', 1);
        if ((name.startsWith("field.") || name.startsWith("row.")) && isSetting(key.toStdString()))
            return {"settings", help::anchorOf(pages::settingHeading(key.toStdString()))};
        // The inspector of Validate is the drive's.
        if (name == "dock.inspector") return {pages.back()};
        const QString title = titleOf(*widget);
        if (title.isEmpty()) continue;
        for (const QString& candidate : pages) {
            const QString anchor = help::anchorOf(title);
            if (book.has(candidate, anchor)) return {candidate, anchor};
        }
    }
    return {page};
}

}  // namespace trapwright::window
