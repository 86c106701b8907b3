#pragma once

#include <QString>
#include <QWidget>
#include <filesystem>
#include <vector>

namespace trapwright::scene {
class SceneView;
}
namespace trapwright::session {
class StudySession;
enum class Fork;
}  // namespace trapwright::session
namespace trapwright::workflow {
struct LoadedPart;
}

namespace trapwright::pages {

/// How a page is called. `name` is stable (settings, tests, jumps between pages); the others are for people.
struct PageFace {
    QString name;   // "track"
    QString title;  // tr("Track")
    QString icon;   // of look::icon
    QString tip;    // one sentence on what is done here
};

/// A chart or a table of a page. The window puts it into a dock of its own, which can be moved, floated,
/// closed and is remembered by its name.
struct Panel {
    QString name;   // stable, "success"
    QString title;  // tr("Success")
    QWidget* widget = nullptr;
    Qt::DockWidgetArea area = Qt::BottomDockWidgetArea;
};

/// One step of the work: an inspector for the right dock that shows and changes one subject of the open
/// study. A page is a view: it computes nothing, keeps no data of a study and does nothing long on its own
/// thread.
///
/// QActions added with addAction() are listed among the keyboard shortcuts and work while the page is shown.
/// Colours follow the palette; a page that draws with colours of its own looks again on
/// QEvent::PaletteChange.
class Page : public QWidget {
    Q_OBJECT
 public:
    explicit Page(PageFace face, QWidget* parent = nullptr);

    [[nodiscard]] const PageFace& face() const { return face_; }

    /// The study that is open from now on; null if none is. The one before is still alive during the call.
    virtual void setSession(session::StudySession* session) = 0;
    /// The page is shown from now on, and what is in the scene is its own choice: sets the scene's contents.
    virtual void activate(scene::SceneView& scene) = 0;
    /// Another page is shown from now on: ends what only makes sense in sight (a replay that plays).
    virtual void deactivate() {}

    /// The study or the window is about to go. True: at once. False: something ends first that must not be
    /// cut short (a drive comes to rest); releasing() tells how far it is, and released() when it is over.
    virtual bool release() { return true; }

    /// Charts and tables, asked for once. The docks own the widgets from then on.
    virtual std::vector<Panel> panels() { return {}; }
    /// What belongs under the scene while the page is shown (film strip, transport bar), asked for once; the
    /// window owns it from then on. Null: nothing.
    virtual QWidget* sceneBar() { return nullptr; }
    /// A file that was dropped or chosen and is no study. False if the page has no use for it.
    virtual bool takeFile(const std::filesystem::path& file);

 signals:
    /// To tell in the window's message bar: what was tried (a few words), and what was wrong, where, and what
    /// to do about it.
    void failed(const QString& what, const QString& message);
    /// See release(): what goes on, and its state with what there is to do about it.
    void releasing(const QString& what, const QString& state);
    /// What did not end well, if anything, and what to do: the page and its study may be gone when it is
    /// read.
    void released(const QString& what, const QString& message);
    /// A page shall be shown; its name. Empty, while no study is open: none needs to be.
    void pageWanted(const QString& name);
    /// One of the page's own panels has what the user waited for; its name. Comes to the front if it is open.
    void panelWanted(const QString& name);
    /// A new study of this part shall be opened in place of the one that is open, if any.
    void studyWanted(const trapwright::workflow::LoadedPart& part);
    /// A new study with the settings and the part of the open one, and no generations, shall be opened in its
    /// place.
    void forkWanted(trapwright::session::Fork kind);

 private:
    PageFace face_;
};

}  // namespace trapwright::pages
