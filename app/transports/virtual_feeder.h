#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/drive/feeder_model.h"
#include "core/drive/profile.h"
#include "core/drive/transport.h"

namespace trapwright::transports {

/// What can be made to go wrong.
enum class Trouble {
    none,
    late,       // acts at once, answers after a second
    silent,     // hears nothing and answers nothing any more
    wrong,      // answers that fit no question
    refusing,   // Modbus: every question gets an exception; REO: answers that are no hexadecimal numbers
    disagrees,  // acts on a set-point that is half of full away from what it was told, and says so
    fault       // a fault of the drive itself
};

/// A feeder that only the program sees, served like a real one. It has a thread of its own; all members may
/// be called from any thread.
class VirtualFeeder {
 public:
    VirtualFeeder() = default;
    VirtualFeeder(const VirtualFeeder&) = delete;
    VirtualFeeder& operator=(const VirtualFeeder&) = delete;
    /// Cuts the connection and joins the thread.
    virtual ~VirtualFeeder() = default;

    /// Where it is reached.
    [[nodiscard]] virtual drive::Address address() const = 0;

    virtual void setTrouble(Trouble trouble) = 0;
    /// The cable is pulled: the connection ends, and there is no other until restore().
    virtual void cut() = 0;
    /// The cable is back. A pseudo-terminal has a new name then: see address().
    virtual base::Status restore() = 0;

    /// Without noise. [m]
    [[nodiscard]] virtual double halfStroke() const = 0;
    /// Moves by less than 1 % of full.
    [[nodiscard]] virtual bool isAtRest() const = 0;
    /// Rests because nobody spoke to it.
    [[nodiscard]] virtual bool watchdogActed() const = 0;
    /// What it was told last.
    [[nodiscard]] virtual drive::Command command() const = 0;
    /// Everything that it was told, the newest 20,000. Over Modbus set-point and enable come one after the
    /// other.
    [[nodiscard]] virtual std::vector<drive::Command> commands() const = 0;
};

/// As a Modbus TCP server on the loopback, with the places of a Modbus profile, whichever it is. Port 0: any
/// free one. Error: the port is taken.
base::Result<std::unique_ptr<VirtualFeeder>> serveModbusFeeder(const drive::Profile& profile,
                                                               const drive::FeederProperties& properties = {},
                                                               int port = 0);

/// As a REO REOVIB MFS 268 of such a profile on a pseudo-terminal. Error: the system has none left.
base::Result<std::unique_ptr<VirtualFeeder>> serveReoFeeder(const drive::Profile& profile,
                                                            const drive::FeederProperties& properties = {});

/// The virtual feeder of a profile that isVirtual.
base::Result<std::unique_ptr<VirtualFeeder>> serveVirtualFeeder(const drive::Profile& profile);

}  // namespace trapwright::transports
