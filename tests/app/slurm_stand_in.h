#pragma once

#include <QDir>
#include <QFile>
#include <QString>

/// Commands that stand for Slurm's, with the real batch script: one job, number 7, started at once, in one
/// process.
namespace trapwright::test {

inline constexpr const char* kSbatch = R"sh(#!/bin/bash
# As Slurm: a script with the options in front of it left out, in the background, in a session of its own.
options=()
while [[ $1 == --* ]]; do options+=("$1"); shift; done
echo "${options[@]}" > "$SLURM_STANDIN/options"
SLURM_JOB_ID=7 SLURM_NTASKS=2 setsid bash "$@" > slurm-7.out 2>&1 < /dev/null &
echo $! > "$SLURM_STANDIN/process"
echo "a word of the site"
echo 7
)sh";
inline constexpr const char* kSqueue = R"sh(#!/bin/bash
if kill -0 "$(cat "$SLURM_STANDIN/process")" 2> /dev/null; then
    echo RUNNING
else
    echo "slurm_load_jobs error: Invalid job id specified" >&2
    exit 1
fi
)sh";
inline constexpr const char* kScancel = R"sh(#!/bin/bash
signal=TERM
for argument; do [[ $argument == --signal=* ]] && signal=${argument#--signal=}; done
echo "$@" >> "$SLURM_STANDIN/cancelled"
kill "-$signal" "$(cat "$SLURM_STANDIN/process")"
)sh";

/// An sbatch that has no such partition.
inline constexpr const char* kRefusing = R"sh(#!/bin/sh
echo 'sbatch: error: invalid partition specified: long' >&2
exit 1
)sh";

class SlurmStandIn {
 public:
    explicit SlurmStandIn(const QString& folder) : folder_(folder) {}

    /// Puts the commands into folder/bin.
    [[nodiscard]] bool install() const {
        return QDir(folder_).mkpath("bin") && write("sbatch", kSbatch) && write("squeue", kSqueue) &&
               write("scancel", kScancel);
    }
    /// Another command in the place of one.
    [[nodiscard]] bool write(const QString& command, const QByteArray& script) const {
        QFile file(folder_ + "/bin/" + command);
        const bool isWritten =
            file.open(QIODevice::WriteOnly | QIODevice::Truncate) && file.write(script) == script.size();
        file.close();
        return isWritten && file.setPermissions(file.permissions() | QFileDevice::ExeOwner);
    }
    /// What the commands noted: "options" of sbatch, "cancelled" of scancel, the job's "process".
    [[nodiscard]] QByteArray read(const QString& name) const {
        QFile file(folder_ + '/' + name);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
    /// Where the commands are, and that the job's program is started by itself; `path`: PATH of before.
    [[nodiscard]] QList<std::pair<QString, QString>> environment(const QString& path) const {
        return {{"SLURM_STANDIN", folder_},
                {"TRAPWRIGHT_LAUNCH", "env"},
                {"TRAPWRIGHT", TRAPWRIGHT_PROGRAM},
                {"PATH", folder_ + "/bin:" + path}};
    }

 private:
    QString folder_;
};

}  // namespace trapwright::test
