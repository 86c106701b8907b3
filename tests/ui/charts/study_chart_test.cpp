#include "ui/charts/study_chart.h"

#include <QAbstractButton>
#include <QLabel>
#include <QSignalSpy>
#include <QSvgRenderer>
#include <QtTest>
#include <ctime>

#include "tests/ui/sample_records.h"
#include "ui/charts/plot.h"

using namespace trapwright;
using charts::FitnessChart;
using charts::Plot;
using charts::Range;
using charts::StudyCurves;

namespace {

StudyCurves someStudy(int generations) {
    StudyCurves curves;
    curves.name = "one";
    for (int g = 0; g < generations; ++g) {
        study::GenerationSummary summary = sample::summary(g, 0.01 * g);
        summary.statistics.best.scores[0].value = summary.statistics.topMean.scores[0].value = 0.0;
        curves.summaries.push_back(summary);
        curves.trialsPerSecond.push_back(100.0);
    }
    curves.attainable = {{"F_O", 1.25}};
    return curves;
}

void goOn(charts::StudyChart& chart, const study::GenerationSummary& summary, double rate) {
    std::vector<StudyCurves> studies = chart.studies();
    studies.front().append(summary, rate);
    chart.setStudies(std::move(studies));
}

void showChart(QWidget& chart) {
    chart.resize(640, 300);
    chart.show();
    QVERIFY(QTest::qWaitForWindowExposed(&chart));
}

void wheel(Plot* plot, const QPointF& position, int notches) {
    QWheelEvent event(position, plot->viewport()->mapToGlobal(position), {}, {0, 120 * notches}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(plot->viewport(), &event);
}

void moveTo(Plot* plot, const QPoint& place, Qt::MouseButtons buttons = Qt::NoButton) {
    QMouseEvent event(QEvent::MouseMove, place, plot->viewport()->mapToGlobal(place), Qt::NoButton, buttons,
                      Qt::NoModifier);
    QApplication::sendEvent(plot->viewport(), &event);
}

void drag(Plot* plot, const QPoint& from, const QPoint& to) {
    QTest::mousePress(plot->viewport(), Qt::LeftButton, {}, from);
    moveTo(plot, (from + to) / 2, Qt::LeftButton);
    moveTo(plot, to, Qt::LeftButton);
    QTest::mouseRelease(plot->viewport(), Qt::LeftButton, {}, to);
}

QAbstractButton& legendItem(const QWidget& chart, const QString& key) {
    return *chart.findChild<QAbstractButton*>("legend." + key);
}

/// What is read where the curves will be.
QString shownText(const QWidget& chart) {
    QStringList texts;
    for (const QLabel* label : chart.findChildren<QLabel*>())
        if (label->isVisible() && label->wordWrap()) texts << label->text();
    return texts.join(' ');
}

bool isClose(double a, double b) {
    return std::abs(a - b) < 1e-6;
}

}  // namespace

class StudyChartTest : public QObject {
    Q_OBJECT

 private slots:
    void emptyChartSaysWhatToExpect() {
        FitnessChart chart;
        showChart(chart);
        QVERIFY(!chart.savePictureAction()->isEnabled());
        QCOMPARE(shownText(chart),
                 QString("The learning curves begin when the first generation is complete."));
        chart.setStudies({someStudy(1)});
        QCOMPARE(shownText(chart), QString());
        QVERIFY(chart.savePictureAction()->isEnabled());
        QCOMPARE(chart.shownPlots().size(), std::size_t{2});  // nothing ever overlapped
    }

    void withoutSuccessItSaysWhy() {
        charts::SuccessChart chart;
        showChart(chart);
        QVERIFY2(shownText(chart).contains("first generation"), qPrintable(shownText(chart)));
        StudyCurves curves = someStudy(2);
        for (study::GenerationSummary& summary : curves.summaries) {
            summary.statistics.success.reset();
            summary.statistics.topSuccess.reset();
        }
        chart.setStudies({curves});
        QVERIFY2(shownText(chart).contains("older Trapwright"), qPrintable(shownText(chart)));
    }

    void everythingIsInViewAndStaysSo() {
        FitnessChart chart;
        chart.setStudies({someStudy(20)});
        showChart(chart);
        const Plot* plot = chart.shownPlots().back();
        QVERIFY(plot->xRange().contains(0.0) && plot->xRange().contains(19.0));
        QVERIFY(plot->yRange().contains(0.0) && plot->yRange().contains(1.25));
        goOn(chart, sample::summary(20, 1.9), 90.0);
        QVERIFY(plot->xRange().contains(20.0));
        QVERIFY(plot->yRange().contains(1.9));
        QVERIFY(plot->isFitted());
    }

    void wheelZoomsAboutTheCursor() {
        FitnessChart chart;
        chart.setStudies({someStudy(101)});
        showChart(chart);
        Plot* plot = chart.shownPlots().front();
        const QPointF place = plot->toWidget({40.0, -0.25});
        const Range before = plot->xRange();
        wheel(plot, place, 3);
        QVERIFY(plot->xRange().size() < 0.6 * before.size());
        QVERIFY((plot->toWidget({40.0, -0.25}) - place).manhattanLength() < 1e-6);
        // All plots show the same generations.
        QVERIFY(isClose(chart.shownPlots().back()->xRange().low, plot->xRange().low));
        // Zoomed in, the view stays where it is when a generation comes.
        const Range zoomed = plot->xRange();
        goOn(chart, sample::summary(101), 90.0);
        QVERIFY(isClose(plot->xRange().low, zoomed.low) && isClose(plot->xRange().high, zoomed.high));
        wheel(plot, place, -30);
        QVERIFY(plot->isFitted());
    }

    void wheelOverAnAxisZoomsAlongIt() {
        FitnessChart chart;
        chart.setStudies({someStudy(101)});
        showChart(chart);
        Plot* plot = chart.shownPlots().front();
        const QRectF area = plot->plotArea();
        const Range x = plot->xRange();
        const Range y = plot->yRange();
        wheel(plot, {area.center().x(), area.bottom() + 15.0}, 2);
        QVERIFY(plot->xRange().size() < x.size());
        QCOMPARE(plot->yRange(), y);
        chart.fit();
        wheel(plot, {area.left() - 15.0, area.center().y()}, 2);
        QCOMPARE(plot->xRange(), x);
        QVERIFY(plot->yRange().size() < y.size());
    }

    void draggingPansAndDoubleClickShowsAll() {
        FitnessChart chart;
        chart.setStudies({someStudy(101)});
        showChart(chart);
        Plot* plot = chart.shownPlots().front();
        chart.zoom(0.2);
        const Range before = plot->xRange();
        const QPoint middle = plot->plotArea().center().toPoint();
        QSignalSpy picked(&chart, &FitnessChart::picked);
        drag(plot, middle, middle + QPoint(-50, 0));
        const double expected = 50.0 / plot->plotArea().width() * before.size();
        QVERIFY(std::abs(plot->xRange().low - before.low - expected) < 1e-3 * before.size());
        QCOMPARE(picked.count(), 0);
        QTest::mouseDClick(plot->viewport(), Qt::LeftButton, {}, middle);
        QVERIFY(plot->isFitted());
        QVERIFY(plot->xRange().contains(0.0) && plot->xRange().contains(100.0));
    }

    void cursorReadsValuesOff() {
        FitnessChart chart;
        chart.setStudies({someStudy(101)});
        showChart(chart);
        Plot* orientation = chart.shownPlots().back();
        const QPoint place = orientation->toWidget({40.0, 0.4}).toPoint();
        moveTo(orientation, place);
        QCOMPARE(*chart.cursor(), 40.0);
        const QStringList values = orientation->readOff();
        QCOMPARE(values, (QStringList{"Generation 40", "best: 0.400", "mean of top 30 %: 0.200",
                                      "best attainable: 1.250"}));
        QCOMPARE(orientation->accessibleDescription(), values.join('\n'));
        // The same generation in the other plot.
        QCOMPARE(chart.shownPlots().front()->readOff().front(), QString("Generation 40"));
        QSignalSpy picked(&chart, &FitnessChart::picked);
        QTest::mouseClick(orientation->viewport(), Qt::LeftButton, {}, place);
        QCOMPARE(picked.count(), 1);
        QCOMPARE(picked[0][0].toInt(), 40);
    }

    void keysDoWhatTheMouseDoes() {
        FitnessChart chart;
        chart.setStudies({someStudy(101)});
        showChart(chart);
        chart.activateWindow();
        Plot* plot = chart.shownPlots().front();
        plot->setFocus();
        QVERIFY(QTest::qWaitForWindowActive(&chart));
        QTest::keyClick(plot, Qt::Key_Left);
        QCOMPARE(*chart.cursor(), 100.0);  // begins with the newest
        QTest::keyClick(plot, Qt::Key_Left);
        QCOMPARE(*chart.cursor(), 99.0);
        QTest::keyClick(plot, Qt::Key_Right);
        QCOMPARE(*chart.cursor(), 100.0);
        QTest::keyClick(plot, Qt::Key_Plus);
        QVERIFY(!plot->isFitted());
        QTest::keyClick(plot, Qt::Key_Home);
        QVERIFY(plot->isFitted());
        QSignalSpy picked(&chart, &FitnessChart::picked);
        QTest::keyClick(plot, Qt::Key_Return);
        QCOMPARE(picked.count(), 1);
    }

    void legendSwitchesCurvesAndPlots() {
        FitnessChart chart;
        chart.setStudies({someStudy(20)});
        showChart(chart);
        QAbstractButton& distance = legendItem(chart, "F_D");
        QVERIFY(distance.isChecked());
        QVERIFY(!distance.accessibleName().isEmpty());
        distance.click();
        QCOMPARE(chart.shownPlots().size(), std::size_t{1});
        // What the user chose stays when data come, also the other way.
        goOn(chart, sample::summary(20), 90.0);
        QCOMPARE(chart.shownPlots().size(), std::size_t{2});  // now there are collisions
        legendItem(chart, "F_C").click();
        QCOMPARE(chart.shownPlots().size(), std::size_t{1});
        chart.setShown("mean", false);
        QCOMPARE(chart.shownPlots().front()->readOff().size(), 0);
        chart.setCursor(3.0);
        QCOMPARE(chart.shownPlots().front()->readOff().size(), 3);
        // Something remains.
        legendItem(chart, "F_O").click();
        QCOMPARE(chart.shownPlots().size(), std::size_t{1});
    }

    void logarithmicChartLeavesOutWhatItCannotShow() {
        StudyCurves study = someStudy(10);
        study.summaries[4].statistics.curves[2].value = 0.0;
        charts::SearchChart chart;
        chart.setStudies({study});
        showChart(chart);
        const Plot* plot = chart.shownPlots().front();
        QVERIFY(std::isfinite(plot->yRange().low) && std::isfinite(plot->yRange().high));
        QVERIFY(plot->yRange().low < -2.0 && plot->yRange().high > std::log10(0.8));
        chart.setCursor(4.0);
        QVERIFY(plot->readOff().last().endsWith("0.0000"));
    }

    void successIsReadOffWithItsBounds() {
        charts::SuccessChart chart;
        chart.setStudies({someStudy(20)});
        showChart(chart);
        Plot* plot = chart.shownPlots().front();
        chart.setCursor(3.0);
        QCOMPARE(plot->readOff(),
                 (QStringList{"Generation 3", "winner: 85.0 (62.1 … 96.8)", "mean of top 30 %: 50.0"}));
        // The area has its colour between the bounds, and none outside them.
        chart.setCursor(std::nullopt);
        const QImage picture = plot->grab().toImage();
        const double ratio = picture.devicePixelRatio();
        const auto colourAt = [&](double x, double y) {
            return picture.pixelColor((plot->toWidget({x, y}) * ratio).toPoint());
        };
        const QColor paper = colourAt(10.4, 15.0);
        QVERIFY(colourAt(10.4, 74.0) != paper);
        QCOMPARE(colourAt(10.4, 58.0), paper);
    }

    /// What is attainable is a line from edge to edge, however many generations there are.
    void levelsAreDrawn() {
        FitnessChart chart;
        chart.setStudies({someStudy(20)});
        showChart(chart);
        const auto plots = chart.shownPlots();
        const auto found = std::find_if(plots.begin(), plots.end(), [](const Plot* plot) {
            return plot->accessibleName().contains("F_O") || plot->accessibleName().contains("FO");
        });
        QVERIFY(found != plots.end());
        Plot* plot = *found;
        const QImage picture = plot->grab().toImage();
        const double ratio = picture.devicePixelRatio();
        const auto colourAt = [&](double x, double y) {
            return picture.pixelColor((plot->toWidget({x, y}) * ratio).toPoint());
        };
        int inked = 0;  // where the picture below it, between the grid's lines, is not
        for (int i = 0; i < 200; ++i) {
            const double x = 1.0 + 0.08 * i;
            inked += colourAt(x, 1.25) != colourAt(x, 1.15) ? 1 : 0;
        }
        QVERIFY2(inked > 60, qPrintable(QString::number(inked)));  // dots
    }

    /// Of a study that has no success there is nothing to draw, and no line at 0.
    void unknownSuccessIsNotDrawn() {
        StudyCurves study = someStudy(20);
        for (study::GenerationSummary& summary : study.summaries) {
            summary.statistics.success.reset();
            summary.statistics.topSuccess.reset();
        }
        charts::SuccessChart chart;
        chart.setStudies({study});
        showChart(chart);
        QVERIFY(!chart.savePictureAction()->isEnabled());
    }

    /// Every generation has a marker or none has, whatever the zoom; data that are missing leave a gap.
    void markersAreOnAllPointsOrNone_data() {
        QTest::addColumn<int>("generations");
        QTest::addColumn<bool>("marked");
        QTest::newRow("few") << 12 << true;
        QTest::newRow("many") << 300 << false;
    }
    void markersAreOnAllPointsOrNone() {
        QFETCH(int, generations);
        QFETCH(bool, marked);
        StudyCurves study = someStudy(generations);
        study.summaries.erase(study.summaries.begin() + 6, study.summaries.begin() + 8);  // 6 and 7
        charts::SpeedChart chart;
        study.trialsPerSecond.assign(study.summaries.size(), 100.0);
        chart.setStudies({study});
        showChart(chart);
        Plot* plot = chart.shownPlots().front();
        const QImage picture = plot->grab().toImage();
        const double ratio = picture.devicePixelRatio();
        const auto colourAt = [&](double x, double offset) {
            const QPointF place = plot->toWidget({x, 100.0}) + QPointF(0.0, offset);
            return picture.pixelColor((place * ratio).toPoint());
        };
        const QColor ink = colourAt(2.5, 0.0);
        const QColor paper = colourAt(2.5, -8.0);
        // A marker reaches 3 pixels above the line, which is 1.8 thick.
        const auto isMarked = [&](int generation) {
            const int grey = qGray(colourAt(generation, -2.0).rgb());
            return std::abs(grey - qGray(ink.rgb())) < std::abs(grey - qGray(paper.rgb()));
        };
        for (int g = 0; g < generations; ++g) {
            if (g == 6 || g == 7) continue;
            QVERIFY2(isMarked(g) == marked, QByteArray::number(g));
        }
        if (!marked) return;  // too narrow to look at
        QCOMPARE(colourAt(4.5, 0.0), ink);
        QVERIFY(colourAt(6.5, 0.0) != ink);
        QCOMPARE(colourAt(8.5, 0.0), ink);
    }

    void speedOfReopenedStudyBeginsWhereItGoesOn() {
        StudyCurves study = someStudy(5);
        study.trialsPerSecond.clear();
        charts::SpeedChart chart;
        chart.setStudies({study});
        QVERIFY(!chart.saveCsvAction()->isEnabled());
        goOn(chart, sample::summary(5), 120.0);
        QVERIFY(chart.saveCsvAction()->isEnabled());
        QCOMPARE(chart.csv(), QString("Generation,Trials per second\n5,120\n"));
    }

    void appendingIsCheap() {
        FitnessChart chart;
        const auto studies = std::make_shared<std::vector<StudyCurves>>(1, someStudy(1));
        chart.shareStudies(studies);
        showChart(chart);
        // The processor's time: how busy the machine is does not matter.
        std::clock_t worst = 0;
        for (int g = 1; g < 500; ++g) {
            const std::clock_t begin = std::clock();
            studies->front().append(sample::summary(g, 0.002 * g), 100.0);
            chart.studiesChanged();
            QApplication::processEvents();
            worst = std::max(worst, std::clock() - begin);
        }
        qInfo("500 generations: the slowest update took %.1f ms",
              1e3 * static_cast<double>(worst) / CLOCKS_PER_SEC);
        QCOMPARE(chart.studies().front().summaries.size(), std::size_t{500});
        QCOMPARE(chart.shownPlots().front()->sheet().curves.front().points.size(), std::size_t{500});
    }

    void pictureIsBlackOnWhiteWhateverTheTheme() {
        FitnessChart chart;
        QPalette dark;
        dark.setColor(QPalette::Base, Qt::black);
        dark.setColor(QPalette::Text, Qt::white);
        chart.setPalette(dark);
        chart.setStudies({someStudy(20)});
        showChart(chart);
        const QImage picture = chart.picture({400, 200}, 2.0);
        QCOMPARE(picture.size(), QSize(800, 400));
        QCOMPARE(picture.pixelColor(picture.rect().bottomRight()), QColor(Qt::white));
        int ink = 0;
        for (int x = 0; x < picture.width(); ++x)
            for (int y = 0; y < picture.height(); ++y)
                if (qGray(picture.pixel(x, y)) < 60) ++ink;
        QVERIFY(ink > 200);             // text
        QVERIFY(ink < 800 * 400 / 20);  // on white
        // The chart on the screen is dark again.
        QVERIFY(qGray(chart.grab().toImage().pixel(5, 290)) < 60);
    }

    void filesAreWrittenAndErrorsTold() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        FitnessChart chart;
        chart.setStudies({someStudy(20)});
        showChart(chart);
        QVERIFY(chart.savePicture(path / "a.png").ok());
        QCOMPARE(QImage(folder.filePath("a.png")).size(), chart.size() * 2);
        QVERIFY(chart.savePicture(path / "a.svg").ok());
        QSvgRenderer svg(folder.filePath("a.svg"));
        QVERIFY(svg.isValid());
        QCOMPARE(svg.viewBox(), QRect(QPoint(0, 0), chart.size()));
        QVERIFY(chart.saveCsv(path / "a.csv").ok());
        QFile csv(folder.filePath("a.csv"));
        QVERIFY(csv.open(QIODevice::ReadOnly));
        QCOMPARE(QString::fromUtf8(csv.readAll()), chart.csv());

        const auto wrong = chart.savePicture(path / "a.gif");
        QVERIFY(!wrong.ok());
        QVERIFY(QString::fromStdString(wrong.error().message).contains(".png or .svg"));
        const auto nowhere = chart.savePicture(path / "none" / "a.png");
        QVERIFY(!nowhere.ok());
        QVERIFY(QString::fromStdString(nowhere.error().message).contains("none"));
    }

    void zoomedSvgDrawsNothingOutsideItsPlot() {
        const QTemporaryDir folder;
        FitnessChart chart;
        chart.setStudies({someStudy(101)});
        showChart(chart);
        chart.setShown("F_D", false);
        chart.zoom(0.1);
        QVERIFY(chart.savePicture(std::filesystem::path(folder.path().toStdString()) / "z.svg").ok());
        QSvgRenderer svg(folder.filePath("z.svg"));
        QImage image(chart.size(), QImage::Format_RGB32);
        image.fill(Qt::white);
        QPainter painter(&image);
        svg.render(&painter);
        painter.end();
        // Left of the axis's title and right of the plot there is only paper.
        for (int y = 60; y < image.height(); ++y) {
            QCOMPARE(image.pixelColor(1, y), QColor(Qt::white));
            QCOMPARE(image.pixelColor(image.width() - 2, y), QColor(Qt::white));
        }
    }
};

QTEST_MAIN(StudyChartTest)
#include "study_chart_test.moc"
