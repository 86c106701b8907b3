#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "core/part/stable_poses.h"
#include "core/study/settings.h"
#include "ui/scene/picture_maker.h"

class QCheckBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QPushButton;
class QToolButton;

namespace trapwright::scene {
class SceneView;
}

namespace trapwright::pages {

class OrientationEditor;

/// How parts shall end, in a line: "Any one way", "Poses 3-4, any heading". Problems of the settings are not
/// told.
QString wantedText(const study::TargetSettings& target, const part::Part& part);

/// Of the Part page: how parts shall end. The stable poses to choose from, alike ones as one, with the
/// heading in which they shall lie, or an orientation made by hand in the scene; and what learning makes of
/// the choice.
class TargetCard : public QWidget {
    Q_OBJECT
 public:
    explicit TargetCard(QWidget* parent);

    void show(std::shared_ptr<const part::Part> part, const study::Settings& settings);
    void setLocked(bool locked);
    /// The scene to turn the part in, while there is one.
    void setScene(scene::SceneView* scene);
    /// Whether the scene shows the part that is turned by hand.
    [[nodiscard]] bool hasScene() const;

 signals:
    /// The scene is free again.
    void sceneFreed();
    /// The settings with the user's choice, and its name for undo.
    void edited(const trapwright::study::Settings& settings, const QString& what);

 protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;

 private:
    void rebuild();
    QToolButton* addButton(const QString& name, const QString& text);
    /// What a button that chooses this orientation shows.
    void drawPicture(QToolButton& button, const base::Quaternion& rotation);
    void refresh();
    void chooseAny();
    void toggle(std::size_t group);
    void chooseHeading();
    void turnByHand();
    void countIt();
    void choose(study::TargetSettings target, const QString& what);

    std::shared_ptr<const part::Part> part_;
    std::vector<part::PoseGroup> groups_;  // of the part
    study::Settings settings_;
    scene::PictureMaker pictures_;
    QGridLayout* grid_;
    QToolButton* any_ = nullptr;
    std::vector<QToolButton*> poses_;  // one for each group
    QToolButton* byHand_ = nullptr;
    std::optional<base::Quaternion> drawnByHand_;  // the orientation that byHand_ shows
    OrientationEditor* editor_;
    scene::SceneView* scene_ = nullptr;  // while there is one
    QWidget* headingRow_;
    QCheckBox* anyHeading_;
    QDoubleSpinBox* heading_;
    QLabel* told_;
    QWidget* proposal_;
    QLabel* proposalText_;
    bool stale_ = false;
};

}  // namespace trapwright::pages
