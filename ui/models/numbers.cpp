#include "ui/models/numbers.h"

#include <QCoreApplication>
#include <cmath>

#include "core/part/stable_poses.h"

namespace trapwright::models {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(Numbers)
};

constexpr double kPercent = 100.0;
constexpr double kRounding = 1e-9;
const QString kNothing = QStringLiteral("–");

QString percentOf(double share) {
    return fixed(kPercent * share, stats::countPercentDecimals(share));
}

}  // namespace

QString fixed(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    // A small negative number would be written as -0.
    const double shown = std::abs(value) * scale < 0.5 ? 0.0 : value;
    return QString::number(shown, 'f', decimals);
}

QString percent(int successes, int trials) {
    if (trials == 0) return kNothing;
    return percentOf(static_cast<double>(successes) / trials);
}

QString boundsText(const stats::Interval& bounds, int trials) {
    if (trials == 0) return kNothing;
    return QStringLiteral("%1 … %2").arg(fixed(kPercent * bounds.low, 1), fixed(kPercent * bounds.high, 1));
}

QVariant percentValue(int successes, int trials) {
    if (trials == 0) return {};
    return kPercent * successes / trials;
}

QString percent(const std::optional<stats::Count>& success) {
    return success ? percent(success->successes, success->trials) : kNothing;
}

QString boundsText(const std::optional<stats::Count>& success) {
    if (!success) return kNothing;
    return boundsText(stats::calcClopperPearson(success->successes, success->trials), success->trials);
}

QString successWord(const std::optional<stats::Count>& success) {
    return successWord(success ? std::optional(success->share()) : std::nullopt);
}

QString successWord(const std::optional<double>& rate) {
    if (!rate) return kNothing;
    // 99.96 % must not look like 100 %, but 95 % need not be 95.0 %.
    const double shown = kPercent * *rate;
    const bool whole = std::abs(shown - std::round(shown)) < kRounding;
    return Text::tr("%1 %").arg(whole ? fixed(shown, 0) : percentOf(*rate));
}

QString shareText(const std::optional<stats::Count>& success) {
    return success ? Text::tr("%1 % (%2)").arg(percent(success), boundsText(success)) : kNothing;
}

QVariant percentValue(const std::optional<stats::Count>& success) {
    return success ? percentValue(success->successes, success->trials) : QVariant();
}

QString boundsHelp() {
    return Text::tr("95 % Clopper-Pearson: where the true rate is with 95 % confidence.");
}

QStringList boundsTitles(const QString& of) {
    return {Text::tr("%1, 95 % Clopper-Pearson low [%]").arg(of),
            Text::tr("%1, 95 % Clopper-Pearson high [%]").arg(of)};
}

QVariantList boundsValues(const stats::Interval& bounds, int trials) {
    if (trials == 0) return {QVariant(), QVariant()};
    return {kPercent * bounds.low, kPercent * bounds.high};
}

QVariantList boundsValues(const std::optional<stats::Count>& success) {
    if (!success) return {QVariant(), QVariant()};
    return boundsValues(stats::calcClopperPearson(success->successes, success->trials), success->trials);
}

QString successHelp(const std::optional<stats::Count>& success) {
    if (!success)
        return Text::tr(
            "Not known: the track was not simulated, or learned by a program that did not count it.");
    return Text::tr("%1 of %2 parts finished in the expected orientation; 95 % Clopper-Pearson %3 %")
        .arg(success->successes)
        .arg(success->trials)
        .arg(boundsText(success));
}

QString percent(const std::optional<double>& share) {
    return share ? percentOf(*share) : kNothing;
}

QVariant percentValue(const std::optional<double>& share) {
    return share ? QVariant(kPercent * *share) : QVariant();
}

QString poseNumbers(std::span<const int> poses) {
    return QString::fromStdString(part::namePoses(poses)).replace(u'-', u'–');
}

QString poseName(std::span<const int> poses) {
    const QString text = poses.size() > 1 ? QCoreApplication::translate("Poses", "poses %1")
                                          : QCoreApplication::translate("Poses", "pose %1");
    return text.arg(poseNumbers(poses));
}

}  // namespace trapwright::models
