#include "ui/charts/curve_style.h"

#include <QtTest>
#include <set>

using namespace trapwright;
using charts::ChartTheme;
using charts::CurveStyle;
using charts::Marker;
using charts::SeriesColour;

namespace {

/// Relative luminance (WCAG 2.1).
double luminance(const QColor& colour) {
    const auto linear = [](double c) {
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
           0.0722 * linear(colour.blueF());
}

double contrast(const QColor& a, const QColor& b) {
    const double high = std::max(luminance(a), luminance(b));
    const double low = std::min(luminance(a), luminance(b));
    return (high + 0.05) / (low + 0.05);
}

ChartTheme themeOf(bool dark) {
    QPalette palette;
    palette.setColor(QPalette::Base, dark ? QColor(0x1C, 0x1E, 0x22) : Qt::white);
    palette.setColor(QPalette::Text, dark ? Qt::white : Qt::black);
    return ChartTheme::from(palette);
}

}  // namespace

class CurveStyleTest : public QObject {
    Q_OBJECT

 private slots:
    void coloursReadOnTheirBackground_data() {
        QTest::addColumn<bool>("dark");
        QTest::newRow("light") << false;
        QTest::newRow("dark") << true;
    }
    void coloursReadOnTheirBackground() {
        QFETCH(bool, dark);
        const ChartTheme theme = themeOf(dark);
        QCOMPARE(theme.dark, dark);
        // WCAG 2.1, 1.4.11: 3 for lines, 4.5 for text. Lines use the first three colours.
        for (const SeriesColour colour :
             {SeriesColour::first, SeriesColour::second, SeriesColour::third, SeriesColour::neutral})
            QVERIFY(contrast(theme.series(colour), theme.background) >= 3.0);
        QVERIFY(contrast(theme.text, theme.background) >= 4.5);
        QVERIFY(contrast(theme.faintText, theme.background) >= 4.5);
    }

    void secondStudyIsLighterAndHasOtherDashes() {
        const ChartTheme theme = ChartTheme::paper();
        for (const Qt::PenStyle line : {Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine}) {
            const CurveStyle first{SeriesColour::first, line, Marker::circle, false};
            const CurveStyle second{SeriesColour::first, line, Marker::circle, true};
            QVERIFY(charts::curvePen(second, theme).dashPattern() !=
                    charts::curvePen(first, theme).dashPattern());
            QVERIFY(luminance(charts::curvePen(second, theme).color()) >
                    luminance(charts::curvePen(first, theme).color()));
        }
    }

    void linesAreCutAtTheRectangle() {
        const QRectF rect(0, 0, 10, 10);
        // In, out at the right, back in through the top.
        const QPolygonF line{{5, 5}, {15, 5}, {15, -5}, {5, -5}, {5, 5}};
        const std::vector<QPolygonF> pieces = charts::clipPolyline(line, rect);
        QCOMPARE(pieces.size(), std::size_t{2});
        QCOMPARE(pieces[0], (QPolygonF{{5, 5}, {10, 5}}));
        QCOMPARE(pieces[1], (QPolygonF{{5, 0}, {5, 5}}));
    }

    void lineInsideStaysWhole() {
        const QPolygonF line{{1, 1}, {2, 9}, {9, 9}, {9, 9}, {3, 2}};
        QCOMPARE(charts::clipPolyline(line, QRectF(0, 0, 10, 10)), std::vector<QPolygonF>{line});
    }

    void lineThatOnlyPassesIsOnePiece() {
        const auto pieces = charts::clipPolyline({{-5, 5}, {15, 5}}, QRectF(0, 0, 10, 10));
        QCOMPARE(pieces, (std::vector<QPolygonF>{{{0, 5}, {10, 5}}}));
        QVERIFY(charts::clipPolyline({{-5, -5}, {15, -5}}, QRectF(0, 0, 10, 10)).empty());
        QVERIFY(charts::clipPolyline({{5, 5}}, QRectF(0, 0, 10, 10)).empty());
    }

    void markersDifferInShape() {
        std::set<QByteArray> shapes;
        const ChartTheme theme = ChartTheme::paper();
        for (const Marker marker : {Marker::circle, Marker::square, Marker::triangle, Marker::diamond}) {
            QImage image(32, 32, QImage::Format_Grayscale8);
            image.fill(Qt::white);
            QPainter painter(&image);
            painter.scale(3, 3);
            charts::paintMarker(painter, {5.3, 5.3}, {SeriesColour::neutral, Qt::SolidLine, marker}, theme);
            painter.end();
            shapes.insert(QByteArray(reinterpret_cast<const char*>(image.constBits()), image.sizeInBytes()));
        }
        QCOMPARE(shapes.size(), std::size_t{4});
    }
};

QTEST_GUILESS_MAIN(CurveStyleTest)
#include "curve_style_test.moc"
