#pragma once

#include <QObject>

namespace trapwright::window {

/// While this lives, SIGTERM, SIGINT and SIGHUP (the latter not under nohup) end the process no more: asked()
/// tells of them in the event loop, which may end in order. One at a time in a process.
class EndSignals : public QObject {
    Q_OBJECT
 public:
    explicit EndSignals(QObject* parent = nullptr);
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;
    ~EndSignals() override;

 signals:
    void asked();
};

}  // namespace trapwright::window
