#pragma once

#include <QPointer>
#include <QWidget>

#include "ui/models/winner_model.h"
#include "ui/pages/winner_pictures.h"

class QLabel;
class QListView;
class QSlider;
class QStackedLayout;
class QTimer;
class QToolButton;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

/// The winners of all generations as a strip of pictures, with a slider that goes through them. Pictures are
/// made of what is in view.
class FilmStrip : public QWidget {
    Q_OBJECT
 public:
    explicit FilmStrip(QWidget* parent = nullptr);

    void setRuns(const session::StudyRuns* runs);
    /// What the scene shows: a generation (-1: none is there yet), what to call it, and whether the best one
    /// is followed.
    void setCurrent(int generation, const QString& caption, bool following);

 signals:
    void picked(int generation);
    void followWanted();

 protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    QWidget* makeList();
    QWidget* makeControls();
    void refresh();
    void redraw();
    void wantSeen();

    QPointer<const session::StudyRuns> runs_;
    models::WinnerModel model_;
    WinnerPictures* pictures_;
    QStackedLayout* stack_;
    QListView* list_ = nullptr;
    QSlider* slider_ = nullptr;
    QLabel* caption_ = nullptr;
    QToolButton* follow_ = nullptr;
    QTimer* seen_;
    bool setting_ = false;
};

}  // namespace trapwright::pages
