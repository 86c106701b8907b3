#pragma once

#include <QPointer>
#include <memory>
#include <optional>

#include "core/part/materials.h"
#include "ui/pages/page.h"
#include "ui/session/part_import.h"
#include "ui/session/work_thread.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace trapwright::session {
class StudyDesign;
class StudyRuns;
}  // namespace trapwright::session

namespace trapwright::pages {

class DropCard;
class FactList;
class PoseCards;
class SettingsForm;
class TargetCard;
class ImportQuestion;

/// Step 1: the part. Import with its unit, what was found in the mesh and mended, material, symmetry, stable
/// poses.
class PartPage : public Page {
    Q_OBJECT
 public:
    explicit PartPage(QWidget* parent = nullptr);
    ~PartPage() override;

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;
    bool takeFile(const std::filesystem::path& file) override;

 private:
    void addHead();
    void addForm();
    void askForFile();
    void import(const workflow::PartRequest& request);
    void take(const workflow::LoadedPart& part);
    /// Ends an import that came to nothing.
    void leave();
    void setBusy(const QString& what);

    void refresh();
    /// Whether the part of the study is the one that was imported last.
    [[nodiscard]] bool knowsImport() const;
    void showMesh();
    void tellMesh(const geometry::MeshReport& report, std::size_t triangles,
                  const std::vector<std::string>& notes);
    void showUnits();
    void readMaterials();
    void showMaterial();
    void showProposal();
    void changeUnits(int index);
    void changeMaterial(int index);
    void showLibrary();
    void edit(const study::Settings& settings, const QString& what);
    void showScene();

    QPointer<session::StudyDesign> design_;
    QPointer<const session::StudyRuns> runs_;
    scene::SceneView* scene_ = nullptr;  // while the page is shown
    session::PartImport import_;
    QString importing_;  // the file's name
    session::NewestTask meshCheck_;
    std::optional<workflow::LoadedPart> imported_;  // the last one, for its report
    std::shared_ptr<const part::Part> shownMesh_;   // whose mesh was checked

    QLabel* name_;
    QLabel* size_;
    QPushButton* importButton_;
    QWidget* busy_;
    QLabel* busyText_;
    ImportQuestion* question_;
    QLabel* misfit_;
    SettingsForm* form_;
    QComboBox* unit_;
    part::MaterialLibrary library_;
    std::optional<part::MaterialPair> afterMaterial_;  // to be proposed when the part is built anew
    std::optional<part::MaterialPair> proposed_;       // since then
    QComboBox* material_;
    QWidget* proposal_;
    QLabel* proposalText_;
    DropCard* drop_;
    QLabel* notes_;
    QLabel* symmetry_;
    FactList* mesh_;
    FactList* mass_;
    PoseCards* poses_;
    TargetCard* target_;
};

}  // namespace trapwright::pages
