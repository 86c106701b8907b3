#include <QActionGroup>
#include <QApplication>
#include <QFile>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QToolBar>
#include <QToolButton>
#include <QUndoGroup>

#include "core/part/bundled.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/pages/export_page.h"
#include "ui/pages/page.h"
#include "ui/window/main_window.h"
#include "ui/window/page_docks.h"
#include "ui/window/rail.h"
#include "ui/window/scene_frame.h"
#include "ui/window/shortcut_list.h"
#include "ui/window/welcome.h"

namespace trapwright::window {

namespace {

template <class Target, class Slot>
QAction* addItem(QMenu& menu, const QString& name, const QString& icon, const QString& text,
                 const QKeySequence& key, Target* target, Slot slot) {
    QAction* action = menu.addAction(icon.isEmpty() ? QIcon() : look::icon(icon), text);
    action->setObjectName(name);
    action->setShortcut(key);
    QObject::connect(action, &QAction::triggered, target, slot);
    return action;
}

QString choiceName(look::ThemeChoice choice) {
    switch (choice) {
        case look::ThemeChoice::system:
            return "system";
        case look::ThemeChoice::light:
            return "light";
        case look::ThemeChoice::dark:
            return "dark";
    }
    return {};
}

}  // namespace

void MainWindow::addFileMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&File"));
    addItem(menu, "file.new", "new", tr("&New study..."), QKeySequence::New, this, &MainWindow::askForPart);
    // The Part page's own, here for all the others and for the start.
    menu.addAction(findPage("part")->findChild<QAction*>("part.import"));
    addItem(menu, "file.open", "open", tr("&Open study..."), QKeySequence::Open, this,
            &MainWindow::askForStudy);
    recentMenu_ = menu.addMenu(look::icon("recent"), tr("Open &recent"));
    recentMenu_->setObjectName("menu.recent");
    QMenu& examples = *menu.addMenu(look::icon("example"), tr("Start with an &example part"));
    examples.setObjectName("menu.examples");
    for (const part::BundledPart& part : part::listBundledParts()) {
        const QString name = look::fromUtf8(part.name);
        const QString text = look::fromUtf8(part.description);
        addItem(examples, "example." + name, {}, text, {}, this, [this, name] { openExample(name, false); });
    }
    QMenu& learned = *menu.addMenu(look::icon("review"), tr("Open a &learned example"));
    learned.setObjectName("menu.learnedExamples");
    for (const workflow::ExampleStudy& example : workflow::listExampleStudies()) {
        const QString text = tr("%1: %2").arg(look::toText(example.name), look::toText(example.description));
        addItem(learned, "learned." + look::toText(example.name), {}, text, {}, this,
                [this, example] { openLearnedExample(example); });
    }
    menu.addSeparator();
    studyActions_ << addItem(menu, "file.save", {}, tr("&Save"), QKeySequence(Qt::CTRL | Qt::Key_S), this,
                             &MainWindow::save);
    studyActions_ << addItem(menu, "file.saveAs", "save-as", tr("Save &as..."),
                             QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S), this,
                             [this] { askForSaveAs([] {}); });
    QMenu& exports = *menu.addMenu(look::icon("printer"), tr("E&xport the track"));
    exports.setObjectName("menu.export");
    const auto addExport = [&](const QString& format, const QString& text) {
        studyActions_ << addItem(exports, "file.export." + format, {}, text, {}, this, [this, format] {
            showPage("export");
            if (auto* page = findChild<pages::ExportPage*>()) page->exportWhenBuilt(format);
        });
    };
    addExport("stl", tr("&STL, for printing..."));
    addExport("3mf", tr("&3MF, for printing..."));
    addExport("step", tr("S&TEP, for machining..."));
    studyActions_ << addItem(menu, "file.close", "close", tr("&Close study"),
                             QKeySequence(Qt::CTRL | Qt::Key_W), this,
                             [this] { whenClosable([this] { desk_.close(true); }); });
    menu.addSeparator();
    addItem(menu, "file.quit", {}, tr("&Quit"), QKeySequence(Qt::CTRL | Qt::Key_Q), this, &MainWindow::close);
}

void MainWindow::addEditMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&Edit"));
    QAction* undo = undo_->createUndoAction(this, tr("&Undo"));
    QAction* redo = undo_->createRedoAction(this, tr("&Redo"));
    undo->setObjectName("edit.undo");
    redo->setObjectName("edit.redo");
    undo->setProperty(kLastingText, tr("Undo"));
    redo->setProperty(kLastingText, tr("Redo"));
    undo->setIcon(look::icon("undo"));
    redo->setIcon(look::icon("redo"));
    undo->setShortcut(QKeySequence::Undo);
    redo->setShortcuts({QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z), QKeySequence(Qt::CTRL | Qt::Key_Y)});
    menu.addAction(undo);
    menu.addAction(redo);
}

void MainWindow::addViewMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&View"));
    for (QAction* action : rail_->actions()) {
        menu.addAction(action);
        studyActions_ << action;
    }
    menu.addSeparator();
    QMenu& scene = *menu.addMenu(look::icon("view-iso"), tr("&Scene"));
    scene.addActions(frame_->scene().viewActions());
    studyActions_ << frame_->scene().viewActions();
    docksMenu_ = menu.addMenu(look::icon("table"), tr("&Panels"));
    menu.addSeparator();

    QMenu& themes = *menu.addMenu(look::icon("theme"), tr("&Theme"));
    auto* group = new QActionGroup(this);
    const QString stored = QSettings().value("theme").toString();
    const std::vector<std::pair<look::ThemeChoice, QString>> choices = {
        {look::ThemeChoice::system, tr("&System")},
        {look::ThemeChoice::light, tr("&Light")},
        {look::ThemeChoice::dark, tr("&Dark")}};
    for (const auto& [choice, text] : choices) {
        QAction* action =
            addItem(themes, "theme." + choiceName(choice), {}, text, {}, this, [this, choice = choice] {
                theme_.choose(choice);
                QSettings().setValue("theme", choiceName(choice));
            });
        action->setCheckable(true);
        group->addAction(action);
        if (choiceName(choice) == stored) theme_.choose(choice);
        action->setChecked(choice == theme_.choice());
    }
    QAction* full = addItem(menu, "view.fullScreen", {}, tr("&Full screen"), Qt::Key_F11, this,
                            [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
    full->setCheckable(true);
    connect(&menu, &QMenu::aboutToShow, full, [this, full] { full->setChecked(isFullScreen()); });
}

void MainWindow::addRunMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&Run"));
    menu.addActions({run_.start(), run_.draft(), run_.corners(), run_.cluster(), run_.pause(),
                     run_.stopAfterGeneration(), run_.stopNow()});
}

void MainWindow::addHelpMenu() {
    QMenu& menu = *menuBar()->addMenu(tr("&Help"));
    addItem(menu, "help.open", "help", tr("&Help on this place"), Qt::Key_F1, this, &MainWindow::showHelp);
    addItem(menu, "help.tour", "tour", tr("&Tour"), {}, this, &MainWindow::startTour);
    addItem(menu, "help.shortcuts", "keyboard", tr("&Keyboard shortcuts"), Qt::CTRL | Qt::Key_F1, this,
            [this] { showShortcuts(this, findShortcuts(*this)); });
    addItem(menu, "help.about", "info", tr("&About Trapwright"), {}, this, [this] {
        auto* box = new QMessageBox(this);
        box->setObjectName("dialog.about");
        box->setAttribute(Qt::WA_DeleteOnClose);
        box->setWindowTitle(tr("About Trapwright"));
        box->setIconPixmap(look::programIcon().pixmap(64, 64));
        box->setText(
            tr("<b>%1</b><p>Designs tracks for vibratory part feeders: a genetic algorithm grows them, "
               "rigid-body contact simulation judges them.</p><p>Free software under the GNU General Public "
               "License, version 3 or later. Without any warranty.</p>")
                .arg(QString::fromStdString(desk_.environment().program)));
        box->setStandardButtons(QMessageBox::Close);
        box->open();
    });
}

void MainWindow::addCorner() {
    auto* bar = new QToolBar(this);
    bar->setObjectName("corner");
    bar->setIconSize({18, 18});
    bar->setStyleSheet("#corner { border: none; padding: 1px 4px; }");
    for (const char* name : {"edit.undo", "edit.redo"})
        bar->addAction(findChild<QAction*>(name));
    bar->addSeparator();
    bar->addActions({run_.start(), run_.pause(), run_.stopAfterGeneration()});
    for (QAction* action : bar->actions()) {
        auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action));
        if (button == nullptr) continue;
        button->setFocusPolicy(Qt::TabFocus);
        if (action != run_.start()) continue;
        // A menu bar does not make room for a text that grows: "Start" becomes "Go on" and "Resume".
        button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        constexpr int kRoom = 36;
        button->setMinimumWidth(button->fontMetrics().horizontalAdvance(tr("Resume learning")) + kRoom);
    }
    menuBar()->setCornerWidget(bar);
}

void MainWindow::showRecent() {
    const QStringList studies = desk_.recent().list();
    frame_->welcome().setRecent(studies, desk_.forgottenDrafts());
    recentMenu_->clear();
    for (const QString& study : studies) {
        addItem(*recentMenu_, "recent." + study, {}, look::pathText(study.toStdString()).replace('&', "&&"),
                {}, this, [this, study] { openStudy(QFile::encodeName(study).toStdString()); })
            ->setEnabled(QFile::exists(study));
    }
    recentMenu_->addSeparator();
    addItem(*recentMenu_, "recent.clear", {}, tr("&Clear this list"), {}, &desk_.recent(),
            &RecentFiles::clear);
    recentMenu_->setEnabled(!studies.isEmpty());
}

void MainWindow::showDocks() {
    docksMenu_->clear();
    docksMenu_->addActions(docks_->toggles());
    docksMenu_->addSeparator();
    addItem(*docksMenu_, "docks.reset", "reset", tr("&Reset the layout"), {}, docks_, &PageDocks::reset);
    docksMenu_->setEnabled(desk_.session() != nullptr);
}

}  // namespace trapwright::window
