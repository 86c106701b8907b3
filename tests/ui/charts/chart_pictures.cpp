/// Pictures of all charts of one study, or of two compared, to be looked at:
/// chart_pictures FOLDER STUDY [STUDY]
#include <QApplication>
#include <QDir>
#include <QPainter>
#include <QSvgRenderer>
#include <cstdio>

#include "core/part/part_builder.h"
#include "core/store/study_file.h"
#include "core/study/selection.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "sim/native/native_engine.h"
#include "ui/charts/orientation_chart.h"
#include "ui/charts/study_chart.h"
#include "ui/look/theme.h"

using namespace trapwright;

namespace {

constexpr int kTrials = 400;  // of the orientation chart

struct Study {
    charts::StudyCurves curves;
    study::OrientationShares shares;
    double tolerance = 0.0;
};

double trialsPerSecond(const study::GenerationRecord& record) {
    int trials = 0;
    for (const study::IndividualRecord& individual : record.individuals)
        trials += individual.trials;
    return trials / record.seconds;
}

/// Exits with the message if something cannot be read: this program is run by hand.
template <class T>
T take(base::Result<T> result) {
    if (result) return std::move(result).value();
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(1);
}

Study load(const char* path) {
    const store::StudyFile file = take(store::StudyFile::openReadOnly(path));
    const study::Settings settings = take(file.loadSettings());
    const store::StoredPart stored = take(file.loadPart());
    const auto part =
        std::make_shared<const part::Part>(take(part::buildPart(stored.mesh, stored.options)).part);
    Study loaded;
    loaded.tolerance = settings.validation.tolerance;
    loaded.curves.name = QString::fromStdString(std::filesystem::path(path).filename().string());
    loaded.curves.summaries = take(file.loadSummaries());
    loaded.curves.checks = take(file.loadChecks());
    loaded.curves.attainable = objectives::listAttainable(study::makeTask(settings, *part));
    for (const study::GenerationSummary& summary : loaded.curves.summaries)
        loaded.curves.trialsPerSecond.push_back(trialsPerSecond(take(file.loadGeneration(summary.index))));

    const std::vector<study::Individual> best = study::rankWinners(take(file.loadWinners()), 1);
    const study::TrialScene scene =
        study::makeScene(settings, part,
                         std::make_shared<const track::Track>(
                             take(study::decodeTrack(settings.track, best.front().record.design))));
    const trial::TrialBatch batch = study::makeSelectionBatch(scene, best.front(), kTrials);
    const auto outcomes = take(native::NativeEngine({0, 0.0}).run(std::span(&batch, 1), {})).front();
    const base::Quaternion expected =
        trial::findModalOrientation(trial::finalOrientations(outcomes), part->symmetry, loaded.tolerance);
    loaded.shares = study::calcOrientationShares(*part, outcomes, trial::makeGoal(expected));
    return loaded;
}

class Photographer {
 public:
    Photographer(QString folder, std::vector<Study> studies)
        : folder_(std::move(folder)), studies_(std::move(studies)) {}

    void takeAll(const QString& suffix, QSize size) {
        charts::FitnessChart fitness;
        charts::SearchChart search;
        charts::SpeedChart speed;
        charts::EngineChart engines;
        std::vector<charts::StudyCurves> curves;
        for (const Study& study : studies_)
            curves.push_back(study.curves);
        for (charts::StudyChart* chart :
             std::initializer_list<charts::StudyChart*>{&fitness, &search, &speed, &engines}) {
            chart->setStudies(curves);
            take(*chart, suffix, size);
        }
        charts::OrientationChart orientation;
        orientation.setShares(studies_.front().shares, studies_.front().tolerance);
        take(orientation, suffix, size);

        fitness.setCursor(12.0);
        take(fitness, suffix + "-cursor", size);
        fitness.setShown("F_D", false);
        fitness.zoom(0.3);
        search.zoom(0.3);
        take(fitness, suffix + "-zoomed", size);
        take(search, suffix + "-zoomed", size);
        saveAll(fitness, suffix);
        saveAll(search, suffix);
        saveAll(orientation, suffix);
    }

 private:
    /// As its user saves it, and the SVG as a viewer draws it.
    void saveAll(charts::ChartPanel& chart, const QString& suffix) {
        const QString name = folder_ + "/" + chart.objectName() + "-" + suffix + "-saved";
        for (const char* ending : {".png", ".svg"})
            ::take(chart.savePicture((name + ending).toStdString()));
        QSvgRenderer svg(name + ".svg");
        QImage image(chart.size() * 2, QImage::Format_RGB32);
        QPainter painter(&image);
        svg.render(&painter);
        painter.end();
        image.save(name + "-svg.png");
    }

    void take(QWidget& chart, const QString& suffix, QSize size) {
        chart.resize(size);
        chart.show();
        QApplication::processEvents();
        chart.grab().save(folder_ + "/" + chart.objectName() + "-" + suffix + ".png");
    }

    QString folder_;
    std::vector<Study> studies_;
};

}  // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    Q_INIT_RESOURCE(icons);
    if (argc < 3) {
        std::fprintf(stderr, "chart_pictures FOLDER STUDY [STUDY]\n");
        return 2;
    }
    const QString folder = argv[1];
    QDir().mkpath(folder);
    std::vector<Study> studies;
    for (int i = 2; i < argc; ++i)
        studies.push_back(load(argv[i]));
    Photographer photographer(folder, std::move(studies));
    QApplication::setStyle("Fusion");
    for (const auto& [scheme, name] :
         {std::pair{look::Scheme::light, QString("light")}, std::pair{look::Scheme::dark, QString("dark")}}) {
        QApplication::setPalette(look::makePalette(scheme));
        photographer.takeAll(name, {640, 300});
        photographer.takeAll(name + "-large", {1280, 600});
    }
    return 0;
}
