#pragma once

#include <QString>
#include <vector>

class QWidget;

namespace trapwright::window {

/// One action that has a key.
struct Shortcut {
    QString place;  // the menu or page that it belongs to
    QString text;   // what it does
    QString keys;   // "Ctrl+O"
};

/// Property of an action whose text changes: what it is called in the list.
inline constexpr const char* kLastingText = "lastingText";

/// All shortcuts of a window, from its QActions: those in menus in their order, then those of its pages.
std::vector<Shortcut> findShortcuts(const QWidget& window);

/// The table of the README, in Markdown.
QString shortcutTable(const std::vector<Shortcut>& shortcuts);

/// Help > Keyboard shortcuts: the list with a field to search in it. Does not wait.
void showShortcuts(QWidget* parent, const std::vector<Shortcut>& shortcuts);

}  // namespace trapwright::window
