#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace trapwright::drive {

enum class Protocol { modbusTcp, modbusRtu, reo };

/// The four tables of a Modbus device.
enum class Table { coil, discreteInput, inputRegister, holdingRegister };

enum class DataType { bit, uint16, int16, uint32, int32, float32 };

/// A place in a Modbus device. Two registers of a 32-bit value: the high word first, unless lowWordFirst.
struct Place {
    Table table = Table::holdingRegister;
    int address = 0;  // from 0, as on the wire: a manual's 40011 is holding register 10, its 00017 coil 16
    DataType type = DataType::uint16;
    bool lowWordFirst = false;

    /// Registers (or coils) that the value takes: 1 or 2.
    [[nodiscard]] int count() const;
    friend bool operator==(const Place&, const Place&) = default;
};

/// A quantity at a place: the raw number `zero` stands for 0 and `one` for 1 of its unit.
struct Quantity {
    Place place;
    double zero = 0.0;
    double one = 1.0;

    friend bool operator==(const Quantity&, const Quantity&) = default;
};

/// A switch: a coil, or a register of which two numbers mean on and off.
struct Switch {
    Place place;
    unsigned on = 1;         // the number that is written to switch it on,
    unsigned off = 0;        // and off
    unsigned mask = 0xFFFF;  // what is read counts as on when it has the masked bits of `on`

    friend bool operator==(const Switch&, const Switch&) = default;
};

/// A raw number for a place.
struct Write {
    Place place;
    double value = 0.0;
    bool mayFail = false;  // an error of the device is no reason not to go on

    friend bool operator==(const Write&, const Write&) = default;
};

/// How a number tells a fault: by masked bits other than `good`.
struct FaultCode {
    unsigned mask = 0xFFFF;
    unsigned good = 0;
    std::map<unsigned, std::string> meanings;  // of masked bits

    /// The fault in words; none when the bits are good.
    [[nodiscard]] std::optional<std::string> findFault(unsigned raw) const;
    friend bool operator==(const FaultCode&, const FaultCode&) = default;
};

/// Where a Modbus device tells its fault.
struct FaultPlace {
    Place place;
    FaultCode code;

    friend bool operator==(const FaultPlace&, const FaultPlace&) = default;
};

/// Where a Modbus device keeps what; shares for set-points and currents, Hz and m/s^2 for the others.
struct ModbusMap {
    int unit = 1;     // the device's Modbus address
    int port = 502;   // TCP
    int baud = 9600;  // RTU
    char parity = 'E';
    int stopBits = 1;

    std::optional<Quantity> setPoint;          // without one the drive knows on and off only
    std::optional<Quantity> setPointReadBack;  // default: where it was written, if that can be read
    std::optional<Quantity> frequency;
    std::optional<Quantity> frequencyReadBack;
    std::optional<Switch> enable;
    std::optional<Switch> enableReadBack;
    std::optional<FaultPlace> fault;
    std::optional<Quantity> acceleration;  // [m/s^2], peak
    std::optional<Quantity> current;
    std::vector<Write> atConnect;    // in this order
    std::vector<Write> atHeartbeat;  // with every heartbeat, for a watchdog; a two-step toggle has two writes
    std::vector<Write>
        whileEnabled;  // with every heartbeat while enabled: a drive that is triggered again and again
    std::vector<Write> atDisconnect;  // after set-point zero and enable off

    friend bool operator==(const ModbusMap&, const ModbusMap&) = default;
};

/// What the REO REOVIB protocol leaves to the device. Words are 16-bit numbers.
struct ReoMap {
    int baud = 9600;
    unsigned enable = 0x0001;                // bit of the control word
    unsigned enabled = 0;                    // bit of the status word that repeats it; 0: not known
    FaultCode code{0x00FF, 0x00A5, {}};      // in the status word; A5 is "ready"
    std::optional<double> fullAcceleration;  // [m/s^2], peak, that 8000 (100 %) stands for, where it is known

    friend bool operator==(const ReoMap&, const ReoMap&) = default;
};

/// A drive that can be chosen, as a readable JSON file describes it.
struct Profile {
    std::string name;   // "adam-6024": the file's name without .json
    std::string title;  // for people
    std::string maker;
    std::string checkedAgainst;  // for people: "documentation only", or which real protocol peer
    std::vector<std::string> sources;
    std::string wiring;      // for people: what to connect and to set before the first use
    bool isVirtual = false;  // the program serves the feeder itself
    Protocol protocol = Protocol::modbusTcp;
    ModbusMap modbus;        // for the two Modbus protocols
    ReoMap reo;              // for REO
    double timeOut = 0.3;    // [s] for one heartbeat, from the first byte out to the last byte in
    double heartbeat = 8.0;  // [Hz], 5 ... 10
    std::optional<double>
        watchdog;               // [s] of silence after which the drive rests by itself; none: it does not
    double settlingTime = 0.5;  // [s] until a reading must agree with what was told
    double tolerance = 0.02;    // by how much, share of full
    std::optional<double> restAcceleration;  // [m/s^2]: above it the feeder moves
    std::optional<double> fullHalfStroke;    // [m] at set-point 1, where it is known
    std::optional<double> frequency;         // [Hz], mechanical, where the drive does not tell it

    /// Whether it can be told a frequency, and a set-point other than all or nothing.
    [[nodiscard]] bool hasFrequency() const { return modbus.frequency.has_value(); }
    [[nodiscard]] bool hasSetPoint() const {
        return protocol == Protocol::reo || modbus.setPoint.has_value();
    }
    friend bool operator==(const Profile&, const Profile&) = default;
};

/// Reads a profile. Error: what is wrong, under which key, and what must stand there.
base::Result<Profile> readProfile(std::string_view json);

/// "coil", "holding register" and so on.
std::string_view nameOf(Table table);

}  // namespace trapwright::drive
