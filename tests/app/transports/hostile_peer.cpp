#include "tests/app/transports/hostile_peer.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "core/drive/reo_drive.h"

namespace trapwright::tests {

namespace reo = drive::reo;

namespace {

constexpr int kUnit = 1;
constexpr double kFull = 10000.0;  // raw number of a full set-point

std::string word(unsigned value) {
    return {static_cast<char>(value >> 8U & 0xFFU), static_cast<char>(value & 0xFFU)};
}

unsigned byteAt(const std::string& bytes, std::size_t at) {
    return static_cast<unsigned char>(bytes[at]);
}

int wordAt(const std::string& bytes, std::size_t at) {
    return static_cast<int>(byteAt(bytes, at) << 8U | byteAt(bytes, at + 1));
}

/// CRC-16/MODBUS, low byte first (Modbus over Serial Line 1.02, section 6.2.2).
std::string checkSum(const std::string& bytes) {
    unsigned crc = 0xFFFF;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int i = 0; i < 8; ++i)
            crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xA001U : crc >> 1U;
    }
    return {static_cast<char>(crc & 0xFFU), static_cast<char>(crc >> 8U)};
}

bool isSerial(const drive::Profile& profile) {
    return profile.protocol != drive::Protocol::modbusTcp;
}

drive::FeederProperties propertiesOf(const drive::Profile& profile, std::uint64_t seed) {
    drive::FeederProperties properties;
    properties.watchdog = profile.watchdog.value_or(1e9);
    properties.seed = seed;
    return properties;
}

}  // namespace

HostilePeer::HostilePeer(const drive::Profile& profile, std::uint64_t seed, const std::string& folder)
    : profile_(profile),
      link_(folder + "/line-" + std::to_string(seed)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      model_(propertiesOf(profile, seed)),
      random_(seed) {
    address_.unit = kUnit;
    if (isSerial(profile_)) {
        openLine();
        address_.line = link_;
    } else {
        listen();
        address_.host = "127.0.0.1";
        address_.port = port_;
    }
    thread_ = std::thread([this] { run(); });
}

HostilePeer::~HostilePeer() {
    over_ = true;
    static_cast<void>(::eventfd_write(wake_, 1));
    thread_.join();
    cut(false);
    closeListener();
    ::close(wake_);
    ::unlink(link_.c_str());
}

void HostilePeer::setMood(Mood mood) {
    {
        const std::lock_guard lock(mutex_);
        frozen_ = model_.read(clock());
        mood_ = mood;
    }
    static_cast<void>(::eventfd_write(wake_, 1));
}

bool HostilePeer::isAtRest() const {
    const std::lock_guard lock(mutex_);
    return model_.isAtRest(clock());
}

int HostilePeer::startings() const {
    const std::lock_guard lock(mutex_);
    return startings_;
}

double HostilePeer::clock() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double HostilePeer::draw(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
}

void HostilePeer::run() {
    while (!over_) {
        const Mood mood = mood_;
        const bool away = mood == Mood::refused;
        if (away && (listener_ >= 0 || peer_ >= 0)) {
            cut(true);
            closeListener();
        }
        if (!away && isSerial(profile_) && peer_ < 0 && clock() > lineBack_) openLine();
        if (!away && !isSerial(profile_) && listener_ < 0) listen();
        const bool floods = mood == Mood::flood && peer_ >= 0;
        std::array<pollfd, 3> ends = {{{wake_, POLLIN, 0}, {listener_, POLLIN, 0}, {peer_, POLLIN, 0}}};
        const int wait = floods ? 2 : !late_.empty() || peer_ < 0 ? 10 : 100;  // [ms]
        ::poll(ends.data(), ends.size(), wait);
        eventfd_t count = 0;
        static_cast<void>(::eventfd_read(wake_, &count));
        if ((ends[1].revents & POLLIN) != 0) take();
        if ((ends[2].revents & (POLLIN | POLLHUP | POLLERR)) != 0) receive();
        sendLate();
        if (!floods) continue;
        Bytes noise;
        while (noise.size() < 2048)
            noise += profile_.protocol == drive::Protocol::reo
                         ? Bytes("000000000000\r")
                         : word(7) + word(0) + word(5) + "\1\3\2" + word(1);
        send(noise);
    }
}

void HostilePeer::listen() {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const int on = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    where.sin_port = htons(static_cast<std::uint16_t>(port_));
    socklen_t size = sizeof where;
    auto* place = reinterpret_cast<sockaddr*>(&where);
    if (::bind(listener_, place, size) != 0 || ::listen(listener_, 8) != 0) return closeListener();
    ::getsockname(listener_, place, &size);
    port_ = ntohs(where.sin_port);
}

void HostilePeer::openLine() {
    std::array<char, 64> name{};
    peer_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (peer_ < 0 || ::grantpt(peer_) != 0 || ::unlockpt(peer_) != 0 ||
        ::ptsname_r(peer_, name.data(), name.size()) != 0)
        return;
    slave_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    ::tcgetattr(slave_, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(slave_, TCSANOW, &settings);
    ::unlink(link_.c_str());
    static_cast<void>(::symlink(name.data(), link_.c_str()));
    ++connections_;
}

void HostilePeer::closeListener() {
    if (listener_ >= 0) ::close(listener_);
    listener_ = -1;
}

void HostilePeer::cut(bool abruptly) {
    if (peer_ >= 0 && abruptly && !isSerial(profile_)) {
        const linger now{1, 0};  // a reset instead of an orderly end
        ::setsockopt(peer_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    }
    for (int* end : {&slave_, &peer_}) {
        if (*end >= 0) ::close(*end);
        *end = -1;
    }
    received_.clear();
    late_.clear();
    lineBack_ = clock() + 0.3;
}

void HostilePeer::take() {
    const int taken = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (taken < 0) return;
    if (peer_ >= 0) cut(false);
    peer_ = taken;
    ++connections_;
}

void HostilePeer::receive() {
    std::array<char, 512> bytes{};
    const ssize_t count = ::read(peer_, bytes.data(), bytes.size());
    if (count <= 0) {
        if (!isSerial(profile_)) cut(false);
        return;
    }
    const Mood mood = mood_;
    if (mood == Mood::deaf) return;
    if (mood == Mood::echo) send({bytes.data(), static_cast<std::size_t>(count)});
    received_.append(bytes.data(), static_cast<std::size_t>(count));
    answerAll();
    if (received_.size() > 512) received_.clear();
}

void HostilePeer::send(const Bytes& bytes) {
    if (peer_ < 0) return;
    if (isSerial(profile_)) {
        static_cast<void>(::write(peer_, bytes.data(), bytes.size()));
    } else {
        static_cast<void>(::send(peer_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
    }
}

void HostilePeer::sendLate() {
    while (!late_.empty() && late_.front().due <= clock()) {
        send(late_.front().bytes);
        late_.pop_front();
    }
}

void HostilePeer::answerAll() {
    while (peer_ >= 0) {
        bool whole = false;
        switch (profile_.protocol) {
            case drive::Protocol::modbusTcp:
                whole = answerTcp();
                break;
            case drive::Protocol::modbusRtu:
                whole = answerRtu();
                break;
            case drive::Protocol::reo:
                whole = answerLine();
                break;
        }
        if (!whole) return;
    }
}

bool HostilePeer::answerTcp() {
    if (received_.size() < 8) return false;
    const auto length = static_cast<std::size_t>(wordAt(received_, 4));
    if (received_.size() < 6 + length || length < 2) return false;
    const Bytes mark = received_.substr(0, 2);
    const Bytes pdu = received_.substr(7, length - 1);
    received_.erase(0, 6 + length);
    const Bytes answer = obeyPdu(pdu);
    const auto frame = [&](const Bytes& transaction, std::size_t size, int unit) {
        return transaction + word(0) + word(static_cast<unsigned>(size)) + static_cast<char>(unit) + answer;
    };
    const std::size_t size = answer.size() + 1;
    const Mood mood = mood_;
    Bytes bad;
    if (mood == Mood::wrongMark) bad = frame(word(0xBEEF), size, kUnit);
    if (mood == Mood::wrongUnit) bad = frame(mark, size, kUnit + 1);
    if (mood == Mood::wrongLength) {
        const std::array<std::size_t, 4> sizes = {0, 1, size + 3, 0xFFFF};
        bad = frame(mark, sizes[random_() % sizes.size()], kUnit);
    }
    deliver(frame(mark, size, kUnit), bad);
    return true;
}

bool HostilePeer::answerRtu() {
    if (received_.size() < 8) return false;
    const unsigned code = byteAt(received_, 1);
    std::size_t size = 8;
    if (code == 15 || code == 16) size = 9 + byteAt(received_, 6);
    if (received_.size() < size) return false;
    const Bytes frame = received_.substr(0, size);
    received_.erase(0, size);
    if (checkSum(frame.substr(0, size - 2)) != frame.substr(size - 2) || byteAt(frame, 0) != kUnit) {
        received_.clear();
        return false;
    }
    const Bytes answer = obeyPdu(frame.substr(1, size - 3));
    const auto close = [](const Bytes& bytes) { return bytes + checkSum(bytes); };
    const Bytes good = close(static_cast<char>(kUnit) + answer);
    const Mood mood = mood_;
    Bytes bad;
    if (mood == Mood::wrongMark) bad = static_cast<char>(kUnit) + answer + "??";
    if (mood == Mood::wrongUnit) bad = close(static_cast<char>(kUnit + 1) + answer);
    if (mood == Mood::wrongLength) bad = good + Bytes(random_() % 200, '\x55');
    deliver(good, bad);
    return true;
}

bool HostilePeer::answerLine() {
    const auto end = received_.find('\r');
    if (end == Bytes::npos) return false;
    const Bytes line = received_.substr(0, end + 1);
    received_.erase(0, end + 1);
    const Bytes good = obeyLine(line);
    if (good.empty()) return true;
    const Mood mood = mood_;
    Bytes bad;
    if (mood == Mood::wrongMark) {
        bad = good;
        std::transform(bad.begin(), bad.end(), bad.begin(), [](char c) { return c == 'A' ? 'a' : c; });
    }
    if (mood == Mood::wrongLength) bad = "00" + good;
    if (mood == Mood::refusing) bad = "ERROR 7\r";
    deliver(good, bad);
    return true;
}

void HostilePeer::deliver(const Bytes& good, const Bytes& bad) {
    const Bytes half = good.substr(0, good.size() / 2);
    const auto later = [this](double seconds, const Bytes& bytes) {
        late_.push_back({clock() + seconds, bytes});
    };
    switch (mood_) {
        case Mood::late:
            return later(draw(0.0, 1.0), good);
        case Mood::mute:
            return;
        case Mood::garbage: {
            Bytes noise(1 + random_() % 600, ' ');
            for (char& c : noise)
                c = static_cast<char>(random_());
            return send(noise);
        }
        case Mood::half:
            return send(half);
        case Mood::paused:
            send(half);
            return later(draw(0.0, 0.4), good.substr(half.size()));
        case Mood::reset:
            if (random_() % 3 != 0) return send(good);
            send(half);
            return cut(true);
        case Mood::closing:
            send(good);
            return cut(false);
        default:
            return send(bad.empty() ? good : bad);
    }
}

HostilePeer::Bytes HostilePeer::obeyPdu(const Bytes& pdu) {
    const auto code = static_cast<int>(byteAt(pdu, 0));
    {
        const std::lock_guard lock(mutex_);
        model_.hear(clock());
    }
    const auto refuse = [code](char why) { return Bytes{static_cast<char>(code | 0x80), why}; };
    if (mood_ == Mood::refusing || pdu.size() < 5) return refuse(6);
    const int address = wordAt(pdu, 1);
    const int value = wordAt(pdu, 3);
    if (code >= 1 && code <= 4) return readRegisters(code, address, value);
    if (code != 5 && code != 6) return refuse(1);
    write(code, address, value);
    if (mood_ != Mood::wrongEcho) return pdu;
    return pdu.substr(0, 3) +
           (code == 5 ? word(value == 0 ? 0xFF00 : 0) : word(static_cast<unsigned>(value) ^ 1U));
}

HostilePeer::Bytes HostilePeer::readRegisters(int code, int address, int count) {
    const drive::Reading reading = read();
    Bytes data;
    if (code <= 2) {
        data = {static_cast<char>(*reading.enabled ? 1 : 0)};
    } else {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(*reading.acceleration));
        const std::array<unsigned, 6> values = {
            static_cast<unsigned>(std::lround(kFull * *reading.setPoint)),
            static_cast<unsigned>(std::lround(100.0 * *reading.frequency)),
            bits >> 16U,
            bits & 0xFFFFU,
            static_cast<unsigned>(std::lround(kFull * *reading.current)),
            0U};
        for (int i = address; i < address + std::min(count, 64); ++i)
            data += word(i < static_cast<int>(values.size()) ? values[static_cast<std::size_t>(i)] : 0U);
    }
    return Bytes{static_cast<char>(code), static_cast<char>(data.size())} + data;
}

void HostilePeer::write(int code, int address, int value) {
    drive::Command command;
    {
        const std::lock_guard lock(mutex_);
        command = model_.command();
    }
    if (code == 5) command.enable = value != 0;
    if (code == 6 && address == 0) command.setPoint = value / kFull;
    if (code == 6 && address == 1) command.frequency = value / 100.0;
    tell(command);
}

HostilePeer::Bytes HostilePeer::obeyLine(const Bytes& line) {
    const auto words = reo::decode(line);
    if (!words) return {};
    drive::Command command;
    command.setPoint = (*words)[0] / static_cast<double>(reo::kFullSetPoint);
    command.enable = ((*words)[2] & profile_.reo.enable) != 0;
    tell(command);
    const drive::Reading reading = read();
    const double share = *reading.acceleration / profile_.reo.fullAcceleration.value_or(100.0);
    const unsigned status = profile_.reo.code.good | (*reading.enabled ? profile_.reo.enabled : 0U);
    const double raw = std::clamp(share * reo::kFullAnswer, 0.0, 65535.0);
    return reo::encode({static_cast<std::uint16_t>(raw), 0, static_cast<std::uint16_t>(status)});
}

void HostilePeer::tell(const drive::Command& command) {
    const std::lock_guard lock(mutex_);
    model_.hear(clock());
    if (mood_ == Mood::ignoring || mood_ == Mood::refusing) return;
    const drive::Command before = model_.command();
    const bool moved = before.enable && before.setPoint > 0.0;
    if (!moved && command.enable && command.setPoint > 0.0) ++startings_;
    model_.tell(command, clock());
}

drive::Reading HostilePeer::read() {
    const std::lock_guard lock(mutex_);
    return mood_ == Mood::stuck ? frozen_ : model_.read(clock());
}

}  // namespace trapwright::tests
