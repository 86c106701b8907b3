#include "app/transports/serial_transport.h"

#include <fmt/format.h>

#include <QEventLoop>
#include <QSerialPort>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/drive/deadline.h"

namespace trapwright::transports {

namespace {

constexpr qsizetype kLongestLine = 256;

int toMilliseconds(double seconds) {
    return static_cast<int>(std::ceil(seconds * 1e3));
}

class SerialTransport final : public drive::LineTransport {
 public:
    SerialTransport(std::string line, int baud) : line_(std::move(line)), baud_(baud) {}
    SerialTransport(const SerialTransport&) = delete;
    SerialTransport& operator=(const SerialTransport&) = delete;
    ~SerialTransport() override { close(); }

    base::Status open(double /*timeOut*/) override {
        close();
        // Gives a thread that is not Qt's the means to wait for the port.
        const QEventLoop loop;
        port_ = std::make_unique<QSerialPort>();
        port_->setPortName(QString::fromStdString(line_));
        port_->setBaudRate(baud_);
        port_->setDataBits(QSerialPort::Data8);
        port_->setParity(QSerialPort::NoParity);
        port_->setStopBits(QSerialPort::OneStop);
        port_->setFlowControl(QSerialPort::NoFlowControl);
        if (port_->open(QIODevice::ReadWrite)) {
            port_->clear();
            return base::success();
        }
        const std::string reason = port_->errorString().toStdString();
        port_.reset();
        return base::Error{
            fmt::format("the serial port {} cannot be opened: {}. Is it plugged in, may you use it "
                        "(group dialout), and does no other program hold it?",
                        line_, reason)};
    }

    [[nodiscard]] bool isOpen() const override { return port_ && port_->isOpen(); }

    base::Result<std::string> exchange(std::string_view line, double timeOut) override {
        if (!isOpen()) return base::Error{fmt::format("the serial port {} is not open", line_)};
        const drive::Deadline deadline(timeOut);
        port_->clear(QSerialPort::Input);
        port_->clearError();
        port_->write(line.data(), static_cast<qint64>(line.size()));
        QByteArray answer;
        while (!answer.contains('\r')) {
            const double left = deadline.left();
            if (left <= 0.0) return late();
            // Sends what is not sent yet as well.
            if (!port_->waitForReadyRead(toMilliseconds(left))) {
                return port_->error() == QSerialPort::TimeoutError || port_->error() == QSerialPort::NoError
                           ? late()
                           : gone();
            }
            answer += port_->readAll();
            if (answer.size() > kLongestLine) break;
        }
        return answer.left(answer.indexOf('\r') + 1).toStdString();
    }

    void close() override { port_.reset(); }

 private:
    [[nodiscard]] base::Error late() const {
        return base::Error{
            fmt::format("no answer in time on {}. Check the drive's power, the cable, and that its serial "
                        "interface is switched on",
                        line_)};
    }

    // The port is of no use any more.
    base::Error gone() {
        const std::string reason = port_->errorString().toStdString();
        port_.reset();
        return base::Error{fmt::format("the serial port {} is gone: {}. Was it unplugged?", line_, reason)};
    }

    const std::string line_;
    const int baud_;
    std::unique_ptr<QSerialPort> port_;
};

}  // namespace

std::unique_ptr<drive::LineTransport> makeSerialTransport(const std::string& line, int baud) {
    return std::make_unique<SerialTransport>(line, baud);
}

}  // namespace trapwright::transports
