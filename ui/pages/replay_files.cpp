#include "ui/pages/replay_files.h"

#include <QBuffer>
#include <QComboBox>
#include <QFile>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <array>
#include <cmath>

#include "core/base/file.h"
#include "ui/look/file_dialog.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/pages/replay_player.h"
#include "ui/scene/scene_view.h"
#include "ui/scene/when_ready.h"

namespace trapwright::pages {

namespace {

constexpr std::array kRates{25, 30, 50, 60};
constexpr std::array kSizes{QSize(1280, 720), QSize(1920, 1080), QSize(2560, 1440), QSize(3840, 2160)};
constexpr QSize kUsualSize(1920, 1080);
constexpr int kUsualRate = 30;
constexpr double kUsualHeight = 720.0;  // at which labels are as large as on a screen

/// Empty if there is no image.
QByteArray encodePng(const QImage& image) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (image.isNull() || !image.save(&buffer, "PNG")) return {};
    return bytes;
}

double ratioOf(QSize size) {
    return size.height() / kUsualHeight;
}

}  // namespace

ReplayFiles::ReplayFiles(ReplayPlayer& player, QWidget* parent)
    : QWidget(parent),
      player_(player),
      export_(this),
      size_(new QComboBox(this)),
      rate_(new QComboBox(this)),
      length_(new QLabel(this)),
      savePicture_(new QPushButton(look::icon("picture"), tr("Save picture..."), this)),
      saveMovie_(new QPushButton(look::icon("film"), tr("Save film..."), this)),
      busy_(makeProgress()) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(makeChoices());
    column->addWidget(length_);
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(savePicture_);
    buttons->addWidget(saveMovie_);
    column->addLayout(buttons);
    column->addWidget(busy_);
    addButtons();
    length_->setObjectName("review.filmLength");
    length_->setForegroundRole(QPalette::PlaceholderText);
    length_->setWordWrap(true);

    connect(&player_, &ReplayPlayer::durationChanged, this, &ReplayFiles::showLength);
    connect(&player_, &ReplayPlayer::speedChanged, this, &ReplayFiles::showLength);
    connect(rate_, &QComboBox::currentIndexChanged, this, &ReplayFiles::showLength);
    connect(&export_, &MovieExport::progressed, this, [this](int frame, int frames) {
        const double left = 1e-3 * static_cast<double>(clock_.elapsed()) / frame * (frames - frame);
        busyText_->setText(frame < frames
                               ? tr("Picture %1 of %2, %3 left")
                                     .arg(frame)
                                     .arg(frames)
                                     .arg(look::durationText(std::ceil(left)))
                               : tr("All %1 pictures are drawn; the film is being closed").arg(frames));
        bar_->setRange(0, frames);
        bar_->setValue(frame);
    });
    connect(&export_, &MovieExport::finished, this,
            [this](const QString& file) { showEnd(tr("Saved: %1").arg(file)); });
    connect(&export_, &MovieExport::cancelled, this, [this] { showEnd(tr("The film was not saved.")); });
    connect(&export_, &MovieExport::failed, this, [this](const QString& message) {
        showEnd({});
        showLength();
        emit failed(tr("The film cannot be saved"), message);
    });
    showLength();
}

QWidget* ReplayFiles::makeChoices() {
    auto* choices = new QWidget(this);
    size_->setObjectName("review.pictureSize");
    for (const QSize& size : kSizes)
        size_->addItem(tr("%1 × %2").arg(size.width()).arg(size.height()), size);
    setPictureSize(kUsualSize);
    rate_->setObjectName("review.frameRate");
    for (const int rate : kRates)
        rate_->addItem(tr("%1 per second").arg(rate), rate);
    setFramesPerSecond(kUsualRate);
    auto* form = new QFormLayout(choices);
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(tr("Size"), size_);
    form->addRow(tr("Film"), rate_);
    size_->setAccessibleName(tr("Size of pictures and films"));
    rate_->setAccessibleName(tr("Pictures per second of a film"));
    return choices;
}

QWidget* ReplayFiles::makeProgress() {
    auto* busy = new QWidget(this);
    busyText_ = new QLabel(busy);
    bar_ = new QProgressBar(busy);
    bar_->setTextVisible(false);
    bar_->setFixedHeight(6);
    auto* cancel = new QPushButton(tr("Cancel"), busy);
    cancel->setObjectName("review.cancelMovie");
    connect(cancel, &QPushButton::clicked, &export_, &MovieExport::cancel);
    auto* row = new QHBoxLayout;
    row->addWidget(busyText_, 1);
    row->addWidget(cancel);
    auto* column = new QVBoxLayout(busy);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addLayout(row);
    column->addWidget(bar_);
    busy->hide();
    return busy;
}

void ReplayFiles::addButtons() {
    savePicture_->setObjectName("review.savePicture");
    savePicture_->setToolTip(tr("Save what the scene shows as a picture"));
    connect(savePicture_, &QPushButton::clicked, this, [this] {
        look::askForNewFile(
            this, {"picture", tr("Save the picture"), tr("Save"), tr("Pictures (*.png)"), "png", name_},
            [this](const std::filesystem::path& file) { savePicture(look::toText(file)); });
    });
    saveMovie_->setObjectName("review.saveMovie");
    saveMovie_->setToolTip(tr("Save the replay as a film, at the speed of the replay"));
    connect(saveMovie_, &QPushButton::clicked, this, [this] {
        look::askForNewFile(this,
                            {"film", tr("Save the film"), tr("Save"), tr("Films (*.mp4)"), "mp4", name_},
                            [this](const std::filesystem::path& file) { saveMovie(look::toText(file)); });
    });
}

void ReplayFiles::setScene(scene::SceneView* scene) {
    if (scene == nullptr && export_.busy()) {
        export_.cancel();
        emit failed(tr("The film was not saved"),
                    tr("Its pictures are those of the Review page: stay there until it is."));
    }
    scene_ = scene;
    showLength();
}

void ReplayFiles::setFramesPerSecond(int frames) {
    rate_->setCurrentIndex(rate_->findData(frames));
}

void ReplayFiles::setPictureSize(QSize size) {
    size_->setCurrentIndex(size_->findData(size));
}

QSize ReplayFiles::pictureSize() const {
    return size_->currentData().toSize();
}

int ReplayFiles::countFrames() const {
    if (player_.duration() <= 0.0) return 0;
    const double seconds = player_.duration() / player_.speed();
    // One more for the end: at many times the speed, a part goes far between two pictures.
    return static_cast<int>(std::ceil(seconds * rate_->currentData().toInt())) + 1;
}

void ReplayFiles::showLength() {
    const int frames = countFrames();
    saveMovie_->setEnabled(scene_ != nullptr && frames > 0 && !export_.busy());
    savePicture_->setEnabled(scene_ != nullptr && !export_.busy());
    if (export_.busy()) return;
    length_->setText(
        frames == 0 ? tr("Choose a trial to make a film of it.")
                    : tr("The film will take %1 s at %2 ×: %3 pictures.")
                          .arg(look::numberText(static_cast<double>(frames) / rate_->currentData().toInt()),
                               look::numberText(player_.speed()), QLocale().toString(frames)));
}

void ReplayFiles::savePicture(const QString& file) {
    if (scene_ == nullptr) return;
    length_->setText(tr("Drawing the picture"));
    // Encoded where it is drawn: that of a large one takes long.
    const auto bytes = scene_->picture(pictureSize(), ratioOf(pictureSize())).then(encodePng);
    scene::whenReady(bytes, this, [this, file](const QByteArray& png) { writePicture(png, file); });
}

void ReplayFiles::writePicture(const QByteArray& bytes, const QString& file) {
    showLength();
    if (bytes.isEmpty()) {
        emit failed(tr("The picture cannot be saved"), tr("It could not be drawn. Try a smaller size."));
        return;
    }
    const base::Status status =
        base::writeFile(QFile::encodeName(file).toStdString(),
                        std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
    if (!status)
        return emit failed(tr("The picture cannot be saved"), QString::fromStdString(status.error().message));
    length_->setText(tr("Saved: %1").arg(file));
}

void ReplayFiles::saveMovie(const QString& file) {
    if (scene_ == nullptr || export_.busy() || countFrames() == 0) return;
    player_.pause();
    Movie movie;
    movie.file = file;
    movie.size = pictureSize();
    movie.framesPerSecond = rate_->currentData().toInt();
    movie.frames = countFrames();
    const double between = player_.speed() / movie.framesPerSecond;
    movie.picture = [this, between, size = movie.size](int frame) {
        player_.setTime(between * frame);
        return scene_->picture(size, ratioOf(size));
    };
    busyText_->setText(tr("Picture 1 of %1").arg(movie.frames));
    bar_->setRange(0, movie.frames);
    bar_->setValue(0);
    clock_.start();
    busy_->show();
    export_.start(movie);
    showLength();
}

void ReplayFiles::showEnd(const QString& text) {
    busy_->hide();
    showLength();
    length_->setText(text);
}

}  // namespace trapwright::pages
