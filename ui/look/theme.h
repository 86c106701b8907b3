#pragma once

#include <QColor>
#include <QObject>
#include <QPalette>

/// Eight colours that people with any kind of colour vision tell apart (Okabe and Ito 2008), for series and
/// outcomes. Never the only difference: a dash, a marker, a glyph or a word goes with it.

class QLabel;
class QToolButton;

namespace trapwright::look {

inline const QColor kBlack{0x00, 0x00, 0x00};
inline const QColor kOrange{0xE6, 0x9F, 0x00};
inline const QColor kSkyBlue{0x56, 0xB4, 0xE9};
inline const QColor kBluishGreen{0x00, 0x9E, 0x73};
inline const QColor kYellow{0xF0, 0xE4, 0x42};
inline const QColor kBlue{0x00, 0x72, 0xB2};
inline const QColor kVermillion{0xD5, 0x5E, 0x00};
inline const QColor kReddishPurple{0xCC, 0x79, 0xA7};

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
