#include "ui/feeder/drive_texts.h"

#include <QCoreApplication>
#include <QLocale>

#include "ui/look/text.h"

namespace trapwright::feeder {

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(DriveTexts)
};

const QString kNothing = QStringLiteral("–");

}  // namespace

QString stateText(drive::State state) {
    switch (state) {
        case drive::State::disconnected:
            return Texts::tr("Not connected");
        case drive::State::idle:
            return Texts::tr("At rest");
        case drive::State::ramping:
            return Texts::tr("On the way to the set-point");
        case drive::State::running:
            return Texts::tr("Running");
        case drive::State::stopping:
            return Texts::tr("Coming to rest");
        case drive::State::faulted:
            return Texts::tr("Stopped by a fault");
    }
    return {};
}

QString shareText(const std::optional<double>& share) {
    constexpr double kPercent = 100.0;
    if (!share) return kNothing;
    return Texts::tr("%1 %").arg(QLocale().toString(kPercent * *share, 'f', 1));
}

QString readingText(const std::optional<double>& value, double factor, const QString& unit) {
    if (!value) return kNothing;
    return QString("%1 %2").arg(look::numberText(factor * *value), unit);
}

QString asSentence(QString text) {
    if (text.isEmpty()) return text;
    text[0] = text[0].toUpper();
    return text.endsWith('.') ? text : text + '.';
}

QString entryText(const drive::LogEntry& entry) {
    QString text = QString::fromStdString(entry.text);
    switch (entry.kind) {
        case drive::LogKind::connected:
            return text.isEmpty() ? Texts::tr("Connected") : Texts::tr("Connected: %1").arg(text);
        case drive::LogKind::disconnected:
            return text.isEmpty() ? Texts::tr("Disconnected") : Texts::tr("Disconnected: %1").arg(text);
        case drive::LogKind::command:
            return Texts::tr("Set-point %1").arg(shareText(entry.setPoint));
        case drive::LogKind::reading:
            return Texts::tr("Read back %1").arg(shareText(entry.setPoint));
        case drive::LogKind::state: {
            for (const drive::State state :
                 {drive::State::disconnected, drive::State::idle, drive::State::ramping,
                  drive::State::running, drive::State::stopping, drive::State::faulted}) {
                if (entry.text == drive::nameOf(state)) return stateText(state);
            }
            return text;
        }
        case drive::LogKind::fault:
            return Texts::tr("Fault: %1").arg(text);
        case drive::LogKind::note:
            return text;
    }
    return text;
}

}  // namespace trapwright::feeder
