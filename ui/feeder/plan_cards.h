#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "core/part/stable_poses.h"
#include "ui/scene/picture_maker.h"

class QCheckBox;
class QFrame;
class QGridLayout;
class QLabel;
class QProgressBar;

namespace trapwright::feeder {

/// How far alike poses of a plan are.
struct PoseProgress {
    int pose = 0;  // one of them: index into the part's stable poses
    int made = 0;
    int planned = 0;
    int failures = 0;

    friend bool operator==(const PoseProgress&, const PoseProgress&) = default;
};

/// The stable poses of a part as cards, alike ones on one: with their progress in a validation, or to choose
/// from for a new one.
class PlanCards : public QWidget {
    Q_OBJECT
 public:
    explicit PlanCards(QWidget* parent);

    /// `groups` are the part's, with the weights of the study.
    void setPart(std::shared_ptr<const part::Part> part, std::vector<part::PoseGroup> groups);
    /// The poses of a plan; the one that is to be placed is marked.
    void showProgress(const std::vector<PoseProgress>& progress, std::optional<int> current);
    /// All with a box to choose each.
    void showChoice();
    /// One pose of each card that is chosen.
    [[nodiscard]] std::vector<int> chosen() const;

 signals:
    void choiceChanged();

 protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;

 private:
    struct Card {
        std::vector<int> poses;
        double probability;
        QFrame* frame;
        QLabel* picture;
        QCheckBox* box;
        QLabel* title;
        QLabel* count;
        QProgressBar* bar;
    };

    void rebuild();
    void addCard(const part::PoseGroup& group);
    void drawPictures();
    void update();

    std::shared_ptr<const part::Part> part_;
    scene::PictureMaker pictures_;
    QGridLayout* grid_;
    std::vector<part::PoseGroup> groups_;
    std::vector<Card> cards_;                            // by group
    std::optional<std::vector<PoseProgress>> progress_;  // none: to choose
    std::optional<int> current_;
    bool stale_ = false;  // the pictures
};

}  // namespace trapwright::feeder
