#include "ui/session/track_build.h"

#include "core/study/track_design.h"

namespace trapwright::session {

TrackBuild::TrackBuild(QObject* parent) : QObject(parent) {}

void TrackBuild::buildLayout(const study::TrackSettings& settings) {
    start([settings] { return study::buildLayout(settings); });
}

void TrackBuild::buildIndividual(const study::TrackSettings& settings, const search::Design& design) {
    start([settings, design] { return study::decodeTrack(settings, design); });
}

void TrackBuild::start(std::function<base::Result<track::Track>()> build) {
    task_.start([this, build = std::move(build)]() -> NewestTask::Deliver {
        auto track = build();
        if (!track)
            return [this, message = track.error().message] { emit failed(QString::fromStdString(message)); };
        return
            [this, shared = std::make_shared<const track::Track>(std::move(*track))] { emit built(shared); };
    });
}

void TrackBuild::cancel() {
    task_.cancel();
}

}  // namespace trapwright::session
