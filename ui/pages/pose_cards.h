#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/part/stable_poses.h"
#include "core/study/pose_drops.h"
#include "core/study/settings.h"
#include "ui/scene/picture_maker.h"

class QFrame;
class QGridLayout;
class QToolButton;

namespace trapwright::pages {

/// The stable poses of a part as cards: a picture and the probability, estimated and as dropped. Poses that
/// look the same are one card, which opens to them.
class PoseCards : public QWidget {
    Q_OBJECT
 public:
    explicit PoseCards(QWidget* parent);

    /// `drops` is a test of this part, if it was dropped; what counts by `weights` is bold.
    void show(std::shared_ptr<const part::Part> part, const std::optional<study::DropRecord>& drops,
              study::PoseWeights weights);

 protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;

 private:
    void rebuild();
    QFrame* addCard(const QString& name, const std::vector<int>& poses, double probability);
    /// Adds how likely the poses are together to the card, and tells it in words.
    void addChances(QFrame& card, const std::vector<int>& poses, double probability, const QString& name);
    void addOpener(QFrame& card, const part::PoseGroup& group);
    void focusOpener(const std::vector<int>& poses);

    std::shared_ptr<const part::Part> part_;
    std::optional<study::DropRecord> drops_;
    study::PoseWeights weights_ = study::PoseWeights::quasiStatic;
    scene::PictureMaker pictures_;
    QGridLayout* grid_;
    std::set<std::vector<int>> open_;  // groups, by their poses
    std::map<std::vector<int>, QToolButton*> openers_;
    int place_ = 0;  // of the next card
    bool stale_ = false;
};

}  // namespace trapwright::pages
