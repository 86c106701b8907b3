#include "ui/pages/materials_dialog.h"

#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QStandardItemModel>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>

#include "core/study/presets.h"
#include "ui/look/file_dialog.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/session/study_design.h"

namespace trapwright::pages {

using look::numberText;

namespace {

constexpr int kPlaceRole = Qt::UserRole + 1;  // in the library

enum Column { kMaterial, kSurface, kStatic, kKinetic, kRestitution, kDensity, kOrigin, kSource, kColumns };

QString fromText(const std::string& text) {
    return QString::fromStdString(text);
}

QString withSpread(const part::MaterialNumber& number) {
    return QString("%1 ± %2").arg(numberText(number.value), numberText(number.spread, 2));
}

QString describe(const part::MaterialPair& pair) {
    const auto line = [](const QString& what, const part::MaterialNumber& number, const QString& unit) {
        return QString("<b>%1</b> %2%3 (%4)")
            .arg(what, withSpread(number), unit, fromText(number.source).toHtmlEscaped());
    };
    return QStringList{line(MaterialsDialog::tr("Static friction"), pair.staticFriction, {}),
                       line(MaterialsDialog::tr("Kinetic friction"), pair.kineticFriction, {}),
                       line(MaterialsDialog::tr("Restitution"), pair.restitution, {}),
                       line(MaterialsDialog::tr("Density"), pair.density, " kg/m³")}
        .join("<br>");
}

/// Whatever the user searches for must be somewhere in a row.
class FoundPairs : public QSortFilterProxyModel {
 public:
    using QSortFilterProxyModel::QSortFilterProxyModel;

    void search(const QString& text) {
        words_ = text.split(' ', Qt::SkipEmptyParts);
        invalidateFilter();
    }

 protected:
    [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& parent) const override {
        QString text;
        for (int column = 0; column < sourceModel()->columnCount(parent); ++column)
            text += sourceModel()->index(row, column, parent).data().toString() + ' ';
        return std::all_of(words_.begin(), words_.end(),
                           [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
    }

 private:
    QStringList words_;
};

}  // namespace

PairEditor::PairEditor(const part::MaterialPair& pair, const QString& title, Save save, QWidget* parent)
    : QDialog(parent),
      pair_(pair),
      save_(std::move(save)),
      material_(new QLineEdit(fromText(pair.material), this)),
      surface_(new QLineEdit(fromText(pair.surface), this)),
      problem_(new QLabel(this)) {
    setObjectName("pairEditor");
    setWindowTitle(title);
    setAttribute(Qt::WA_DeleteOnClose);
    material_->setObjectName("pair.material");
    material_->setAccessibleName(tr("Part material"));
    material_->setPlaceholderText(tr("What the part is made of"));
    surface_->setObjectName("pair.surface");
    surface_->setAccessibleName(tr("Surface"));
    surface_->setPlaceholderText(tr("What the track is made of"));
    problem_->setObjectName("pair.problem");
    problem_->setWordWrap(true);
    problem_->hide();

    auto* grid = new QGridLayout;
    grid->addWidget(new QLabel(tr("Part material"), this), 0, 0);
    grid->addWidget(material_, 0, 1, 1, 3);
    grid->addWidget(new QLabel(tr("Surface"), this), 1, 0);
    grid->addWidget(surface_, 1, 1, 1, 3);
    int line = 2;
    const QString heads[] = {tr("Value"), tr("Spread ±"), tr("Source, or \"assumed\"")};
    for (int column = 0; column < 3; ++column)
        grid->addWidget(new QLabel(heads[column], this), line, column + 1);
    const auto add = [&](const QString& name, const QString& label,
                         part::MaterialNumber part::MaterialPair::*number, double high, int decimals,
                         const QString& unit) {
        ++line;
        const auto box = [&](const QString& what, double value) {
            auto* spin = new QDoubleSpinBox(this);
            spin->setObjectName("pair." + name + "." + what);
            spin->setAccessibleName(label + ' ' + what);
            spin->setDecimals(decimals);
            spin->setRange(0.0, high);
            spin->setSingleStep(decimals == 0 ? 10.0 : 0.01);
            spin->setSuffix(unit);
            spin->setValue(value);
            return spin;
        };
        const part::MaterialNumber& present = pair_.*number;
        Row row{number, box("value", present.value), box("spread", present.spread),
                new QLineEdit(fromText(present.source), this)};
        row.source->setObjectName("pair." + name + ".source");
        row.source->setAccessibleName(label + ' ' + tr("source"));
        row.source->setCursorPosition(0);
        grid->addWidget(new QLabel(label, this), line, 0);
        grid->addWidget(row.value, line, 1);
        grid->addWidget(row.spread, line, 2);
        grid->addWidget(row.source, line, 3);
        rows_.push_back(row);
    };
    add("static", tr("Static friction"), &part::MaterialPair::staticFriction, 2.0, 3, {});
    add("kinetic", tr("Kinetic friction"), &part::MaterialPair::kineticFriction, 2.0, 3, {});
    add("restitution", tr("Restitution"), &part::MaterialPair::restitution, 1.0, 3, {});
    add("density", tr("Density"), &part::MaterialPair::density, 30000.0, 1, " kg/m³");
    grid->setColumnStretch(3, 1);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel, this);
    buttons->button(QDialogButtonBox::Save)->setObjectName("pair.save");
    connect(buttons, &QDialogButtonBox::accepted, this, &PairEditor::save);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* column = new QVBoxLayout(this);
    column->addLayout(grid);
    column->addWidget(problem_);
    column->addWidget(buttons);
    resize(640, sizeHint().height());
}

void PairEditor::save() {
    part::MaterialPair pair = pair_;
    pair.material = material_->text().trimmed().toStdString();
    pair.surface = surface_->text().trimmed().toStdString();
    for (const Row& row : rows_) {
        part::MaterialNumber& number = pair.*row.number;
        // A box shows three digits; a number that it was not changed in keeps all of its own.
        const auto take = [](double& value, const QDoubleSpinBox& box) {
            if (box.textFromValue(value) != box.textFromValue(box.value())) value = box.value();
        };
        take(number.value, *row.value);
        take(number.spread, *row.spread);
        number.source = row.source->text().trimmed().toStdString();
    }
    const auto problem = save_(pair);
    if (!problem) return accept();
    problem_->setText(*problem);
    look::colourText(*problem_, look::Tone::bad);
    problem_->show();
}

MaterialsDialog::MaterialsDialog(std::filesystem::path own, const QString& search, bool canUse,
                                 QWidget* parent)
    : QDialog(parent),
      own_(std::move(own)),
      canUse_(canUse),
      model_(new QStandardItemModel(0, kColumns, this)),
      found_(new FoundPairs(this)),
      search_(new QLineEdit(search, this)),
      table_(new QTableView(this)),
      details_(new QLabel(this)),
      problems_(new QLabel(this)),
      edit_(new QPushButton(this)),
      remove_(new QPushButton(tr("Remove"), this)),
      use_(new QPushButton(tr("Use for this study"), this)) {
    setObjectName("materials");
    setWindowTitle(tr("Materials"));
    setAttribute(Qt::WA_DeleteOnClose);
    model_->setHorizontalHeaderLabels({tr("Part material"), tr("Surface"), tr("Static friction"),
                                       tr("Kinetic friction"), tr("Restitution"), tr("Density, kg/m³"),
                                       tr("From"), tr("Sources")});
    found_->setSourceModel(model_);
    search_->setObjectName("materials.search");
    search_->setPlaceholderText(tr("Search materials, surfaces and sources"));
    search_->setAccessibleName(search_->placeholderText());
    search_->setClearButtonEnabled(true);
    connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
        static_cast<FoundPairs*>(found_)->search(text);
        showCurrent();
    });

    table_->setObjectName("materials.table");
    table_->setAccessibleName(tr("Pairs of materials"));
    table_->setModel(found_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setAlternatingRowColors(true);
    table_->setShowGrid(false);
    table_->setWordWrap(false);
    table_->verticalHeader()->hide();
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->setTabKeyNavigation(false);
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &MaterialsDialog::showCurrent);
    connect(table_, &QTableView::doubleClicked, this, &MaterialsDialog::use);

    details_->setObjectName("materials.details");
    details_->setWordWrap(true);
    details_->setTextFormat(Qt::RichText);
    details_->setAlignment(Qt::AlignTop);
    details_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    details_->setMinimumHeight(4 * details_->fontMetrics().lineSpacing() + 4);
    problems_->setObjectName("materials.problems");
    problems_->setWordWrap(true);

    auto* column = new QVBoxLayout(this);
    column->addWidget(search_);
    column->addWidget(table_, 1);
    column->addWidget(details_);
    column->addWidget(problems_);
    addActions();
    resize(1080, 620);
    read();
    emit search_->textChanged(search_->text());
}

void MaterialsDialog::addActions() {
    auto* add = new QPushButton(tr("New..."), this);
    auto* import = new QPushButton(tr("Import..."), this);
    auto* close = new QPushButton(tr("Close"), this);
    add->setObjectName("materials.new");
    edit_->setObjectName("materials.edit");
    remove_->setObjectName("materials.remove");
    import->setObjectName("materials.import");
    use_->setObjectName("materials.use");
    close->setObjectName("materials.close");
    add->setToolTip(tr("An entry of your own, beginning with the numbers of the one that is picked"));
    import->setToolTip(tr("Takes a file of materials (JSON) into your own"));
    use_->setToolTip(tr("Sets the study's friction and restitution, and the part's material and density"));
    connect(add, &QPushButton::clicked, this, &MaterialsDialog::makeNew);
    connect(edit_, &QPushButton::clicked, this, &MaterialsDialog::editCurrent);
    connect(remove_, &QPushButton::clicked, this, &MaterialsDialog::removeCurrent);
    connect(import, &QPushButton::clicked, this, &MaterialsDialog::import);
    connect(use_, &QPushButton::clicked, this, &MaterialsDialog::use);
    connect(close, &QPushButton::clicked, this, &QDialog::reject);
    auto* row = new QHBoxLayout;
    for (QPushButton* button : {add, edit_, remove_, import}) {
        button->setAutoDefault(false);
        row->addWidget(button);
    }
    row->addStretch(1);
    row->addWidget(use_);
    row->addWidget(close);
    use_->setDefault(true);
    static_cast<QVBoxLayout*>(layout())->addLayout(row);
}

void MaterialsDialog::read(const std::string& select) {
    reading_ = true;
    library_ = part::readMaterials(own_);
    model_->setRowCount(0);
    int place = 0;
    int picked = -1;
    for (const part::MaterialPair& pair : library_.pairs) {
        const QString texts[] = {fromText(pair.material),
                                 fromText(pair.surface),
                                 withSpread(pair.staticFriction),
                                 withSpread(pair.kineticFriction),
                                 withSpread(pair.restitution),
                                 withSpread(pair.density),
                                 pair.own ? tr("You") : tr("Trapwright"),
                                 fromText(part::describeSources(pair))};
        QList<QStandardItem*> row;
        for (int i = 0; i < kColumns; ++i) {
            auto* item = new QStandardItem(texts[i]);
            item->setData(place, kPlaceRole);
            if (i == kSource) item->setToolTip(texts[i]);
            if (i >= kStatic && i <= kDensity) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            row << item;
        }
        model_->appendRow(row);
        if (pair.name == select) picked = place;
        ++place;
    }
    reading_ = false;
    // The sources take what the others leave.
    for (int column = 0; column < kSource; ++column)
        table_->resizeColumnToContents(column);
    if (picked >= 0) {
        const QModelIndex index = found_->mapFromSource(model_->index(picked, 0));
        if (!index.isValid()) search_->clear();
        table_->setCurrentIndex(found_->mapFromSource(model_->index(picked, 0)));
        table_->scrollTo(table_->currentIndex());
    }
    QStringList problems;
    for (const std::string& problem : library_.problems)
        problems << tr("Not read: %1").arg(fromText(problem));
    tell(problems.join('\n'));
    showCurrent();
}

const part::MaterialPair* MaterialsDialog::current() const {
    const QModelIndex index = table_->currentIndex();
    if (!index.isValid()) return nullptr;
    return &library_.pairs[index.data(kPlaceRole).toUInt()];
}

void MaterialsDialog::showCurrent() {
    if (reading_) return;
    if (current() == nullptr && found_->rowCount() > 0) table_->selectRow(0);
    const part::MaterialPair* pair = current();
    details_->setText(pair != nullptr ? describe(*pair)
                                      : tr("No pair of materials matches. Make one of your own with New."));
    // What comes with the program stays as it is; a copy of it can be changed, and goes before it.
    edit_->setText(pair == nullptr || pair->own ? tr("Edit...") : tr("Edit a copy..."));
    edit_->setEnabled(pair != nullptr);
    remove_->setEnabled(pair != nullptr && pair->own);
    remove_->setToolTip(remove_->isEnabled() || pair == nullptr ? QString()
                                                                : tr("What comes with Trapwright stays"));
    use_->setEnabled(pair != nullptr && canUse_);
}

void MaterialsDialog::edit(const part::MaterialPair& pair, const QString& title,
                           const std::optional<part::MaterialPair>& before) {
    auto* editor = new PairEditor(
        pair, title,
        [this, before](const part::MaterialPair& wanted) -> std::optional<QString> {
            const auto saved = part::savePair(own_, wanted, before);
            if (!saved) return fromText(saved.error().message);
            read(part::pairName(wanted.material, wanted.surface));
            emit libraryChanged();
            return std::nullopt;
        },
        this);
    editor->open();
}

void MaterialsDialog::makeNew() {
    part::MaterialPair pair;
    if (const part::MaterialPair* like = current()) {
        pair = *like;
        pair.surface.clear();
        for (part::MaterialNumber* number : {&pair.staticFriction, &pair.kineticFriction, &pair.restitution})
            number->source = "assumed";
    }
    pair.own = false;
    edit(pair, tr("New pair of materials"), std::nullopt);
}

void MaterialsDialog::editCurrent() {
    const part::MaterialPair* pair = current();
    if (pair == nullptr) return;
    edit(*pair, fromText(part::pairTitle(*pair)),
         pair->own ? std::optional(*pair) : std::optional<part::MaterialPair>());
}

void MaterialsDialog::removeCurrent() {
    const part::MaterialPair* pair = current();
    if (pair == nullptr || !pair->own) return;
    auto* question =
        new QMessageBox(QMessageBox::Question, tr("Remove a pair of materials"),
                        tr("Remove your own entry \"%1\"?").arg(fromText(part::pairTitle(*pair))),
                        QMessageBox::NoButton, this);
    question->setObjectName("materials.removeQuestion");
    question->setTextFormat(Qt::PlainText);
    question->setAttribute(Qt::WA_DeleteOnClose);
    auto* yes = question->addButton(tr("Remove"), QMessageBox::AcceptRole);
    question->addButton(QMessageBox::Cancel);
    connect(yes, &QPushButton::clicked, this, [this, removed = *pair] {
        const auto status = part::removePair(removed);
        read();
        if (!status) tell(fromText(status.error().message));
        emit libraryChanged();
    });
    question->open();
}

void MaterialsDialog::import() {
    look::askForFile(
        this,
        {"materials", tr("Import materials"), tr("Import"), tr("Materials (*.json);;All files (*)"), {}, {}},
        [this](const std::filesystem::path& file) {
            const auto pairs = part::importPairs(file, own_);
            read(pairs ? pairs->front().name : std::string());
            if (!pairs) tell(fromText(pairs.error().message));
            emit libraryChanged();
        });
}

void MaterialsDialog::use() {
    const part::MaterialPair* pair = current();
    if (pair == nullptr || !canUse_) return;
    emit pairWanted(*pair);
    accept();
}

void MaterialsDialog::tell(const QString& message) {
    problems_->setVisible(!message.isEmpty());
    problems_->setText(message);
    look::colourText(*problems_, look::Tone::bad);
}

part::MaterialLibrary readMaterials(const session::StudyDesign& design) {
    return part::readMaterials(design.ownMaterials());
}

void usePair(session::StudyDesign& design, const part::MaterialPair& pair) {
    study::Settings settings = design.settings();
    study::useContact(settings, pair);
    design.changeSettings(settings, MaterialsDialog::tr("Pair of materials"));
    if (settings.part.material == pair.material && settings.part.density == pair.density.value) return;
    settings.part.material = pair.material;
    settings.part.density = pair.density.value;
    store::StoredPart stored = design.storedPart();
    stored.options.density = pair.density.value;
    design.changePart(stored, settings.part, MaterialsDialog::tr("Material"));
}

QString pairText(const part::MaterialPair& pair) {
    return MaterialsDialog::tr("%1: friction %2 static, %3 kinetic; restitution %4")
        .arg(fromText(part::pairTitle(pair)), numberText(pair.staticFriction.value),
             numberText(pair.kineticFriction.value), numberText(pair.restitution.value));
}

}  // namespace trapwright::pages
