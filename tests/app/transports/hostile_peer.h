#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/drive/feeder_model.h"
#include "core/drive/profile.h"
#include "core/drive/transport.h"

namespace trapwright::tests {

/// How a hostile peer behaves. What a serial line has no word for (a transaction) is damaged otherwise there.
enum class Mood {
    honest,
    late,         // acts at once, answers after up to a second
    mute,         // acts, never answers
    deaf,         // hears nothing
    refusing,     // an exception to everything, and acts on nothing
    ignoring,     // says that it does what it is told, and does not
    stuck,        // reads back what it read back first
    wrongMark,    // another transaction; a wrong check sum; small digits
    wrongUnit,    // answers as another device
    wrongLength,  // a length that is not that of the frame
    wrongEcho,    // says that it wrote another value
    garbage,      // any bytes
    half,         // half an answer, and nothing more
    paused,       // half an answer, and the rest after a while
    flood,        // unasked frames without end
    echo,         // sends back what it hears, as a line that is short-circuited
    reset,        // resets the connection in the midst of an answer
    closing,      // ends the connection after each answer
    refused,      // no connection is taken
    last = refused
};

/// A device that speaks Modbus TCP, Modbus RTU or REO frames by itself on a socket or a pseudo-terminal, not
/// through a library, so that it can break every rule. Deterministic from its seed but for the times. What it
/// drives is a FeederModel, whose motion is the truth. It has a thread of its own; all members may be called
/// from any thread. The places are those of the bundled profile virtual-modbus.
class HostilePeer {
 public:
    /// `folder` is where the name of the line is kept: a hang-up changes the terminal behind it.
    HostilePeer(const drive::Profile& profile, std::uint64_t seed, const std::string& folder);
    HostilePeer(const HostilePeer&) = delete;
    HostilePeer& operator=(const HostilePeer&) = delete;
    ~HostilePeer();

    [[nodiscard]] drive::Address address() const { return address_; }
    void setMood(Mood mood);
    [[nodiscard]] bool isAtRest() const;
    /// Times that it was switched on from rest.
    [[nodiscard]] int startings() const;
    [[nodiscard]] int connections() const { return connections_; }

 private:
    using Bytes = std::string;
    struct Late {
        double due;  // [s]
        Bytes bytes;
    };

    [[nodiscard]] static double clock();
    void run();
    void listen();
    void openLine();
    void closeListener();
    void cut(bool abruptly);
    void take();
    void receive();
    void send(const Bytes& bytes);
    void sendLate();
    void answerAll();
    bool answerTcp();
    bool answerRtu();
    bool answerLine();
    void deliver(const Bytes& good, const Bytes& bad);
    Bytes obeyPdu(const Bytes& pdu);
    Bytes readRegisters(int code, int address, int count);
    void write(int code, int address, int value);
    Bytes obeyLine(const Bytes& line);
    void tell(const drive::Command& command);
    drive::Reading read();
    double draw(double low, double high);

    const drive::Profile profile_;
    const std::string link_;
    drive::Address address_;
    int wake_ = -1;

    mutable std::mutex mutex_;  // guards the next three
    mutable drive::FeederModel model_;
    drive::Reading frozen_;
    int startings_ = 0;
    std::atomic<Mood> mood_ = Mood::honest;
    std::atomic<int> connections_ = 0;
    std::atomic<bool> over_ = false;

    // The thread's own.
    std::mt19937_64 random_;
    int listener_ = -1;
    int peer_ = -1;   // the connection, or the master of the terminal
    int slave_ = -1;  // keeps the terminal alive between two visitors
    int port_ = 0;
    Bytes received_;
    std::deque<Late> late_;
    double lineBack_ = 0.0;  // [s], when a line that was hung up is there again

    std::thread thread_;  // last: it uses all of the above
};

}  // namespace trapwright::tests
