#include <fmt/format.h>

#include <QApplication>

#include "tests/ui/feeder/hostile_window.h"
#include "tests/ui/footprint.h"

using namespace trapwright;

/// Runs hostile sequences in the studio's window and prints one line for each: hostile_window tcp|rtu|reo
/// FIRST LAST [SECONDS]. After so many seconds it begins no other one.
int main(int count, char** words) {
    if (count != 4 && count != 5) {
        fmt::print(stderr, "Usage: hostile_window tcp|rtu|reo FIRST LAST [SECONDS]\n");
        return 2;
    }
    const QApplication application(count, words);
    const feeder::HostileStudies studies("hostile_window");
    const double seconds = count == 5 ? std::stod(words[4]) : 1e9;
    QElapsedTimer clock;
    clock.start();
    feeder::HostileWindow window(words[1], studies.files(), studies.folder());
    const std::uint64_t last = std::stoull(words[3]);
    for (std::uint64_t seed = std::stoull(words[2]); seed <= last; ++seed) {
        if (1e-3 * static_cast<double>(clock.elapsed()) > seconds) break;
        feeder::WindowOutcome outcome = window.run(seed);
        fmt::print(
            "window {} {} started={:d} rest={:.3f} intime={:d} left={:d} end={:.3f} late_ms={:.1f} deed={} "
            "moods={}\n",
            words[1], outcome.seed, outcome.started, outcome.rest, outcome.rested, outcome.left, outcome.end,
            outcome.late, outcome.deed.replace(' ', '-').toStdString(),
            outcome.moods.trimmed().replace(' ', ',').toStdString());
        std::fflush(stdout);
    }
    return 0;
}
