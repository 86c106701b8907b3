#include <fmt/format.h>
#include <sys/resource.h>

#include <QCoreApplication>
#include <QDir>
#include <QEventLoop>
#include <QTemporaryDir>
#include <QTimer>
#include <fstream>

#include "tests/ui/transports/hostile_sequence.h"

using namespace trapwright;

namespace {

long entriesOf(const char* folder) {
    return static_cast<long>(
        QDir(folder).entryList(QDir::AllEntries | QDir::System | QDir::NoDotAndDotDot).size());
}

/// Memory that is in use. [kB]
long memory() {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
    }
    return 0;
}

}  // namespace

/// Runs hostile sequences and prints one line for each: hostile_device tcp|rtu|reo FIRST LAST AT_ONCE.
int main(int count, char** words) {
    const QCoreApplication application(count, words);
    if (count != 5) {
        fmt::print(stderr, "Usage: hostile_device tcp|rtu|reo FIRST LAST AT_ONCE\n");
        return 2;
    }
    qputenv("QT_LOGGING_RULES", "qt.modbus*=false");
    const QTemporaryDir folder;
    const QString link = words[1];
    const std::string path = folder.path().toStdString();
    // The first one loads what stays: libraries, the thread pool.
    tests::runHostile(link, 900001, 900004, 4, path);
    const long files = entriesOf("/proc/self/fd");
    const long threads = entriesOf("/proc/self/task");
    const long before = memory();

    // How late this thread's events are, as the window's would be.
    QElapsedTimer clock;
    double longest = 0.0;
    QTimer probe;
    probe.setTimerType(Qt::PreciseTimer);
    probe.setInterval(5);
    QObject::connect(&probe, &QTimer::timeout, [&] {
        longest = std::max(longest, 1e-6 * static_cast<double>(clock.nsecsElapsed()) - 5.0);
        clock.restart();
    });
    clock.start();
    probe.start();
    const auto outcomes =
        tests::runHostile(link, std::stoull(words[2]), std::stoull(words[3]), std::stoull(words[4]), path);
    for (const tests::Outcome& outcome : outcomes) {
        fmt::print(
            "sequence {} {} started={:d} rest={:.3f} intime={:d} told={:d} self={:d} recovered={:d} "
            "end={:.3f} "
            "reason={} moods={}\n",
            words[1], outcome.seed, outcome.started, outcome.rest, outcome.rested, outcome.told,
            outcome.selfMoved, outcome.recovered, outcome.end, outcome.reason.toStdString(),
            outcome.mood.trimmed().replace(' ', ',').toStdString());
    }
    fmt::print("process {} block_ms={:.1f} files={} threads={} memory_kB={}\n", words[1], longest,
               entriesOf("/proc/self/fd") - files, entriesOf("/proc/self/task") - threads, memory() - before);
    return 0;
}
