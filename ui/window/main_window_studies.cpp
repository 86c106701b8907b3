#include <QLabel>
#include <QMessageBox>
#include <QPushButton>

#include "ui/look/file_dialog.h"
#include "ui/look/message_bar.h"
#include "ui/look/text.h"
#include "ui/pages/cluster_dialog.h"
#include "ui/pages/page.h"
#include "ui/pages/part_files.h"
#include "ui/session/part_import.h"
#include "ui/session/recovery_note.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/window/farewell.h"
#include "ui/window/main_window.h"
#include "ui/window/scene_frame.h"

namespace trapwright::window {

using session::RunState;

namespace {

// Small enough that the example's first winners are seen within some seconds on two cores.
constexpr int kExamplePopulation = 40;
constexpr int kExampleTrials = 40;
constexpr int kExampleGenerations = 60;

QString studyFilter() {
    return MainWindow::tr("Studies (*.trap)");
}

QMessageBox* question(QWidget* parent, const QString& name, const QString& text, const QString& detail) {
    auto* box = new QMessageBox(QMessageBox::Question, MainWindow::tr("Trapwright"), text,
                                QMessageBox::NoButton, parent);
    box->setObjectName(name);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setInformativeText(detail);
    // A part may be called what looks like rich text.
    for (auto* label : box->findChildren<QLabel*>())
        label->setTextFormat(Qt::PlainText);
    return box;
}

QPushButton* addAnswer(QMessageBox* box, const QString& name, const QString& text,
                       QMessageBox::ButtonRole role, QObject* context, const std::function<void()>& act) {
    QPushButton* button = box->addButton(text, role);
    button->setObjectName(name);
    // Another question may follow: this one has to be gone by then.
    QObject::connect(button, &QPushButton::clicked, context, act, Qt::QueuedConnection);
    return button;
}

}  // namespace

void MainWindow::askForPart() {
    look::askForFile(this, pages::partQuestion(),
                     [this](const std::filesystem::path& file) { importPart(file, true); });
}

/// A part to learn quickly with: once it is imported, Evolve tells how long a draft takes, and offers it.
void MainWindow::askForDraft() {
    look::askForFile(this, pages::partQuestion(), [this](const std::filesystem::path& file) {
        importPart(file, true);
        pageAfterImport_ = "evolve";
    });
}

void MainWindow::askForStudy() {
    look::askForFile(this, {"study", tr("Open a study"), tr("Open"), studyFilter(), {}, {}},
                     [this](const std::filesystem::path& file) { openStudy(file); });
}

void MainWindow::askForSaveAs(const std::function<void()>& afterwards) {
    // The name of a study that lost its place is taken, or another's.
    const bool lost = desk_.session() != nullptr && !desk_.session()->isInPlace();
    look::askForNewFile(this,
                        {"study", tr("Save the study as"), tr("Save"), studyFilter(), "trap",
                         lost ? QStringLiteral("rescued") : QString()},
                        [this, afterwards](const std::filesystem::path& file) {
                            const base::Status saved = desk_.saveAs(file);
                            report(tr("The study cannot be saved there"), saved);
                            if (saved) afterwards();
                        });
}

void MainWindow::askForCluster() {
    if (desk_.session() == nullptr) return;
    if (desk_.isDraft()) return askForSaveAs([this] { askForCluster(); });
    showPage("evolve");
    auto* dialog = new pages::ClusterDialog(*desk_.session(), this);
    dialog->open();
}

/// A study with a name is saved already: whoever presses Ctrl+S out of habit is told so.
void MainWindow::save() {
    if (desk_.isDraft()) return askForSaveAs([] {});
    frame_->messages().show(look::MessageKind::info, tr("Everything is saved"),
                            tr("A study keeps each change and each generation as it happens. \"Save as\" "
                               "copies it under another name."));
    messageOf_ = pages_[page_];
}

void MainWindow::importPart(const std::filesystem::path& file, bool asNewStudy) {
    pageAfterImport_ = "part";
    const auto import = [this, file] {
        frame_->messages().clear();
        pages::Page* page = findPage("part");
        page->takeFile(file);
    };
    if (!asNewStudy || desk_.session() == nullptr) return import();
    whenClosable([this, import] {
        desk_.close(true);
        import();
    });
}

void MainWindow::openStudy(const std::filesystem::path& file, bool learn) {
    if (desk_.session() != nullptr && desk_.session()->path() == file) return;
    whenClosable([this, file, learn] {
        desk_.open(file, [this, file, learn](const base::Status& opened) {
            report(tr("The study cannot be opened"), opened);
            if (!opened || !learn) return;
            showPage("evolve");
            desk_.session()->runs().startLearning();
        });
    });
}

void MainWindow::openExample(const QString& name, bool learn, const std::function<void()>& afterwards) {
    whenClosable([this, name, learn, afterwards] {
        auto* import = new session::PartImport(this);
        connect(import, &session::PartImport::failed, this,
                [this, import](const workflow::PartRequest&, const QString& message) {
                    import->deleteLater();
                    fail(tr("The example cannot be opened"), message);
                });
        connect(import, &session::PartImport::finished, this,
                [this, import, learn, afterwards](const workflow::LoadedPart& part) {
                    import->deleteLater();
                    const base::Status created = desk_.createDraft(part);
                    report(tr("The example cannot be opened"), created);
                    if (!created) return;
                    if (!learn) return afterwards();
                    study::Settings settings = desk_.session()->design().settings();
                    settings.evolution.populationSize = kExamplePopulation;
                    settings.evolution.trialsPerEvaluation = kExampleTrials;
                    settings.evolution.generations = kExampleGenerations;
                    desk_.session()->design().changeSettings(settings, tr("Example"));
                    showPage("evolve");
                    desk_.session()->runs().startLearning();
                });
        import->start(pages::partRequest(name.toStdString()));
    });
}

void MainWindow::openLearnedExample(const workflow::ExampleStudy& example) {
    whenClosable([this, example] {
        desk_.openExample(example, [this](const base::Status& opened) {
            report(tr("The example cannot be opened"), opened);
            if (opened) showPage("review");
        });
    });
}

void MainWindow::offerRecovery() {
    // Who starts with a study in hand is asked the next time.
    if (desk_.session() != nullptr || desk_.isOpening()) return;
    const auto interrupted = session::takeInterruptedStudies(desk_.environment().stateFolder);
    if (interrupted.empty()) return;
    const std::filesystem::path& study = interrupted.front();
    frame_->messages().show(
        look::MessageKind::warning,
        tr("%1 was learning when the program ended").arg(look::toText(study.stem())),
        tr("Every generation that was complete is saved. Learning can go on where it stopped."),
        {{tr("Go on learning"), [this, study] { openStudy(study, true); }},
         {tr("Only open it"), [this, study] { openStudy(study); }}});
}

void MainWindow::whenClosable(const std::function<void()>& afterwards) {
    const session::StudySession* session = desk_.session();
    const RunState state = session == nullptr ? RunState::idle : session->runs().state();
    // A job of a cluster goes on by itself.
    if (state == RunState::idle || state == RunState::simulating || state == RunState::following) {
        return whenSaved([this, afterwards] { farewell_->whenReleased(afterwards); });
    }

    const bool learns = !session::isJudging(state);
    QMessageBox* box = question(this, "dialog.running",
                                learns ? tr("The study is learning.") : tr("The study is simulating."),
                                learns ? tr("All complete generations are saved. What is done of the present "
                                            "one is lost if it stops now.")
                                       : tr("What is not complete is lost if it stops now."));
    if (learns) {
        addAnswer(box, "answer.stopAfter", tr("Stop after this generation"), QMessageBox::AcceptRole, this,
                  [this, afterwards] {
                      desk_.session()->runs().stopAfterGeneration();
                      whenIdle([this, afterwards] { whenClosable(afterwards); });
                  });
    }
    addAnswer(box, "answer.stopNow", tr("Stop now"), QMessageBox::DestructiveRole, this, [this, afterwards] {
        desk_.session()->runs().stopNow();
        whenIdle([this, afterwards] { whenClosable(afterwards); });
    });
    box->setDefaultButton(
        addAnswer(box, "answer.goOn", tr("Keep it running"), QMessageBox::RejectRole, this, [] {}));
    box->open();
}

void MainWindow::whenIdle(const std::function<void()>& afterwards) {
    // While the question was open the run may have ended by itself.
    if (desk_.session()->runs().state() == RunState::idle) return afterwards();
    auto* waiting = new QObject(this);
    connect(&desk_.session()->runs(), &session::StudyRuns::stateChanged, waiting,
            [this, waiting, afterwards](RunState now) {
                if (now != RunState::idle) return;
                waiting->deleteLater();
                QMetaObject::invokeMethod(this, afterwards, Qt::QueuedConnection);
            });
}

void MainWindow::whenSaved(const std::function<void()>& afterwards) {
    if (!desk_.isDraft()) return afterwards();
    // What was only looked at asks no question.
    session::StudySession& session = *desk_.session();
    if (session.runs().summaries().empty() && session.runs().state() == RunState::idle &&
        session.design().undoStack()->isClean()) {
        desk_.discardLater();
        return afterwards();
    }
    QMessageBox* box =
        question(this, "dialog.draft",
                 tr("Save the study of %1?").arg(QString::fromStdString(session.design().part()->name)),
                 tr("It has no file of its own yet."));
    box->setDefaultButton(addAnswer(box, "answer.save", tr("Save as..."), QMessageBox::AcceptRole, this,
                                    [this, afterwards] { askForSaveAs(afterwards); }));
    addAnswer(box, "answer.discard", tr("Discard it"), QMessageBox::DestructiveRole, this,
              [this, afterwards] {
                  desk_.discardLater();
                  afterwards();
              });
    addAnswer(box, "answer.cancel", tr("Cancel"), QMessageBox::RejectRole, this, [] {});
    box->open();
}

}  // namespace trapwright::window
