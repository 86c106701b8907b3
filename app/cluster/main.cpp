// What `trapwright` becomes as a rank of an MPI job: rank 0 does what the command line asks for, and its
// engines simulate on all ranks; the others know nothing of studies.

#include <fmt/format.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include "app/trapwright/console.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/job_launch.h"
#include "app/trapwright/program.h"
#include "app/trapwright/run_program.h"
#include "core/base/file.h"
#include "core/base/instruction_set.h"
#include "sim/cluster/coordinator.h"
#include "sim/cluster/mpi_channel.h"
#include "sim/cluster/worker.h"
#include "sim/engines/registry.h"

namespace {

using namespace trapwright;
using namespace trapwright::app;

/// Version and content of this program: only the same one gives the same bits everywhere.
base::Result<std::string> markOfBuild() {
    std::error_code failure;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
    const auto content = base::readFile(self);
    if (!content) return content.error();
    // FNV-1a, 64 bits: as good as any against mistakes.
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char byte : *content)
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    return fmt::format("{} {:016x}", kProgram, hash);
}

base::Result<cluster::Hello> introduce(const cluster::MpiSession& session) {
    cluster::Hello self;
    auto mark = markOfBuild();
    if (!mark) return mark.error();
    self.program = std::move(*mark);
    self.host = session.host();
    self.threads = session.chooseThreads();
    self.mathInstructions = base::mathInstructionSet();
    const std::optional<std::string> asked = askedInstructionSet();
    self.instructionSets = asked ? std::vector{*asked} : engines::listInstructionSets();
    return self;
}

/// "8 ranks on 2 machines, 16 threads, AVX2"
std::string describeJob(const cluster::Coordinator& coordinator) {
    std::set<std::string> hosts;
    unsigned threads = 0;
    for (const cluster::Hello& member : coordinator.members()) {
        hosts.insert(member.host);
        threads += member.threads;
    }
    return fmt::format("{} ranks on {}, {} threads, instruction set {}", coordinator.members().size(),
                       hosts.size() == 1 ? "one machine" : fmt::format("{} machines", hosts.size()), threads,
                       coordinator.instructionSet());
}

std::string describeTraffic(const cluster::Traffic& traffic) {
    constexpr double kMega = 1e6;
    return fmt::format("{} tasks, {} messages of {:.1f} MB, {:.2f} s of rank 0's time", traffic.tasks,
                       traffic.messages, static_cast<double>(traffic.bytes) / kMega, traffic.busy);
}

ExitCode coordinate(const cluster::MpiSession& session, const cluster::Hello& self, int count,
                    char** arguments) {
    const Console console(false);
    auto coordinator = cluster::Coordinator::start(session.makeChannel(), engines::registry(), self,
                                                   engines::useInstructionSet);
    if (!coordinator) return console.fail({ExitCode::usage, coordinator.error().message});
    console.note(describeJob(**coordinator));
    engines::replaceRegistry(cluster::spread(engines::registry(), **coordinator));
    const ExitCode code = runProgram(count, arguments);
    if (const auto failure = (*coordinator)->failure()) {
        (void)console.fail({ExitCode::fault, *failure});
        coordinator->reset();
        // Who hangs would be waited for.
        session.abort(static_cast<int>(ExitCode::fault));
    }
    if (const cluster::Traffic traffic = (*coordinator)->traffic(); traffic.tasks > 0)
        console.note(describeTraffic(traffic));
    return code;
}

/// Rank 0 decides what signals mean, and tells the others.
void ignoreSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2})
        (void)std::signal(signal, SIG_IGN);
}

ExitCode simulate(const cluster::MpiSession& session, const cluster::Hello& self) {
    ignoreSignals();
    const std::unique_ptr<cluster::Channel> channel = session.makeChannel();
    const base::Status worked =
        cluster::work(*channel, engines::registry(), self, engines::useInstructionSet);
    if (worked) return ExitCode::ok;
    (void)Console(false).fail({ExitCode::fault, worked.error().message});
    session.abort(static_cast<int>(ExitCode::fault));
}

}  // namespace

int main(int argc, char** argv) {
    // Sent before the end of a job's time, maybe before there is anything to finish.
    (void)std::signal(SIGUSR1, SIG_IGN);
    const Console console(false);
    auto session = cluster::MpiSession::begin(argc, argv);
    if (!session) return static_cast<int>(console.fail({ExitCode::fault, session.error().message}));
    // A launcher of another MPI leaves each rank alone.
    if ((*session)->count() == 1 && findJobLaunch() != JobLaunch::alone)
        return static_cast<int>(console.fail({ExitCode::usage, explainSeparateLaunch()}));
    const auto self = introduce(**session);
    if (!self) {
        (void)console.fail({ExitCode::fault, self.error().message});
        (*session)->abort(static_cast<int>(ExitCode::fault));
    }
    return static_cast<int>((*session)->rank() == 0 ? coordinate(**session, *self, argc, argv)
                                                    : simulate(**session, *self));
}
