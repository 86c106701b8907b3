// Drives a feeder until it is killed: driven_until_killed PROFILE HOST PORT LINE LOG
#include <fcntl.h>
#include <unistd.h>

#include <QCoreApplication>
#include <QTimer>
#include <cstdlib>

#include "app/transports/make_drive.h"
#include "core/drive/drive_loop.h"
#include "core/drive/profile_folder.h"

using namespace trapwright;

int main(int count, char** arguments) {
    const QCoreApplication application(count, arguments);
    if (count != 6) return 2;
    const auto folder =
        drive::readProfileFolder(std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/drives");
    drive::Profile profile;
    for (const drive::Profile& known : folder.profiles) {
        if (known.name == arguments[1]) profile = known;
    }
    drive::Address address;
    address.host = arguments[2];
    address.port = std::atoi(arguments[3]);  // NOLINT(cert-err34-c): the test writes it
    address.line = arguments[4];
    const int file = ::open(arguments[5], O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (file < 0) return 1;

    drive::DriveLoop loop(
        profile, {0.9, 2.0}, [&] { return transports::makeDrive(profile, address); },
        [file](const drive::LogEntry& entry) {
            // One call of the system for one line: a kill leaves whole lines.
            const std::string line = drive::toCsv(entry);
            if (::write(file, line.data(), line.size()) < 0) std::abort();
        });
    loop.setTarget(0.7);
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&loop] {
        if (loop.snapshot().state == drive::State::idle) loop.start();
    });
    timer.start(50);
    return QCoreApplication::exec();
}
