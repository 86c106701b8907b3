#include "ui/look/text.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QLocale>
#include <algorithm>
#include <cmath>

#include "core/base/csv.h"

namespace trapwright::look {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("trapwright::look", text);
}

}  // namespace

QString fromUtf8(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString durationText(double seconds) {
    constexpr qint64 kMinute = 60;
    constexpr qint64 kHour = 60 * kMinute;
    constexpr qint64 kDay = 24 * kHour;
    const qint64 whole = std::llround(seconds);
    if (whole < kMinute) return tr("%1 s").arg(whole);
    if (whole < kHour) return tr("%1 min").arg((whole + kMinute / 2) / kMinute);
    const qint64 minutes = (whole % kHour) / kMinute;
    if (whole < kDay) return tr("%1 h %2 min").arg(whole / kHour).arg(minutes);
    return tr("%1 d %2 h").arg(whole / kDay).arg(whole % kDay / kHour);
}

QString roughDurationText(double seconds) {
    if (seconds < 10.0) return durationText(std::max(seconds, 1.0));
    if (seconds < 60.0) return durationText(std::min(std::round(seconds / 5.0) * 5.0, 55.0));
    if (seconds < 3600.0) return durationText(std::min(std::round(seconds / 60.0) * 60.0, 3540.0));
    return durationText(std::round(seconds / 600.0) * 600.0);
}

QString numberText(double value, int digits) {
    if (value == 0.0) return QLocale().toString(0);
    const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
    const int decimals = std::max(0, digits - before);
    QLocale locale;
    QString text = locale.toString(value, 'f', decimals);
    if (decimals == 0) return text;
    while (text.endsWith(locale.zeroDigit()))
        text.chop(1);
    if (text.endsWith(locale.decimalPoint())) text.chop(1);
    return text;
}

QString csvField(const QString& text) {
    return QString::fromStdString(base::csvField(text.toStdString()));
}

QString csvNumber(double value) {
    return QString::number(value, 'g', QLocale::FloatingPointShortest);
}

QString toText(const std::filesystem::path& path) {
    return QFile::decodeName(path.c_str());
}

QString pathText(const std::filesystem::path& path) {
    QString text = toText(path);
    const QString home = QDir::homePath();
    if (text.startsWith(home + '/')) text.replace(0, home.size(), "~");
    return text;
}

}  // namespace trapwright::look
