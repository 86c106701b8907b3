#include <fmt/format.h>

#include <QCoreApplication>
#include <QEventLoop>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>

#include "tests/app/transports/hostile_sequence.h"
#include "tests/ui/footprint.h"
#include "tests/ui/session/event_loop_probe.h"

using namespace trapwright;

namespace {

constexpr int kPatience = 20000;  // [ms]

void printFootprint(const char* link, int count, const tests::HostilePeer& peer) {
    const tests::Footprint now = tests::measureFootprint();
    fmt::print("reconnect {} {} connections={} files={} threads={} resident_MiB={:.2f} heap_MiB={:.3f}\n",
               link, count, peer.connections(), now.files, now.threads, now.resident, now.used);
    std::fflush(stdout);
}

bool fail(const char* link, int count, const char* what, const drive::DriveLoop& loop) {
    fmt::print(stderr, "reconnect {} {}: {}: {}\n", link, count, what, loop.snapshot().fault);
    return false;
}

/// Connects and disconnects so often, in this one process; every fifth time the peer is in trouble while it
/// is left. False: a connection did not come about, or did not end.
bool reconnect(const char* link, int times, const std::string& folder) {
    const drive::Profile profile = tests::hostileProfile(link);
    tests::HostilePeer peer(profile, 1, folder);
    constexpr std::array kTroubles = {tests::Mood::reset, tests::Mood::half, tests::Mood::closing,
                                      tests::Mood::garbage, tests::Mood::refused};
    for (int i = 1; i <= times; ++i) {
        drive::DriveLoop loop(
            profile, drive::Limits{0.9, 4.0}, [&] { return transports::makeDrive(profile, peer.address()); },
            drive::DriveLoop::Log());
        const auto rests = [&] {
            // A busy computer may have been late: that is a fault.
            if (loop.snapshot().state == drive::State::faulted) loop.acknowledge();
            return loop.snapshot().state == drive::State::idle;
        };
        if (!QTest::qWaitFor(rests, kPatience)) return fail(link, i, "there is no connection", loop);
        if (i % 5 == 0) {
            peer.setMood(kTroubles[static_cast<std::size_t>(i / 5) % kTroubles.size()]);
            QTest::qWait(150);
        }
        loop.end();
        if (!QTest::qWaitFor([&] { return loop.ended(); }, kPatience))
            return fail(link, i, "the connection does not end", loop);
        peer.setMood(tests::Mood::honest);
        if (i == 50 || i % 250 == 0 || i == times) printFootprint(link, i, peer);
    }
    return true;
}

}  // namespace

/// Runs hostile sequences and prints one line for each: hostile_device tcp|rtu|reo FIRST LAST AT_ONCE. Or
/// tells what so many connections leave behind: hostile_device reconnect tcp|rtu|reo TIMES.
int main(int count, char** words) {
    const QCoreApplication application(count, words);
    const bool reconnects = count == 4 && std::string(words[1]) == "reconnect";
    if (count != 5 && !reconnects) {
        fmt::print(stderr,
                   "Usage: hostile_device tcp|rtu|reo FIRST LAST AT_ONCE\n"
                   "       hostile_device reconnect tcp|rtu|reo TIMES\n");
        return 2;
    }
    qputenv("QT_LOGGING_RULES", "qt.modbus*=false");
    const QTemporaryDir folder;
    const std::string path = folder.path().toStdString();
    if (reconnects) return reconnect(words[2], std::stoi(words[3]), path) ? 0 : 1;
    const QString link = words[1];
    // The first one loads what stays: libraries, the thread pool.
    tests::runHostile(link, 900001, 900004, 4, path);
    const tests::Footprint before = tests::measureFootprint();

    // How late this thread's events are, as the window's would be.
    session::LateEvents late;
    late.start();
    const auto outcomes =
        tests::runHostile(link, std::stoull(words[2]), std::stoull(words[3]), std::stoull(words[4]), path);
    const double longest = late.stop();
    for (const tests::Outcome& outcome : outcomes) {
        fmt::print(
            "sequence {} {} started={:d} rest={:.3f} intime={:d} told={:d} self={:d} recovered={:d} "
            "end={:.3f} "
            "reason={} moods={}\n",
            words[1], outcome.seed, outcome.started, outcome.rest, outcome.rested, outcome.told,
            outcome.selfMoved, outcome.recovered, outcome.end, outcome.reason.toStdString(),
            outcome.mood.trimmed().replace(' ', ',').toStdString());
    }
    const tests::Footprint after = tests::measureFootprint();
    fmt::print("process {} block_ms={:.1f} files={} threads={} memory_kB={:.0f}\n", words[1], longest,
               after.files - before.files, after.threads - before.threads,
               1024.0 * (after.resident - before.resident));
    return 0;
}
