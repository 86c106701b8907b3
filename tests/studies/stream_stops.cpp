// Where parts of streams stand still: STREAMS streams of an individual's track at INFLOW parts a minute, from
// the trials of `trapwright stream` on the study. One line a stop of a part, stream by stream: from when to
// when, and where the part was when it had come farthest [mm] and which way its axes pointed up.
//
//     stream_stops STUDY GENERATION INDIVIDUAL INFLOW STREAMS

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <string_view>

#include "core/base/math.h"
#include "core/store/study_file.h"
#include "core/study/stream.h"
#include "core/workflow/study_design.h"
#include "core/workflow/study_trials.h"
#include "sim/engines/registry.h"

using namespace trapwright;

namespace {

template <class T>
T readNumber(std::string_view text) {
    T number{};
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

void printStream(const trial::Outcome& outcome, const study::StreamSettings& settings,
                 const trial::Termination& termination) {
    const auto print = [](std::size_t index, const trial::PartOutcome& part, double from, double to) {
        const base::Vec3 at = part.farthest.position / base::kMillimetre;
        const base::Vec3 up = part.farthest.rotation.conjugate() * base::Vec3::UnitZ();
        fmt::print(
            "  part {:3} {:6.1f} ... {:6.1f} s, {:9} at ({:6.1f}, {:5.1f}, {:5.1f}) mm, up ({:.2f}, "
            "{:.2f}, {:.2f})\n",
            index, from, to, trial::endingName(part.ending), at.x(), at.y(), at.z(), up.x(), up.y(), up.z());
    };
    for (const trial::Stop& stop : outcome.stops)
        print(stop.part, outcome.parts[stop.part], stop.from, stop.to);
    for (const study::Jam& jam : study::findJams(outcome, termination))
        fmt::print("  jam {:.1f} ... {:.1f} s{}\n", jam.from, jam.to, jam.cleared ? ", cleared" : "");
    if (outcome.stops.empty()) return;
    fmt::print("  on the track at the end:\n");
    for (std::size_t i = 0; i < outcome.parts.size(); ++i) {
        const trial::PartOutcome& part = outcome.parts[i];
        if (part.entered && part.time >= settings.warmUp + settings.duration - 0.01)
            print(i, part, *part.entered, part.time);
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 6) {
        fmt::print(stderr, "stream_stops STUDY GENERATION INDIVIDUAL INFLOW STREAMS\n");
        return 2;
    }
    const auto fail = [](const base::Error& error) {
        fmt::print(stderr, "{}\n", error.message);
        return 1;
    };
    const auto file = store::StudyFile::openReadOnly(arguments[1]);
    if (!file) return fail(file.error());
    const auto design = workflow::loadDesign(*file);
    if (!design) {
        fmt::print(stderr, "{}\n", design.error().message);
        return 1;
    }
    const study::IndividualId id{readNumber<int>(arguments[2]), readNumber<int>(arguments[3])};
    const auto individual = file->loadIndividual(id);
    if (!individual) return fail(individual.error());
    study::Settings settings = design->settings;
    settings.stream.partsPerMinute = readNumber<double>(arguments[4]);
    settings.stream.streams = readNumber<int>(arguments[5]);
    workflow::TrialsRequest request;
    request.kind = workflow::TrialKind::stream;
    request.winner = {id, *individual};
    request.count = settings.stream.streams;
    request.stream = workflow::StreamTrials{settings.stream, study::boxOfJudging(settings), {}, "native"};
    const auto batch = workflow::makeTrials(settings, design->part, request, {request.count, "native"});
    if (!batch) return fail(batch.error());
    const auto engine = engines::registry().find("native")->make({.threads = 1});
    const auto outcomes = engine->run(std::span(&*batch, 1), {});
    if (!outcomes) return fail(outcomes.error());
    for (std::size_t i = 0; i < outcomes->front().size(); ++i) {
        fmt::print("stream {}\n", i);
        printStream(outcomes->front()[i], settings.stream, batch->termination);
    }
    return 0;
}
