#pragma once

#include <QWidget>
#include <memory>

#include "core/part/part.h"
#include "ui/scene/picture_maker.h"

class QGridLayout;

namespace trapwright::pages {

/// The stable poses of a part as cards: a picture and the probability.
class PoseCards : public QWidget {
    Q_OBJECT
 public:
    explicit PoseCards(QWidget* parent);

    void show(std::shared_ptr<const part::Part> part);

 protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;

 private:
    void rebuild();

    std::shared_ptr<const part::Part> part_;
    scene::PictureMaker pictures_;
    QGridLayout* grid_;
    bool stale_ = false;
};

}  // namespace trapwright::pages
