#include "ui/pages/movie_export.h"

#include <QFile>
#include <QStandardPaths>
#include <filesystem>
#include <system_error>
#include <utility>

#include "ui/scene/when_ready.h"

namespace trapwright::pages {

namespace {

constexpr int kPicturesWaiting = 3;  // that ffmpeg has not taken yet

QStringList arguments(const Movie& movie, const QString& file) {
    return {"-y",
            "-loglevel",
            "error",
            "-f",
            "rawvideo",
            "-pixel_format",
            "bgr0",
            "-video_size",
            QString("%1x%2").arg(movie.size.width()).arg(movie.size.height()),
            "-framerate",
            QString::number(movie.framesPerSecond),
            "-i",
            "-",
            "-an",
            "-c:v",
            "libx264",
            "-preset",
            "medium",
            "-crf",
            "18",
            "-pix_fmt",
            "yuv420p",
            "-movflags",
            "+faststart",
            "-f",
            "mp4",
            file};
}

}  // namespace

MovieExport::MovieExport(QObject* parent) : QObject(parent) {}

MovieExport::~MovieExport() {
    if (busy()) drop();
}

void MovieExport::start(const Movie& movie) {
    if (busy()) return;
    const QString program = QStandardPaths::findExecutable("ffmpeg");
    if (program.isEmpty()) {
        emit failed(tr(
            "Films are made by the program ffmpeg, which is not installed. Install it (on Debian and Ubuntu: "
            "sudo apt install ffmpeg) and try again."));
        return;
    }
    movie_ = movie;
    partial_ = movie.file + ".part";
    next_ = 0;
    drawing_ = false;
    process_ = new QProcess(this);
    connect(process_, &QProcess::started, this, &MovieExport::feed);
    connect(process_, &QProcess::bytesWritten, this, &MovieExport::feed);
    connect(process_, &QProcess::finished, this, &MovieExport::end);
    connect(process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error != QProcess::FailedToStart) return;  // finished() tells the others
        const QString message = process_->errorString();
        drop();
        emit failed(tr("ffmpeg could not be started: %1").arg(message));
    });
    process_->start(program, arguments(movie_, partial_));
}

void MovieExport::cancel() {
    if (!busy()) return;
    drop();
    emit cancelled();
}

/// Has the next picture drawn, unless ffmpeg has enough to do.
void MovieExport::feed() {
    if (!busy() || drawing_ || next_ >= movie_.frames || process_->state() != QProcess::Running) return;
    if (process_->bytesToWrite() >= kPicturesWaiting * 4LL * movie_.size.width() * movie_.size.height())
        return;
    drawing_ = true;
    scene::whenReady(movie_.picture(next_), process_, [this, process = process_](const QImage& picture) {
        if (process != process_) return;  // dropped
        drawing_ = false;
        write(picture.convertToFormat(QImage::Format_RGB32));
    });
}

void MovieExport::write(const QImage& picture) {
    if (picture.size() != movie_.size) {
        drop();
        emit failed(tr("Picture %1 could not be drawn. Try a smaller size.").arg(next_ + 1));
        return;
    }
    process_->write(reinterpret_cast<const char*>(picture.constBits()), picture.sizeInBytes());
    ++next_;
    emit progressed(next_, movie_.frames);
    if (!busy()) return;
    if (next_ == movie_.frames) {
        process_->closeWriteChannel();
    } else {
        feed();
    }
}

void MovieExport::end(int exitCode, QProcess::ExitStatus status) {
    const QString said = QString::fromLocal8Bit(process_->readAllStandardError()).trimmed();
    const bool complete = status == QProcess::NormalExit && exitCode == 0 && next_ == movie_.frames;
    std::error_code error;
    if (complete)
        std::filesystem::rename(QFile::encodeName(partial_).toStdString(),
                                QFile::encodeName(movie_.file).toStdString(), error);
    const QString file = movie_.file;
    drop();
    if (!complete) {
        emit failed(
            tr("ffmpeg could not write %1: %2").arg(file, said.isEmpty() ? tr("it ended early") : said));
    } else if (error) {
        emit failed(tr("%1 cannot be written: %2").arg(file, QString::fromStdString(error.message())));
    } else {
        emit finished(file);
    }
}

void MovieExport::drop() {
    QProcess* const process = std::exchange(process_, nullptr);
    process->disconnect(this);
    process->kill();
    process->waitForFinished(1000);
    process->deleteLater();
    QFile::remove(partial_);
}

}  // namespace trapwright::pages
