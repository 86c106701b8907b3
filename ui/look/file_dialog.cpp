#include "ui/look/file_dialog.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QRegularExpression>
#include <QSettings>
#include <QStandardPaths>

namespace trapwright::look {

namespace {

/// The file that the window of `widget` is about. A panel may float in a window of its own.
QString fileOfWindow(const QWidget* widget) {
    for (; widget != nullptr; widget = widget->parentWidget())
        if (!widget->windowFilePath().isEmpty()) return widget->windowFilePath();
    return {};
}

/// One that is there: of a folder that is not, the dialog would make a file's name.
QString firstFolder(const QString& study, const QString& setting) {
    const QStringList folders = {QSettings().value(setting).toString(),
                                 study.isEmpty() ? QString() : QFileInfo(study).absolutePath(),
                                 QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)};
    for (const QString& folder : folders)
        if (!folder.isEmpty() && QFileInfo(folder).isDir()) return folder;
    return QDir::homePath();
}

QString firstName(const QString& study, const FileQuestion& question) {
    const QStringList parts = {QFileInfo(study).completeBaseName(), question.subject};
    QString name = QStringList(parts.filter(QRegularExpression("."))).join('-');
    return name.replace('/', '-') + '.' + question.suffix;
}

void ask(QWidget* parent, const FileQuestion& question, bool isNew, const FileAnswer& answer) {
    const QString setting = "folders/" + question.name;
    const QString study = fileOfWindow(parent);
    auto* dialog = new QFileDialog(parent, question.title, firstFolder(study, setting), question.filter);
    dialog->setObjectName("dialog.file");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(isNew ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
    dialog->setAcceptMode(isNew ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
    dialog->setLabelText(QFileDialog::Accept, question.accept);
    dialog->setDefaultSuffix(question.suffix);
    if (isNew) dialog->selectFile(firstName(study, question));
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
