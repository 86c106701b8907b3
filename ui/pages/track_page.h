#pragma once

#include <QPointer>
#include <memory>
#include <optional>

#include "core/part/materials.h"
#include "core/study/settings.h"
#include "core/track/track.h"
#include "core/workflow/proposal.h"
#include "ui/pages/page.h"
#include "ui/session/track_build.h"

class QComboBox;
class QLabel;

namespace trapwright::session {
class StudyDesign;
class StudyRuns;
}  // namespace trapwright::session

namespace trapwright::pages {

class DriveCard;
class RunActions;
class SettingsForm;

/// Step 2: what the track is made of, how it vibrates and how it is learned; the scene follows every edit.
class TrackPage : public Page {
    Q_OBJECT
 public:
    explicit TrackPage(RunActions& run, QWidget* parent = nullptr);

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;

 protected:
    void changeEvent(QEvent* event) override;

 private:
    QWidget* makeHead();
    QWidget* makeStart(QWidget* parent);
    void addContactChoice();
    void refresh();
    void showProblems();
    void listPairs();
    void showContact();
    void showLibrary();
    void edit(const study::Settings& settings, const QString& what);
    void usePreset(const QString& name, const QString& title);
    void usePaperMode();
    void useSorting();
    void useLedges();
    void useSlots();
    void useRails();
    void useFullLearning();
    void useDraft();
    void propose(double seconds, const QString& what);
    void useProposal(const workflow::Proposal& proposal);
    void showTime();
    void showTrack();
    void showTitle();

    RunActions& run_;
    QPointer<session::StudyDesign> design_;
    QPointer<session::StudyRuns> runs_;
    scene::SceneView* scene_ = nullptr;  // while the page is shown
    session::TrackBuild build_;
    std::optional<study::TrackSettings> built_;  // what is shown, or being built
    std::shared_ptr<const track::Track> track_;
    SettingsForm* form_;
    DriveCard* drive_;
    part::MaterialLibrary library_;
    QComboBox* contact_;
    QWidget* locked_;
    QLabel* title_;
    QLabel* size_;
    QLabel* time_;
    QAction* draftPreset_;
    QMenu* timePresets_;
    QLabel* proposal_;
    QString proposing_;                        // what was asked for last
    std::optional<study::Settings> proposed_;  // for it
    QLabel* problems_;
    QLabel* help_;
};

}  // namespace trapwright::pages
