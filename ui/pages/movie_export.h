#pragma once

#include <QFuture>
#include <QImage>
#include <QObject>
#include <QProcess>
#include <QSize>
#include <QString>
#include <functional>
#include <memory>

namespace trapwright::pages {

/// A film to be made.
struct Movie {
    QString file;  // .mp4
    QSize size;    // pixels, even
    int framesPerSecond = 30;
    int frames = 0;
    std::function<QFuture<QImage>(int frame)> picture;  // of that size; called in the GUI thread
};

/// Makes a film with ffmpeg, picture by picture as they are drawn in the background. The file appears when it
/// is complete.
class MovieExport : public QObject {
    Q_OBJECT
 public:
    explicit MovieExport(QObject* parent);
    ~MovieExport() override;

    /// One at a time. Ends with finished(), failed() or cancelled().
    void start(const Movie& movie);
    void cancel();
    [[nodiscard]] bool busy() const { return process_ != nullptr; }

 signals:
    void progressed(int frame, int frames);
    void finished(const QString& file);
    void cancelled();
    void failed(const QString& message);

 private:
    void feed();
    void write(const QImage& picture);
    void end(int exitCode, QProcess::ExitStatus status);
    void drop();

    Movie movie_;
    QString partial_;              // the file as long as it is not complete
    int next_ = 0;                 // frame
    bool drawing_ = false;         // the next picture
    QProcess* process_ = nullptr;  // while busy
};

}  // namespace trapwright::pages
