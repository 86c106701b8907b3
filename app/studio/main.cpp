#include <QApplication>
#include <QCommandLineParser>
#include <QFile>
#include <QStandardPaths>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "app/transports/make_drive.h"
#include "app/transports/virtual_feeder.h"
#include "app/trapwright/program.h"
#include "sim/engines/registry.h"
#include "ui/pages/field_texts.h"
#include "ui/scene/scene_view.h"
#include "ui/window/end_signals.h"
#include "ui/window/main_window.h"
#include "ui/window/shortcut_list.h"

namespace {

using namespace trapwright;

base::Result<session::ServedFeeder> serveFeeder(const drive::Profile& profile) {
    auto feeder = transports::serveVirtualFeeder(profile);
    if (!feeder) return feeder.error();
    const std::shared_ptr<transports::VirtualFeeder> served = std::move(*feeder);
    return session::ServedFeeder{served, served->address()};
}

std::filesystem::path toPath(const QString& text) {
    return QFile::encodeName(text).toStdString();
}

/// Without a display what only prints still works, and the rest says what to do.
bool findDisplay(int count, char** arguments) {
    if (qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY") ||
        qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) {
        return true;
    }
    for (int i = 1; i < count; ++i) {
        const std::string_view argument = arguments[i];
        if (argument != "--shortcuts" && argument != "--settings-page" && argument != "--help" &&
            argument != "-h" && argument != "--version" && argument != "-v") {
            continue;
        }
        qputenv("QT_QPA_PLATFORM", "offscreen");
        return true;
    }
    std::fputs(
        "trapwright-studio: there is no display. Work without one with the command line: trapwright --help\n",
        stderr);
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    // A file that reaches its size limit is an error to report like a full disk, not the end of the process.
    (void)std::signal(SIGXFSZ, SIG_IGN);
    if (!findDisplay(argc, argv)) return 1;
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName("Trapwright");
    QCoreApplication::setApplicationName("trapwright-studio");
    QCoreApplication::setApplicationVersion(TRAPWRIGHT_VERSION);
    QGuiApplication::setDesktopFileName("trapwright-studio");

    QCommandLineParser parser;
    parser.setApplicationDescription(QApplication::tr("Designs tracks for vibratory part feeders."));
    parser.addHelpOption();
    parser.addVersionOption();
    const QCommandLineOption shortcuts("shortcuts",
                                       QApplication::tr("Print the table of keyboard shortcuts and end."));
    parser.addOption(shortcuts);
    const QCommandLineOption settingsPage("settings-page",
                                          QApplication::tr("Print the help's page of settings and end."));
    parser.addOption(settingsPage);
    parser.addPositionalArgument("file", QApplication::tr("A study to open, or a part to import."), "[file]");
    parser.process(application);

    if (parser.isSet(settingsPage)) {
        std::fputs(pages::settingsReference().toUtf8().constData(), stdout);
        return 0;
    }
    const std::filesystem::path data =
        toPath(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation));
    window::MainWindow window({engines::registry(),
                               app::kProgram,
                               data / "running",
                               {transports::makeDrive, serveFeeder, data / "drives"},
                               data / "materials"});
    if (parser.isSet(shortcuts)) {
        std::fputs(window::shortcutTable(window::findShortcuts(window)).toUtf8().constData(), stdout);
        return 0;
    }
    const window::EndSignals ends;
    QObject::connect(&ends, &window::EndSignals::asked, &window, &window::MainWindow::closeUnasked);
    window.show();
    if (!parser.positionalArguments().isEmpty())
        window.openFile(toPath(parser.positionalArguments().front()));
    return QApplication::exec();
}
