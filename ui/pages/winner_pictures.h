#pragma once

#include <QObject>
#include <QSize>
#include <deque>
#include <memory>

#include "core/study/settings.h"
#include "core/track/track.h"
#include "ui/session/track_build.h"

namespace trapwright::models {
class WinnerModel;
}
namespace trapwright::scene {
class PictureMaker;
}

namespace trapwright::pages {

/// Gives winners their small pictures, one after the other; tracks are built and pictures drawn in the
/// background.
class WinnerPictures : public QObject {
    Q_OBJECT
 public:
    /// `size` in logical pixels.
    WinnerPictures(models::WinnerModel& model, QSize size, QObject* parent);
    ~WinnerPictures() override;

    /// Forgets what is wanted. Call with the settings that the winners' genes belong to.
    void setTracks(const study::TrackSettings& settings);
    void setLook(bool dark, double pixelRatio);
    /// Those of these generations that have no picture yet, in this order, and no others.
    void want(std::deque<int> generations);

 private:
    void next();
    void draw(const std::shared_ptr<const track::Track>& track);

    models::WinnerModel& model_;
    QSize size_;
    study::TrackSettings settings_;
    bool dark_ = false;
    double pixelRatio_ = 1.0;
    std::deque<int> wanted_;
    int generation_ = -1;  // that is being made; -1: none
    int order_ = 0;        // counts the settings of tracks
    session::TrackBuild build_;
    std::unique_ptr<scene::PictureMaker> maker_;  // made for the first picture
};

}  // namespace trapwright::pages
