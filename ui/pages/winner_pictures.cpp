#include "ui/pages/winner_pictures.h"

#include <QPixmap>
#include <utility>

#include "ui/models/winner_model.h"
#include "ui/scene/picture_maker.h"
#include "ui/scene/when_ready.h"

namespace trapwright::pages {

WinnerPictures::WinnerPictures(models::WinnerModel& model, QSize size, QObject* parent)
    : QObject(parent), model_(model), size_(size) {
    connect(&build_, &session::TrackBuild::built, this, &WinnerPictures::draw);
    connect(&build_, &session::TrackBuild::failed, this, [this] {
        generation_ = -1;
        next();
    });
}

WinnerPictures::~WinnerPictures() = default;

void WinnerPictures::setTracks(const study::TrackSettings& settings) {
    settings_ = settings;
    wanted_.clear();
    build_.cancel();
    ++order_;
    generation_ = -1;
}

void WinnerPictures::setLook(bool dark, double pixelRatio) {
    dark_ = dark;
    pixelRatio_ = pixelRatio;
}

void WinnerPictures::want(std::deque<int> generations) {
    wanted_ = std::move(generations);
    next();
}

void WinnerPictures::next() {
    while (generation_ < 0 && !wanted_.empty()) {
        const int generation = wanted_.front();
        wanted_.pop_front();
        const study::Individual* winner = model_.winnerAt(model_.rowOf(generation));
        if (winner == nullptr || model_.hasPicture(generation)) continue;
        generation_ = generation;
        build_.buildIndividual(settings_, winner->record.design);
    }
}

void WinnerPictures::draw(const std::shared_ptr<const track::Track>& track) {
    if (!maker_) maker_ = std::make_unique<scene::PictureMaker>();
    maker_->setTheme(dark_ ? scene::SceneTheme::dark() : scene::SceneTheme::light());
    scene::whenReady(maker_->trackPicture(track, size_, pixelRatio_), this,
                     [this, order = order_](const QImage& drawn) {
                         if (order != order_) return;  // of a study that was left
                         model_.setPicture(std::exchange(generation_, -1), QPixmap::fromImage(drawn));
                         next();
                     });
}

}  // namespace trapwright::pages
