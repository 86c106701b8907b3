#include "ui/scene/picture_maker.h"

#include "ui/scene/offscreen.h"
#include "ui/scene/subject.h"

namespace trapwright::scene {

namespace {

constexpr double kMargin = 0.06;  // a share of the picture on every side

}  // namespace

struct PictureMaker::State {
    SceneContents contents;
    Offscreen offscreen;

    QImage draw(QSize pixels) {
        const Camera camera = fitted(homeCamera(contents), boxOf(contents), pixels, kMargin);
        return offscreen.draw(contents, camera, pixels, 1.0);
    }
};

PictureMaker::PictureMaker() : state_(std::make_unique<State>()) {
    state_->contents.marks = TrackMarks::none();
}

PictureMaker::~PictureMaker() = default;

void PictureMaker::setTheme(const SceneTheme& theme) {
    state_->contents.theme = theme;
}

QImage PictureMaker::trackPicture(std::shared_ptr<const track::Track> track, QSize pixels) {
    state_->contents.track = std::move(track);
    state_->contents.part = nullptr;
    return state_->draw(pixels);
}

QImage PictureMaker::partPicture(std::shared_ptr<const part::Part> part, const base::Quaternion& rotation,
                                 QSize pixels) {
    state_->contents.track = nullptr;
    state_->contents.part = std::move(part);
    state_->contents.partPoses = {{rotation, base::Vec3::Zero()}};
    return state_->draw(pixels);
}

}  // namespace trapwright::scene
