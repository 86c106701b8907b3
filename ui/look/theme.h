#pragma once

#include <QObject>
#include <QPalette>

class QLabel;
class QToolButton;

namespace trapwright::look {

class SystemScheme;

enum class Scheme { light, dark };
/// What the user asked for under View > Theme.
enum class ThemeChoice { system, light, dark };

/// Neutral greys and one accent (QPalette::Highlight and Link).
QPalette makePalette(Scheme scheme);
/// What a palette is, for widgets that draw with colours of their own.
Scheme schemeOf(const QPalette& palette);

/// A sign's colour, readable on a window of either scheme. Never the only difference: each has its icon, too.
enum class Tone { good, warning, bad };
QColor toneColour(Tone tone, const QPalette& palette);

/// Gives a text the colour of a tone, in the scheme of the program. Call it again when that changes.
void colourText(QLabel& label, Tone tone);

/// Gives a tool button, which has an action's text, icon and state, the looks of a push button.
void drawAsButton(QToolButton& button);

/// Gives the application its palette and keeps it: as the system has it until the user chooses.
class Theme : public QObject {
    Q_OBJECT
 public:
    explicit Theme(QObject* parent = nullptr);

    void choose(ThemeChoice choice);
    [[nodiscard]] ThemeChoice choice() const { return choice_; }
    [[nodiscard]] Scheme scheme() const;

 signals:
    void schemeChanged(trapwright::look::Scheme scheme);

 private:
    void apply();

    SystemScheme* system_;
    ThemeChoice choice_ = ThemeChoice::system;
};

}  // namespace trapwright::look
