#pragma once

#include <QColor>
#include <QPalette>

namespace trapwright::charts {

/// `share` of the first colour, the rest of the second.
QColor mix(const QColor& first, const QColor& second, double share);

/// What the colour of a series stands for; the theme says which colour that is.
enum class SeriesColour { first, second, third, fourth, fifth, sixth, seventh, neutral };

/// The colours of a chart.
struct ChartTheme {
    bool dark = false;
    QColor background;
    QColor text;
    QColor faintText;  // axis titles, hints
    QColor axis;
    QColor grid;
    QColor box;  // behind the values under the cursor

    /// Dark if the palette's window is.
    static ChartTheme from(const QPalette& palette);
    /// Black on white, for pictures that are saved and printed.
    static ChartTheme paper();

    /// `second`: the same series of the second of two studies, lighter.
    [[nodiscard]] QColor series(SeriesColour colour, bool second = false) const;

    friend bool operator==(const ChartTheme&, const ChartTheme&) = default;
};

}  // namespace trapwright::charts
