#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "ui/pages/movie_export.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace trapwright::scene {
class SceneView;
}

namespace trapwright::pages {

class ReplayPlayer;

/// Saves what the scene shows as a picture, and a replay as a film at a fixed frame rate.
class ReplayFiles : public QWidget {
    Q_OBJECT
 public:
    ReplayFiles(ReplayPlayer& player, QWidget* parent);

    /// Where the pictures come from; null: there are none, and a film that is being made ends.
    void setScene(scene::SceneView* scene);
    /// What of the study is shown, for the names of files.
    void setName(const QString& name) { name_ = name; }

    /// The replay at the player's speed, from its beginning to its end.
    void saveMovie(const QString& file);
    void savePicture(const QString& file);
    void setFramesPerSecond(int frames);
    void setPictureSize(QSize size);
    [[nodiscard]] const MovieExport& movie() const { return export_; }

 signals:
    void failed(const QString& what, const QString& message);

 private:
    QWidget* makeChoices();
    QWidget* makeProgress();
    void addButtons();
    [[nodiscard]] QSize pictureSize() const;
    [[nodiscard]] int countFrames() const;
    void writePicture(const QByteArray& bytes, const QString& file);
    void showLength();
    void showEnd(const QString& text);

    ReplayPlayer& player_;
    MovieExport export_;
    QElapsedTimer clock_;  // since the film was begun
    scene::SceneView* scene_ = nullptr;
    QString name_;
    QComboBox* size_;
    QComboBox* rate_;
    QLabel* length_;
    QPushButton* savePicture_;
    QPushButton* saveMovie_;
    QWidget* busy_;
    QLabel* busyText_;
    QProgressBar* bar_;
};

}  // namespace trapwright::pages
