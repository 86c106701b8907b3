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

void ask(QWidget* parent, const FileQuestion& question, QFileDialog::FileMode mode,
         const FilesAnswer& answer) {
    const bool isNew = mode == QFileDialog::AnyFile;
    const QString setting = "folders/" + question.name;
    const QString study = fileOfWindow(parent);
    auto* dialog = new QFileDialog(parent, question.title, firstFolder(study, setting), question.filter);
    dialog->setObjectName("dialog.file");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(mode);
    dialog->setAcceptMode(isNew ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
    dialog->setLabelText(QFileDialog::Accept, question.accept);
    dialog->setDefaultSuffix(question.suffix);
    if (isNew) dialog->selectFile(firstName(study, question));
    QObject::connect(dialog, &QFileDialog::filesSelected, parent, [setting, answer](QStringList files) {
        if (files.isEmpty()) return;
        files.sort();
        QSettings().setValue(setting, QFileInfo(files.front()).absolutePath());
        std::vector<std::filesystem::path> paths;
        for (const QString& file : files)
            paths.emplace_back(QFile::encodeName(file).toStdString());
        answer(paths);
    });
    dialog->open();
}

}  // namespace

void askForFile(QWidget* parent, const FileQuestion& question, const FileAnswer& answer) {
    ask(parent, question, QFileDialog::ExistingFile, [answer](const auto& files) { answer(files.front()); });
}

void askForFiles(QWidget* parent, const FileQuestion& question, const FilesAnswer& answer) {
    ask(parent, question, QFileDialog::ExistingFiles, answer);
}

void askForNewFile(QWidget* parent, const FileQuestion& question, const FileAnswer& answer) {
    ask(parent, question, QFileDialog::AnyFile, [answer](const auto& files) { answer(files.front()); });
}

}  // namespace trapwright::look
