#pragma once

#include <QDateTime>
#include <QHash>
#include <QImage>
#include <QObject>
#include <QSize>
#include <QStringList>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/stats/binomial.h"
#include "core/store/study_file.h"
#include "ui/session/track_build.h"
#include "ui/session/work_thread.h"

namespace trapwright::scene {
class PictureMaker;
}

namespace trapwright::window {

/// What a card tells of a study that is not open.
struct StudyCover {
    QString part;
    int generations = 0;  // learned
    int wanted = 0;
    struct Success {
        bool ofArriving = false;
        double rate = 0.0;
        stats::Interval interval;
        stats::Count count;
        int finished = 0;
    };
    std::optional<Success> success;  // as study::TrackSuccess has it
    QImage picture;                  // of its best track, or of the empty layout; null: could not be drawn
};

/// Covers of studies, read from their files and drawn in the background, one after the other, and kept in the
/// user's cache until the file changes. No study is opened for it.
class StudyCovers : public QObject {
    Q_OBJECT
 public:
    /// `size` of pictures in logical pixels.
    StudyCovers(QSize size, QObject* parent);
    ~StudyCovers() override;

    /// Pictures in these colours from now on.
    void setLook(bool dark, double pixelRatio);
    /// Has these covers made or read; others that are not begun are dropped.
    void want(const QStringList& studies);
    /// What is known now, perhaps of an earlier state of the file.
    [[nodiscard]] std::optional<StudyCover> find(const QString& study) const;

 signals:
    void ready(const QString& study);

 private:
    struct Contents;

    void next();
    void draw(const Contents& contents);
    void finish(const QImage& picture);
    [[nodiscard]] QString cacheName(const QString& study) const;
    [[nodiscard]] static QString stateOf(const QString& study);
    [[nodiscard]] bool readCache(const QString& study);
    void writeCache(const QString& study, const QString& state) const;

    QSize size_;
    bool dark_ = false;
    double pixelRatio_ = 1.0;
    QHash<QString, StudyCover> covers_;
    QStringList waiting_;
    QString current_;       // that is being made; empty: none
    QString currentState_;  // of its file when it was begun
    int order_ = 0;         // counts the looks
    session::NewestTask reading_;
    session::TrackBuild build_;
    std::unique_ptr<scene::PictureMaker> maker_;  // made for the first picture
};

}  // namespace trapwright::window
