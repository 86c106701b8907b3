#include <fmt/format.h>

#include <QEventLoop>
#include <QMetaObject>
#include <QModbusTcpServer>
#include <QTcpServer>
#include <QTcpSocket>
#include <QVariant>
#include <algorithm>
#include <condition_variable>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <thread>

#include "app/transports/modbus_tables.h"
#include "app/transports/virtual_feeder.h"
#include "app/transports/virtual_state.h"
#include "core/drive/register_value.h"

namespace trapwright::transports {

namespace {

using drive::Place;
using drive::Table;

std::vector<Place> placesOf(const drive::ModbusMap& map) {
    std::vector<Place> places;
    for (const auto* quantity : {&map.setPoint, &map.setPointReadBack, &map.frequency, &map.frequencyReadBack,
                                 &map.acceleration, &map.current}) {
        if (*quantity) places.push_back((*quantity)->place);
    }
    for (const auto* item : {&map.enable, &map.enableReadBack}) {
        if (*item) places.push_back((*item)->place);
    }
    if (map.fault) places.push_back(map.fault->place);
    for (const auto* writes : {&map.atConnect, &map.atHeartbeat, &map.whileEnabled, &map.atDisconnect}) {
        for (const drive::Write& write : *writes)
            places.push_back(write.place);
    }
    return places;
}

QModbusDataUnit::RegisterType toQt(Table table) {
    return static_cast<QModbusDataUnit::RegisterType>(registerType(table));
}

bool covers(const QModbusDataUnit& unit, const Place& place) {
    return unit.registerType() == toQt(place.table) && unit.startAddress() <= place.address &&
           place.address + place.count() <= unit.startAddress() + static_cast<int>(unit.valueCount());
}

/// An answer to a question that nobody asked.
QModbusResponse strangeAnswer(const QModbusPdu& request) {
    if (request.functionCode() == QModbusPdu::ReadHoldingRegisters) {
        return {QModbusResponse::ReadInputRegisters, quint8(2), quint16(0x1234)};
    }
    return {QModbusResponse::ReadHoldingRegisters, quint8(4), quint16(0x1234), quint16(0x5678)};
}

/// The Modbus side of a virtual feeder: Qt's server with the places of a profile, filled from the model
/// before every request and told to it after every write. Lives in one thread; release() may be called from
/// any.
class FeederServer final : public QModbusTcpServer {
 public:
    FeederServer(const drive::ModbusMap& map, VirtualState& state);

    /// Answers that are held back come now.
    void release();
    /// From now on answers may be held back again.
    void hold();

 protected:
    QModbusResponse processRequest(const QModbusPdu& request) override;
    bool writeData(const QModbusDataUnit& unit) override;

 private:
    void makeTables();
    void fillTables();
    void put(const drive::Place& place, double raw);
    void put(const std::optional<drive::Quantity>& quantity, const std::optional<double>& value);
    [[nodiscard]] double rawAt(const drive::Place& place) const;
    void waitUntilReleased(bool howeverLong);

    const drive::ModbusMap map_;
    VirtualState& state_;
    drive::Command command_;  // as it was written
    bool filling_ = false;    // writes come from the model

    std::mutex mutex_;
    std::condition_variable wake_;
    bool released_ = false;
};

FeederServer::FeederServer(const drive::ModbusMap& map, VirtualState& state) : map_(map), state_(state) {
    setServerAddress(map_.unit);
    makeTables();
}

void FeederServer::release() {
    {
        const std::lock_guard lock(mutex_);
        released_ = true;
    }
    wake_.notify_all();
}

void FeederServer::hold() {
    const std::lock_guard lock(mutex_);
    released_ = false;
}

QModbusResponse FeederServer::processRequest(const QModbusPdu& request) {
    const Trouble trouble = state_.trouble();
    if (trouble == Trouble::silent) {
        waitUntilReleased(true);
        return QModbusExceptionResponse(request.functionCode(), QModbusPdu::ServerDeviceFailure);
    }
    state_.hear();
    fillTables();
    const QModbusResponse response = QModbusTcpServer::processRequest(request);
    if (trouble == Trouble::late) waitUntilReleased(false);
    if (trouble == Trouble::wrong) return strangeAnswer(request);
    if (trouble == Trouble::refusing) {
        return QModbusExceptionResponse(request.functionCode(), QModbusPdu::ServerDeviceBusy);
    }
    return response;
}

bool FeederServer::writeData(const QModbusDataUnit& unit) {
    if (!QModbusTcpServer::writeData(unit)) return false;
    if (filling_) return true;
    bool told = false;
    if (map_.setPoint && covers(unit, map_.setPoint->place)) {
        command_.setPoint = drive::fromRaw(*map_.setPoint, rawAt(map_.setPoint->place));
        told = true;
    }
    if (map_.frequency && covers(unit, map_.frequency->place)) {
        command_.frequency = drive::fromRaw(*map_.frequency, rawAt(map_.frequency->place));
        told = true;
    }
    if (map_.enable && covers(unit, map_.enable->place)) {
        const auto raw = static_cast<unsigned>(rawAt(map_.enable->place));
        command_.enable = (raw & map_.enable->mask) == (map_.enable->on & map_.enable->mask);
        told = true;
    }
    if (told) state_.tell(command_);
    return true;
}

void FeederServer::makeTables() {
    std::map<Table, int> ends;
    for (const Place& place : placesOf(map_))
        ends[place.table] = std::max(ends[place.table], place.address + place.count());
    QModbusDataUnitMap tables;
    for (const auto& [table, end] : ends)
        tables.insert(toQt(table), QModbusDataUnit(toQt(table), 0, static_cast<quint16>(end)));
    filling_ = true;
    setMap(tables);
    filling_ = false;
}

void FeederServer::fillTables() {
    const drive::Command command = state_.command();
    // The watchdog has changed what was written.
    if (!command.enable && command.setPoint == 0.0) command_ = command;
    const drive::Reading reading = state_.read();
    filling_ = true;
    put(map_.setPointReadBack ? map_.setPointReadBack : map_.setPoint, reading.setPoint);
    put(map_.frequencyReadBack ? map_.frequencyReadBack : map_.frequency, reading.frequency);
    put(map_.acceleration, reading.acceleration);
    put(map_.current, reading.current);
    const auto& enabled = map_.enableReadBack ? map_.enableReadBack : map_.enable;
    if (enabled) put(enabled->place, reading.enabled.value_or(false) ? enabled->on : enabled->off);
    if (map_.fault) {
        const drive::FaultCode& code = map_.fault->code;
        const unsigned bad = code.meanings.empty() ? ~code.good & code.mask : code.meanings.begin()->first;
        put(map_.fault->place, reading.fault ? bad : code.good);
    }
    filling_ = false;
}

void FeederServer::put(const std::optional<drive::Quantity>& quantity, const std::optional<double>& value) {
    if (quantity && value) put(quantity->place, drive::toRaw(*quantity, *value));
}

void FeederServer::put(const Place& place, double raw) {
    const auto registers = drive::encodeRaw(place, raw);
    setData(QModbusDataUnit(toQt(place.table), place.address,
                            QList<quint16>(registers.begin(), registers.end())));
}

double FeederServer::rawAt(const Place& place) const {
    QModbusDataUnit unit(toQt(place.table), place.address, static_cast<quint16>(place.count()));
    data(&unit);
    const QList<quint16> values = unit.values();
    return drive::decodeRaw(place, std::vector<std::uint16_t>(values.begin(), values.end()));
}

void FeederServer::waitUntilReleased(bool howeverLong) {
    std::unique_lock lock(mutex_);
    const auto released = [this] { return released_; };
    if (howeverLong) {
        wake_.wait(lock, released);
    } else {
        wake_.wait_for(lock, kLateAnswer, released);
    }
}

constexpr const char* kLoopback = "127.0.0.1";

class VirtualModbusFeeder final : public VirtualFeeder {
 public:
    VirtualModbusFeeder(const drive::Profile& profile, const drive::FeederProperties& properties, int port)
        : map_(profile.modbus), state_(properties), port_(port) {
        // Shared: the thread may still be in set_value() when we go on.
        const auto ready = std::make_shared<std::promise<void>>();
        thread_ = std::thread([this, ready] { run(*ready); });
        ready->get_future().wait();
    }
    VirtualModbusFeeder(const VirtualModbusFeeder&) = delete;
    VirtualModbusFeeder& operator=(const VirtualModbusFeeder&) = delete;
    ~VirtualModbusFeeder() override {
        server_->release();
        QMetaObject::invokeMethod(
            server_, [this] { loop_->quit(); }, Qt::QueuedConnection);
        thread_.join();
    }

    [[nodiscard]] drive::Address address() const override {
        drive::Address address;
        address.host = kLoopback;
        address.port = port_;
        address.unit = map_.unit;
        return address;
    }

    void setTrouble(Trouble trouble) override {
        // Whoever waits for an answer of the trouble before gets it now.
        server_->release();
        call([this, trouble] {
            state_.setTrouble(trouble);
            server_->hold();
        });
    }

    void cut() override {
        server_->release();
        call([this] { server_->disconnectDevice(); });
    }

    base::Status restore() override {
        base::Status status = base::success();
        call([this, &status] {
            server_->hold();
            status = listen();
        });
        return status;
    }

    [[nodiscard]] double halfStroke() const override { return state_.halfStroke(); }
    [[nodiscard]] bool isAtRest() const override { return state_.isAtRest(); }
    [[nodiscard]] bool watchdogActed() const override { return state_.watchdogActed(); }
    [[nodiscard]] drive::Command command() const override { return state_.command(); }
    [[nodiscard]] std::vector<drive::Command> commands() const override { return state_.commands(); }

 private:
    void run(std::promise<void>& ready) {
        QEventLoop loop;
        FeederServer server(map_, state_);
        loop_ = &loop;
        server_ = &server;
        ready.set_value();
        loop.exec();
        // Qt frees what belongs to a connection only while the server is there.
        server.disconnectDevice();
        qDeleteAll(server.findChildren<QTcpSocket*>());
    }

    void call(const std::function<void()>& work) {
        QMetaObject::invokeMethod(server_, work, Qt::BlockingQueuedConnection);
    }

    // On the thread.
    base::Status listen() {
        server_->setConnectionParameter(QModbusDevice::NetworkAddressParameter, kLoopback);
        server_->setConnectionParameter(QModbusDevice::NetworkPortParameter, port_);
        if (!server_->connectDevice()) {
            return base::Error{
                fmt::format("the virtual feeder cannot be served at {}:{}: {}. Does another program "
                            "use this port?",
                            kLoopback, port_, server_->errorString().toStdString())};
        }
        // The port that was free, for when the cable is back.
        if (const auto* listener = server_->findChild<QTcpServer*>()) port_ = listener->serverPort();
        return base::success();
    }

    const drive::ModbusMap map_;
    VirtualState state_;
    int port_;
    QEventLoop* loop_ = nullptr;      // the thread's,
    FeederServer* server_ = nullptr;  // while it runs
    std::thread thread_;
};

}  // namespace

base::Result<std::unique_ptr<VirtualFeeder>> serveModbusFeeder(const drive::Profile& profile,
                                                               const drive::FeederProperties& properties,
                                                               int port) {
    std::unique_ptr<VirtualFeeder> feeder = std::make_unique<VirtualModbusFeeder>(profile, properties, port);
    if (const auto status = feeder->restore(); !status) return status.error();
    return feeder;
}

base::Result<std::unique_ptr<VirtualFeeder>> serveVirtualFeeder(const drive::Profile& profile) {
    drive::FeederProperties properties;
    properties.fullHalfStroke = profile.fullHalfStroke.value_or(properties.fullHalfStroke);
    properties.resonance = profile.frequency.value_or(properties.resonance);
    properties.watchdog = profile.watchdog.value_or(properties.watchdog);
    if (profile.protocol == drive::Protocol::reo) return serveReoFeeder(profile, properties);
    return serveModbusFeeder(profile, properties);
}

}  // namespace trapwright::transports
