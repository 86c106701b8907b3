#pragma once

#include <QString>
#include <filesystem>
#include <functional>
#include <vector>

class QWidget;

namespace trapwright::look {

/// A question for a file. The folder is remembered under `name`; the first time it is that of the study that
/// the window is about (QWidget::windowFilePath), or else the user's documents. A new file has the study's
/// name to begin with.
struct FileQuestion {
    QString name;     // "study"
    QString title;    // "Open study"
    QString accept;   // the button's verb: "Open"
    QString filter;   // "Studies (*.trap)"
    QString suffix;   // added to a name without one
    QString subject;  // what of the study is in a new file: "fitness"; empty: all of it
};

/// The files that are chosen, in the order of their names.
using FilesAnswer = std::function<void(const std::vector<std::filesystem::path>&)>;
using FileAnswer = std::function<void(const std::filesystem::path&)>;

/// Asks for an existing file, for several, or for the name of a new one. Does not wait: `answer` is called if
/// one is chosen.
void askForFile(QWidget* parent, const FileQuestion& question, const FileAnswer& answer);
void askForFiles(QWidget* parent, const FileQuestion& question, const FilesAnswer& answer);
void askForNewFile(QWidget* parent, const FileQuestion& question, const FileAnswer& answer);

}  // namespace trapwright::look
