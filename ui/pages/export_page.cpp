#include "ui/pages/export_page.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "core/study/selection.h"
#include "ui/look/file_dialog.h"
#include "ui/look/folding_group.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"
#include "ui/pages/mend_card.h"
#include "ui/pages/part_files.h"
#include "ui/pages/print_findings.h"
#include "ui/pages/print_form.h"
#include "ui/pages/split_form.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

namespace {

constexpr int kGeneration = Qt::UserRole;
constexpr int kIndividual = Qt::UserRole + 1;
const QColor kCut(0x00, 0x72, 0xb2);  // of the Okabe-Ito palette
constexpr int kCircleSides = 24;

/// The circles at a hole's ends, and its axis.
std::vector<std::vector<base::Vec3>> outlineHole(const track::DowelHole& hole, const base::Vec3& shift) {
    const base::Vec3 mouth = hole.mouth + shift;
    const base::Vec3 end = mouth + hole.depth * hole.axis;
    const base::Vec3 up = hole.axis.unitOrthogonal();
    const base::Vec3 aside = hole.axis.cross(up);
    std::vector<std::vector<base::Vec3>> lines = {{mouth, end}};
    for (const base::Vec3& middle : {mouth, end}) {
        std::vector<base::Vec3>& circle = lines.emplace_back();
        for (int i = 0; i <= kCircleSides; ++i) {
            const double angle = 2.0 * base::kPi * i / kCircleSides;
            circle.push_back(middle + hole.radius * (std::cos(angle) * up + std::sin(angle) * aside));
        }
    }
    return lines;
}

}  // namespace

ExportPage::ExportPage(QWidget* parent)
    : Page({"export", tr("Export"), "export", tr("The track as a solid to print, with walls and a mount")},
           parent),
      contents_(new QWidget(this)),
      empty_(new QLabel(this)),
      tracks_(new QComboBox(contents_)),
      form_(new PrintForm(contents_)),
      findings_(new PrintFindings(contents_)),
      mend_(new MendCard(contents_)),
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
        const auto winner = session_->runs().loadIndividual(shownTrack());
        if (!winner)
            return emit failed(tr("The track cannot be read"),
                               QString::fromStdString(winner.error().message));
        session_->runs().choose(*winner);
        build();
    });

    auto* found = new look::FoldingGroup("print.found", tr("Checks"), false, contents_);
    found->body()->addWidget(findings_);
    found->body()->addWidget(mend_);
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
    connect(form_, &PrintForm::apartChanged, this, &ExportPage::showScene);
    connect(form_, &PrintForm::failed, this, &Page::failed);
    const auto help = [this](const QString& label, const QString& text) {
        help_->setText("<b>" + label.toHtmlEscaped() + "</b>&nbsp; " + text.toHtmlEscaped());
    };
    connect(form_, &PrintForm::attended, this, help);
    connect(findings_, &PrintFindings::attended, this, help);
    connect(findings_, &PrintFindings::highlightsChanged, this, [this] {
        if (scene_ != nullptr && shown_) scene_->setHighlights(highlights());
    });
    connect(&print_, &session::PrintBuild::built, this, &ExportPage::take);
    connect(
        &print_, &session::PrintBuild::failed, this, [this](const QString& option, const QString& message) {
            form_->setProblem(option, message);
            setState(option.isEmpty() ? message : tr("Correct the marked value; then the solid is built."));
        });
    connect(&print_, &session::PrintBuild::written, this, &ExportPage::tellWritten);
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
    addExport("step", tr("Export S&TEP..."), {});
    exports_.back()->setToolTip(tr("For machining: one solid of plane faces in mm"));
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
    action->setIconText(format.toUpper() + "...");
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, [this, format] { exportAs(format); });
    addAction(action);
    exports_ << action;
}

void ExportPage::setSession(session::StudySession* session) {
    if (session_) session_->leave(this);
    session_ = session;
    print_.cancel();
    printed_.reset();
    shown_.reset();
    findings_->clear();
    mend_->setRuns(session_ ? &session_->runs() : nullptr);
    if (session_) {
        using session::StudyDesign;
        using session::StudyRuns;
        connect(&session_->design(), &StudyDesign::settingsChanged, this, &ExportPage::refresh);
        connect(&session_->runs(), &StudyRuns::generationSaved, this, [this] {
            listStale_ = scene_ == nullptr;
            if (!listStale_) refresh();
        });
        connect(&session_->runs(), &StudyRuns::selectionSaved, this, &ExportPage::refresh);
        connect(&session_->runs(), &StudyRuns::chosenChanged, this, &ExportPage::refresh);
        connect(&session_->runs(), &StudyRuns::validationSaved, this, [this] {
            if (printed_) take(printed_);
        });
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
    wanted_.clear();
    if (scene_ != nullptr) scene_->setHighlights({});
    scene_ = nullptr;
}

void ExportPage::refresh() {
    const bool any = session_ && !session_->runs().winners().empty();
    empty_->setVisible(!any);
    contents_->setVisible(any);
    foot_->setVisible(any);
    if (session_) {
        const study::TrackSettings& settings = session_->design().settings().track;
        form_->setDesign(settings.baseThickness, settings.shape.type == track::FeederType::bowl,
                         settings.walls.any());
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
    if (!session_->runs().selections().empty()) {
        int place = 0;
        for (const study::SelectionEntry& entry : session_->runs().selections().back().entries) {
            const QString text = session_->runs().mendedFrom(entry.generation)
                                     ? tr("Selected, place %1: generation %2, individual %3, mended")
                                     : tr("Selected, place %1: generation %2, individual %3");
            add(text.arg(++place).arg(entry.generation).arg(entry.individual), entry.generation,
                entry.individual);
        }
    }
    const std::vector<study::Individual>& winners = session_->runs().winners();
    for (const study::Individual& winner : study::rankWinners(winners, static_cast<int>(winners.size()))) {
        add(tr("Generation %1, individual %2: %3")
                .arg(winner.generation)
                .arg(winner.individual)
                .arg(models::successWord(winner.record.success())),
            winner.generation, winner.individual);
    }
    const auto chosen = session_->runs().chosen();
    if (!chosen) return;
    for (int i = 0; i < tracks_->count(); ++i) {
        if (tracks_->itemData(i, kGeneration) == chosen->generation &&
            tracks_->itemData(i, kIndividual) == chosen->individual)
            return tracks_->setCurrentIndex(i);
    }
    // Any individual can be made the final one.
    add(tr("Final: generation %1, individual %2").arg(chosen->generation).arg(chosen->individual),
        chosen->generation, chosen->individual);
    tracks_->setCurrentIndex(tracks_->count() - 1);
}

study::IndividualId ExportPage::shownTrack() const {
    return {tracks_->currentData(kGeneration).toInt(), tracks_->currentData(kIndividual).toInt()};
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
    const study::IndividualId id = shownTrack();
    const auto winner = session_->runs().loadIndividual(id);
    if (!winner)
        return emit failed(tr("The track cannot be read"), QString::fromStdString(winner.error().message));
    setState(tr("Building the solid ..."));
    const std::string about = tr("%1, generation %2, individual %3")
                                  .arg(look::toText(session_->path().stem()))
                                  .arg(id.generation)
                                  .arg(id.individual)
                                  .toStdString();
    const PrintChoice& choice = form_->choice();
    print_.build({session_->design().settings().track, winner->record.design, about, choice.options,
                  choice.limits, form_->printer().space, form_->split().mode(), form_->split().options()});
}

void ExportPage::take(const std::shared_ptr<const session::PrintedTrack>& printed) {
    printed_ = printed;
    shown_ = printed;
    form_->setProblem({}, {});
    form_->show(*printed);
    findings_->show(*printed, successOfTrack(), form_->choice(), form_->printer());
    if (const auto track = session_->runs().loadIndividual(shownTrack()))
        mend_->show(*track, *printed, form_->choice().limits);
    setState({});
    enableExport();
    showScene();
    if (const QString format = std::exchange(wanted_, {}); !format.isEmpty() && exports_.front()->isEnabled())
        exportAs(format);
}

void ExportPage::exportWhenBuilt(const QString& format) {
    if (printed_ && exports_.front()->isEnabled()) return exportAs(format);
    wanted_ = format;
}

std::optional<study::TrackSuccess> ExportPage::successOfTrack() const {
    const auto winner = session_->runs().loadIndividual(shownTrack());
    if (!winner) return std::nullopt;
    return session_->runs().findSuccess(*winner);
}

void ExportPage::exportAs(const QString& format) {
    const auto success = successOfTrack();
    if (!success || success->rate >= findings_->leastSuccess()) return askForPath(format, printed_);
    auto* question = new QMessageBox(this);
    question->setObjectName("dialog.success");
    question->setAttribute(Qt::WA_DeleteOnClose);
    question->setIcon(QMessageBox::Warning);
    question->setWindowTitle(tr("Export the track"));
    question->setText(tr("Success of this track: %1. Export it all the same?").arg(successText(*success)));
    question->setInformativeText(
        tr("You want to be asked below %1 %.").arg(look::numberText(100.0 * findings_->leastSuccess())));
    QPushButton* yes = question->addButton(tr("Export it"), QMessageBox::AcceptRole);
    yes->setObjectName("dialog.success.export");
    question->setDefaultButton(question->addButton(QMessageBox::Cancel));
    // The track that the question named, though learning may have put a better one in its place since.
    connect(yes, &QPushButton::clicked, this,
            [this, format, printed = printed_] { askForPath(format, printed); });
    question->open();
}

void ExportPage::setState(const QString& text) {
    state_->setText(text);
    state_->setVisible(!text.isEmpty());
}

void ExportPage::enableExport() {
    for (QAction* action : exports_)
        action->setEnabled(printed_ && printed_->report.closed && !printed_->pieces.empty() &&
                           !print_.writing());
}

void ExportPage::askForPath(const QString& format,
                            const std::shared_ptr<const session::PrintedTrack>& printed) {
    const QString upper = format.toUpper();
    const look::FileQuestion question{"print",      tr("Export %1").arg(upper),
                                      tr("Export"), tr("%1 files (*.%2)").arg(upper, format),
                                      format,       "track"};
    look::askForNewFile(this, question, [this, printed](const std::filesystem::path& file) {
        setState(tr("Writing %1 ...").arg(look::toText(file.filename())));
        print_.write(printed, file);
        enableExport();
    });
}

void ExportPage::tellWritten(const std::vector<workflow::ExportedFile>& files) {
    enableExport();
    const workflow::ExportedFile& first = files.front();
    if (files.size() > 1) {
        return setState(
            tr("Wrote %1 and the other pieces, %2 files in all. Read back: each closed and manifold.")
                .arg(look::pathText(first.path))
                .arg(files.size()));
    }
    const QString what = first.solids > 1 ? tr("%n pieces, ", nullptr, first.solids) : QString();
    setState(tr("Wrote %1: %2%3, %4 cm³. Read back: closed and manifold.")
                 .arg(look::pathText(first.path), what, sizeText(first.size),
                      look::numberText(first.volume * 1e6)));
}

std::vector<scene::Highlight> ExportPage::highlights() const {
    const bool apart = form_->split().apart() && shown_->isCut();
    std::vector<scene::Highlight> highlights;
    // What is wrong lies on the whole.
    if (!apart) highlights = findings_->highlights();
    for (std::size_t i = 0; shown_->isCut() && i < shown_->pieces.size(); ++i) {
        const track::PrintPiece& piece = shown_->pieces[i];
        const base::Vec3 shift = apart ? shown_->shifts[i] : base::Vec3::Zero();
        if (!apart && i + 1 < shown_->pieces.size())
            highlights.push_back({nullptr, track::findCutOutline(shown_->design.track, piece), kCut});
        for (const track::DowelHole& hole : piece.holes)
            highlights.push_back({nullptr, outlineHole(hole, shift), kCut, true});
    }
    return highlights;
}

void ExportPage::showScene() {
    if (scene_ == nullptr) return;
    if (!shown_) return scene_->clear();
    scene_->setParts({});
    scene_->showSolid(form_->split().apart() ? shown_->apart : shown_->together);
    scene_->setHighlights(highlights());
}

}  // namespace trapwright::pages
