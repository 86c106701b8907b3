#include "ui/scene/light_map.h"

#include <QTest>

#include "core/track/track_builder.h"
#include "tests/ui/scene/scene_samples.h"

using namespace trapwright;
using base::Vec2;

/// A valley across the track has little light, a plain all of it.
class LightMapTest : public QObject {
    Q_OBJECT

    static track::Track makeTrack(const std::vector<Vec2>& points, track::FeederType type) {
        track::TrackParameters parameters;
        parameters.shape.type = type;
        const std::vector<track::CrossSection> trap = {{40e-3, points}, {80e-3, points}};
        return track::buildTrack(parameters, trap).value();
    }

    static int skyAt(const scene::LightMap& map, double alongShare, double acrossShare) {
        const int column = std::min(map.columns - 1, static_cast<int>(alongShare * map.columns));
        const int row = std::min(map.rows - 1, static_cast<int>(acrossShare * map.rows));
        return map.values[2 * (static_cast<std::size_t>(row) * map.columns + column)];
    }

    static void addFeeders() {
        QTest::addColumn<track::FeederType>("type");
        QTest::newRow("linear") << track::FeederType::linear;
        QTest::newRow("bowl") << track::FeederType::bowl;
    }

 private slots:
    void plainSeesTheWholeSky_data() { addFeeders(); }

    void plainSeesTheWholeSky() {
        QFETCH(track::FeederType, type);
        const scene::LightMap map = scene::calcLightMap(makeTrack({{-30e-3, 15e-3}, {30e-3, 15e-3}}, type));
        for (const std::uint8_t value : map.values)
            QCOMPARE(int(value), 255);
    }

    void valleySeesLess_data() { addFeeders(); }

    void valleySeesLess() {
        QFETCH(track::FeederType, type);
        // Two walls of 45 degrees: at the bottom the horizon is at 45 degrees to both sides.
        const scene::LightMap map =
            scene::calcLightMap(makeTrack({{-30e-3, 30e-3}, {0.0, 0.0}, {30e-3, 30e-3}}, type));
        const int bottom = skyAt(map, 0.75, 0.5);
        // Twelve directions at 15, 45, 75 ... degrees: a rise of |sin| in each, so sin^2 / (1 + sin^2) is
        // lost.
        double lost = 0.0;
        for (const double angle : {15.0, 45.0, 75.0}) {
            const double rise = std::sin(angle * base::kDegree);
            lost += rise * rise / (1.0 + rise * rise) / 3.0;
        }
        QVERIFY2(std::abs(bottom / 255.0 - (1.0 - lost)) < 0.06, qPrintable(QString::number(bottom)));
        QVERIFY(skyAt(map, 0.75, 0.03) > bottom + 20);
    }

    void wallThrowsAShadow() {
        // The light comes from behind and from outside, so a ridge across the track shades what follows it.
        track::TrackParameters parameters;
        const std::vector<Vec2> low = {{-30e-3, 0.0}, {30e-3, 0.0}};
        const std::vector<Vec2> high = {{-30e-3, 30e-3}, {30e-3, 30e-3}};
        const std::vector<track::CrossSection> trap = {{20e-3, high}, {22e-3, low}, {60e-3, low}};
        const track::Track track = track::buildTrack(parameters, trap).value();
        const scene::LightMap map = scene::calcLightMap(track);
        const auto keyAt = [&](double x) {
            const double share = (x - track.begin()) / (track.end() - track.begin());
            const auto column = static_cast<std::size_t>(share * map.columns);
            return int(map.values[2 * (static_cast<std::size_t>(map.rows / 2) * map.columns + column) + 1]);
        };
        QVERIFY(keyAt(80e-3 + 30e-3) < 40);
        QVERIFY(keyAt(track.end() - 5e-3) > 240);
        QVERIFY(keyAt(20e-3) > 240);
    }
};

QTEST_APPLESS_MAIN(LightMapTest)
#include "light_map_test.moc"
