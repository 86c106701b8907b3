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

namespace trapwright::pages {

/// How parts shall end, in a line: "Any one way", "Poses 3-4, any heading". Problems of the settings are not
/// told.
QString wantedText(const study::TargetSettings& target, const part::Part& part);

/// Of the Part page: how parts shall end. The stable poses to choose from, alike ones as one, with the
/// heading in which they shall lie; and what learning makes of the choice.
class TargetCard : public QWidget {
    Q_OBJECT
 public:
    explicit TargetCard(QWidget* parent);

    void show(std::shared_ptr<const part::Part> part, const study::Settings& settings);
    void setLocked(bool locked);

 signals:
    /// The settings with the user's choice, and its name for undo.
    void edited(const trapwright::study::Settings& settings, const QString& what);

 protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;

 private:
    void rebuild();
    QToolButton* addButton(const QString& name, const QString& text);
    void refresh();
    void chooseAny();
    void toggle(std::size_t group);
    void chooseHeading();
    void countIt();
    void choose(study::TargetSettings target, const QString& what);

    std::shared_ptr<const part::Part> part_;
    std::vector<part::PoseGroup> groups_;  // of the part
    study::Settings settings_;
    scene::PictureMaker pictures_;
    QGridLayout* grid_;
    QToolButton* any_ = nullptr;
    std::vector<QToolButton*> poses_;  // one for each group
    QWidget* headingRow_;
    QCheckBox* anyHeading_;
    QDoubleSpinBox* heading_;
    QLabel* told_;
    QWidget* proposal_;
    QLabel* proposalText_;
    bool stale_ = false;
};

}  // namespace trapwright::pages
