#include "ui/pages/export_page.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <utility>

#include "core/study/selection.h"
#include "ui/look/file_dialog.h"
#include "ui/look/folding_group.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/pages/part_files.h"
#include "ui/pages/print_findings.h"
#include "ui/pages/print_form.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

namespace {

constexpr int kGeneration = Qt::UserRole;
constexpr int kIndividual = Qt::UserRole + 1;

}  // namespace

ExportPage::ExportPage(QWidget* parent)
    : Page({"export", tr("Export"), "export", tr("The track as a solid to print, with walls and a mount")},
           parent),
      contents_(new QWidget(this)),
      empty_(new QLabel(this)),
      tracks_(new QComboBox(contents_)),
      form_(new PrintForm(contents_)),
      findings_(new PrintFindings(contents_)),
      state_(new QLabel(this)),
      help_(new QLabel(this)) {
    empty_->setObjectName("export.empty");
    empty_->setWordWrap(true);
    empty_->setMargin(12);
    empty_->setText(tr("There is no track to print yet. <a href=\"evolve\">Learn one first</a>"));
    connect(empty_, &QLabel::linkActivated, this, &Page::pageWanted);

    tracks_->setObjectName("export.track");
    tracks_->setAccessibleName(tr("Track to print"));
    tracks_->setToolTip(tr("The first of the last selection, unless another one is picked"));
    tracks_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    connect(tracks_, &QComboBox::activated, this, [this] {
        const auto winner = session_->loadWinner(tracks_->currentData(kGeneration).toInt(),
                                                 tracks_->currentData(kIndividual).toInt());
        if (!winner)
            return emit failed(tr("The track cannot be read"),
                               QString::fromStdString(winner.error().message));
        session_->choose(*winner);
        build();
    });

    auto* found = new look::FoldingGroup("print.found", tr("Solid"), false, contents_);
    found->body()->addWidget(findings_);
    auto* column = new QVBoxLayout(contents_);
    column->setContentsMargins(12, 12, 12, 12);
    column->setSpacing(8);
    column->addWidget(tracks_);
    column->addWidget(found);
    column->addWidget(form_);
    column->addStretch(1);
    auto* scroll = new QScrollArea(this);
    scroll->setWidget(contents_);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(empty_);
    layout->addWidget(scroll, 1);
    foot_ = makeFoot();
    layout->addWidget(foot_);

    connect(form_, &PrintForm::edited, this, &ExportPage::build);
    connect(form_, &PrintForm::attended, this, [this](const QString& label, const QString& help) {
        help_->setText("<b>" + label.toHtmlEscaped() + "</b>&nbsp; " + help.toHtmlEscaped());
    });
    connect(findings_, &PrintFindings::highlightsChanged, this, [this] {
        if (scene_ != nullptr && shown_) scene_->setHighlights(findings_->highlights());
    });
    connect(&print_, &session::PrintBuild::built, this, &ExportPage::take);
    connect(
        &print_, &session::PrintBuild::failed, this, [this](const QString& option, const QString& message) {
            form_->setProblem(option, message);
            setState(option.isEmpty() ? message : tr("Correct the marked value; then the solid is built."));
        });
    connect(&print_, &session::PrintBuild::written, this, [this](const work::ExportedFile& file) {
        enableExport();
        setState(tr("Wrote %1: %2, %3 cm³. Read back: closed and manifold.")
                     .arg(look::pathText(file.path), sizeText(file.size),
                          look::numberText(file.report.volume * 1e6)));
    });
    connect(&print_, &session::PrintBuild::notWritten, this, [this](const QString& message) {
        enableExport();
        setState({});
        emit failed(tr("The track was not exported"), message);
    });
    refresh();
}

QWidget* ExportPage::makeFoot() {
    auto* foot = new QWidget(this);
    foot->setObjectName("export.foot");
    foot->setStyleSheet("#export\\.foot { border-top: 1px solid palette(mid); }");
    // Always as high, so that the form does not move while the mouse passes over it.
    constexpr int kHelpLines = 3;
    help_->setObjectName("export.help");
    help_->setWordWrap(true);
    help_->setTextFormat(Qt::RichText);
    help_->setAlignment(Qt::AlignTop);
    help_->setFixedHeight(kHelpLines * help_->fontMetrics().lineSpacing() + 2);
    help_->setText(tr("Point at a field to read what it means."));
    state_->setObjectName("export.state");
    state_->setWordWrap(true);
    state_->setTextInteractionFlags(Qt::TextSelectableByMouse);

    auto* layout = new QVBoxLayout(foot);
    layout->setContentsMargins(12, 8, 12, 12);
    layout->setSpacing(8);
    layout->addWidget(help_);
    layout->addWidget(state_);
    auto* row = new QHBoxLayout;
    layout->addLayout(row);
    addExport("stl", tr("Export &STL..."), QKeySequence(Qt::CTRL | Qt::Key_E));
    addExport("3mf", tr("Export &3MF..."), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_E));
    for (QAction* action : exports_) {
        auto* button = new QToolButton(foot);
        button->setObjectName(action->objectName() + "Button");
        button->setDefaultAction(action);
        look::drawAsButton(*button);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        row->addWidget(button);
    }
    return foot;
}

void ExportPage::addExport(const QString& format, const QString& text, const QKeySequence& key) {
    auto* action = new QAction(look::icon("printer"), text, this);
    action->setObjectName("export." + format);
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, [this, format] { askForPath(format); });
    addAction(action);
    exports_ << action;
}

void ExportPage::setSession(session::StudySession* session) {
    if (session_) session_->disconnect(this);
    session_ = session;
    print_.cancel();
    printed_.reset();
    shown_.reset();
    findings_->clear();
    if (session_) {
        using session::StudySession;
        connect(session_, &StudySession::settingsChanged, this, &ExportPage::refresh);
        connect(session_, &StudySession::generationSaved, this, [this] {
            listStale_ = scene_ == nullptr;
            if (!listStale_) refresh();
        });
        connect(session_, &StudySession::selectionSaved, this, &ExportPage::refresh);
        connect(session_, &StudySession::chosenChanged, this, &ExportPage::refresh);
    }
    refresh();
}

void ExportPage::activate(scene::SceneView& scene) {
    scene_ = &scene;
    if (std::exchange(listStale_, false)) refresh();
    showScene();
    if (stale_) build();
}

void ExportPage::deactivate() {
    if (scene_ != nullptr) scene_->setHighlights({});
    scene_ = nullptr;
}

void ExportPage::refresh() {
    const bool any = session_ && !session_->winners().empty();
    empty_->setVisible(!any);
    contents_->setVisible(any);
    foot_->setVisible(any);
    if (session_) {
        const study::TrackSettings& settings = session_->settings().track;
        form_->setDesign(settings.baseThickness, settings.shape.type == track::FeederType::bowl);
    }
    const QVariant before = tracks_->currentData(kGeneration);
    const QVariant beforeIndividual = tracks_->currentData(kIndividual);
    fillTracks();
    const bool other =
        before != tracks_->currentData(kGeneration) || beforeIndividual != tracks_->currentData(kIndividual);
    if (other || !any) build();
}

void ExportPage::fillTracks() {
    tracks_->clear();
    if (!session_) return;
    const auto add = [this](const QString& text, int ofGeneration, int number) {
        tracks_->addItem(text);
        tracks_->setItemData(tracks_->count() - 1, ofGeneration, kGeneration);
        tracks_->setItemData(tracks_->count() - 1, number, kIndividual);
    };
    if (!session_->selections().empty()) {
        int place = 0;
        for (const study::SelectionEntry& entry : session_->selections().back().entries) {
            add(tr("Selected, place %1: generation %2, individual %3")
                    .arg(++place)
                    .arg(entry.generation)
                    .arg(entry.individual),
                entry.generation, entry.individual);
        }
    }
    const std::vector<study::Winner>& winners = session_->winners();
    for (const study::Winner& winner : study::rankWinners(winners, static_cast<int>(winners.size()))) {
        add(tr("Generation %1, individual %2: fitness %3")
                .arg(winner.generation)
                .arg(winner.individual)
                .arg(look::numberText(winner.record.fitness.total())),
            winner.generation, winner.individual);
    }
    const auto chosen = session_->chosen();
    for (int i = 0; chosen && i < tracks_->count(); ++i) {
        if (tracks_->itemData(i, kGeneration) == chosen->generation &&
            tracks_->itemData(i, kIndividual) == chosen->individual)
            return tracks_->setCurrentIndex(i);
    }
}

void ExportPage::build() {
    printed_.reset();
    enableExport();
    stale_ = scene_ == nullptr;
    print_.cancel();
    if (stale_) return;
    if (!session_ || tracks_->count() == 0) {
        setState({});
        return showScene();
    }
    const int generation = tracks_->currentData(kGeneration).toInt();
    const int individual = tracks_->currentData(kIndividual).toInt();
    const auto winner = session_->loadWinner(generation, individual);
    if (!winner)
        return emit failed(tr("The track cannot be read"), QString::fromStdString(winner.error().message));
    setState(tr("Building the solid ..."));
    const std::string about = tr("%1, generation %2, individual %3")
                                  .arg(look::toText(session_->path().stem()))
                                  .arg(generation)
                                  .arg(individual)
                                  .toStdString();
    print_.build({session_->settings().track, winner->record.chromosome, about, form_->choice().options,
                  form_->choice().limits});
}

void ExportPage::take(const std::shared_ptr<const session::PrintedTrack>& printed) {
    printed_ = printed;
    shown_ = printed->solid;
    form_->setProblem({}, {});
    findings_->show(printed->report);
    setState({});
    enableExport();
    showScene();
}

void ExportPage::setState(const QString& text) {
    state_->setText(text);
    state_->setVisible(!text.isEmpty());
}

void ExportPage::enableExport() {
    for (QAction* action : exports_)
        action->setEnabled(printed_ && printed_->report.closed && !print_.writing());
}

void ExportPage::askForPath(const QString& format) {
    const QString upper = format.toUpper();
    const look::FileQuestion question{"print",      tr("Export %1").arg(upper),
                                      tr("Export"), tr("%1 files (*.%2)").arg(upper, format),
                                      format,       {}};
    look::askForNewFile(this, question, [this, printed = printed_](const std::filesystem::path& file) {
        setState(tr("Writing %1 ...").arg(look::toText(file.filename())));
        print_.write(printed, file);
        enableExport();
    });
}

void ExportPage::showScene() {
    if (scene_ == nullptr) return;
    if (!shown_) return scene_->clear();
    scene_->showPart(nullptr);
    scene_->showSolid(shown_);
    scene_->setHighlights(findings_->highlights());
}

}  // namespace trapwright::pages
