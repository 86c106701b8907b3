#include "ui/window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QTimer>
#include <QUndoGroup>
#include <utility>

#include "ui/help/help_window.h"
#include "ui/look/icon.h"
#include "ui/look/message_bar.h"
#include "ui/look/text.h"
#include "ui/pages/page.h"
#include "ui/session/part_import.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/window/farewell.h"
#include "ui/window/help_place.h"
#include "ui/window/page_docks.h"
#include "ui/window/rail.h"
#include "ui/window/scene_frame.h"
#include "ui/window/status_line.h"
#include "ui/window/tour.h"
#include "ui/window/welcome.h"

namespace trapwright::window {

using session::RunState;

namespace {

constexpr QSize kFirstSize(1440, 900);
constexpr QSize kFrameOfWindow(16, 48);  // that the desktop draws around it, about
const QString kFirstPage = QStringLiteral("part");

bool isStudy(const std::filesystem::path& file) {
    return file.extension() == ".trap";
}

}  // namespace

MainWindow::MainWindow(session::Environment environment)
    : desk_(std::move(environment), nullptr),
      run_(this),
      undo_(new QUndoGroup(this)),
      pages_(makePages(run_, desk_.environment())),
      frame_(new SceneFrame(this)),
      rail_(new Rail(pages_, this)),
      docks_(new PageDocks(*this, pages_)),
      status_(new StatusLine(this)),
      farewell_(new Farewell(pages_, this)) {
    setObjectName("mainWindow");
    setWindowIcon(look::programIcon());
    setAcceptDrops(true);
    setCentralWidget(frame_);
    addToolBar(Qt::LeftToolBarArea, rail_);
    setStatusBar(status_);
    for (pages::Page* page : pages_)
        connectPage(*page);
    connect(rail_, &Rail::chosen, this, &MainWindow::setPage);
    connect(&desk_, &StudyDesk::sessionChanged, this, &MainWindow::setSession);
    connect(&desk_, &StudyDesk::nameChanged, this, &MainWindow::updateTitle);
    connect(&desk_.recent(), &RecentFiles::changed, this, &MainWindow::showRecent);
    connect(&frame_->scene(), &scene::SceneView::failed, this,
            [this](const QString& message) { fail(tr("The 3D scene cannot be drawn"), message); });

    Welcome& welcome = frame_->welcome();
    connect(&welcome, &Welcome::importWanted, this, &MainWindow::askForPart);
    connect(&welcome, &Welcome::draftWanted, this, &MainWindow::askForDraft);
    connect(&welcome, &Welcome::tourWanted, this, &MainWindow::startTour);
    connect(&welcome, &Welcome::helpWanted, this, &MainWindow::showHelp);
    connect(&welcome, &Welcome::forgetWanted, this,
            [this](const QString& path) { desk_.recent().remove(QFile::encodeName(path).toStdString()); });
    connect(&welcome, &Welcome::openWanted, this, &MainWindow::askForStudy);
    connect(&welcome, &Welcome::exampleWanted, this, [this] { openExample("cuboid", true); });
    connect(&welcome, &Welcome::studyWanted, this,
            [this](const QString& path) { openStudy(QFile::encodeName(path).toStdString()); });

    // Learning is watched where it is shown.
    connect(&run_, &pages::RunActions::started, this, [this] {
        const QString page = pages_[page_]->face().name;
        if (page == "part" || page == "track") showPage("evolve");
    });

    connect(run_.cluster(), &QAction::triggered, this, &MainWindow::askForCluster);

    // Another drive may have been connected while the study was opened.
    desk_.setGate([this](const std::function<void()>& pass) { farewell_->whenReleased(pass); });

    addFileMenu();
    addEditMenu();
    addViewMenu();
    addRunMenu();
    addHelpMenu();
    addCorner();

    resize(kFirstSize.boundedTo(screen()->availableSize() - kFrameOfWindow));
    restoreGeometry(QSettings().value("window/geometry").toByteArray());
    setSession(nullptr);
    updateTitle();
    // After the window is seen: it reads the disk.
    QTimer::singleShot(0, this, [this] {
        offerRecovery();
        offerTour();
    });
}

MainWindow::~MainWindow() {
    // The pages look at the study until they are gone.
    setSession(nullptr);
}

void MainWindow::openFile(const std::filesystem::path& file) {
    if (isStudy(file)) {
        openStudy(file);
    } else {
        importPart(file, false);
    }
}

void MainWindow::showPage(const QString& name) {
    if (const auto place = findPlace(name)) {
        if (desk_.session() != nullptr) return setPage(*place);
        // Beside the welcome: an import has something to ask.
        if (name == kFirstPage) return docks_->show(*place);
    }
    if (name.isEmpty() && desk_.session() == nullptr) docks_->hideAll();
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!mayClose_ && desk_.session() != nullptr) {
        event->ignore();
        whenClosable([this] { closeForGood(); });
        return;
    }
    docks_->remember();
    QSettings().setValue("window/geometry", saveGeometry());
    if (desk_.isDiscarded()) desk_.close(false);
    event->accept();
}

void MainWindow::closeUnasked() {
    farewell_->whenReleased([this] { closeForGood(); });
}

void MainWindow::closeForGood() {
    mayClose_ = true;
    // Not within the event: a widget that is closing takes no second call.
    QMetaObject::invokeMethod(
        this, [this] { close(); }, Qt::QueuedConnection);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    const QList<QUrl> urls = event->mimeData()->urls();
    if (urls.isEmpty()) return;
    event->acceptProposedAction();
    openFile(QFile::encodeName(urls.front().toLocalFile()).toStdString());
}

void MainWindow::connectPage(pages::Page& page) {
    connect(&page, &pages::Page::failed, this, [this, &page](const QString& what, const QString& message) {
        fail(what, message);
        messageOf_ = &page;
    });
    connect(&page, &pages::Page::pageWanted, this, &MainWindow::showPage);
    connect(&page, &pages::Page::panelWanted, this,
            [this, &page](const QString& panel) { docks_->bringToFront(page, panel); });
    connect(&page, &pages::Page::studyWanted, this, [this](const workflow::LoadedPart& part) {
        whenClosable([this, part] {
            report(tr("No study can be made"), desk_.createDraft(part));
            showPage(std::exchange(pageAfterImport_, kFirstPage));
        });
    });
    connect(&page, &pages::Page::forkWanted, this, [this](session::Fork kind) {
        whenClosable([this, kind] { report(tr("No new study can be made"), desk_.forkToDraft(kind)); });
    });
    if (QWidget* bar = page.sceneBar()) frame_->addBar(page.face().name, bar);
}

void MainWindow::setSession(session::StudySession* session) {
    if (desk_.session() != nullptr) leaveSession(*desk_.session());
    for (pages::Page* page : pages_)
        page->setSession(session);
    run_.setStudy(session != nullptr ? &session->design() : nullptr,
                  session != nullptr ? &session->runs() : nullptr);
    status_->setRuns(session != nullptr ? &session->runs() : nullptr);
    for (QUndoStack* stack : undo_->stacks())
        undo_->removeStack(stack);
    for (QAction* action : studyActions_)
        action->setEnabled(session != nullptr);
    if (session == nullptr) {
        docks_->hideAll();
        frame_->showBar({});
        frame_->scene().clear();
        clearPageMessage();
        page_ = 0;
    } else {
        connect(session, &session::StudySession::failed, this, &MainWindow::failSession);
        connect(&session->design(), &session::StudyDesign::partChanged, this, [this] {
            clearPageMessage();
            updateTitle();
        });
        undo_->addStack(session->design().undoStack());
        undo_->setActiveStack(session->design().undoStack());
        frame_->messages().clear();
        setPage(findPlace(desk_.recent().page(session->path())).value_or(page_));
    }
    rail_->setVisible(session != nullptr);
    status_->setVisible(session != nullptr);
    frame_->showWelcome(session == nullptr);
    showDocks();
    if (session != nullptr) session->runs().followLastJob();
}

/// Before another study takes its place, or none does.
void MainWindow::leaveSession(session::StudySession& session) {
    session.leave(this);
    // What a page still builds must not appear in the scene of the page that comes next.
    pages_[page_]->deactivate();
    if (!desk_.isDiscarded()) desk_.recent().setPage(session.path(), pages_[page_]->face().name);
}

void MainWindow::updateTitle() {
    const QString program = tr("Trapwright");
    // Where dialogs for files begin, and the names that they propose. Before a study is open: where the last
    // one was.
    setWindowFilePath(desk_.session() != nullptr ? desk_.publicPath() : desk_.recent().list().value(0));
    setWindowTitle(desk_.session() == nullptr ? program : QString("%1 - %2").arg(desk_.name(), program));
    if (desk_.session() == nullptr) showRecent();
}

void MainWindow::setPage(std::size_t page) {
    if (page != page_) {
        clearPageMessage();
        pages_[page_]->deactivate();
    }
    page_ = page;
    rail_->setCurrent(page);
    docks_->show(page);
    frame_->showBar(pages_[page]->face().name);
    pages_[page]->activate(frame_->scene());
    showDocks();
}

pages::Page* MainWindow::findPage(const QString& name) const {
    const auto place = findPlace(name);
    return place ? pages_[*place] : nullptr;
}

std::optional<std::size_t> MainWindow::findPlace(const QString& name) const {
    for (std::size_t i = 0; i < pages_.size(); ++i)
        if (pages_[i]->face().name == name) return i;
    return std::nullopt;
}

void MainWindow::offerTour() {
    constexpr auto kOffered = "tour/offered";
    if (desk_.session() != nullptr || desk_.isOpening() || !frame_->messages().text().isEmpty()) return;
    if (QSettings().value(kOffered).toBool()) return;
    QSettings().setValue(kOffered, true);
    frame_->messages().show(look::MessageKind::info, tr("New here?"),
                            tr("A tour shows the window in five steps. It is in the Help menu as well."),
                            {{tr("Take the tour"), [this] { startTour(); }}});
}

void MainWindow::startTour() {
    if (tour_ != nullptr) return;
    if (desk_.session() == nullptr) {
        return openExample("cuboid", false, [this] { startTour(); });
    }
    tour_ = new Tour(*this, windowTour(), [this](const QString& page) { showPage(page); });
    tour_->start();
}

void MainWindow::showHelp() {
    if (help_ == nullptr) help_ = new help::HelpWindow(this);
    const HelpPlace place = findHelp(help_->book(), QApplication::focusWidget(),
                                     desk_.session() != nullptr ? pages_[page_]->face().name : QString());
    help_->showAt(place.page, place.anchor);
}

void MainWindow::report(const QString& what, const base::Status& status) {
    if (!status) fail(what, QString::fromStdString(status.error().message));
}

void MainWindow::fail(const QString& what, const QString& message) {
    frame_->messages().show(look::MessageKind::error, what, message);
    messageOf_ = nullptr;
}

/// A run belongs to the study, and what ends it is told on every page; what else was tried was tried on this
/// one.
void MainWindow::failSession(const QString& what, const QString& message) {
    const RunState state = desk_.session()->runs().state();
    if (!desk_.session()->isInPlace()) {
        frame_->messages().show(look::MessageKind::error, what, message,
                                {{tr("Save a copy..."), [this] { askForSaveAs([] {}); }}});
        messageOf_ = nullptr;
        return;
    }
    fail(what, message);
    if (state == RunState::idle || state == RunState::simulating) messageOf_ = pages_[page_];
}

void MainWindow::clearPageMessage() {
    if (std::exchange(messageOf_, nullptr) != nullptr) frame_->messages().clear();
}

}  // namespace trapwright::window
