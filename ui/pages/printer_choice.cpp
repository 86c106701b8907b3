#include "ui/pages/printer_choice.h"

#include <QAction>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/resources.h"
#include "ui/look/file_dialog.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/pages/value_edit.h"

namespace trapwright::pages {

namespace {

constexpr auto kSetting = "print/printer";
constexpr auto kFirstChoice = "prusa-mk4";
constexpr int kEditorWidth = 128;

QString fromText(const std::string& text) {
    return QString::fromStdString(text);
}

}  // namespace

PrinterEditor::PrinterEditor(const track::Printer& printer, const QString& title, Save save, QWidget* parent)
    : QDialog(parent),
      printer_(printer),
      save_(std::move(save)),
      title_(new QLineEdit(fromText(printer.title), this)),
      problem_(new QLabel(this)) {
    setObjectName("dialog.printer");
    setAttribute(Qt::WA_DeleteOnClose);
    setWindowTitle(title);
    auto* form = new QFormLayout;
    title_->setObjectName("printer.title");
    form->addRow(tr("Name"), title_);
    const auto add = [&](const char* key, const QString& label, const QString& unitName, const QString& help,
                         double low, double high, double& target, double unit) {
        auto* edit = new ValueEdit(unitName, low, high, false, this);
        edit->setObjectName(QString("printer.") + key);
        edit->setFixedWidth(kEditorWidth);
        edit->setText(QString::number(target / unit, 'g', 6));
        edit->setToolTip(help);
        edit->setAccessibleName(label + ", " + unitName);
        form->addRow(label, edit);
        rows_.push_back({edit, &target, unit});
    };
    using base::kDegree;
    using base::kMillimetre;
    add("bedX", tr("Bed, x"), tr("mm"), tr("What can be printed on, without what the printer keeps free"), 10,
        5000, printer_.space.x, kMillimetre);
    add("bedY", tr("Bed, y"), tr("mm"), tr("What can be printed on, without what the printer keeps free"), 10,
        5000, printer_.space.y, kMillimetre);
    add("height", tr("Height"), tr("mm"), tr("How high it prints"), 10, 5000, printer_.space.height,
        kMillimetre);
    add("thinnestWall", tr("Thinnest wall"), tr("mm"), tr("About three times the nozzle's width prints well"),
        0.05, 20, printer_.thinnestWall, kMillimetre);
    add("steepestOverhang", tr("Steepest overhang"), tr("°"),
        tr("From upright, without supports; 90° is a ceiling"), 0, 90, printer_.steepestOverhang, kDegree);
    problem_->setObjectName("printer.problem");
    problem_->setWordWrap(true);
    problem_->hide();
    auto* buttons = new QDialogButtonBox(this);
    QPushButton* keep = buttons->addButton(tr("Save printer"), QDialogButtonBox::AcceptRole);
    keep->setObjectName("printer.save");
    buttons->addButton(QDialogButtonBox::Cancel);
    connect(buttons, &QDialogButtonBox::accepted, this, &PrinterEditor::save);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* column = new QVBoxLayout(this);
    column->addLayout(form);
    column->addWidget(problem_);
    column->addWidget(buttons);
}

void PrinterEditor::save() {
    const auto complain = [this](const QString& text) {
        problem_->setText(text);
        look::colourText(*problem_, look::Tone::bad);
        problem_->show();
    };
    for (const Row& row : rows_) {
        bool isNumber = false;
        const double value = row.edit->number().toDouble(&isNumber);
        row.edit->setBad(!isNumber);
        if (!isNumber) return complain(tr("%1: this is not a number.").arg(row.edit->accessibleName()));
        *row.target = value * row.unit;
    }
    const std::string title = title_->text().trimmed().toStdString();
    if (title != printer_.title || printer_.name.empty()) printer_.name = track::nameOfTitle(title);
    printer_.title = title;
    if (printer_.name.empty()) return complain(tr("Give the printer a name with a letter or digit in it."));
    if (const auto problem = save_(printer_)) return complain(*problem);
    accept();
}

PrinterChoice::PrinterChoice(QWidget* parent)
    : QWidget(parent),
      own_(base::findOwnFolder("printers")),
      names_(new QComboBox(this)),
      about_(new QLabel(this)) {
    names_->setObjectName("print.printer");
    names_->setAccessibleName(tr("Printer"));
    names_->setToolTip(tr("Which printer the track is for: its bed, thinnest wall and steepest overhang"));
    names_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    about_->setObjectName("print.printer.about");
    about_->setWordWrap(true);
    about_->setForegroundRole(QPalette::PlaceholderText);
    auto* more = new QToolButton(this);
    more->setObjectName("print.printer.more");
    more->setIcon(look::icon("more"));
    more->setPopupMode(QToolButton::InstantPopup);
    more->setToolTip(tr("Printers of your own: new, edit, import, remove"));
    more->setAccessibleName(tr("Printers of your own"));
    more->setStyleSheet("QToolButton::menu-indicator { image: none; }");
    more->setMenu(new QMenu(more));
    edit_ = more->menu()->addAction(tr("&Edit..."));
    auto* add = more->menu()->addAction(look::icon("add"), tr("&New..."));
    auto* import = more->menu()->addAction(look::icon("import"), tr("&Import..."));
    remove_ = more->menu()->addAction(tr("&Remove"));
    edit_->setObjectName("printer.edit");
    add->setObjectName("printer.new");
    import->setObjectName("printer.import");
    remove_->setObjectName("printer.remove");

    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    row->addWidget(names_, 1);
    row->addWidget(more);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addLayout(row);
    column->addWidget(about_);

    connect(names_, &QComboBox::activated, this, [this] {
        QSettings().setValue(kSetting, names_->currentData());
        take();
        emit changed();
    });
    connect(edit_, &QAction::triggered, this, [this] { edit(printer_, tr("Edit printer")); });
    connect(add, &QAction::triggered, this, [this] {
        track::Printer printer = printer_;
        printer.name.clear();
        printer.title = tr("My printer").toStdString();
        printer.sources.clear();
        edit(printer, tr("New printer"));
    });
    connect(import, &QAction::triggered, this, [this] {
        look::askForFile(
            this, {"printers", tr("Import printer"), tr("Import"), tr("Printers (*.json)"), {}, {}},
            [this](const std::filesystem::path& file) {
                const auto printer = track::importPrinter(file, own_);
                if (!printer)
                    return emit failed(tr("The printer was not imported"), fromText(printer.error().message));
                read(printer->name);
                emit changed();
            });
    });
    connect(remove_, &QAction::triggered, this, &PrinterChoice::askToRemove);
    read(QSettings().value(kSetting, kFirstChoice).toString().toStdString());
    // As soon as somebody listens.
    QTimer::singleShot(0, this, [this] {
        for (const std::string& problem : list_.problems)
            emit failed(tr("A printer cannot be used"), fromText(problem));
    });
}

void PrinterChoice::read(const std::string& wanted) {
    list_ = track::readPrinters(own_);
    {
        const QSignalBlocker quiet(names_);
        names_->clear();
        for (const track::Printer& printer : list_.printers) {
            const QString title = fromText(printer.title);
            names_->addItem(printer.own ? tr("%1 (your own)").arg(title) : title, fromText(printer.name));
            if (printer.name == wanted) names_->setCurrentIndex(names_->count() - 1);
        }
    }
    if (names_->count() > 0) QSettings().setValue(kSetting, names_->currentData());
    take();
}

void PrinterChoice::take() {
    const auto place = static_cast<std::size_t>(names_->currentIndex());
    printer_ = place < list_.printers.size() ? list_.printers[place] : track::Printer{};
    const geometry::BuildSpace& space = printer_.space;
    about_->setText(tr("Bed %1 × %2 mm, height %3 mm")
                        .arg(look::numberText(space.x * 1e3, 4), look::numberText(space.y * 1e3, 4),
                             look::numberText(space.height * 1e3, 4)));
    QStringList sources;
    for (const std::string& source : printer_.sources)
        sources << fromText(source);
    about_->setToolTip(sources.join('\n'));
    edit_->setText(printer_.own ? tr("&Edit...") : tr("&Edit a copy..."));
    remove_->setEnabled(printer_.own);
}

void PrinterChoice::edit(const track::Printer& printer, const QString& title) {
    auto* editor = new PrinterEditor(
        printer, title,
        [this](const track::Printer& wanted) -> std::optional<QString> {
            if (own_.empty()) return tr("There is no folder to keep it in.");
            const auto saved = track::savePrinter(own_, wanted);
            if (!saved) return fromText(saved.error().message);
            read(wanted.name);
            emit changed();
            return std::nullopt;
        },
        this);
    editor->open();
}

void PrinterChoice::askToRemove() {
    auto* question = new QMessageBox(QMessageBox::Question, tr("Remove a printer"),
                                     tr("Remove your own printer \"%1\"?").arg(fromText(printer_.title)),
                                     QMessageBox::NoButton, this);
    question->setObjectName("printer.removeQuestion");
    question->setAttribute(Qt::WA_DeleteOnClose);
    QPushButton* yes = question->addButton(tr("Remove"), QMessageBox::AcceptRole);
    yes->setObjectName("printer.removeQuestion.remove");
    question->addButton(QMessageBox::Cancel);
    connect(yes, &QPushButton::clicked, this, [this, name = printer_.name] {
        const auto removed = track::removePrinter(own_, name);
        if (!removed) emit failed(tr("The printer was not removed"), fromText(removed.error().message));
        read(name);  // one that it was a copy of, or else the first
        emit changed();
    });
    question->open();
}

}  // namespace trapwright::pages
