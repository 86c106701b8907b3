#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/drive/feeder_model.h"
#include "core/drive/heartbeat.h"
#include "core/drive/modbus_drive.h"
#include "core/drive/register_value.h"
#include "core/drive/reo_drive.h"

using namespace trapwright;
using drive::State;
using drive::Table;

namespace {

constexpr double kTimeOut = 0.3;   // [s]
constexpr double kWatchdog = 2.0;  // [s]
constexpr double kBeat = 0.125;    // [s]
constexpr double kStep = 0.02;     // [s] between two looks at the feeder

/// Until the operator is told that the drive may still move: the time to coast, and three time-outs.
constexpr double kToldIn = 1.5 + 3.0 * kTimeOut + kBeat;
/// Until it rests where its watchdog works: that, five time-outs more, the watchdog's time and 0.4 s to
/// decay.
constexpr double kRestsIn = kToldIn + 5.0 * kTimeOut + kWatchdog + 0.4;

enum class Mood {
    honest,
    slow,       // answers after up to twice the time-out
    mute,       // acts and does not answer
    deaf,       // hears nothing
    refusing,   // hears, acts on nothing, answers with errors
    moody,      // refuses half of all
    forgetful,  // hears, says that it does what it is told, and does not; reads back the truth
    stuck,      // reads back what it read back first
    babbling,   // reads back anything
    absent,     // ends the connection and takes no other one
    resetting,  // ends the connection in the midst of every third exchange, takes it again
    last = resetting
};

/// A feeder whose link and answers are as bad as its mood, on a clock made by hand. Its drive and its
/// watchdog are those of the model.
class Device {
 public:
    Device(std::uint64_t seed, bool hasWatchdog) : random_(seed), model_(propertiesOf(hasWatchdog)) {}

    std::function<void()> looked;  // called whenever time has passed

    [[nodiscard]] double now() const { return now_; }
    void pass(double seconds) {
        for (const double end = now_ + seconds; now_ < end - 1e-9;) {
            now_ = std::min(now_ + kStep, end);
            if (looked) looked();
        }
    }
    double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    bool happens(double share) { return draw(0.0, 1.0) < share; }

    void setMood(Mood mood) {
        mood_ = mood;
        frozen_ = model_.read(now_);
        if (mood == Mood::absent) open_ = false;
    }
    [[nodiscard]] bool isAtRest() { return model_.isAtRest(now_); }
    /// Times that it was switched on from rest.
    [[nodiscard]] int startings() const { return startings_; }

    [[nodiscard]] bool open() {
        pass(0.005);
        if (mood_ == Mood::absent) pass(happens(0.5) ? kTimeOut : 0.0);
        open_ = mood_ != Mood::absent;
        return open_;
    }
    [[nodiscard]] bool isOpen() const { return open_; }
    void close() { open_ = false; }

    enum class Answer { good, none, refused };
    /// One question on its way there and back: `act` is what it does when it hears and obeys.
    Answer ask(double timeOut, const std::function<void()>& act) {
        if (!open_) return Answer::none;
        const double time = mood_ == Mood::slow ? draw(0.0, 2.0 * kTimeOut) : draw(0.001, 0.01);
        const bool lost = mood_ == Mood::deaf;
        if (!lost) model_.hear(now_);
        const bool refused = mood_ == Mood::refusing || (mood_ == Mood::moody && happens(0.5));
        const bool reset = mood_ == Mood::resetting && happens(1.0 / 3.0);
        if (!lost && !refused && !(reset && happens(0.5))) act();
        if (lost || mood_ == Mood::mute || time > timeOut) {
            pass(std::max(timeOut, 0.02));
            return Answer::none;
        }
        pass(time);
        if (reset) open_ = false;
        if (reset) return Answer::none;
        return refused ? Answer::refused : Answer::good;
    }

    void tell(const drive::Command& command) {
        if (mood_ == Mood::forgetful) return;
        const drive::Command& before = model_.command();
        const bool moved = before.enable && before.setPoint > 0.0;
        if (!moved && command.enable && command.setPoint > 0.0) ++startings_;
        model_.tell(command, now_);
    }
    [[nodiscard]] drive::Command command() const { return model_.command(); }
    [[nodiscard]] drive::Reading read() {
        drive::Reading reading = mood_ == Mood::stuck ? frozen_ : model_.read(now_);
        if (mood_ == Mood::babbling) {
            reading.setPoint = draw(-1.0, 6.0);
            reading.enabled = happens(0.5);
            reading.acceleration = happens(0.2) ? std::nan("") : draw(-500.0, 500.0);
        }
        return reading;
    }

 private:
    static drive::FeederProperties propertiesOf(bool hasWatchdog) {
        drive::FeederProperties properties;
        properties.watchdog = hasWatchdog ? kWatchdog : 1e9;
        return properties;
    }

    std::mt19937_64 random_;
    drive::FeederModel model_;
    double now_ = 0.0;
    Mood mood_ = Mood::honest;
    drive::Reading frozen_;
    bool open_ = false;
    int startings_ = 0;
};

/// The places of `modbusProfile`: registers 0 and 2, coil 0.
class Registers final : public drive::RegisterTransport {
 public:
    explicit Registers(Device& device) : device_(device) {}
    base::Status open(double /*timeOut*/) override {
        return device_.open() ? base::success() : base::Status(base::Error{"cannot be reached"});
    }
    [[nodiscard]] bool isOpen() const override { return device_.isOpen(); }
    base::Result<std::vector<std::uint16_t>> read(Table table, int address, int /*count*/,
                                                  double timeOut) override {
        std::vector<std::uint16_t> values;
        const auto answer = device_.ask(timeOut, [&] {
            const drive::Reading reading = device_.read();
            const drive::Place place{Table::inputRegister, address, drive::DataType::float32};
            if (table == Table::coil) {
                values = {static_cast<std::uint16_t>(*reading.enabled ? 1 : 0)};
            } else if (table == Table::holdingRegister) {
                values = drive::encodeRaw({}, 10000.0 * *reading.setPoint);
            } else if (std::isnan(*reading.acceleration)) {
                values = {0x7FC0, 0};
            } else {
                values = drive::encodeRaw(place, *reading.acceleration);
            }
        });
        if (answer != Device::Answer::good) return errorOf(answer);
        return values;
    }
    base::Status write(Table table, int /*address*/, std::span<const std::uint16_t> values,
                       double timeOut) override {
        const auto answer = device_.ask(timeOut, [&] {
            drive::Command command = device_.command();
            if (table == Table::coil) {
                command.enable = values[0] != 0;
            } else {
                command.setPoint = values[0] / 10000.0;
            }
            device_.tell(command);
        });
        return answer == Device::Answer::good ? base::success() : base::Status(errorOf(answer));
    }
    void close() override { device_.close(); }

 private:
    static base::Error errorOf(Device::Answer answer) {
        return {answer == Device::Answer::none ? "no answer" : "refused"};
    }
    Device& device_;
};

class Lines final : public drive::LineTransport {
 public:
    explicit Lines(Device& device) : device_(device) {}
    base::Status open(double /*timeOut*/) override {
        return device_.open() ? base::success() : base::Status(base::Error{"cannot be opened"});
    }
    [[nodiscard]] bool isOpen() const override { return device_.isOpen(); }
    base::Result<std::string> exchange(std::string_view line, double timeOut) override {
        const auto words = drive::reo::decode(line);
        if (!words) qFatal("no line");
        std::string said = "ERROR\r";
        const auto answer = device_.ask(timeOut, [&] {
            drive::Command command;
            command.setPoint = (*words)[0] / static_cast<double>(drive::reo::kFullSetPoint);
            command.enable = (*words)[2] != 0;
            device_.tell(command);
            const drive::Reading reading = device_.read();
            const double share = std::abs(*reading.acceleration) / 100.0;
            const double word = std::isnan(share) ? 65535.0 : std::min(share * 32768.0, 65535.0);
            said = drive::reo::encode({static_cast<std::uint16_t>(word), 0,
                                       static_cast<std::uint16_t>(*reading.enabled ? 0x40A5 : 0x00A5)});
        });
        if (answer == Device::Answer::none) return base::Error{"no answer"};
        return said;
    }
    void close() override { device_.close(); }

 private:
    Device& device_;
};

drive::Profile profileOf(drive::Protocol protocol, bool hasWatchdog) {
    drive::Profile profile;
    profile.protocol = protocol;
    profile.timeOut = kTimeOut;
    profile.heartbeat = 1.0 / kBeat;
    if (hasWatchdog) profile.watchdog = kWatchdog;
    profile.restAcceleration = 5.0;
    profile.frequency = 50.0;
    profile.reo.enabled = 0x4000;
    profile.reo.fullAcceleration = 100.0;
    profile.modbus.setPoint = drive::Quantity{{Table::holdingRegister, 0}, 0.0, 10000.0};
    profile.modbus.acceleration =
        drive::Quantity{{Table::inputRegister, 2, drive::DataType::float32}, 0.0, 1.0};
    profile.modbus.enable = drive::Switch{{Table::coil, 0, drive::DataType::bit}};
    return profile;
}

/// One sequence: an operator who starts, stops and acknowledges at random, and a device of changing mood.
class Sequence {
 public:
    Sequence(drive::Protocol protocol, bool hasWatchdog, std::uint64_t seed)
        : hasWatchdog_(hasWatchdog),
          device_(seed, hasWatchdog),
          profile_(profileOf(protocol, hasWatchdog)),
          heartbeat_(
              profile_, {0.9, 2.0}, [this] { return makeDrive(); }, {}, [this] { return device_.now(); }) {
        device_.looked = [this] { look(); };
    }
    Sequence(const Sequence&) = delete;
    Sequence& operator=(const Sequence&) = delete;
    ~Sequence() = default;

    /// What went wrong; empty if nothing did.
    QString run() {
        double nextMood = device_.draw(1.0, 3.0);
        while (device_.now() < 40.0 && wrong_.isEmpty()) {
            if (device_.now() > nextMood) {
                device_.setMood(device_.happens(0.4) ? Mood::honest
                                                     : static_cast<Mood>(static_cast<int>(device_.draw(
                                                           0.0, static_cast<int>(Mood::last) + 1.0))));
                nextMood = device_.now() + device_.draw(0.1, 6.0);
            }
            wish();
            beat();
        }
        // The window closes, as DriveLoop's end does it.
        heartbeat_.supervisor().stop();
        const double end = device_.now() + profile_.settlingTime;
        while (!heartbeat_.supervisor().restConfirmed() && device_.now() < end)
            beat();
        heartbeat_.finish();
        device_.setMood(Mood::deaf);
        device_.pass(kRestsIn + 1.0);
        return wrong_;
    }
    double longestMotion = 0.0;  // [s] after it should rest
    int stops = 0;
    int told = 0;

 private:
    base::Result<std::unique_ptr<drive::Drive>> makeDrive() {
        if (profile_.protocol == drive::Protocol::reo)
            return drive::makeReoDrive(profile_, std::make_unique<Lines>(device_));
        return drive::makeModbusDrive(profile_, std::make_unique<Registers>(device_),
                                      [this] { return device_.now(); });
    }

    void wish() {
        heartbeat_.attend();
        const double chance = device_.draw(0.0, 1.0);
        if (chance < 0.03) {
            heartbeat_.supervisor().setTarget(device_.draw(0.1, 1.0));
        } else if (chance < 0.2) {
            heartbeat_.acknowledge();
        } else if (chance < 0.4) {
            heartbeat_.supervisor().setTarget(device_.draw(0.1, 1.0));
            heartbeat_.start();
        } else if (chance < 0.42) {
            heartbeat_.supervisor().stop();
        }
    }

    void beat() {
        const double begin = device_.now();
        heartbeat_.beat();
        const double took = device_.now() - begin;
        if (took > 5.0 * kTimeOut + 0.1) wrong("a beat took too long", took);
        device_.pass(std::max(kBeat - took, 0.001));
    }

    void look() {
        const State state = heartbeat_.supervisor().state();
        const bool wanted = state == State::ramping || state == State::running;
        if (wanted_ && !wanted) ++stops;
        // What was on the way when the stop was asked for counts as before.
        if (!wanted && device_.startings() != startings_ && !wanted_) wrong("it was set in motion", 0.0);
        startings_ = device_.startings();
        wanted_ = wanted;
        const bool moves = !device_.isAtRest();
        const bool mayMove = heartbeat_.supervisor().mayMove();
        if (mayMove && !mayMove_) ++told;
        mayMove_ = mayMove;
        if (wanted || !moves) moving_ = device_.now();
        if (wanted || !moves || mayMove) untold_ = device_.now();
        const double motion = device_.now() - moving_;
        longestMotion = std::max(longestMotion, motion);
        if (hasWatchdog_ && motion > kRestsIn) wrong("it moved too long", motion);
        if (device_.now() - untold_ > kToldIn) wrong("nobody was told", device_.now() - untold_);
        if (mayMove && heartbeat_.snapshot().warning.empty()) wrong("no words", 0.0);
    }

    void wrong(const char* what, double seconds) {
        if (wrong_.isEmpty()) wrong_ = QString("%1 (%2 s) at %3 s").arg(what).arg(seconds).arg(device_.now());
    }

    const bool hasWatchdog_;
    Device device_;
    const drive::Profile profile_;
    drive::Heartbeat heartbeat_;
    QString wrong_;
    bool wanted_ = false;
    bool mayMove_ = false;
    double moving_ = 0.0;
    double untold_ = 0.0;
    int startings_ = 0;
};

}  // namespace

/// Random sequences of a device that lies, stalls and resets, on a simulated clock: whenever it should rest
/// it does so in the time that core/drive/README.md states, or the operator is told that it may not.
class HostileDeviceTest : public QObject {
    Q_OBJECT

 private slots:
    void restsInTimeOrTheOperatorIsTold_data() {
        QTest::addColumn<int>("protocol");
        QTest::addColumn<bool>("hasWatchdog");
        QTest::newRow("Modbus, watchdog") << static_cast<int>(drive::Protocol::modbusTcp) << true;
        QTest::newRow("Modbus, none") << static_cast<int>(drive::Protocol::modbusTcp) << false;
        QTest::newRow("REO, watchdog") << static_cast<int>(drive::Protocol::reo) << true;
        QTest::newRow("REO, none") << static_cast<int>(drive::Protocol::reo) << false;
    }
    void restsInTimeOrTheOperatorIsTold() {
        QFETCH(int, protocol);
        QFETCH(bool, hasWatchdog);
        int stops = 0;
        int told = 0;
        double longest = 0.0;
        for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
            Sequence sequence(static_cast<drive::Protocol>(protocol), hasWatchdog, seed);
            const QString wrong = sequence.run();
            QVERIFY2(wrong.isEmpty(), qPrintable(QString("seed %1: %2").arg(seed).arg(wrong)));
            stops += sequence.stops;
            told += sequence.told;
            longest = std::max(longest, sequence.longestMotion);
        }
        qInfo("%d stops, told %d times, longest motion after a stop %.2f s", stops, told, longest);
        // A device that never was asked to stop shows nothing.
        QVERIFY(stops > 2000 && told > 200);
    }
};

QTEST_APPLESS_MAIN(HostileDeviceTest)
#include "hostile_device_test.moc"
