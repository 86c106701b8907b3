#include "ui/pages/track_page.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <tuple>

#include "core/study/planning.h"
#include "core/study/presets.h"
#include "core/track/track_builder.h"
#include "core/track/track_solid.h"
#include "core/workflow/estimate.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/pages/drive_card.h"
#include "ui/pages/materials_dialog.h"
#include "ui/pages/part_files.h"
#include "ui/pages/problem_text.h"
#include "ui/pages/run_actions.h"
#include "ui/pages/settings_form.h"
#include "ui/pages/track_in_scene.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

namespace {

/// What may still change when a study has scores (store::StudyFile::changeSettings).
bool staysFree(const std::string& key) {
    return key == "evolution.generations" || key.starts_with("validation.") || key.starts_with("stream.");
}

}  // namespace

TrackPage::TrackPage(RunActions& run, QWidget* parent)
    : Page({"track", tr("Track"), "track",
            tr("What the track is made of, how it vibrates and how it is learned")},
           parent),
      run_(run),
      form_(new SettingsForm(trackGroups(), {}, this)),
      drive_(new DriveCard(form_)),
      contact_(new QComboBox(form_)),
      help_(new QLabel(this)) {
    auto* contents = new QWidget(this);
    auto* column = new QVBoxLayout(contents);
    column->setContentsMargins(12, 12, 12, 12);
    column->setSpacing(8);
    column->addWidget(makeHead());
    column->addWidget(form_);
    form_->offer("track.traps", trapChoices());
    form_->offer("evolution.objectives", objectiveChoices());
    form_->offer("evolution.tradeOff", tradeOffChoices());
    column->addStretch(1);
    auto* scroll = new QScrollArea(this);
    scroll->setWidget(contents);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);

    // Always as high, so that the form does not move while the mouse passes over it.
    constexpr int kHelpLines = 4;
    help_->setObjectName("track.help");
    help_->setWordWrap(true);
    help_->setTextFormat(Qt::RichText);
    help_->setAlignment(Qt::AlignTop);
    help_->setContentsMargins(12, 8, 12, 8);
    help_->setFixedHeight(kHelpLines * help_->fontMetrics().lineSpacing() + 16);
    help_->setStyleSheet("#track\\.help { border-top: 1px solid palette(mid); }");

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(scroll, 1);
    layout->addWidget(help_);

    form_->addToGroup("drive", drive_);
    addContactChoice();
    connect(form_, &SettingsForm::edited, this, &TrackPage::edit);
    connect(form_, &SettingsForm::attended, this, [this](const QString& label, const QString& help) {
        help_->setText("<b>" + label.toHtmlEscaped() + "</b>&nbsp; " + help.toHtmlEscaped());
    });
    connect(&build_, &session::TrackBuild::built, this,
            [this](const std::shared_ptr<const track::Track>& track) {
                track_ = track;
                showTitle();
                showTrack();
            });
    refresh();
}

QWidget* TrackPage::makeHead() {
    auto* head = new QWidget(this);
    auto* presets = new QPushButton(tr("Presets"), head);
    presets->setObjectName("track.presets");
    presets->setToolTip(tr("Sets of values that are known to work"));
    auto* menu = new QMenu(presets);
    const auto addPreset = [&](const QString& name, const QString& title) {
        QAction* action = menu->addAction(title);
        action->setObjectName("preset." + name);
        connect(action, &QAction::triggered, this, [this, name, title] { usePreset(name, title); });
    };
    timePresets_ = menu->addMenu(tr("For the part and the time that I have"));
    timePresets_->setObjectName("preset.time");
    for (const auto& [name, title, seconds] :
         {std::tuple{"10min", tr("10 minutes"), 600.0}, std::tuple{"1h", tr("An hour"), 3600.0},
          std::tuple{"night", tr("Over night, 10 hours"), 36000.0}}) {
        QAction* action = timePresets_->addAction(title);
        action->setObjectName(QString("preset.time.") + name);
        connect(action, &QAction::triggered, this,
                [this, title = title, seconds = seconds] { propose(seconds, title); });
    }
    menu->addSeparator();
    addPreset("cuboid", tr("The paper's Table 1, cuboid"));
    addPreset("cone", tr("The paper's Table 1, cone-like part"));
    menu->addSeparator();
    draftPreset_ = menu->addAction(tr("Draft in 10 minutes"));
    draftPreset_->setObjectName("preset.draft");
    connect(draftPreset_, &QAction::triggered, this, &TrackPage::useDraft);
    QAction* full = menu->addAction(tr("Full learning, 200 generations of 100 × 100 trials"));
    full->setObjectName("preset.full");
    connect(full, &QAction::triggered, this, &TrackPage::useFullLearning);
    QAction* sorting = menu->addAction(tr("Throw out what lies wrong, in proportion to the part"));
    sorting->setObjectName("preset.sorting");
    connect(sorting, &QAction::triggered, this, &TrackPage::useSorting);
    QAction* ledges =
        menu->addAction(tr("Let only one way pass, over gaps and ledges, in proportion to the part"));
    ledges->setObjectName("preset.ledges");
    connect(ledges, &QAction::triggered, this, &TrackPage::useLedges);
    QAction* hanging =
        menu->addAction(tr("Let parts with a head hang by it in slots, in proportion to the part"));
    hanging->setObjectName("preset.slots");
    connect(hanging, &QAction::triggered, this, &TrackPage::useSlots);
    QAction* rails =
        menu->addAction(tr("Let them leave hanging between rails, head up, in proportion to the part"));
    rails->setObjectName("preset.rails");
    connect(rails, &QAction::triggered, this, &TrackPage::useRails);
    menu->addSeparator();
    QAction* paper = menu->addAction(tr("The paper's own choices throughout"));
    paper->setObjectName("preset.paper");
    connect(paper, &QAction::triggered, this, &TrackPage::usePaperMode);
    presets->setMenu(menu);

    problems_ = new QLabel(head);
    problems_->setObjectName("track.problems");
    problems_->setWordWrap(true);
    connect(problems_, &QLabel::linkActivated, this, [this] { form_->goToProblem(); });

    locked_ = new QWidget(head);
    locked_->setObjectName("track.locked");
    auto* reason = new QLabel(tr("All tracks of a study are learned with the same settings."), locked_);
    reason->setWordWrap(true);
    auto* fork = new QPushButton(tr("Change in a new study"), locked_);
    fork->setObjectName("track.fork");
    fork->setToolTip(tr("A new study with the same part and settings, and no generations"));
    auto* withTracks = new QCheckBox(tr("Begin with these tracks"), locked_);
    withTracks->setObjectName("track.forkTracks");
    withTracks->setToolTip(tr(
        "Half of the first generation are tracks of this study: the final one, the last comparison and the "
        "last generation. So little is learned anew where friction, drive or what is wanted is another. The "
        "numbers that a track is made of (traps, sections, points) must stay"));
    auto* behind = new QCheckBox(tr("Add a rejecting trap"), locked_);
    behind->setObjectName("track.forkBehind");
    behind->setToolTip(tr(
        "The chosen track stays as it is, and a notched track, or ledges where it has a spiral, ends in a "
        "groove or on a ledge, is learned behind it that throws out what still lies wrong, so that it comes "
        "again: fewer wrong ones, at the price of parts a minute"));
    // One or the other, or neither.
    connect(withTracks, &QCheckBox::toggled, behind, [behind](bool on) {
        if (on) behind->setChecked(false);
    });
    connect(behind, &QCheckBox::toggled, withTracks, [withTracks](bool on) {
        if (on) withTracks->setChecked(false);
    });
    connect(fork, &QPushButton::clicked, this, [this, withTracks, behind] {
        emit forkWanted(withTracks->isChecked() ? session::Fork::knownTracks
                        : behind->isChecked()   ? session::Fork::trapBehind
                                                : session::Fork::settingsAlone);
    });
    auto* lockedLayout = new QGridLayout(locked_);
    lockedLayout->setContentsMargins(0, 0, 0, 0);
    lockedLayout->setColumnStretch(0, 1);
    lockedLayout->addWidget(reason, 0, 0, 3, 1);
    lockedLayout->addWidget(fork, 0, 1);
    lockedLayout->addWidget(withTracks, 1, 1);
    lockedLayout->addWidget(behind, 2, 1);

    title_ = new QLabel(head);
    QFont font = title_->font();
    font.setPointSizeF(font.pointSizeF() * 1.3);
    font.setBold(true);
    title_->setFont(font);
    size_ = new QLabel(head);
    size_->setObjectName("track.size");
    size_->setForegroundRole(QPalette::PlaceholderText);
    auto* titles = new QVBoxLayout;
    titles->setSpacing(0);
    titles->addWidget(title_);
    titles->addWidget(size_);
    auto* row = new QHBoxLayout;
    row->addLayout(titles, 1);
    row->addWidget(presets, 0, Qt::AlignTop);
    auto* layout = new QVBoxLayout(head);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addLayout(row);
    layout->addWidget(makeStart(head));
    layout->addWidget(problems_);
    layout->addWidget(locked_);
    return head;
}

/// How long learning takes, told before it starts, and the two ways to start it.
QWidget* TrackPage::makeStart(QWidget* parent) {
    auto* start = new QWidget(parent);
    start->setObjectName("track.starting");
    time_ = new QLabel(start);
    time_->setObjectName("track.time");
    time_->setWordWrap(true);
    proposal_ = new QLabel(start);
    proposal_->setObjectName("track.proposal");
    proposal_->setWordWrap(true);
    proposal_->setForegroundRole(QPalette::PlaceholderText);
    proposal_->hide();
    auto* buttons = new QHBoxLayout;
    for (const auto& [action, name] :
         {std::pair{run_.draft(), "track.draft"}, std::pair{run_.start(), "track.start"}}) {
        auto* button = new QToolButton(start);
        button->setDefaultAction(action);
        button->setObjectName(name);
        look::drawAsButton(*button);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        button->setFocusPolicy(Qt::StrongFocus);
        buttons->addWidget(button);
    }
    auto* layout = new QVBoxLayout(start);
    layout->setContentsMargins(0, 4, 0, 4);
    layout->setSpacing(4);
    layout->addWidget(time_);
    layout->addWidget(proposal_);
    layout->addLayout(buttons);
    connect(run_.draft(), &QAction::changed, this, &TrackPage::showTime);
    connect(run_.start(), &QAction::changed, this, &TrackPage::showTime);
    return start;
}

void TrackPage::showTime() {
    const auto draft = design_ ? runs_->draft() : std::nullopt;
    draftPreset_->setEnabled(draft.has_value());
    // Until something else is changed.
    proposal_->setVisible(design_ && proposed_ && *proposed_ == design_->settings());
    const double seconds = design_ ? runs_->estimatedSeconds() : 0.0;
    const bool isLeft =
        design_ && static_cast<int>(runs_->summaries().size()) < design_->settings().evolution.generations;
    time_->setVisible(isLeft && design_->problems().empty() && runs_->state() == session::RunState::idle);
    if (seconds <= 0.0) {
        time_->setText(tr("How long learning takes on this machine is being measured."));
    } else if (draft) {
        time_->setText(tr("Learning takes about <b>%1</b> on this machine, a draft about <b>%2</b>.")
                           .arg(look::roughDurationText(seconds), look::roughDurationText(draft->seconds)));
    } else {
        time_->setText(
            tr("Learning takes about <b>%1</b> on this machine.").arg(look::roughDurationText(seconds)));
    }
}

void TrackPage::addContactChoice() {
    contact_->setObjectName("track.contact");
    contact_->setAccessibleName(tr("Pair of materials"));
    connect(contact_, &QComboBox::activated, this, [this](int index) {
        const auto* pair = part::findPair(library_, contact_->itemData(index).toString().toStdString());
        if (pair == nullptr || !design_) return showContact();
        study::Settings settings = design_->settings();
        study::useContact(settings, *pair);
        edit(settings, tr("Pair of materials"));
    });
    auto* library = new QPushButton(tr("Library..."), form_);
    library->setObjectName("track.library");
    library->setToolTip(tr("All pairs of materials, with spread and source; your own entries"));
    connect(library, &QPushButton::clicked, this, &TrackPage::showLibrary);
    contact_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    auto* row = new QWidget(form_);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(contact_, 1);
    layout->addWidget(library);
    form_->addToGroup("contact", row, true);
}

void TrackPage::listPairs() {
    contact_->clear();
    const part::Material* material = study::findUsedMaterial(library_, design_->settings().part);
    for (const part::MaterialPair& pair : library_.pairs) {
        if (material != nullptr && pair.material != material->name) continue;
        contact_->addItem(QString::fromStdString(part::pairTitle(pair)), QString::fromStdString(pair.name));
        contact_->setItemData(contact_->count() - 1, QString::fromStdString(part::describeSources(pair)),
                              Qt::ToolTipRole);
    }
    contact_->addItem(tr("Own values"), QString());
}

void TrackPage::showLibrary() {
    if (!design_) return;
    const part::Material* used = study::findUsedMaterial(library_, design_->settings().part);
    auto* dialog = new MaterialsDialog(design_->ownMaterials(),
                                       used != nullptr ? QString::fromStdString(used->name) : QString(),
                                       !design_->locked(), this);
    connect(dialog, &MaterialsDialog::pairWanted, this, [this](const part::MaterialPair& pair) {
        if (design_) usePair(*design_, pair);
    });
    connect(dialog, &MaterialsDialog::libraryChanged, this, [this] {
        if (!design_) return;
        library_ = readMaterials(*design_);
        showContact();
    });
    dialog->open();
}

void TrackPage::setSession(session::StudySession* session) {
    if (design_) design_->disconnect(this);
    if (runs_) runs_->disconnect(this);
    design_ = session != nullptr ? &session->design() : nullptr;
    runs_ = session != nullptr ? &session->runs() : nullptr;
    built_.reset();
    track_.reset();
    build_.cancel();
    if (design_) {
        form_->offer("simulation.engine", engineChoices(design_->engines()));
        library_ = readMaterials(*design_);
        using session::StudyDesign;
        using session::StudyRuns;
        connect(design_, &StudyDesign::settingsChanged, this, &TrackPage::refresh);
        connect(design_, &StudyDesign::partChanged, this, &TrackPage::refresh);
        connect(runs_, &StudyRuns::stateChanged, this, &TrackPage::refresh);
        connect(runs_, &StudyRuns::estimated, this, &TrackPage::showTime);
        connect(runs_, &StudyRuns::proposed, this, &TrackPage::useProposal);
        connect(runs_, &StudyRuns::generationSaved, this, [this] {
            if (locked_->isHidden() == design_->locked()) refresh();
        });
    }
    refresh();
}

void TrackPage::activate(scene::SceneView& scene) {
    scene_ = &scene;
    // Other pages change the library, too.
    if (design_) {
        library_ = readMaterials(*design_);
        showContact();
    }
    showTrack();
}

void TrackPage::deactivate() {
    scene_ = nullptr;
}

void TrackPage::refresh() {
    form_->QWidget::setVisible(design_ != nullptr);
    locked_->setVisible(design_ && design_->locked());
    problems_->hide();
    showTime();
    help_->setText(tr("Point at a field to read what it means."));
    if (!design_) return;

    const study::Settings& settings = design_->settings();
    form_->show(settings);
    const bool bowl = settings.track.shape.type == track::FeederType::bowl;
    form_->setVisible("track.bowlRadius_mm", bowl);
    form_->setVisible("track.conveying", bowl);
    const bool spiral = settings.track.spiral.width > 0.0;
    const bool hasLedge = spiral || settings.track.traps.find("ledge") != std::string::npos;
    form_->setVisible("track.spiralWall_mm", hasLedge);
    form_->setVisible("track.spiralInclination_deg", hasLedge);
    form_->setVisible("track.chuteAngle_deg", settings.track.chute.length > 0.0);
    const bool freeForm = settings.track.traps.find("free-form") != std::string::npos;
    for (const char* key : {"track.crossSections", "track.encoding"})
        form_->setVisible(key, freeForm);
    const bool genetic = settings.evolution.search == search::Method::genetic;
    for (const char* key : {"evolution.tournamentSize", "evolution.staticMutation", "evolution.mutationFloor",
                            "evolution.strategyScope", "evolution.smoothingLimit"})
        form_->setVisible(key, genetic);
    form_->setVisible("evolution.firstGeneration", settings.evolution.search != search::Method::random);
    form_->setVisible("evolution.plannedTraps", study::isPlanned(settings.evolution));
    const bool locked = design_->locked();
    form_->setLocked([locked](const std::string& key) { return !locked || staysFree(key); });
    contact_->setEnabled(!locked);
    timePresets_->setEnabled(!locked && runs_->state() == session::RunState::idle);
    showTitle();
    showContact();
    showProblems();
    if (study::findProblems(settings).empty()) drive_->show(settings);
    if (!built_ || !(*built_ == settings.track)) {
        built_ = settings.track;
        build_.buildLayout(settings.track);
    }
    if (scene_ != nullptr) showTrack();
}

void TrackPage::changeEvent(QEvent* event) {
    Page::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && design_) showProblems();
}

void TrackPage::showProblems() {
    const std::vector<std::string>& problems = design_->problems();
    form_->setProblems(problems, design_->recommendations());
    problems_->setVisible(!problems.empty());
    if (problems.empty()) return;
    const QColor colour = look::toneColour(look::Tone::bad, palette());
    const QString text =
        problems.size() == 1
            ? tr("1 problem: a value has to be corrected before learning")
            : tr("%1 problems: values have to be corrected before learning").arg(problems.size());
    problems_->setText(QString("<a href=\"#\" style=\"color: %1\">%2</a>").arg(colour.name(), text));
}

void TrackPage::showContact() {
    listPairs();
    const part::MaterialPair* used = study::findUsedPair(library_, design_->settings());
    const int index = used != nullptr ? contact_->findData(QString::fromStdString(used->name)) : -1;
    contact_->setCurrentIndex(index >= 0 ? index : contact_->count() - 1);
    contact_->setToolTip(used != nullptr ? QString::fromStdString(part::describeSources(*used)) : QString());
}

void TrackPage::edit(const study::Settings& settings, const QString& what) {
    if (design_) design_->changeSettings(settings, what);
}

void TrackPage::usePreset(const QString& name, const QString& title) {
    if (!design_) return;
    auto settings = study::presetSettings(name.toStdString());
    if (!settings) return emit failed(title, QString::fromStdString(settings.error().message));
    settings->part = design_->settings().part;
    settings->feeder = design_->settings().feeder;
    edit(*settings, title);
}

void TrackPage::useDraft() {
    const auto draft = design_ ? runs_->draft() : std::nullopt;
    if (!draft) return;
    study::Settings settings = design_->settings();
    settings.evolution = draft->evolution;
    edit(settings, tr("Draft in 10 minutes"));
}

void TrackPage::propose(double seconds, const QString& what) {
    if (!design_ || !design_->part()) return;
    proposing_ = what;
    proposal_->setText(tr("Trials of this part are being timed, to see what fits into the time ..."));
    proposal_->show();
    runs_->requestProposal(seconds);
}

void TrackPage::useProposal(const workflow::Proposal& proposal) {
    QStringList reasons;
    for (const std::string& reason : proposal.reasons)
        reasons.push_back(QString::fromStdString(reason));
    proposal_->setText(reasons.join('\n'));
    proposed_ = proposal.settings;
    edit(proposal.settings, tr("For the part and the time: %1").arg(proposing_));
}

void TrackPage::useFullLearning() {
    if (!design_) return;
    study::Settings settings = design_->settings();
    settings.evolution = workflow::fullEvolution(settings.evolution);
    edit(settings, tr("Full learning"));
}

void TrackPage::usePaperMode() {
    if (design_) edit(study::paperMode(design_->settings()), tr("The paper's own choices"));
}

void TrackPage::useSorting() {
    if (!design_ || !design_->part()) return;
    edit(study::sortingMode(design_->settings(), *design_->part()), tr("Throw out what lies wrong"));
}

void TrackPage::useLedges() {
    if (!design_ || !design_->part()) return;
    edit(study::ledgeMode(design_->settings(), *design_->part()), tr("Let only one way pass"));
}

void TrackPage::useSlots() {
    if (!design_ || !design_->part()) return;
    edit(study::slotMode(design_->settings(), *design_->part()), tr("Let parts hang in slots"));
}

void TrackPage::useRails() {
    if (!design_ || !design_->part()) return;
    edit(study::railsMode(design_->settings(), *design_->part()), tr("Let parts leave on rails"));
}

void TrackPage::showTitle() {
    const bool bowl = design_ && design_->settings().track.shape.type == track::FeederType::bowl;
    title_->setText(bowl ? tr("Bowl track") : tr("Linear track"));
    size_->clear();
    if (!track_) return;
    // As high as traps may be at the track's higher end, from below its lowest place; walls rise above it.
    const double highest =
        track_->height + std::max(track_->shape.rise(track_->begin()), track_->shape.rise(track_->end()));
    const double base = track::findBase(track_->shape, track_->sections, track_->baseThickness);
    size_->setText(sizeText({track_->end() - track_->begin(),
                             track::widthWithWalls(track_->width, track_->walls), highest - base}));
}

void TrackPage::showTrack() {
    if (scene_ == nullptr) return;
    showTrackWithPart(*scene_, track_, design_ ? design_->part() : nullptr);
}

}  // namespace trapwright::pages
