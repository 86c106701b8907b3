#pragma once

#include <QMainWindow>
#include <QPointer>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "ui/look/theme.h"
#include "ui/look/wheel_focus.h"
#include "ui/pages/run_actions.h"
#include "ui/window/study_desk.h"

class QMenu;
class QUndoGroup;

namespace trapwright::help {
class HelpWindow;
}

namespace trapwright::pages {
class Page;
}

namespace trapwright::window {

class Farewell;
class PageDocks;
class Tour;
class Rail;
class SceneFrame;
class StatusLine;

/// The studio's window: rail, scene, docks, menus. What is shown of a study is its pages' matter; this opens
/// and closes studies and gives every page its place.
class MainWindow : public QMainWindow {
    Q_OBJECT
 public:
    explicit MainWindow(session::Environment environment);
    ~MainWindow() override;

    /// Opens a study, or imports a part, by the file's name. Asks first if something would be lost.
    void openFile(const std::filesystem::path& file);
    /// Shows a page by its name, as "track". Without a study only the Part page is shown, where one begins.
    void showPage(const QString& name);

    /// Closes it without a question, for a system that ends the program: a drive is told to rest and left
    /// first, a run is cancelled, and a draft is kept to be offered again.
    void closeUnasked();

    [[nodiscard]] StudyDesk& desk() { return desk_; }

 protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

 private:
    void addFileMenu();
    void addEditMenu();
    void addViewMenu();
    void addRunMenu();
    void addHelpMenu();
    void addCorner();
    void showRecent();
    void showDocks();

    void connectPage(pages::Page& page);
    void setSession(session::StudySession* session);
    void leaveSession(session::StudySession& session);
    void updateTitle();
    void setPage(std::size_t page);
    [[nodiscard]] pages::Page* findPage(const QString& name) const;
    [[nodiscard]] std::optional<std::size_t> findPlace(
        const QString& name) const;  // in the order of the rail

    void closeForGood();
    void askForPart();
    void askForDraft();
    void askForStudy();
    void save();
    /// What a job of a cluster is to have; of a study with a name, beside which the job's folder lies.
    void askForCluster();
    void askForSaveAs(const std::function<void()>& afterwards);
    void importPart(const std::filesystem::path& file, bool asNewStudy);
    void openStudy(const std::filesystem::path& file, bool learn = false);
    void openExample(
        const QString& name, bool learn, const std::function<void()>& afterwards = [] {});
    void openLearnedExample(const workflow::ExampleStudy& example);
    void offerRecovery();
    void offerTour();
    /// Through the open study, or through an example where none is open.
    void startTour();
    /// The help at what has the focus.
    void showHelp();
    /// Calls `afterwards` once nothing would be lost any more, and a drive rests: asks about a run and about
    /// a draft.
    void whenClosable(const std::function<void()>& afterwards);
    void whenIdle(const std::function<void()>& afterwards);
    void whenSaved(const std::function<void()>& afterwards);
    void report(const QString& what, const base::Status& status);
    void fail(const QString& what, const QString& message);
    void failSession(const QString& what, const QString& message);
    /// A message of a page leaves with it.
    void clearPageMessage();

    look::WheelFocus wheel_;
    look::Theme theme_;
    StudyDesk desk_;
    pages::RunActions run_;
    QUndoGroup* undo_;
    std::vector<pages::Page*> pages_;
    std::size_t page_ = 0;
    const pages::Page* messageOf_ = nullptr;  // whose message is shown, if it is a page's
    SceneFrame* frame_;
    Rail* rail_;
    PageDocks* docks_;
    StatusLine* status_;
    Farewell* farewell_;
    QMenu* recentMenu_ = nullptr;
    QMenu* docksMenu_ = nullptr;
    QList<QAction*> studyActions_;  // that need an open study
    QString pageAfterImport_ = QStringLiteral("part");
    QPointer<Tour> tour_;
    help::HelpWindow* help_ = nullptr;  // once it was asked for
    bool mayClose_ = false;
};

}  // namespace trapwright::window
