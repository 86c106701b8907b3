#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "core/part/stable_poses.h"
#include "ui/scene/picture_maker.h"

class QFrame;
class QGridLayout;
class QToolButton;

namespace trapwright::pages {

/// The stable poses of a part as cards: a picture and the probability. Poses that look the same are one card,
/// which opens to them.
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
    QFrame* addCard(const QString& name, int pose, double probability);
    void addOpener(QFrame& card, const part::PoseGroup& group);
    void focusOpener(const std::vector<int>& poses);

    std::shared_ptr<const part::Part> part_;
    scene::PictureMaker pictures_;
    QGridLayout* grid_;
    std::set<std::vector<int>> open_;  // groups, by their poses
    std::map<std::vector<int>, QToolButton*> openers_;
    int place_ = 0;  // of the next card
    bool stale_ = false;
};

}  // namespace trapwright::pages
