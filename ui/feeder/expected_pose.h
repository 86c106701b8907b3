#pragma once

#include <QSize>
#include <QWidget>
#include <memory>
#include <optional>

#include "core/part/part.h"
#include "core/track/track.h"
#include "core/trial/goal.h"
#include "ui/scene/picture_maker.h"

class QLabel;

namespace trapwright::feeder {

/// What a part that succeeded looks like.
struct ExpectedExit {
    std::shared_ptr<const track::Track> track;  // null while it is built
    std::shared_ptr<const part::Part> part;
    std::optional<trial::Goal> goal;  // none: not known yet

    [[nodiscard]] bool known() const { return track && part && goal; }
    friend bool operator==(const ExpectedExit&, const ExpectedExit&) = default;
};

/// Which other orientations are right as well, in sentences: "Any of 4 alike orientations is right." Empty if
/// there are none.
QString alikeText(const part::SymmetryGroup& symmetry, const trial::Goal& goal);

/// The picture of a success, drawn in the background: the track's exit with the part on it as it leaves, from
/// the operator's side, the conveying direction marked. Null if something is not known.
QFuture<QImage> expectedPicture(scene::PictureMaker& maker, const ExpectedExit& exit, QSize size,
                                double pixelRatio = 1.0);

/// That picture with what it says in words; as large as its place.
class ExpectedPose : public QWidget {
    Q_OBJECT
 public:
    /// `name`: of the object.
    ExpectedPose(const QString& name, QWidget* parent);

    void show(const ExpectedExit& exit);
    [[nodiscard]] const ExpectedExit& shown() const { return exit_; }
    /// As it is drawn by now; null if it is not.
    [[nodiscard]] const QImage& picture() const { return picture_; }

 protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

 private:
    void refresh();
    [[nodiscard]] QRect pictureArea() const;

    ExpectedExit exit_;
    scene::PictureMaker maker_;
    QImage picture_;
    QLabel* title_;
    QLabel* text_;
    QWidget* place_;     // of the picture
    int request_ = 0;    // the newest
    bool stale_ = true;  // drawn only when it is seen
};

}  // namespace trapwright::feeder
