#pragma once

#include <QKeySequence>
#include <QPointer>
#include <memory>
#include <utility>
#include <vector>

#include "ui/feeder/drive_link.h"
#include "ui/feeder/guide_actions.h"
#include "ui/feeder/physical_model.h"
#include "ui/feeder/placing_scene.h"
#include "ui/feeder/trial_guide.h"
#include "ui/pages/page.h"

namespace trapwright::pages {
class ResultTable;
}

namespace trapwright::feeder {

class CalibratePanel;
class DriveChart;
class DriveLog;
class DrivePanel;
class GuideBar;
class PlanPanel;
class ReportCard;

/// Step 6: the printed track on the real feeder. The operator connects the drive, places part after part as
/// the scene shows, and tells by a key what became of each.
class ValidatePage : public pages::Page {
    Q_OBJECT
 public:
    explicit ValidatePage(const session::Environment& environment, QWidget* parent = nullptr);
    ~ValidatePage() override;

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;
    bool release() override;
    std::vector<pages::Panel> panels() override;
    QWidget* sceneBar() override;

    [[nodiscard]] DriveLink& link() { return link_; }
    [[nodiscard]] TrialGuide& guide() { return guide_; }

 private:
    void addInspector(const session::Environment& environment);
    void addPanels();
    void tellFarewell();
    void takeSceneKeys(const QList<QAction*>& actions);
    void giveSceneKeysBack();
    void showTrial();
    void showExpected();
    void showTable();
    void applyCalibration();
    void goOnWithFork();

    QPointer<session::StudySession> session_;
    DriveLink link_;
    TrialGuide guide_;
    GuideActions actions_;
    PlacingScene placing_;
    PhysicalModel model_;
    DrivePanel* drive_;
    ReportCard* report_ = nullptr;
    GuideBar* bar_;
    // The window owns these.
    PlanPanel* plan_;
    pages::ResultTable* table_;
    DriveChart* chart_;
    DriveLog* log_;
    CalibratePanel* calibrate_;
    std::vector<std::pair<QPointer<QAction>, QKeySequence>> taken_;
};

}  // namespace trapwright::feeder
