#include "ui/look/file_dialog.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

namespace trapwright::look {

namespace {

void ask(QWidget* parent, const FileQuestion& question, bool isNew, const FileAnswer& answer) {
    const QString setting = "folders/" + question.name;
    const QString home = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    auto* dialog =
        new QFileDialog(parent, question.title, QSettings().value(setting, home).toString(), question.filter);
    dialog->setObjectName("dialog.file");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(isNew ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
    dialog->setAcceptMode(isNew ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
    dialog->setLabelText(QFileDialog::Accept, question.accept);
    dialog->setDefaultSuffix(question.suffix);
    if (!question.suggest.isEmpty()) dialog->selectFile(question.suggest);
    QObject::connect(dialog, &QFileDialog::fileSelected, parent, [setting, answer](const QString& file) {
        QSettings().setValue(setting, QFileInfo(file).absolutePath());
        answer(std::filesystem::path(QFile::encodeName(file).toStdString()));
    });
    dialog->open();
}

}  // namespace

void askForFile(QWidget* parent, const FileQuestion& question, const FileAnswer& answer) {
    ask(parent, question, false, answer);
}

void askForNewFile(QWidget* parent, const FileQuestion& question, const FileAnswer& answer) {
    ask(parent, question, true, answer);
}

}  // namespace trapwright::look
