#pragma once

#include <QString>

class QWidget;

namespace trapwright::help {
class HelpBook;
}

namespace trapwright::window {

/// A section of the help.
struct HelpPlace {
    QString page;
    QString anchor = {};  // empty: the page's beginning

    friend bool operator==(const HelpPlace&, const HelpPlace&) = default;
};

/// What the help has to say about a widget: about the setting that it edits, else about the group or panel
/// that it belongs to, else about the page that is shown (its name; empty: none, the start page).
HelpPlace findHelp(const help::HelpBook& book, const QWidget* focus, const QString& page);

}  // namespace trapwright::window
