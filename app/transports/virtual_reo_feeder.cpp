#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "app/transports/pseudo_terminal.h"
#include "app/transports/virtual_feeder.h"
#include "app/transports/virtual_state.h"
#include "core/drive/deadline.h"
#include "core/drive/reo_drive.h"

namespace trapwright::transports {

namespace {

namespace reo = drive::reo;

constexpr int kPoll = 100;  // [ms]
constexpr std::size_t kLongestLine = 256;

class VirtualReoFeeder final : public VirtualFeeder {
 public:
    VirtualReoFeeder(const drive::Profile& profile, const drive::FeederProperties& properties)
        : map_(profile.reo),
          fullAcceleration_(profile.reo.fullAcceleration.value_or(
              drive::calcAcceleration(properties.fullHalfStroke, properties.resonance))),
          state_(properties),
          wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
          thread_([this] { run(); }) {}
    VirtualReoFeeder(const VirtualReoFeeder&) = delete;
    VirtualReoFeeder& operator=(const VirtualReoFeeder&) = delete;
    ~VirtualReoFeeder() override {
        call([this] { over_ = true; });
        thread_.join();
        ::close(wake_);
    }

    [[nodiscard]] drive::Address address() const override {
        drive::Address address;
        const std::lock_guard lock(mutex_);
        address.line = name_;
        return address;
    }

    void setTrouble(Trouble trouble) override { state_.setTrouble(trouble); }

    void cut() override {
        call([this] { terminal_.close(); });
    }

    base::Status restore() override {
        base::Status status = base::success();
        call([this, &status] {
            status = terminal_.open();
            received_.clear();
            const std::lock_guard lock(mutex_);
            name_ = terminal_.name();
        });
        return status;
    }

    [[nodiscard]] double halfStroke() const override { return state_.halfStroke(); }
    [[nodiscard]] bool isAtRest() const override { return state_.isAtRest(); }
    [[nodiscard]] bool watchdogActed() const override { return state_.watchdogActed(); }
    [[nodiscard]] drive::Command command() const override { return state_.command(); }
    [[nodiscard]] std::vector<drive::Command> commands() const override { return state_.commands(); }

 private:
    /// Has the thread do something, and waits for it.
    void call(const std::function<void()>& work) {
        // Shared: the thread may still be in set_value() when we go on.
        const auto done = std::make_shared<std::promise<void>>();
        {
            const std::lock_guard lock(mutex_);
            calls_.emplace_back([&work, done] {
                work();
                done->set_value();
            });
        }
        static_cast<void>(::eventfd_write(wake_, 1));
        done->get_future().wait();
    }

    void run() {
        while (!over_) {
            wait(kPoll);
            if (terminal_.master() >= 0) listen();
        }
    }

    /// Until something comes, or the time [ms] is over; does what others want done.
    void wait(int time) {
        // A closed end is -1, which poll ignores.
        std::array<pollfd, 2> ends = {{{wake_, POLLIN, 0}, {terminal_.master(), POLLIN, 0}}};
        ::poll(ends.data(), ends.size(), time);
        eventfd_t count = 0;
        static_cast<void>(::eventfd_read(wake_, &count));
        std::vector<std::function<void()>> calls;
        {
            const std::lock_guard lock(mutex_);
            calls.swap(calls_);
        }
        for (const auto& work : calls)
            work();
    }

    void listen() {
        std::array<char, kLongestLine> bytes{};
        const ssize_t count = ::read(terminal_.master(), bytes.data(), bytes.size());
        if (state_.watchdogActed()) terminal_.unlock();
        if (count <= 0 || state_.trouble() == Trouble::silent) return;
        received_.append(bytes.data(), static_cast<std::size_t>(count));
        for (auto end = received_.find('\r'); end != std::string::npos; end = received_.find('\r')) {
            const std::string line = received_.substr(0, end + 1);
            received_.erase(0, end + 1);
            // "Invalid information is disregarded", and does not count as a sign of life.
            if (const auto words = reo::decode(line)) obey(*words);
        }
        if (received_.size() > kLongestLine) received_.clear();
    }

    void obey(const reo::Words& words) {
        drive::Command command;
        command.setPoint = static_cast<double>(words[0]) / reo::kFullSetPoint;
        command.enable = (words[2] & map_.enable) != 0;
        state_.tell(command);
        const Trouble trouble = state_.trouble();
        if (trouble == Trouble::late) {
            const drive::Deadline deadline(std::chrono::duration<double>(kLateAnswer).count());
            while (!over_ && deadline.left() > 0.0)
                sleepFor(deadline.left());
        }
        answer(trouble);
    }

    // poll alone would come back for every further line.
    void sleepFor(double seconds) {
        pollfd end = {wake_, POLLIN, 0};
        ::poll(&end, 1, static_cast<int>(std::ceil(seconds * 1e3)));
        if ((end.revents & POLLIN) != 0) wait(0);
    }

    void answer(Trouble trouble) {
        const auto word = [](double share) {
            return static_cast<std::uint16_t>(std::clamp(std::round(share * reo::kFullAnswer), 0.0, 65535.0));
        };
        const drive::Reading reading = state_.read();
        const drive::FaultCode& code = map_.code;
        const unsigned bad = code.meanings.empty() ? ~code.good & code.mask : code.meanings.begin()->first;
        unsigned status = (reading.fault ? bad : code.good) & code.mask;
        const bool enabled = reading.enabled.value_or(false) != (trouble == Trouble::disagrees);
        if (enabled) status |= map_.enabled;
        std::string line =
            reo::encode({word(reading.acceleration.value_or(0.0) / fullAcceleration_),
                         word(reading.current.value_or(0.0)), static_cast<std::uint16_t>(status)});
        if (trouble == Trouble::wrong) line = line.substr(4);
        if (trouble == Trouble::refusing) line = "NOT A DRIVE?\r";
        if (terminal_.master() >= 0) static_cast<void>(::write(terminal_.master(), line.data(), line.size()));
    }

    const drive::ReoMap map_;
    const double fullAcceleration_;  // [m/s^2]
    VirtualState state_;

    mutable std::mutex mutex_;  // guards the next two
    std::vector<std::function<void()>> calls_;
    std::string name_;

    // The thread's own.
    PseudoTerminal terminal_;
    std::string received_;
    bool over_ = false;

    const int wake_;      // an eventfd
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace

base::Result<std::unique_ptr<VirtualFeeder>> serveReoFeeder(const drive::Profile& profile,
                                                            const drive::FeederProperties& properties) {
    std::unique_ptr<VirtualFeeder> feeder = std::make_unique<VirtualReoFeeder>(profile, properties);
    if (const auto status = feeder->restore(); !status) return status.error();
    return feeder;
}

}  // namespace trapwright::transports
