#include <fmt/format.h>

#include <QtTest>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/random.h"
#include "core/study/field_text.h"
#include "core/study/number_text.h"
#include "core/study/presets.h"
#include "core/study/settings.h"

using namespace trapwright;
using study::FileUnit;
using study::Settings;

namespace {

/// Every field away from its default.
Settings unusualSettings() {
    Settings s;
    s.part = {"/parts/a \"quoted\" näme.step",
              "inch",
              7850.5,
              0.0123456789012345678,
              part::SymmetryUse::none,
              "brass \\ zinc",
              study::PoseWeights::dropped,
              "129, 48, 23"};
    s.track.shape = {track::FeederType::bowl, 0.1 + 0.2, track::Conveying::anticlockwise, 0.05};
    s.track.walls = {1.0 / 300.0, 0.0123};
    s.track.spiral = {0.02 / 3.0, 0.01 / 3.0, 7.7 * base::kDegree};
    s.track.chute = {0.1 / 3.0, 22.2 * base::kDegree};
    s.track.traps = "step, free-form";
    s.track.given = "10.5: -30 1, 30 2";
    s.track.returns = trial::Returns::outerSide;
    s.track.crossSections = 7;
    s.track.pointsPerSection = 11;
    s.track.minSegmentLength = 1.0 / 3.0;
    s.track.maxSegmentLength = std::nextafter(36e-3, 1.0);
    s.track.segmentWidth = 0.05999999999999999;
    s.track.segmentHeight = 2.0 / 70.0;
    s.track.leadInLength = 0.0811;
    s.track.startFromLeadInEnd = 0.0212;
    s.track.leadOutSegments = 3;
    s.track.baseThickness = 0.0031;
    s.track.encoding = study::PointEncoding::free;
    s.evolution = {search::Method::random,
                   31,
                   17,
                   5,
                   0.1 / 3.0,
                   0.7,
                   1e-7,
                   search::ga::StrategyScope::gene,
                   search::ga::FirstGeneration::random,
                   777,
                   "success, F_C",
                   "F_C, success",
                   study::TrialConditions::nominal,
                   0.1 / 0.7,
                   23,
                   trial::OrientationDistance::plain,
                   true,
                   4,
                   1.0 / 3.0,
                   true,
                   0.2 / 3.0,
                   5,
                   0.7,
                   0.7e-3 / 3.0,
                   12,
                   0xFFFFFFFFFFFFFFFFULL};
    s.simulation.drive = {60.25, 0.7e-3 / 9.0, 13.7 * base::kDegree};
    s.simulation.contact = {0.6, 0.55, 0.21};
    s.simulation.surface = "PLA, printed";
    s.simulation.termination = {11.5, 1.25, 1.5e-3};
    s.simulation.start.nearPose = base::Quaternion(0.5, -0.5, 0.1 + 0.2, std::sqrt(0.5));
    s.simulation.start.tilt = 2.5 * base::kDegree;
    s.simulation.start.lateral = 1.7e-3;
    s.simulation.gravity = 9.81;
    s.simulation.engine = "native";
    s.box = {trial::BoxDistribution::normal,
             0.15,
             0.25,
             0.1 / 3.0,
             0.01 / 3.0,
             1.3 * base::kDegree,
             0.7e-4,
             0.13e-3,
             1e-4 / 3.0,
             1.5e-3,
             0.05,
             5.0 * base::kDegree};
    s.target = {"3, 5-6", "12.5", base::Quaternion(0.1 + 0.2, 0.5, -1.0 / 3.0, 0.5), true};
    s.stream = {77.7, study::Arrivals::regular, study::Delivery::anyhow, 1.0 / 7.0, 20.0 / 3.0,
                5,    {0.35, 0.3, 0.1}};
    s.validation = {30, 2000, 320, 500, 24.9 * base::kDegree, study::TrialConditions::nominal};
    s.feeder = {1.0 / 7.0, 2.5};
    return s;
}

}  // namespace

class SettingsJsonTest : public QObject {
    Q_OBJECT

 private slots:
    void roundTripIsExact_data() {
        QTest::addColumn<int>("which");
        QTest::newRow("defaults") << 0;
        QTest::newRow("unusual") << 1;
        QTest::newRow("cone as in the paper") << 2;
    }
    void roundTripIsExact() {
        QFETCH(int, which);
        const Settings settings = which == 0   ? Settings{}
                                  : which == 1 ? unusualSettings()
                                               : study::paperMode(study::presetSettings("cone").value());
        // Read over a base that differs everywhere, so that a field that is not written shows.
        const Settings other = which == 1 ? Settings{} : unusualSettings();
        const auto back = study::settingsFromJson(study::toJson(settings), other);
        QVERIFY2(back.ok(), back.ok() ? "" : back.error().message.c_str());
        QVERIFY(*back == settings);
        QCOMPARE(study::toJson(*back), study::toJson(settings));
    }

    void everyFieldTakesPartInEquality() {
        // Reading one changed line must make the settings unequal.
        const std::string json = study::toJson(unusualSettings());
        const QStringList lines = QString::fromStdString(study::toJson(Settings{})).split('\n');
        const QStringList unusual = QString::fromStdString(json).split('\n');
        QCOMPARE(lines.size(), unusual.size());
        for (qsizetype i = 0; i < lines.size(); ++i) {
            if (!lines[i].contains(':') || lines[i].endsWith('{')) continue;
            QVERIFY2(lines[i] != unusual[i], qPrintable("not away from its default: " + lines[i]));
            QStringList changed = lines;
            changed[i] = unusual[i];
            if (!lines[i].endsWith(',')) changed[i].remove(',');
            const auto back = study::settingsFromJson(changed.join('\n').toStdString(), Settings{});
            QVERIFY2(back.ok(), back.ok() ? "" : back.error().message.c_str());
            QVERIFY2(!(*back == Settings{}), qPrintable(lines[i]));
        }
    }

    void lengthsSurviveToTheLastBit() {
        base::Random random({.seed = 5});
        for (int i = 0; i < 20000; ++i) {
            const std::uint64_t bits = (std::uint64_t{random.bits32()} << 32U) | random.bits32();
            const auto value = std::bit_cast<double>(bits);
            if (!std::isfinite(value) || std::abs(value) > 1e300) continue;
            for (const FileUnit unit : {FileUnit::none, FileUnit::millimetre}) {
                const auto back = study::siValue(study::fileText(value, unit), unit);
                QVERIFY(back.has_value());
                QCOMPARE(std::bit_cast<std::uint64_t>(*back), bits);
            }
        }
    }

    void anglesEnteredInDegreesSurviveToTheLastBit() {
        base::Random random({.seed = 6});
        for (int i = 0; i < 20000; ++i) {
            const double degrees =
                i < 10000 ? random.uniform(0.0, 180.0) : std::round(random.uniform(0.0, 1800.0)) / 10.0;
            const double value = degrees * base::kDegree;
            QCOMPARE(*study::siValue(study::fileText(value, FileUnit::degree), FileUnit::degree), value);
        }
    }

    void textIsWhatAPersonWouldWrite_data() {
        QTest::addColumn<double>("value");
        QTest::addColumn<int>("unit");
        QTest::addColumn<QString>("text");
        QTest::newRow("36 mm") << 36e-3 << 1 << "36";
        QTest::newRow("0.8 mm") << 0.8e-3 << 1 << "0.8";
        QTest::newRow("175 mm") << 0.175 << 1 << "175";
        QTest::newRow("1200 mm") << 1.2 << 1 << "1200";
        QTest::newRow("-1 mm") << -1e-3 << 1 << "-1";
        QTest::newRow("0 mm") << 0.0 << 1 << "0";
        QTest::newRow("12 degrees") << 12.0 * base::kDegree << 2 << "12";
        QTest::newRow("0 degrees") << 0.0 << 2 << "0";
        QTest::newRow("-0") << -0.0 << 0 << "0";
        QTest::newRow("25 degrees") << 25.0 * base::kDegree << 2 << "25";
        QTest::newRow("0.002") << 0.002 << 0 << "0.002";
        QTest::newRow("tiny") << 1.5e-9 << 0 << "1.5e-9";
        QTest::newRow("huge") << 1e20 << 0 << "1e20";
        QTest::newRow("9.80665") << 9.80665 << 0 << "9.80665";
    }
    void textIsWhatAPersonWouldWrite() {
        QFETCH(double, value);
        QFETCH(int, unit);
        QFETCH(QString, text);
        QCOMPARE(QString::fromStdString(study::fileText(value, static_cast<FileUnit>(unit))), text);
        QCOMPARE(*study::siValue(text.toStdString(), static_cast<FileUnit>(unit)), value);
    }

    void leftOutKeysKeepTheBase() {
        const auto back = study::settingsFromJson(R"({"track": {"segmentWidth_mm": 5e1}, "evolution": {}})",
                                                  unusualSettings());
        QVERIFY(back.ok());
        Settings expected = unusualSettings();
        expected.track.segmentWidth = 0.05;
        QVERIFY(*back == expected);
    }

    void unreadableTextIsRefused_data() {
        QTest::addColumn<QString>("json");
        QTest::addColumn<QString>("named");
        QTest::newRow("unknown key") << R"({"track": {"segmentwidth_mm": 5}})"
                                     << "\"track.segmentwidth_mm\"";
        QTest::newRow("unknown section") << R"({"trak": {"segmentWidth_mm": 5}})"
                                         << "\"trak.segmentWidth_mm\"";
        QTest::newRow("key one level up") << R"({"segmentWidth_mm": 5})"
                                          << "\"segmentWidth_mm\"";
        QTest::newRow("section is a number") << R"({"track": 5})"
                                             << "\"track\"";
        QTest::newRow("number is an object") << R"({"track": {"segmentWidth_mm": {"value": 5}}})"
                                             << "\"track.segmentWidth_mm.value\"";
        QTest::newRow("text for number") << R"({"track": {"segmentWidth_mm": "60"}})"
                                         << "\"track.segmentWidth_mm\" is \"60\"";
        QTest::newRow("null for number") << R"({"track": {"segmentWidth_mm": null}})"
                                         << "\"track.segmentWidth_mm\" is null";
        QTest::newRow("real for count") << R"({"evolution": {"populationSize": 10.5}})"
                                        << "\"evolution.populationSize\" is 10.5";
        QTest::newRow("count too large") << R"({"evolution": {"populationSize": 99999999999}})"
                                         << "2147483647";
        QTest::newRow("negative seed") << R"({"evolution": {"seed": -1}})"
                                       << "\"evolution.seed\" is -1";
        QTest::newRow("number for flag") << R"({"evolution": {"simulateOverlapping": 1}})"
                                         << "true or false";
        QTest::newRow("unknown choice") << R"({"track": {"feeder": "spiral"}})"
                                        << "\"linear\" or \"bowl\"";
        QTest::newRow("number for text") << R"({"part": {"file": 3}})"
                                         << "\"part.file\" is 3";
        QTest::newRow("short rotation") << R"({"simulation": {"start": {"nearPose": [1, 0, 0]}}})"
                                        << "[w, x, y, z]";
        QTest::newRow("long rotation") << R"({"simulation": {"start": {"nearPose": [1, 0, 0, 0, 0]}}})"
                                       << "nearPose[4]";
        QTest::newRow("key twice") << R"({"part": {"file": "a", "file": "b"}})"
                                   << "\"part.file\" is there twice";
        QTest::newRow("empty") << ""
                               << "not JSON";
        QTest::newRow("cut off") << R"({"part": {"file": "a")"
                                 << "not JSON";
        QTest::newRow("a list") << "[]"
                                << "not a JSON object";
        QTest::newRow("a number") << "5"
                                  << "not a JSON object";
        QTest::newRow("number overflows") << R"({"track": {"segmentWidth_mm": 1e999}})"
                                          << "not JSON";
        QTest::newRow("deep nesting") << QString(100000, '[').prepend("{\"a\":") << "nested too deeply";
        QTest::newRow("control character") << QString("{\"part\": {\"file\": \"\x01\"}}") << "not JSON";
    }
    // Nobody types seven digits.
    void aRotationMayBeRounded() {
        for (const auto& [numbers, length] :
             {std::pair("0.7071, 0, 0.7071, 0", 1.0), std::pair("-0.71, 0.71, 0, 0", 1.0),
              std::pair("1, 0, 0, 0", 1.0), std::pair("0.5, 0, 0, 0", 0.5)}) {
            const auto read =
                study::settingsFromJson(fmt::format(R"({{"target": {{"orientation": [{}]}}}})", numbers), {});
            QVERIFY(read.ok() && read->target.orientation);
            QVERIFY(std::abs(read->target.orientation->norm() - length) < 1e-15);
        }
        Settings typed;
        QVERIFY(study::setField(typed, "target.orientation", "0.7071 0 0 0.7071").ok());
        QVERIFY(std::abs(typed.target.orientation->norm() - 1.0) < 1e-15);
    }

    void unreadableTextIsRefused() {
        QFETCH(QString, json);
        QFETCH(QString, named);
        const auto back = study::settingsFromJson(json.toStdString(), Settings{});
        QVERIFY(!back.ok());
        QVERIFY2(QString::fromStdString(back.error().message).contains(named), back.error().message.c_str());
    }
};

QTEST_APPLESS_MAIN(SettingsJsonTest)
#include "settings_json_test.moc"
