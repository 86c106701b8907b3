#pragma once

#include <QPointer>
#include <memory>
#include <optional>

#include "core/study/records.h"
#include "core/study/selection.h"
#include "ui/pages/page.h"
#include "ui/scene/contents.h"
#include "ui/session/print_build.h"

class QComboBox;
class QLabel;

namespace trapwright::pages {

class MendCard;
class PrintFindings;
class PrintForm;

/// Step 5: the track as a solid to print: which individual, whether it should be printed, for which printer,
/// what stands around its surface, in which pieces, and the file.
class ExportPage : public Page {
    Q_OBJECT
 public:
    explicit ExportPage(QWidget* parent = nullptr);

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;

    /// Asks for a file to export to, "stl", "3mf" or "step", as soon as the solid is built.
    void exportWhenBuilt(const QString& format);

 private:
    QWidget* makeFoot();
    void addExport(const QString& format, const QString& text, const QKeySequence& key);
    void fillTracks();
    void refresh();
    [[nodiscard]] study::IndividualId shownTrack() const;
    void build();
    void take(const std::shared_ptr<const session::PrintedTrack>& printed);
    void setState(const QString& text);
    void enableExport();
    void exportAs(const QString& format);
    void askForPath(const QString& format, const std::shared_ptr<const session::PrintedTrack>& printed);
    void tellWritten(const std::vector<workflow::ExportedFile>& files);
    [[nodiscard]] std::optional<study::TrackSuccess> successOfTrack() const;
    [[nodiscard]] std::vector<scene::Highlight> highlights() const;
    void showScene();

    QPointer<session::StudySession> session_;
    scene::SceneView* scene_ = nullptr;  // while the page is shown
    session::PrintBuild print_;
    std::shared_ptr<const session::PrintedTrack> printed_;  // of the choice in force; null while it is built
    std::shared_ptr<const session::PrintedTrack> shown_;    // the last one that was built
    QString wanted_;          // the format of an export that waits for the solid; empty: none
    bool stale_ = true;       // nothing was asked for since the last change
    bool listStale_ = false;  // of tracks, because the page was not shown
    QWidget* contents_;
    QLabel* empty_;
    QComboBox* tracks_;
    PrintForm* form_;
    PrintFindings* findings_;
    MendCard* mend_;
    QLabel* state_;
    QLabel* help_;
    QWidget* foot_ = nullptr;
    QList<QAction*> exports_;
};

}  // namespace trapwright::pages
