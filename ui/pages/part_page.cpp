#include "ui/pages/part_page.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/geometry/mesh_repair.h"
#include "core/study/field_text.h"
#include "core/study/pose_weights.h"
#include "core/study/presets.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/pages/drop_card.h"
#include "ui/pages/import_question.h"
#include "ui/pages/materials_dialog.h"
#include "ui/pages/part_facts.h"
#include "ui/pages/part_files.h"
#include "ui/pages/pose_cards.h"
#include "ui/pages/problem_text.h"
#include "ui/pages/settings_form.h"
#include "ui/pages/target_card.h"
#include "ui/scene/scene_view.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

namespace {

constexpr std::string_view kWeights = "part.poseWeights";
constexpr auto kOwnDensity = "";  // of no material of the list

/// A row with a label at the left, as those of a form.
QWidget* labelled(const QString& label, QWidget* editor, QWidget* parent) {
    auto* row = new QWidget(parent);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(6);
    auto* text = new QLabel(label, row);
    text->setBuddy(editor);
    layout->addWidget(text, 1);
    layout->addWidget(editor);
    editor->setAccessibleName(label);
    editor->setMinimumWidth(128);
    return row;
}

}  // namespace

PartPage::PartPage(QWidget* parent)
    : Page({"part", tr("Part"), "part", tr("The part that is fed: import, material, symmetry, stable poses")},
           parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 12, 12, 12);
    layout->setSpacing(8);
    addHead();
    addForm();
    layout->addStretch(1);

    auto* importAction = new QAction(look::icon("import"), tr("&Import a part..."), this);
    importAction->setObjectName("part.import");
    importAction->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_I));
    connect(importAction, &QAction::triggered, this, &PartPage::askForFile);
    addAction(importAction);

    connect(&import_, &session::PartImport::stageChanged, this, [this](const QString& stage) {
        if (import_.busy()) busyText_->setText(tr("%1: %2 ...").arg(importing_, stage));
    });
    connect(&import_, &session::PartImport::finished, this, &PartPage::take);
    connect(
        &import_, &session::PartImport::unitNeeded, this,
        [this](const workflow::PartRequest& request, const std::vector<workflow::UnitCandidate>& candidates) {
            setBusy({});
            question_->askUnit(request, candidates);
        });
    connect(&import_, &session::PartImport::repairNeeded, this,
            [this](const workflow::PartRequest& request, const geometry::MeshReport& found,
                   const QString& message) {
                setBusy({});
                question_->askRepair(request, found, message);
            });
    connect(
        &import_, &session::PartImport::failed, this,
        [this](const workflow::PartRequest& request, const QString& message) {
            leave();
            showUnits();
            emit failed(
                tr("%1 cannot be imported").arg(look::toText(std::filesystem::path(request.part).filename())),
                message);
        });
    refresh();
}

PartPage::~PartPage() = default;

void PartPage::addHead() {
    name_ = new QLabel(this);
    name_->setObjectName("part.name");
    QFont font = name_->font();
    font.setPointSizeF(font.pointSizeF() * 1.3);
    font.setBold(true);
    name_->setFont(font);
    size_ = new QLabel(this);
    size_->setObjectName("part.size");
    size_->setForegroundRole(QPalette::PlaceholderText);
    importButton_ = new QPushButton(look::icon("import"), tr("Import a part..."), this);
    importButton_->setObjectName("part.importButton");
    connect(importButton_, &QPushButton::clicked, this, &PartPage::askForFile);

    auto* titles = new QVBoxLayout;
    titles->setSpacing(0);
    titles->addWidget(name_);
    titles->addWidget(size_);
    auto* head = new QHBoxLayout;
    head->addLayout(titles, 1);
    head->addWidget(importButton_, 0, Qt::AlignTop);

    busy_ = new QWidget(this);
    busyText_ = new QLabel(busy_);
    auto* bar = new QProgressBar(busy_);
    bar->setRange(0, 0);
    bar->setTextVisible(false);
    bar->setFixedHeight(6);
    auto* stop = new QPushButton(tr("Stop"), busy_);
    stop->setObjectName("part.stopImport");
    connect(stop, &QPushButton::clicked, this, [this] {
        import_.cancel();
        leave();
    });
    auto* busyLayout = new QVBoxLayout(busy_);
    busyLayout->setContentsMargins(0, 0, 0, 0);
    busyLayout->addWidget(busyText_);
    busyLayout->addWidget(bar);
    busyLayout->addWidget(stop, 0, Qt::AlignRight);
    busy_->hide();

    question_ = new ImportQuestion(this);
    connect(question_, &ImportQuestion::answered, this, [this](const workflow::PartRequest& request) {
        question_->hide();
        import(request);
    });
    connect(question_, &ImportQuestion::cancelled, this, &PartPage::leave);

    misfit_ = new QLabel(this);
    misfit_->setObjectName("part.misfit");
    misfit_->setWordWrap(true);
    connect(misfit_, &QLabel::linkActivated, this, &Page::pageWanted);

    auto* layout = static_cast<QVBoxLayout*>(this->layout());
    layout->addLayout(head);
    layout->addWidget(busy_);
    layout->addWidget(question_);
    layout->addWidget(misfit_);
}

void PartPage::addForm() {
    form_ = new SettingsForm({{"part.poses", tr("Stable poses"), {"part.poseWeights"}},
                              {"part.wanted", tr("Wanted"), {}},
                              {"part.drops", tr("Drop test"), {}, true},
                              {"part.material", tr("Material"), {"part.density_kg_m3"}},
                              {"part.symmetry",
                               tr("Symmetry"),
                               {"part.symmetry", "part.symmetryTolerance", "evolution.orientationDistance"}},
                              {"part.mass", tr("Mass properties"), {}},
                              {"part.mesh", tr("Mesh"), {}}},
                             {}, this);
    connect(form_, &SettingsForm::edited, this, &PartPage::edit);

    poses_ = new PoseCards(form_);
    form_->addToGroup("part.poses", poses_, true);
    target_ = new TargetCard(form_);
    connect(target_, &TargetCard::edited, this, &PartPage::edit);
    connect(target_, &TargetCard::sceneFreed, this, &PartPage::showScene);
    form_->addToGroup("part.wanted", target_);
    drop_ = new DropCard(form_);
    form_->addToGroup("part.drops", drop_);

    material_ = new QComboBox(form_);
    material_->setObjectName("part.material");
    connect(material_, &QComboBox::activated, this, &PartPage::changeMaterial);
    proposal_ = new QWidget(form_);
    proposal_->setObjectName("part.proposal");
    proposalText_ = new QLabel(proposal_);
    proposalText_->setObjectName("part.proposal.text");
    proposalText_->setWordWrap(true);
    auto* take = new QPushButton(tr("Use these"), proposal_);
    take->setObjectName("part.proposal.take");
    auto* keep = new QPushButton(tr("Keep mine"), proposal_);
    keep->setObjectName("part.proposal.keep");
    connect(take, &QPushButton::clicked, this, [this] {
        const auto pair = std::exchange(proposed_, std::nullopt);
        if (pair && design_) usePair(*design_, *pair);
        showProposal();
    });
    connect(keep, &QPushButton::clicked, this, [this] {
        proposed_.reset();
        showProposal();
    });
    auto* answers = new QHBoxLayout;
    answers->addStretch(1);
    answers->addWidget(keep);
    answers->addWidget(take);
    auto* proposal = new QVBoxLayout(proposal_);
    proposal->setContentsMargins(0, 4, 0, 4);
    proposal->addWidget(proposalText_);
    proposal->addLayout(answers);
    auto* library = new QPushButton(tr("Library of materials..."), form_);
    library->setObjectName("part.library");
    connect(library, &QPushButton::clicked, this, &PartPage::showLibrary);
    form_->addToGroup("part.material", proposal_, true);
    form_->addToGroup("part.material", labelled(tr("Material"), material_, form_), true);
    form_->addToGroup("part.material", library);

    symmetry_ = new QLabel(form_);
    symmetry_->setObjectName("part.symmetry");
    symmetry_->setWordWrap(true);
    form_->addToGroup("part.symmetry", symmetry_, true);

    mass_ = new FactList(form_);
    form_->addToGroup("part.mass", mass_);

    unit_ = new QComboBox(form_);
    unit_->setObjectName("part.unit");
    connect(unit_, &QComboBox::activated, this, &PartPage::changeUnits);
    mesh_ = new FactList(form_);
    notes_ = new QLabel(form_);
    notes_->setObjectName("part.notes");
    notes_->setWordWrap(true);
    notes_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    form_->addToGroup("part.mesh", labelled(tr("Unit of the file"), unit_, form_));
    form_->addToGroup("part.mesh", mesh_);
    form_->addToGroup("part.mesh", notes_);
    layout()->addWidget(form_);
}

void PartPage::setSession(session::StudySession* session) {
    if (design_) design_->disconnect(this);
    if (runs_) runs_->disconnect(this);
    design_ = session != nullptr ? &session->design() : nullptr;
    runs_ = session != nullptr ? &session->runs() : nullptr;
    target_->setScene(scene_);  // what is being turned is the part before
    shownMesh_.reset();
    proposed_.reset();
    afterMaterial_.reset();
    drop_->setDesign(design_);
    readMaterials();
    if (design_) {
        using session::StudyDesign;
        using session::StudyRuns;
        connect(design_, &StudyDesign::settingsChanged, this, &PartPage::refresh);
        connect(design_, &StudyDesign::partChanged, this, &PartPage::refresh);
        connect(runs_, &StudyRuns::stateChanged, this, &PartPage::refresh);
        connect(design_, &StudyDesign::dropsChanged, this, [this] {
            if (!design_->drops()) refresh();
        });
    }
    refresh();
}

void PartPage::activate(scene::SceneView& scene) {
    scene_ = &scene;
    target_->setScene(scene_);
    // Other pages change the library, too.
    readMaterials();
    if (design_) refresh();
    showScene();
}

void PartPage::deactivate() {
    scene_ = nullptr;
    target_->setScene(nullptr);
}

bool PartPage::takeFile(const std::filesystem::path& file) {
    import(partRequest(file.string()));
    return true;
}

void PartPage::askForFile() {
    look::askForFile(this, partQuestion(), [this](const std::filesystem::path& file) { takeFile(file); });
}

void PartPage::import(const workflow::PartRequest& request) {
    question_->hide();
    importing_ = look::toText(std::filesystem::path(request.part).filename());
    setBusy(tr("Reading %1 ...").arg(importing_));
    // Where it goes on, and what it asks, is to be seen without a study, too.
    emit pageWanted(face().name);
    import_.start(request);
}

void PartPage::take(const workflow::LoadedPart& part) {
    setBusy({});
    imported_ = part;
    // The scores of a study belong to its part.
    if (!design_ || design_->locked()) {
        emit studyWanted(part);
    } else {
        design_->changePart(part, tr("Import of %1").arg(QString::fromStdString(part.part->name)));
    }
}

void PartPage::leave() {
    setBusy({});
    question_->hide();
    if (!design_) emit pageWanted({});
}

void PartPage::setBusy(const QString& what) {
    busy_->setVisible(!what.isEmpty());
    busyText_->setText(what);
}

void PartPage::refresh() {
    form_->setVisible(design_ != nullptr);
    misfit_->hide();
    if (!design_) {
        name_->setText(tr("No part yet"));
        size_->setText(tr("Import one, or drop its file here"));
        return;
    }
    const std::shared_ptr<const part::Part> part = design_->part();
    name_->setText(QString::fromStdString(part->name));
    size_->setText(sizeText(geometry::calcBoundingBox(part->mesh).size()));
    form_->show(design_->settings());
    form_->setLocked([this](const std::string& key) { return key == kWeights || !design_->locked(); });
    material_->setEnabled(!design_->locked());
    unit_->setEnabled(!design_->locked());

    QStringList misfits;
    for (const std::string& problem : study::findPartProblems(design_->settings(), *part))
        misfits << describeProblem(problem).text.toHtmlEscaped();
    misfit_->setVisible(!misfits.isEmpty());
    misfit_->setText(misfits.join("<br>") + "<br><a href=\"track\">" + tr("Go to the track's settings") +
                     "</a>");

    symmetry_->setText(symmetryText(part->symmetry));
    mass_->show(massFacts(*part));
    poses_->show(part, design_->dropTest(), study::weightsInForce(*part, design_->settings()));
    target_->show(part, design_->settings());
    target_->setLocked(design_->locked());
    drop_->refresh(library_);
    showMaterial();
    showUnits();
    showMesh();
    showScene();
}

bool PartPage::knowsImport() const {
    return imported_ && imported_->settings.file == design_->settings().part.file;
}

void PartPage::showMesh() {
    if (design_->part() == shownMesh_) return;
    shownMesh_ = design_->part();
    const geometry::TriangleMesh& mesh = design_->storedPart().mesh;
    meshCheck_.cancel();
    if (knowsImport()) return tellMesh(imported_->found, mesh.triangles.size(), imported_->notes);
    // A study that was opened does not keep what was found when its part came in.
    meshCheck_.start([this, part = shownMesh_, mesh]() -> session::NewestTask::Deliver {
        const geometry::MeshReport report = geometry::checkMesh(mesh);
        std::vector<std::string> notes;
        if (auto repaired = geometry::repairMesh(mesh)) notes = std::move(repaired->notes);
        return [this, part, report, notes, triangles = mesh.triangles.size()] {
            if (design_ && design_->part() == part) tellMesh(report, triangles, notes);
        };
    });
}

void PartPage::tellMesh(const geometry::MeshReport& report, std::size_t triangles,
                        const std::vector<std::string>& notes) {
    Facts facts = meshFacts(report, triangles);
    facts.emplace_back(tr("Convex pieces"), QString::number(shownMesh_->pieces.size()));
    mesh_->show(facts);
    QStringList sentences;
    for (const std::string& note : notes)
        sentences << QString::fromStdString(note);
    notes_->setText(sentences.join("\n"));
    notes_->setVisible(!sentences.isEmpty());
}

void PartPage::showUnits() {
    unit_->clear();
    if (!design_) return;
    const QString present = QString::fromStdString(design_->settings().part.units);
    if (knowsImport()) {
        for (const workflow::UnitCandidate& candidate : imported_->candidates) {
            const QString name = QString::fromStdString(candidate.name);
            unit_->addItem(name, name);
            unit_->setItemData(unit_->count() - 1, sizeText(candidate.size), Qt::ToolTipRole);
        }
    }
    if (unit_->findData(present) < 0) unit_->addItem(present, present);
    unit_->setCurrentIndex(unit_->findData(present));
}

void PartPage::readMaterials() {
    const std::vector<std::string> told = library_.problems;
    library_ = design_ ? pages::readMaterials(*design_) : part::readMaterials();
    if (design_ && library_.problems != told) {
        for (const std::string& problem : library_.problems)
            emit failed(tr("A file of materials cannot be read"), QString::fromStdString(problem));
    }
    material_->clear();
    for (const part::Material& material : library_.materials) {
        const QString name = QString::fromStdString(material.name);
        material_->addItem(name, name);
        material_->setItemData(material_->count() - 1,
                               tr("%1 kg/m³; %2")
                                   .arg(look::numberText(material.density.value, 4),
                                        QString::fromStdString(material.density.source)),
                               Qt::ToolTipRole);
    }
}

void PartPage::showMaterial() {
    const part::Material* used = study::findUsedMaterial(library_, design_->settings().part);
    const int other = material_->findData(QString(kOwnDensity));
    if (used != nullptr) {
        if (other >= 0) material_->removeItem(other);
        material_->setCurrentIndex(material_->findData(QString::fromStdString(used->name)));
    } else {
        if (other < 0) material_->addItem(tr("other"), QString(kOwnDensity));
        material_->setCurrentIndex(material_->findData(QString(kOwnDensity)));
    }
    // What was proposed for another material, or is in force, is proposed no more.
    if (proposed_ && (used == nullptr || used->name != proposed_->material)) proposed_.reset();
    if (afterMaterial_ && used != nullptr && used->name == afterMaterial_->material)
        proposed_ = std::exchange(afterMaterial_, std::nullopt);
    showProposal();
}

void PartPage::showProposal() {
    bool open = proposed_ && design_ && !design_->locked();
    if (open) {
        const trial::ContactParameters& present = design_->settings().simulation.contact;
        const trial::ContactParameters wanted = study::contactOf(*proposed_);
        open = present.staticFriction != wanted.staticFriction ||
               present.kineticFriction != wanted.kineticFriction || present.restitution != wanted.restitution;
        proposalText_->setText(tr("%1. The study has %2, %3 and %4.")
                                   .arg(pairText(*proposed_), look::numberText(present.staticFriction),
                                        look::numberText(present.kineticFriction),
                                        look::numberText(present.restitution)));
        proposalText_->setToolTip(QString::fromStdString(part::describeSources(*proposed_)));
    }
    proposal_->setVisible(open);
}

void PartPage::changeUnits(int index) {
    const study::PartSettings& settings = design_->settings().part;
    if (unit_->itemData(index).toString().toStdString() == settings.units) return;
    workflow::PartRequest request;
    request.part = settings.file;
    request.units = unit_->itemData(index).toString().toStdString();
    request.density = settings.density;
    request.materialName = settings.material;
    request.tolerance = settings.symmetryTolerance;
    request.symmetry = settings.symmetry;
    import(request);
}

void PartPage::changeMaterial(int index) {
    const part::Material* material =
        part::findMaterial(library_, material_->itemData(index).toString().toStdString());
    if (material == nullptr) return;
    study::Settings settings = design_->settings();
    if (const auto* used = study::findUsedMaterial(library_, settings.part); used == material) return;
    const part::MaterialPair* pair =
        study::suggestPair(library_, material->name, study::findUsedPair(library_, settings));
    settings.part.density = material->density.value;
    settings.part.material = material->name;
    edit(settings, tr("Material"));
    // Friction and restitution are the user's: the pair is proposed, once the part is there.
    afterMaterial_ = pair != nullptr ? std::optional(*pair) : std::nullopt;
}

void PartPage::showLibrary() {
    if (!design_) return;
    const part::Material* used = study::findUsedMaterial(library_, design_->settings().part);
    auto* dialog = new MaterialsDialog(design_->ownMaterials(),
                                       used != nullptr ? QString::fromStdString(used->name) : QString(),
                                       !design_->locked(), this);
    connect(dialog, &MaterialsDialog::pairWanted, this, [this](const part::MaterialPair& pair) {
        if (design_) usePair(*design_, pair);
    });
    connect(dialog, &MaterialsDialog::libraryChanged, this, [this] {
        readMaterials();
        if (design_) refresh();
    });
    dialog->open();
}

void PartPage::edit(const study::Settings& settings, const QString& what) {
    study::PartSettings same = settings.part;
    study::takePoseWeights(same, design_->settings().part);
    if (settings.part.poseWeights != design_->settings().part.poseWeights)
        return design_->countPosesBy(settings.part.poseWeights);
    if (same == design_->settings().part) return design_->changeSettings(settings, what);
    // The part is built anew of these.
    store::StoredPart stored = design_->storedPart();
    stored.options.density = settings.part.density;
    stored.options.symmetryTolerance = settings.part.symmetryTolerance;
    stored.options.symmetry = settings.part.symmetry;
    design_->changePart(stored, settings.part, what);
}

void PartPage::showScene() {
    if (scene_ == nullptr || target_->hasScene()) return;
    if (design_) {
        std::vector<double> shares;
        for (const part::PoseGroup& group : study::weighPoseGroups(*design_->part(), design_->settings()))
            shares.push_back(group.probability);
        scene_->showStablePoses(design_->part(), std::move(shares));
    } else {
        scene_->clear();
    }
}

}  // namespace trapwright::pages
