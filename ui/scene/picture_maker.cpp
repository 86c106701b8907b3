#include "ui/scene/picture_maker.h"

#include "ui/scene/exit_view.h"
#include "ui/scene/subject.h"

namespace trapwright::scene {

namespace {

constexpr double kMargin = 0.06;  // a share of the picture on every side

}  // namespace

QFuture<QImage> PictureMaker::trackPicture(std::shared_ptr<const track::Track> track, QSize size,
                                           double pixelRatio) {
    auto contents = std::make_shared<SceneContents>();
    contents->track = std::move(track);
    return draw(std::move(contents), size, pixelRatio);
}

QFuture<QImage> PictureMaker::partPicture(std::shared_ptr<const part::Part> part,
                                          const base::Quaternion& rotation, QSize size, double pixelRatio) {
    auto contents = std::make_shared<SceneContents>();
    contents->parts = {{std::move(part), {rotation, base::Vec3::Zero()}}};
    return draw(std::move(contents), size, pixelRatio);
}

QFuture<QImage> PictureMaker::exitPicture(std::shared_ptr<const track::Track> track,
                                          std::shared_ptr<const part::Part> part, const base::Pose& pose,
                                          QSize size, double pixelRatio) {
    const ExitView view = makeExitView(*track, *part, pose, size);
    auto contents = std::make_shared<SceneContents>();
    contents->theme = theme_;
    contents->marks = TrackMarks::none();
    contents->marks.finishLine = true;
    contents->track = std::move(track);
    contents->parts = {{std::move(part), pose}};
    return renderer_.render({std::move(contents), view.camera, size * pixelRatio, pixelRatio})
        .then([view, theme = theme_](const Rendering& made) {
            QImage image = made.image;
            if (!image.isNull()) paintArrow(image, view, theme);
            return image;
        });
}

QFuture<QImage> PictureMaker::draw(std::shared_ptr<SceneContents> contents, QSize size, double pixelRatio) {
    contents->theme = theme_;
    contents->marks = TrackMarks::none();
    const Camera camera = fitted(homeCamera(*contents), boxOf(*contents), size, kMargin);
    return renderer_.render({std::move(contents), camera, size * pixelRatio, pixelRatio})
        .then([](const Rendering& made) { return made.image; });
}

}  // namespace trapwright::scene
