#include "core/study/field_text.h"

#include <QtTest>
#include <algorithm>

#include "core/study/presets.h"

using namespace trapwright;
using study::FieldInfo;

namespace {

FieldInfo find(const std::string& key) {
    const std::vector<FieldInfo> fields = study::listFields();
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&](const FieldInfo& f) { return f.key == key; });
    return field == fields.end() ? FieldInfo{} : *field;
}

}  // namespace

class FieldTextTest : public QObject {
    Q_OBJECT

 private slots:
    // What JSON writes is one line per setting: the same settings, told by another writer.
    void everySettingOfTheFileIsListed() {
        const std::string json = study::toJson({});
        for (const FieldInfo& field : study::listFields()) {
            const std::string last = field.key.substr(field.key.rfind('.') + 1);
            QVERIFY2(json.find('"' + last + '"') != std::string::npos, field.key.c_str());
        }
    }

    void copyingEveryFieldCopiesTheSettings() {
        study::Settings from = study::paperMode(study::presetSettings("cone").value());
        from.simulation.start.nearPose = base::Quaternion(0.5, -0.5, 0.5, 0.5);
        from.evolution.seed = 18446744073709551615ULL;
        from.simulation.drive.angle = 12.3 * base::kDegree;
        study::Settings to;
        for (const FieldInfo& field : study::listFields())
            QVERIFY(study::setField(to, field.key, study::fieldText(from, field.key)).ok());
        QVERIFY(to == from);
    }

    void textIsInPeoplesUnits() {
        study::Settings settings;
        settings.track.segmentWidth = 0.0605;
        settings.track.shape.type = track::FeederType::bowl;
        QCOMPARE(study::fieldText(settings, "track.segmentWidth_mm"), std::string("60.5"));
        QCOMPARE(study::fieldText(settings, "track.feeder"), std::string("bowl"));
        QCOMPARE(study::fieldText(settings, "simulation.drive.angle_deg"), std::string("12"));
        QCOMPARE(study::fieldText(settings, "evolution.simulateOverlapping"), std::string("false"));
        QCOMPARE(find("track.feeder").choices, (std::vector<std::string>{"linear", "bowl"}));
        QCOMPARE(find("track.segmentWidth_mm").high, 1000.0);
    }

    void unreadableTextChangesNothing_data() {
        QTest::addColumn<QString>("key");
        QTest::addColumn<QString>("text");
        QTest::newRow("no number") << "track.segmentWidth_mm"
                                   << "wide";
        QTest::newRow("empty") << "track.segmentWidth_mm"
                               << "";
        QTest::newRow("two numbers") << "track.segmentWidth_mm"
                                     << "1 2";
        QTest::newRow("no whole number") << "track.crossSections"
                                         << "2.5";
        QTest::newRow("more than fits") << "track.crossSections"
                                        << "99999999999";
        QTest::newRow("negative seed") << "evolution.seed"
                                       << "-1";
        QTest::newRow("no such choice") << "track.feeder"
                                        << "belt";
        QTest::newRow("no flag") << "evolution.simulateOverlapping"
                                 << "yes";
        QTest::newRow("three of four") << "simulation.start.nearPose"
                                       << "1 0 0";
    }
    void unreadableTextChangesNothing() {
        QFETCH(QString, key);
        QFETCH(QString, text);
        study::Settings settings;
        const base::Status status = study::setField(settings, key.toStdString(), text.toStdString());
        QVERIFY(!status.ok());
        QVERIFY(status.error().message.find(key.toStdString()) != std::string::npos);
        QVERIFY(settings == study::Settings{});
    }

    // A form shows what is out of range where it is; it has to get into the settings for that.
    void rangesAreNotLookedAt() {
        study::Settings settings;
        QVERIFY(study::setField(settings, "track.segmentWidth_mm", "-5").ok());
        QVERIFY(!study::findProblems(settings).empty());
    }
};

QTEST_APPLESS_MAIN(FieldTextTest)
#include "field_text_test.moc"
