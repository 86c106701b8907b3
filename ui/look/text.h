#pragma once

#include <QString>
#include <filesystem>
#include <string_view>

namespace trapwright::look {

/// A duration as people say it: "8 s", "14 min", "2 h 5 min", "3 days 4 h". [s]
QString durationText(double seconds);

/// An estimate of a duration, no more exact than it is: "35 s", "8 min", "9 h 40 min". [s]
QString roughDurationText(double seconds);

/// A number with about this many significant digits, in the user's language, without trailing zeros.
QString numberText(double value, int digits = 3);

/// A field of a CSV line, with quotes if it needs them (RFC 4180), and a number in full with a decimal point.
QString csvField(const QString& text);
QString csvNumber(double value);

/// What the layers below write: UTF-8.
QString fromUtf8(std::string_view text);

/// A path for people: the home folder is "~".
QString pathText(const std::filesystem::path& path);
QString toText(const std::filesystem::path& path);

}  // namespace trapwright::look
