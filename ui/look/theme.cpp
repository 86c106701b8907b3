#include "ui/look/theme.h"

#include <QApplication>
#include <QStyleFactory>

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

/// What a palette cannot say: slim scroll bars, a roomier menu bar, quiet dock titles. Colours are written out,
/// because a style sheet's own palette() does not follow a new palette.
QString makeStyleSheet(const Colours& c) {
    return QString(
               "QScrollBar { background: transparent; border: none; margin: 0px; }"
               "QScrollBar:vertical { width: 10px; } QScrollBar:horizontal { height: 10px; }"
               "QScrollBar::handle { background: %1; border-radius: 3px; margin: 2px; }"
               "QScrollBar::handle:vertical { min-height: 28px; } QScrollBar::handle:horizontal { min-width: 28px; }"
               "QScrollBar::handle:hover { background: %2; }"
               "QScrollBar::add-line, QScrollBar::sub-line { width: 0px; height: 0px; }"
               "QScrollBar::add-page, QScrollBar::sub-page { background: none; }"
               "QToolTip { color: %3; background: %4; border: 1px solid %1; padding: 4px; }"
               "QMenuBar { background: %5; border-bottom: 1px solid %1; spacing: 2px; }"
               "QMenuBar::item { padding: 8px 10px; background: transparent; }"
               "QMenuBar::item:selected, QMenuBar::item:pressed { background: %6; color: %7; }"
               "QDockWidget::title { background: %5; padding: 6px 12px; border-bottom: 1px solid %1; }"
               "QMainWindow::separator { background: %1; width: 1px; height: 1px; }"
               "QMainWindow::separator:hover { background: %6; }")
        .arg(c.line.name(), c.faint.name(), c.text.name(), c.tip.name(), c.window.name(), c.accent.name(),
             c.onAccent.name());
}

}  // namespace

QPalette makePalette(Scheme scheme) {
    const Colours& c = coloursOf(scheme);
    QPalette palette(c.text, c.button, c.button.lighter(120), c.line.darker(130), c.line, c.text, c.text, c.base,
                     c.window);
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
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText})
        palette.setColor(QPalette::Disabled, role, scheme == Scheme::light ? QColor(0x9aa0a6) : QColor(0x6d747b));
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
        case Tone::good: return light ? QColor(0x00795a) : QColor(0x3ec79c);
        case Tone::warning: return light ? QColor(0x9a5b00) : QColor(0xf0b23e);
        case Tone::bad: return light ? QColor(0xb8430a) : QColor(0xff8a52);
    }
    return palette.color(QPalette::WindowText);
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
    qApp->setStyleSheet(makeStyleSheet(coloursOf(scheme())));
    emit schemeChanged(scheme());
}

}  // namespace trapwright::look
