#pragma once

#include <sys/resource.h>

#include <QByteArray>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QStringList>
#include <memory>

/// Runs the real program as a process, as a user or a script does.
namespace trapwright::test {

inline constexpr int kPatience = 60000;  // [ms]

struct Ran {
    int code = -1;  // exit status; -1 if a signal ended it, or we did because it took too long
    QByteArray output;
    QByteArray errors;

    /// The one document of --json; null if there is anything else.
    [[nodiscard]] QJsonObject json() const { return QJsonDocument::fromJson(output).object(); }
    /// For messages of failing tests.
    [[nodiscard]] QByteArray all() const { return QByteArray::number(code) + "\n" + output + errors; }
};

/// Starts the program in a folder.
inline std::unique_ptr<QProcess> start(const QString& folder, const QStringList& arguments) {
    auto process = std::make_unique<QProcess>();
    process->setWorkingDirectory(folder);
    process->start(TRAPWRIGHT_PROGRAM, arguments);
    process->waitForStarted(kPatience);
    return process;
}

inline Ran finish(QProcess& process) {
    Ran ran;
    const bool finished = process.waitForFinished(kPatience);
    if (!finished) {
        process.kill();
        process.waitForFinished(kPatience);
    }
    if (finished && process.exitStatus() == QProcess::NormalExit) ran.code = process.exitCode();
    ran.output = process.readAllStandardOutput();
    ran.errors = process.readAllStandardError();
    if (!finished)
        ran.errors +=
            "\nThe test ended it: it took longer than " + QByteArray::number(kPatience / 1000) + " s.\n";
    return ran;
}

inline Ran run(const QString& folder, const QStringList& arguments) {
    return finish(*start(folder, arguments));
}

/// The commands that the program's --help lists.
inline QStringList listCommands() {
    const QString help = QString::fromUtf8(run(".", {"--help"}).output);
    QStringList names;
    for (const QString& line :
         help.mid(help.indexOf("\nCommands:\n") + 11).section("\n\n", 0, 0).split('\n')) {
        // The texts of a command go on further to the right.
        if (line.startsWith("  ") && !line.startsWith("   ")) names << line.section(' ', 2, 2);
    }
    return names;
}

/// The same where no file can grow past `bytes`, as on a disk that is full.
inline Ran runOnFullDisk(const QString& folder, const QStringList& arguments, rlim_t bytes) {
    QProcess process;
    process.setWorkingDirectory(folder);
    process.setChildProcessModifier([bytes] {
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    });
    process.start(TRAPWRIGHT_PROGRAM, arguments);
    return finish(process);
}

inline void write(const QString& path, const QByteArray& content) {
    QFile file(path);
    (void)file.open(QIODevice::WriteOnly);
    file.write(content);
}

/// A new cuboid study whose generations take a moment: few trials, each of them short.
inline QStringList quickStudy(const QString& name, int generations) {
    return {"evolve",        name,
            "--preset",      "cuboid",
            "--population",  "8",
            "--trials",      "3",
            "--generations", QString::number(generations),
            "--set",         "simulation.termination.timeLimit_s=0.3",
            "--set",         "simulation.termination.stuckTime_s=0.2"};
}

}  // namespace trapwright::test
