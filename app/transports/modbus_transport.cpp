#include "app/transports/modbus_transport.h"

#include <fmt/format.h>

#include <QAbstractSocket>
#include <QEventLoop>
#include <QModbusDataUnit>
#include <QModbusReply>
#include <QModbusRtuSerialClient>
#include <QModbusTcpClient>
#include <QSerialPort>
#include <QTimer>
#include <QVariant>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "app/transports/modbus_tables.h"

namespace trapwright::transports {

namespace {

using drive::Table;

constexpr double kShortest = 0.02;  // [s]: what is sent needs a moment in the event loop to leave
constexpr double kFarewell = 0.05;  // [s] for the end of a connection
constexpr int kShortestOfQt = 50;   // [ms]

QModbusDataUnit::RegisterType toQt(Table table) {
    return static_cast<QModbusDataUnit::RegisterType>(registerType(table));
}

int toMilliseconds(double seconds) {
    return static_cast<int>(std::ceil(std::max(seconds, kShortest) * 1e3));
}

/// Runs the loop until somebody ends it with 0, or the time is over.
bool runFor(QEventLoop& loop, double seconds) {
    QTimer::singleShot(toMilliseconds(seconds), Qt::PreciseTimer, &loop, [&loop] { loop.exit(1); });
    return loop.exec() == 0;
}

QModbusPdu::FunctionCode readCode(Table table) {
    switch (table) {
        case Table::coil:
            return QModbusPdu::ReadCoils;
        case Table::discreteInput:
            return QModbusPdu::ReadDiscreteInputs;
        case Table::inputRegister:
            return QModbusPdu::ReadInputRegisters;
        case Table::holdingRegister:
            return QModbusPdu::ReadHoldingRegisters;
    }
    return QModbusPdu::Invalid;
}

QModbusPdu::FunctionCode writeCode(Table table, std::size_t count) {
    if (table == Table::coil)
        return count == 1 ? QModbusPdu::WriteSingleCoil : QModbusPdu::WriteMultipleCoils;
    return count == 1 ? QModbusPdu::WriteSingleRegister : QModbusPdu::WriteMultipleRegisters;
}

/// Qt's words, without the full stop that our own sentence has.
std::string reasonOf(const QModbusDevice& device) {
    QString reason = device.errorString();
    while (reason.endsWith('.'))
        reason.chop(1);
    return reason.toStdString();
}

const char* meaningOf(int exception) {
    switch (exception) {
        case QModbusPdu::IllegalFunction:
            return "it does not know this function";
        case QModbusPdu::IllegalDataAddress:
            return "it has no such address; check it in the profile";
        case QModbusPdu::IllegalDataValue:
            return "it does not take this value; check the scale in the profile";
        case QModbusPdu::ServerDeviceFailure:
            return "it failed";
        case QModbusPdu::ServerDeviceBusy:
            return "it is busy";
        default:
            return "its manual says why";
    }
}

class ModbusTransport final : public drive::RegisterTransport {
 public:
    using ClientMaker = std::function<std::unique_ptr<QModbusClient>()>;

    ModbusTransport(std::string name, std::string advice, int unit, ClientMaker makeClient)
        : name_(std::move(name)),
          advice_(std::move(advice)),
          unit_(unit),
          makeClient_(std::move(makeClient)) {}
    ModbusTransport(const ModbusTransport&) = delete;
    ModbusTransport& operator=(const ModbusTransport&) = delete;
    ~ModbusTransport() override { close(); }

    base::Status open(double timeOut) override {
        close();
        // Made first: it gives a thread that is not Qt's the means to wait for sockets.
        QEventLoop loop;
        client_ = makeClient_();
        client_->setNumberOfRetries(0);
        QObject::connect(client_.get(), &QModbusClient::stateChanged, &loop, [&](QModbusDevice::State state) {
            if (state == QModbusDevice::ConnectedState) loop.exit(0);
        });
        QObject::connect(client_.get(), &QModbusClient::errorOccurred, &loop, [&] { loop.exit(2); });
        const bool begun = client_->connectDevice();
        if (begun && (isOpen() || runFor(loop, timeOut))) return base::success();
        const std::string reason = reasonOf(*client_);
        client_.reset();
        return base::Error{
            fmt::format("{} cannot be reached{}. {}", name_, reason.empty() ? "" : ": " + reason, advice_)};
    }

    [[nodiscard]] bool isOpen() const override {
        return client_ && client_->state() == QModbusDevice::ConnectedState;
    }

    base::Result<std::vector<std::uint16_t>> read(Table table, int address, int count,
                                                  double timeOut) override {
        const QModbusDataUnit unit(toQt(table), address, static_cast<quint16>(count));
        const auto ask = [&] { return client_->sendReadRequest(unit, unit_); };
        auto answer = exchange(ask, readCode(table), what("read", table, address), timeOut);
        if (!answer) return answer.error();
        // Bits come in whole bytes, and Qt leaves the rest of the last one to us.
        const bool isBit = table == Table::coil || table == Table::discreteInput;
        const int expected = isBit ? (count + 7) / 8 * 8 : count;
        if (answer->valueCount() != static_cast<uint>(expected)) {
            return base::Error{fmt::format("{} answered with {} values to the wish to {}, not {}", name_,
                                           answer->valueCount(), what("read", table, address), count)};
        }
        const QList<quint16> values = answer->values();
        return std::vector<std::uint16_t>(values.begin(), values.begin() + count);
    }

    base::Status write(Table table, int address, std::span<const std::uint16_t> values,
                       double timeOut) override {
        const QModbusDataUnit unit(toQt(table), address, QList<quint16>(values.begin(), values.end()));
        const auto ask = [&] { return client_->sendWriteRequest(unit, unit_); };
        const auto answer =
            exchange(ask, writeCode(table, values.size()), what("write", table, address), timeOut);
        if (!answer) return answer.error();
        if (answer->startAddress() != address) {
            return base::Error{fmt::format("{} wrote to {} {} instead of {}", name_, nameOf(table),
                                           answer->startAddress(), address)};
        }
        return checkedEcho(*answer, table, values);
    }

    void close() override {
        if (!client_) return;
        if (isOpen()) {
            if (auto* socket = qobject_cast<QAbstractSocket*>(client_->device())) socket->flush();
            QEventLoop loop;
            QObject::connect(client_.get(), &QModbusClient::stateChanged, &loop,
                             [&](QModbusDevice::State state) {
                                 if (state == QModbusDevice::UnconnectedState) loop.exit(0);
                             });
            client_->disconnectDevice();
            if (client_->state() != QModbusDevice::UnconnectedState) runFor(loop, kFarewell);
        }
        client_.reset();
    }

 private:
    [[nodiscard]] static std::string what(const char* verb, Table table, int address) {
        return fmt::format("{} {} {}", verb, nameOf(table), address);
    }

    template <class Ask>
    base::Result<QModbusDataUnit> exchange(const Ask& ask, QModbusPdu::FunctionCode code,
                                           const std::string& what, double timeOut) {
        if (!isOpen()) return base::Error{fmt::format("the connection to {} is lost. {}", name_, advice_)};
        client_->setTimeout(std::max(toMilliseconds(timeOut), kShortestOfQt));
        std::unique_ptr<QModbusReply> reply(ask());
        if (!reply) {
            return base::Error{
                fmt::format("{} could not be asked to {}: {}", name_, what, reasonOf(*client_))};
        }
        if (!reply->isFinished()) {
            QEventLoop loop;
            QObject::connect(reply.get(), &QModbusReply::finished, &loop, [&loop] { loop.exit(0); });
            if (!runFor(loop, timeOut)) {
                // Bytes that come before Qt's own time-out make it use this still; the client owns it.
                QObject::connect(reply.get(), &QModbusReply::finished, reply.get(), &QObject::deleteLater);
                static_cast<void>(reply.release());
                return base::Error{
                    fmt::format("{} did not answer in time when asked to {}. {}", name_, what, advice_)};
            }
        }
        return checkedAnswer(*reply, code, what);
    }

    base::Result<QModbusDataUnit> checkedAnswer(const QModbusReply& reply, QModbusPdu::FunctionCode code,
                                                const std::string& what) const {
        if (reply.error() == QModbusDevice::ProtocolError) {
            const QByteArray data = reply.rawResult().data();
            const int exception = data.isEmpty() ? 0 : data.front();
            return base::Error{fmt::format("{} refused to {} with exception {}: {}", name_, what, exception,
                                           meaningOf(exception))};
        }
        if (reply.error() == QModbusDevice::TimeoutError) {
            return base::Error{
                fmt::format("{} did not answer in time when asked to {}. {}", name_, what, advice_)};
        }
        if (reply.error() == QModbusDevice::ReplyAbortedError) {
            return base::Error{
                fmt::format("{} ended the connection when asked to {}. {}", name_, what, advice_)};
        }
        // Qt takes an answer to any question for one to this question.
        if (reply.error() != QModbusDevice::NoError || reply.rawResult().functionCode() != code) {
            return base::Error{
                fmt::format("{} answered to another question when asked to {}. Does somebody "
                            "else speak to it?",
                            name_, what)};
        }
        return reply.result();
    }

    /// One value comes back as it was written, of several only their number (Modbus Application Protocol
    /// 1.1b3, sections 6.5, 6.6, 6.11 and 6.12).
    base::Status checkedEcho(const QModbusDataUnit& answer, Table table,
                             std::span<const std::uint16_t> values) const {
        const bool isBit = table == Table::coil;
        bool same = answer.valueCount() == static_cast<qsizetype>(values.size());
        if (same && values.size() == 1) {
            same = isBit ? (answer.value(0) != 0) == (values[0] != 0) : answer.value(0) == values[0];
        }
        if (same) return base::success();
        return base::Error{
            fmt::format("{} says that it wrote something else to {} {} than it was told. Check in its "
                        "manual which values it takes there, and the scale in the profile",
                        name_, nameOf(table), answer.startAddress())};
    }

    const std::string name_;
    const std::string advice_;
    const int unit_;
    const ClientMaker makeClient_;
    std::unique_ptr<QModbusClient> client_;
};

QSerialPort::Parity toQt(char parity) {
    switch (parity) {
        case 'E':
            return QSerialPort::EvenParity;
        case 'O':
            return QSerialPort::OddParity;
        default:
            return QSerialPort::NoParity;
    }
}

}  // namespace

std::unique_ptr<drive::RegisterTransport> makeTcpTransport(const std::string& host, int port, int unit) {
    return std::make_unique<ModbusTransport>(
        fmt::format("the Modbus device at {}:{}", host, port),
        "Check its power, the cable, its address, and that nobody else holds its connections", unit,
        [host, port] {
            auto client = std::make_unique<QModbusTcpClient>();
            client->setConnectionParameter(QModbusDevice::NetworkAddressParameter,
                                           QString::fromStdString(host));
            client->setConnectionParameter(QModbusDevice::NetworkPortParameter, port);
            return client;
        });
}

std::unique_ptr<drive::RegisterTransport> makeRtuTransport(const std::string& line,
                                                           const drive::ModbusMap& settings, int unit) {
    return std::make_unique<ModbusTransport>(
        fmt::format("the Modbus device {} on {}", unit, line),
        "Check its power, the cable and its two data lines, its number, baud rate and parity", unit,
        [line, baud = settings.baud, parity = settings.parity, stopBits = settings.stopBits] {
            auto client = std::make_unique<QModbusRtuSerialClient>();
            client->setConnectionParameter(QModbusDevice::SerialPortNameParameter,
                                           QString::fromStdString(line));
            client->setConnectionParameter(QModbusDevice::SerialBaudRateParameter, baud);
            client->setConnectionParameter(QModbusDevice::SerialParityParameter, toQt(parity));
            client->setConnectionParameter(QModbusDevice::SerialDataBitsParameter, QSerialPort::Data8);
            client->setConnectionParameter(QModbusDevice::SerialStopBitsParameter,
                                           stopBits == 2 ? QSerialPort::TwoStop : QSerialPort::OneStop);
            return client;
        });
}

}  // namespace trapwright::transports
