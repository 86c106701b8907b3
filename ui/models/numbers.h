#pragma once

#include <QString>
#include <QStringList>
#include <QVariant>
#include <optional>
#include <span>

#include "core/stats/binomial.h"

/// Numbers as the tables show them.
namespace trapwright::models {

/// With so many decimals; never "-0".
QString fixed(double value, int decimals);
/// "99.4", in percent; a dash without trials.
QString percent(int successes, int trials);
/// "98.7 … 99.8", in percent; a dash without trials.
QString boundsText(const stats::Interval& bounds, int trials);
/// In percent; nothing without trials.
QVariant percentValue(int successes, int trials);
/// The same of a share, if it is known.
QString percent(const std::optional<double>& share);
QVariant percentValue(const std::optional<double>& share);
/// Stable poses, counted from 1: "7", "1–6".
QString poseNumbers(std::span<const int> poses);
/// The same in words: "pose 7", "poses 1–6".
QString poseName(std::span<const int> poses);

/// "85.0", in percent; a dash where success is not known.
QString percent(const std::optional<stats::Count>& success);
/// "95 %", "99.6 %", or a dash: as short as it is exact.
QString successWord(const std::optional<stats::Count>& success);
QString successWord(const std::optional<double>& rate);
/// "85.0 % (62.1 … 96.8)", or a dash.
QString shareText(const std::optional<stats::Count>& success);
/// "62.1 … 96.8", in percent; a dash where success is not known.
QString boundsText(const std::optional<stats::Count>& success);
/// In percent; nothing where success is not known.
QVariant percentValue(const std::optional<stats::Count>& success);

/// What is said of bounds wherever they are shown: which interval they are.
QString boundsHelp();
/// Bounds in CSV: the titles of the low and the high one (`of`: "Success"), and the two in percent; without
/// trials nothing.
QStringList boundsTitles(const QString& of);
QVariantList boundsValues(const stats::Interval& bounds, int trials);
QVariantList boundsValues(const std::optional<stats::Count>& success);
/// "17 of 20 parts finished in the expected orientation; 95 % Clopper-Pearson 62.1 … 96.8 %", or why it is
/// not known.
QString successHelp(const std::optional<stats::Count>& success);

}  // namespace trapwright::models
