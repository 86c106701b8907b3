#pragma once

#include <QPointer>
#include <memory>
#include <optional>

#include "core/study/records.h"
#include "ui/pages/page.h"
#include "ui/session/print_build.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace trapwright::pages {

class PrintFindings;
class PrintForm;

/// Step 5: the track as a solid to print: which individual, what stands around its surface, what a printer
/// makes of it, and the file.
class ExportPage : public Page {
    Q_OBJECT
 public:
    explicit ExportPage(QWidget* parent = nullptr);

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;

 private:
    QWidget* makeFoot();
    void addExport(const QString& format, const QString& text, const QKeySequence& key);
    void fillTracks();
    void refresh();
    void build();
    void take(const std::shared_ptr<const session::PrintedTrack>& printed);
    void setState(const QString& text);
    void enableExport();
    void askForPath(const QString& format);
    void showScene();

    QPointer<session::StudySession> session_;
    scene::SceneView* scene_ = nullptr;  // while the page is shown
    session::PrintBuild print_;
    std::shared_ptr<const session::PrintedTrack> printed_;  // of the choice in force; null while it is built
    std::shared_ptr<const geometry::TriangleMesh> shown_;   // the last one that was built
    bool stale_ = true;                                     // nothing was asked for since the last change
    bool listStale_ = false;                                // of tracks, because the page was not shown
    QWidget* contents_;
    QLabel* empty_;
    QComboBox* tracks_;
    PrintForm* form_;
    PrintFindings* findings_;
    QLabel* state_;
    QLabel* help_;
    QWidget* foot_ = nullptr;
    QList<QAction*> exports_;
};

}  // namespace trapwright::pages
