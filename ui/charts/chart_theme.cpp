#include "ui/charts/chart_theme.h"

#include <array>

#include "ui/look/theme.h"

namespace trapwright::charts {

namespace {

constexpr std::size_t kColours = 7;  // those of SeriesColour before neutral

ChartTheme makeTheme(const QColor& background, const QColor& text) {
    ChartTheme theme;
    theme.dark = background.lightnessF() < 0.5F;
    theme.background = background;
    theme.text = text;
    theme.faintText = mix(text, background, 0.75);
    theme.axis = mix(text, background, 0.45);
    theme.grid = mix(text, background, 0.13);
    theme.box = mix(text, background, 0.06);
    return theme;
}

/// What has little contrast to the background comes last: it fills bars, but is no line.
const std::array<QColor, kColours>& coloursOn(bool dark) {
    using namespace look;
    static const std::array<QColor, kColours> light{kBlue,   kVermillion, kBluishGreen, kReddishPurple,
                                                    kOrange, kSkyBlue,    kYellow};
    static const std::array<QColor, kColours> onDark{kSkyBlue, kOrange,     kBluishGreen, kReddishPurple,
                                                     kYellow,  kVermillion, kBlue};
    return dark ? onDark : light;
}

}  // namespace

QColor mix(const QColor& first, const QColor& second, double share) {
    const auto part = [&](float a, float b) { return static_cast<float>(share * a + (1.0 - share) * b); };
    return QColor::fromRgbF(part(first.redF(), second.redF()), part(first.greenF(), second.greenF()),
                            part(first.blueF(), second.blueF()));
}

ChartTheme ChartTheme::from(const QPalette& palette) {
    return makeTheme(palette.color(QPalette::Active, QPalette::Base),
                     palette.color(QPalette::Active, QPalette::Text));
}

ChartTheme ChartTheme::paper() {
    return makeTheme(Qt::white, Qt::black);
}

QColor ChartTheme::series(SeriesColour colour, bool second) const {
    const auto index = static_cast<std::size_t>(colour);
    const QColor plain = index < kColours ? coloursOn(dark)[index] : mix(text, background, 0.6);
    return second ? mix(plain, background, 0.6) : plain;
}

}  // namespace trapwright::charts
