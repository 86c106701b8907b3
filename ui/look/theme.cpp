#include "ui/look/theme.h"

#include <QApplication>
#include <QLabel>
#include <QStyleFactory>
#include <QToolButton>

#include <cmath>

#include "ui/look/system_scheme.h"

namespace trapwright::look {

namespace {

struct Colours {
    QColor window, base, alternate, button, text, faint, line, accent, onAccent, tip;
};

// Text on its ground has a contrast of at least 7:1, faint text 4.5:1 (WCAG 2.1, 1.4.6 and 1.4.3).
const Colours& coloursOf(Scheme scheme) {
    static const Colours light = {0xf3f4f5, 0xffffff, 0xf7f8f9, 0xfcfcfd, 0x1b1f23,
                                  0x646b72, 0xc4c9ce, 0x0b66a3, 0xffffff, 0xffffff};
    static const Colours dark = {0x25282c, 0x1b1d20, 0x212427, 0x2f3338, 0xe4e7ea,
                                 0x9aa2aa, 0x464c53, 0x56a8e0, 0x0c1116, 0x32363b};
    return scheme == Scheme::light ? light : dark;
}

constexpr double kChosen = 0.16;  // of the accent in the ground of a button that is switched on

QColor mixed(const QColor& ground, const QColor& colour, double share) {
    const auto mix = [share](int a, int b) { return static_cast<int>(std::lround(a + share * (b - a))); };
    return {mix(ground.red(), colour.red()), mix(ground.green(), colour.green()),
            mix(ground.blue(), colour.blue())};
}

/// What a palette cannot say: flat controls, slim scroll bars, a roomier menu bar. Colours are written out,
/// because a style sheet's own palette() does not follow a new palette.
QString makeStyleSheet(Scheme scheme) {
    const Colours& c = coloursOf(scheme);
    QString sheet = R"(
QLineEdit, QComboBox, QPushButton {
    border: 1px solid $line; border-radius: 4px; padding: 3px 6px; min-height: 18px; background: $base; color: $text;
    selection-background-color: $accent; selection-color: $onAccent; }
QPushButton { background: $button; padding: 4px 12px; }
QLineEdit:hover, QComboBox:hover, QPushButton:hover { border-color: $faint; }
QPushButton:default { border-color: $accent; }
QPushButton, QComboBox, QAbstractSpinBox, QCheckBox, QToolButton[button="true"] { outline: none; }
QLineEdit:focus, QComboBox:focus { border: 2px solid $accent; padding: 2px 5px; }
QPushButton:focus { border: 2px solid $accent; padding: 3px 11px; }
QToolButton[button="true"] { border: 1px solid $line; border-radius: 4px; padding: 3px 8px; min-height: 18px;
    background: $button; color: $text; }
QToolButton[button="true"]:hover { border-color: $faint; }
QToolButton[button="true"]:focus { border: 2px solid $accent; padding: 2px 7px; }
QToolButton[button="true"]:pressed { background: $line; }
QToolButton[button="true"]:checked { background: $chosen; border-color: $accent; }
QToolButton[button="true"]:disabled { color: $off; background: $window; border-color: $line; }
QCheckBox::indicator { width: 14px; height: 14px; border: 1px solid $faint; border-radius: 3px; background: $base; }
QCheckBox::indicator:hover { border-color: $accent; }
QCheckBox::indicator:focus { border: 2px solid $accent; width: 12px; height: 12px; }
QCheckBox::indicator:checked { background: $accent; border-color: $accent; image: url(:/icons/check-on-$scheme.svg); }
QCheckBox::indicator:disabled { background: $window; border-color: $line; }
QAbstractSpinBox { border: 1px solid $line; border-radius: 4px; padding: 3px 6px; min-height: 18px; background: $base; }
QAbstractSpinBox:hover { border-color: $faint; }
QAbstractSpinBox:focus { border: 2px solid $accent; padding: 2px 5px; }
QAbstractSpinBox:disabled { color: $off; background: $window; border-color: $line; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { border: none; background: transparent; width: 16px; }
QAbstractSpinBox::up-button { subcontrol-origin: border; subcontrol-position: top right; }
QAbstractSpinBox::down-button { subcontrol-origin: border; subcontrol-position: bottom right; }
QAbstractSpinBox::up-arrow { image: url(:/icons/up-on-$scheme.svg); width: 10px; height: 10px; }
QAbstractSpinBox::down-arrow { image: url(:/icons/down-on-$scheme.svg); width: 10px; height: 10px; }
QPushButton:pressed { background: $line; }
QPushButton:checked { background: $chosen; border-color: $accent; }
QPushButton:flat { border-color: transparent; background: transparent; }
QPushButton:flat:hover { background: $base; }
QLineEdit:disabled, QComboBox:disabled, QPushButton:disabled { color: $off; background: $window; border-color: $line; }
QAbstractSpinBox QLineEdit, QComboBox QLineEdit, QAbstractSpinBox QLineEdit:focus, QComboBox QLineEdit:focus {
    border: none; padding: 0px; min-height: 0px; background: transparent; }
QComboBox::drop-down { border: none; width: 18px; }
QComboBox::down-arrow { image: url(:/icons/down-on-$scheme.svg); width: 12px; height: 12px; }
QComboBox QAbstractItemView { border: 1px solid $line; background: $base; color: $text; outline: none;
    selection-background-color: $accent; selection-color: $onAccent; }
QPushButton::menu-indicator { image: url(:/icons/down-on-$scheme.svg); width: 12px; height: 12px;
    subcontrol-origin: padding; subcontrol-position: center right; right: 6px; }
QScrollBar { background: transparent; border: none; margin: 0px; }
QScrollBar:vertical { width: 10px; }
QScrollBar:horizontal { height: 10px; }
QScrollBar::handle { background: $line; border-radius: 3px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 28px; }
QScrollBar::handle:horizontal { min-width: 28px; }
QScrollBar::handle:hover { background: $faint; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0px; height: 0px; }
QScrollBar::add-page, QScrollBar::sub-page { background: none; }
QToolTip { color: $text; background: $tip; border: 1px solid $line; padding: 4px; }
QMenuBar { background: $window; border-bottom: 1px solid $line; spacing: 2px; }
QMenuBar::item { padding: 8px 10px; background: transparent; }
QMenuBar::item:selected, QMenuBar::item:pressed { background: $accent; color: $onAccent; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QProgressBar { border: none; border-radius: 3px; background: $line; }
QProgressBar::chunk { border-radius: 3px; background: $accent; }
QMainWindow::separator { background: $line; width: 1px; height: 1px; }
QMainWindow::separator:hover { background: $accent; }
)";
    const QColor off = makePalette(scheme).color(QPalette::Disabled, QPalette::Text);
    const std::pair<const char*, QString> values[] = {
        {"$onAccent", c.onAccent.name()},
        {"$accent", c.accent.name()},
        {"$chosen", mixed(c.base, c.accent, kChosen).name()},
        {"$button", c.button.name()},
        {"$window", c.window.name()},
        {"$faint", c.faint.name()},
        {"$line", c.line.name()},
        {"$base", c.base.name()},
        {"$text", c.text.name()},
        {"$tip", c.tip.name()},
        {"$off", off.name()},
        {"$scheme", scheme == Scheme::light ? "light" : "dark"}};
    for (const auto& [name, value] : values)
        sheet.replace(name, value);
    return sheet;
}

/// A label asks for the colour of its links only when it is given its text.
void recolourLinks() {
    for (QWidget* widget : QApplication::allWidgets()) {
        auto* label = qobject_cast<QLabel*>(widget);
        if (label == nullptr || !label->text().contains("<a ")) continue;
        const QString text = label->text();
        label->clear();
        label->setText(text);
    }
}

}  // namespace

QPalette makePalette(Scheme scheme) {
    const Colours& c = coloursOf(scheme);
    QPalette palette(c.text, c.button, c.button.lighter(120), c.line.darker(130), c.line, c.text, c.text,
                     c.base, c.window);
    palette.setColor(QPalette::AlternateBase, c.alternate);
    palette.setColor(QPalette::Highlight, c.accent);
    palette.setColor(QPalette::HighlightedText, c.onAccent);
    palette.setColor(QPalette::Link, c.accent);
    palette.setColor(QPalette::LinkVisited, c.accent);
    palette.setColor(QPalette::ToolTipBase, c.tip);
    palette.setColor(QPalette::ToolTipText, c.text);
    palette.setColor(QPalette::PlaceholderText, c.faint);
    palette.setColor(QPalette::Midlight, scheme == Scheme::light ? c.line.lighter(112) : c.line.darker(125));
    palette.setColor(QPalette::Shadow, scheme == Scheme::light ? QColor(0x8a9097) : QColor(0x101214));
    for (const auto role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
        palette.setColor(QPalette::Disabled, role,
                         scheme == Scheme::light ? QColor(0x9aa0a6) : QColor(0x6d747b));
    palette.setColor(QPalette::Disabled, QPalette::Highlight, c.line);
    palette.setColor(QPalette::Disabled, QPalette::Base, c.window);
    return palette;
}

Scheme schemeOf(const QPalette& palette) {
    return palette.color(QPalette::Window).lightness() < palette.color(QPalette::WindowText).lightness()
               ? Scheme::dark
               : Scheme::light;
}

QColor toneColour(Tone tone, const QPalette& palette) {
    const bool light = schemeOf(palette) == Scheme::light;
    switch (tone) {
        case Tone::good:
            return light ? QColor(0x00795a) : QColor(0x3ec79c);
        case Tone::warning:
            return light ? QColor(0x9a5b00) : QColor(0xf0b23e);
        case Tone::bad:
            return light ? QColor(0xb8430a) : QColor(0xff8a52);
    }
    return palette.color(QPalette::WindowText);
}

void colourText(QLabel& label, Tone tone) {
    // Not by a palette: a new style sheet of the program takes that away.
    const QString sheet = QString("color: %1").arg(toneColour(tone, QApplication::palette()).name());
    if (label.styleSheet() != sheet) label.setStyleSheet(sheet);
}

void drawAsButton(QToolButton& button) {
    button.setProperty("button", true);  // as the style sheet knows it
    button.setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
}

Theme::Theme(QObject* parent) : QObject(parent), system_(new SystemScheme(this)) {
    // The same on every desktop: the platform's own styles do not take a palette.
    QApplication::setStyle(QStyleFactory::create("Fusion"));
    connect(system_, &SystemScheme::changed, this, [this] {
        if (choice_ == ThemeChoice::system) apply();
    });
    apply();
}

void Theme::choose(ThemeChoice choice) {
    choice_ = choice;
    apply();
}

Scheme Theme::scheme() const {
    if (choice_ == ThemeChoice::system) return system_->scheme();
    return choice_ == ThemeChoice::dark ? Scheme::dark : Scheme::light;
}

void Theme::apply() {
    QApplication::setPalette(makePalette(scheme()));
    qApp->setStyleSheet(makeStyleSheet(scheme()));
    recolourLinks();
    emit schemeChanged(scheme());
}

}  // namespace trapwright::look
