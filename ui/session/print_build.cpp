#include "ui/session/print_build.h"

#include "core/study/track_design.h"

namespace trapwright::session {

PrintBuild::PrintBuild(QObject* parent) : QObject(parent) {}

void PrintBuild::build(const PrintRequest& request) {
    build_.start([this, request]() -> NewestTask::Deliver {
        const auto fail = [this](const std::string& option, const std::string& message) {
            return [this, option, message] {
                emit failed(QString::fromStdString(option), QString::fromStdString(message));
            };
        };
        auto track = study::decodeTrack(request.settings, request.chromosome);
        if (!track) return fail({}, track.error().message);
        auto solid = track::buildPrintSolid(*track, request.options);
        if (!solid) return fail(solid.error().option, solid.error().message);
        const auto printed = std::make_shared<PrintedTrack>();
        printed->report = geometry::checkForPrinting(*solid, request.limits);
        printed->design = {request.about, std::move(*track), std::nullopt};
        printed->solid = std::make_shared<const geometry::TriangleMesh>(std::move(*solid));
        return [this, printed] { emit built(printed); };
    });
}

void PrintBuild::cancel() {
    build_.cancel();
}

void PrintBuild::write(const std::shared_ptr<const PrintedTrack>& track, const std::filesystem::path& path) {
    write_.start([this, track, path]() -> NewestTask::Deliver {
        const auto file = work::exportTrack(track->design, *track->solid, path);
        if (!file)
            return
                [this, message = file.error().message] { emit notWritten(QString::fromStdString(message)); };
        return [this, file = *file] { emit written(file); };
    });
}

bool PrintBuild::writing() const {
    return write_.busy();
}

}  // namespace trapwright::session
