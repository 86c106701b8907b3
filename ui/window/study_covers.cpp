#include "ui/window/study_covers.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>
#include <QStandardPaths>
#include <algorithm>
#include <utility>

#include "core/study/pose_weights.h"
#include "core/study/selection.h"
#include "core/workflow/study_design.h"
#include "ui/look/text.h"
#include "ui/scene/picture_maker.h"
#include "ui/scene/when_ready.h"

namespace trapwright::window {

/// What is read of a study's file.
struct StudyCovers::Contents {
    StudyCover cover;
    study::TrackSettings track;
    std::optional<search::Design> design;  // of the best track; none: nothing is learned
};

namespace {

constexpr int kVersion = 3;  // of the cache's files

QString cacheFolder() {
    return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + "/covers";
}

/// The final track: chosen, else the best of the last comparison, else the best winner.
std::optional<study::Individual> findTrack(const store::StudyFile& file,
                                           const std::vector<study::SelectionRecord>& selections) {
    std::optional<study::IndividualId> place;
    if (!selections.empty() && !selections.back().entries.empty()) {
        const study::SelectionEntry& best = selections.back().entries.front();
        place = {best.generation, best.individual};
    }
    if (const auto chosen = file.loadChosenWinner(); chosen && *chosen) place = **chosen;
    if (place) {
        const auto record = file.loadIndividual(*place);
        if (record) return study::Individual{*place, *record};
    }
    const auto winners = file.loadWinners();
    if (!winners) return std::nullopt;
    const auto settings = file.loadSettings();
    if (!settings) return std::nullopt;
    const study::Individual* best =
        study::findBestWinner(*winners, study::forgivesFalls(settings->evolution));
    return best != nullptr ? std::optional(*best) : std::nullopt;
}

std::optional<StudyCover::Success> readSuccess(const store::StudyFile& file,
                                               std::span<const study::SelectionRecord> selections,
                                               std::span<const study::ValidationRecord> validations,
                                               const study::Individual& track, bool fallsAreForgiven) {
    std::vector<part::PoseGroup> groups;
    // The part is made anew for its poses, which only a validation needs.
    if (!validations.empty()) {
        if (const auto design = workflow::loadDesign(file))
            groups = study::weighPoseGroups(*design->part, design->settings);
    }
    const auto success = study::findSuccess(selections, validations, track, groups, fallsAreForgiven);
    if (!success) return std::nullopt;
    return StudyCover::Success{success->ofArriving, success->rate, success->calcInterval(), success->count,
                               success->finished};
}

}  // namespace

StudyCovers::StudyCovers(QSize size, QObject* parent) : QObject(parent), size_(size) {
    connect(&build_, &session::TrackBuild::built, this,
            [this](const std::shared_ptr<const track::Track>& track) {
                if (!maker_) maker_ = std::make_unique<scene::PictureMaker>();
                maker_->setTheme(dark_ ? scene::SceneTheme::dark() : scene::SceneTheme::light());
                scene::whenReady(maker_->trackPicture(track, size_, pixelRatio_), this,
                                 [this, order = order_](const QImage& picture) {
                                     if (order == order_) finish(picture);
                                 });
            });
    connect(&build_, &session::TrackBuild::failed, this, [this] { finish({}); });
}

StudyCovers::~StudyCovers() = default;

void StudyCovers::setLook(bool dark, double pixelRatio) {
    if (dark_ == dark && pixelRatio_ == pixelRatio) return;
    dark_ = dark;
    pixelRatio_ = pixelRatio;
    covers_.clear();
    waiting_.clear();
    reading_.cancel();
    build_.cancel();
    current_.clear();
    ++order_;
}

void StudyCovers::want(const QStringList& studies) {
    waiting_.clear();
    for (const QString& study : studies) {
        if (!QFile::exists(study) || study == current_) continue;
        if (!readCache(study)) waiting_ << study;
    }
    next();
}

std::optional<StudyCover> StudyCovers::find(const QString& study) const {
    const auto found = covers_.find(study);
    return found != covers_.end() ? std::optional(*found) : std::nullopt;
}

void StudyCovers::next() {
    if (!current_.isEmpty() || waiting_.isEmpty()) return;
    current_ = waiting_.takeFirst();
    currentState_ = stateOf(current_);
    const std::filesystem::path path = QFile::encodeName(current_).toStdString();
    reading_.start([this, path]() -> session::NewestTask::Deliver {
        const auto read = [&]() -> base::Result<Contents> {
            const auto file = store::StudyFile::openReadOnly(path);
            if (!file) return file.error();
            const auto settings = file->loadSettings();
            if (!settings) return settings.error();
            const auto generations = file->generationCount();
            const auto selections = file->loadSelections();
            const auto validations = file->loadValidations();
            if (!generations) return generations.error();
            if (!selections) return selections.error();
            if (!validations) return validations.error();
            Contents contents;
            contents.cover.part = look::toText(std::filesystem::path(settings->part.file).stem());
            contents.cover.generations = *generations;
            contents.cover.wanted = settings->evolution.generations;
            contents.track = settings->track;
            if (const auto track = findTrack(*file, *selections)) {
                contents.cover.success = readSuccess(*file, *selections, *validations, *track,
                                                     study::forgivesFalls(settings->evolution));
                contents.design = track->record.design;
            }
            return contents;
        };
        auto contents = read();
        return [this, contents = std::move(contents)] {
            if (contents) {
                draw(*contents);
            } else {
                // A file that cannot be read has no cover; opening it tells why.
                current_.clear();
                next();
            }
        };
    });
}

void StudyCovers::draw(const Contents& contents) {
    covers_[current_] = contents.cover;
    if (contents.design) {
        build_.buildIndividual(contents.track, *contents.design);
    } else {
        build_.buildLayout(contents.track);
    }
}

void StudyCovers::finish(const QImage& picture) {
    const QString study = std::exchange(current_, {});
    if (study.isEmpty()) return;
    covers_[study].picture = picture;
    writeCache(study, currentState_);
    emit ready(study);
    next();
}

QString StudyCovers::cacheName(const QString& study) const {
    const QByteArray key = QCryptographicHash::hash(study.toUtf8(), QCryptographicHash::Sha1).toHex();
    return QString("%1/%2-%3-%4")
        .arg(cacheFolder(), QString::fromLatin1(key), dark_ ? "dark" : "light")
        .arg(pixelRatio_);
}

/// Differs once the file, or SQLite's log beside it, was written.
QString StudyCovers::stateOf(const QString& study) {
    QStringList state;
    for (const char* suffix : {"", "-wal"}) {
        const QFileInfo file(study + suffix);
        if (file.exists() && file.size() > 0)
            state << QString("%1 %2").arg(file.size()).arg(file.lastModified().toMSecsSinceEpoch());
    }
    return state.join(' ');
}

/// Whether what is kept is of the file as it is.
bool StudyCovers::readCache(const QString& study) {
    QFile file(cacheName(study) + ".json");
    if (!file.open(QIODevice::ReadOnly)) return false;
    const QJsonObject kept = QJsonDocument::fromJson(file.readAll()).object();
    if (kept["version"].toInt() != kVersion || kept["study"].toString() != study) return false;
    StudyCover cover;
    cover.part = kept["part"].toString();
    cover.generations = kept["generations"].toInt();
    cover.wanted = kept["wanted"].toInt();
    if (kept.contains("trials"))
        cover.success = {kept["of_arriving"].toBool(),
                         kept["rate"].toDouble(),
                         {kept["low"].toDouble(), kept["high"].toDouble()},
                         {kept["successes"].toInt(), kept["trials"].toInt()},
                         kept["finished"].toInt()};
    cover.picture.load(cacheName(study) + ".png");
    cover.picture.setDevicePixelRatio(pixelRatio_);
    covers_[study] = cover;
    return kept["state"].toString() == stateOf(study);
}

void StudyCovers::writeCache(const QString& study, const QString& state) const {
    const StudyCover cover = covers_.value(study);
    QJsonObject kept{{"version", kVersion},
                     {"study", study},
                     {"state", state},
                     {"part", cover.part},
                     {"generations", cover.generations},
                     {"wanted", cover.wanted}};
    if (cover.success) {
        kept["of_arriving"] = cover.success->ofArriving;
        kept["rate"] = cover.success->rate;
        kept["low"] = cover.success->interval.low;
        kept["high"] = cover.success->interval.high;
        kept["successes"] = cover.success->count.successes;
        kept["trials"] = cover.success->count.trials;
        kept["finished"] = cover.success->finished;
    }
    // A cache that cannot be written costs time and nothing else.
    if (!QDir().mkpath(cacheFolder())) return;
    cover.picture.save(cacheName(study) + ".png");
    QSaveFile file(cacheName(study) + ".json");
    if (file.open(QIODevice::WriteOnly)) {
        file.write(QJsonDocument(kept).toJson());
        file.commit();
    }
}

}  // namespace trapwright::window
