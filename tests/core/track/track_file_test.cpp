#include "core/track/track_file.h"

#include <QTemporaryDir>
#include <QtTest>

#include "core/base/file.h"
#include "track_scenes.h"

using namespace trapwright;

namespace {

const std::filesystem::path kScene =
    std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/tracks/cuboid_track.json";

}  // namespace

class TrackFileTest : public QObject {
    Q_OBJECT

 private slots:
    void readsTheLearnedTrack() {
        const auto file = track::readTrackFile(kScene);
        QVERIFY2(file.ok(), file.ok() ? "" : file.error().message.c_str());
        const track::Track& track = file->track;
        QVERIFY(file->about.find("Linear track learned") == 0);
        QCOMPARE(track.sections.size(), std::size_t{9});
        QCOMPARE(track.begin(), -20e-3);
        QCOMPARE(track.sections[1].x, 60e-3);
        QCOMPARE(track.sections[0].points, track.sections[1].points);
        QCOMPARE(track.lastTrapSection, 6);
        QCOMPARE(track.start, 40e-3);
        QCOMPARE(track.finish, 265.31e-3);
        QCOMPARE(track.end(), 273.31e-3);
        QCOMPARE(track.sections[4].points[2], base::Vec2(-8.89e-3, 12.17e-3));
        QCOMPARE(track.surfaceTriangles, std::size_t{8 * 7 * 2});
        const auto& q = *file->expectedOrientation;
        QVERIFY(std::abs(q.w() + 0.656) < 1e-3 && std::abs(q.z() - 0.264) < 1e-3);
        QVERIFY(std::abs(q.norm() - 1.0) < 1e-15);
        // The base is 3 mm thick and the last section the highest.
        const auto box = geometry::calcBoundingBox(track.solid);
        QCOMPARE(box.low.z(), -3e-3);
        QCOMPARE(box.high.z(), 29.44e-3);
    }

    void roundTrip_data() {
        QTest::addColumn<int>("shape");
        QTest::newRow("linear") << 0;
        QTest::newRow("clockwise") << 1;
        QTest::newRow("anticlockwise") << 2;
        QTest::newRow("linear, climbs") << 3;
        QTest::newRow("anticlockwise, falls") << 4;
    }
    void roundTrip() {
        QFETCH(int, shape);
        track::TrackParameters parameters;
        if (shape == 1) parameters.shape = testing::makeBowl(track::Conveying::clockwise);
        if (shape == 2) parameters.shape = testing::makeBowl(track::Conveying::anticlockwise);
        if (shape == 3) parameters.shape.slope = 3.3 * base::kDegree;
        if (shape == 4) parameters.shape = testing::makeBowl(track::Conveying::anticlockwise, -0.05);
        if (shape == 2) parameters.walls = {0.0, 12.5e-3};
        if (shape == 4) parameters.walls = {3e-3, 20e-3};
        if (shape == 0) parameters.spiral.width = 20e-3;
        if (shape == 1) parameters.chute.length = 40e-3;
        auto built = track::buildTrack(parameters, testing::drawTrap({}, 4));
        QVERIFY(built.ok());
        const track::TrackFile file{"drawn at random", *built, std::nullopt};
        QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("track.json").toStdString();
        QVERIFY(track::writeTrackFile(path, file).ok());
        const auto again = track::readTrackFile(path);
        QVERIFY2(again.ok(), again.ok() ? "" : again.error().message.c_str());
        QCOMPARE(again->about, file.about);
        QVERIFY(!again->expectedOrientation);
        QCOMPARE(again->track.firstTrapSection, built->firstTrapSection);
        QCOMPARE(again->track.lastTrapSection, built->lastTrapSection);
        QCOMPARE(again->track.solid.triangles, built->solid.triangles);
        QVERIFY(std::abs(again->track.finish - built->finish) < 1e-14);
        QVERIFY(std::abs(again->track.shape.slope - parameters.shape.slope) < 1e-14);
        QCOMPARE(track::trackToJson(file).find("slope") != std::string::npos, shape >= 3);
        QVERIFY(std::abs(again->track.walls.inner - parameters.walls.inner) < 1e-14);
        QVERIFY(std::abs(again->track.walls.outer - parameters.walls.outer) < 1e-14);
        QCOMPARE(track::trackToJson(file).find("Wall") != std::string::npos, parameters.walls.any());
        QVERIFY(std::abs(track::spiralOf(again->track).width - parameters.spiral.width) < 1e-14);
        QVERIFY(std::abs(track::chuteOf(again->track).length - parameters.chute.length) < 1e-14);
        for (std::size_t i = 0; i < built->solid.vertices.size(); ++i) {
            QVERIFY((again->track.solid.vertices[i] - built->solid.vertices[i]).norm() < 1e-14);
        }
        // What was read writes the same text.
        QCOMPARE(track::trackToJson(*again), track::trackToJson(file));
    }

    void refuses_data() {
        QTest::addColumn<QByteArray>("from");
        QTest::addColumn<QByteArray>("to");
        QTest::addColumn<QByteArray>("named");
        QTest::newRow("not JSON") << QByteArray("{") << QByteArray("") << QByteArray("not JSON");
        QTest::newRow("other format")
            << QByteArray("trapwright track") << QByteArray("something") << QByteArray("\"format\"");
        QTest::newRow("newer version")
            << QByteArray("\"version\": 1") << QByteArray("\"version\": 2") << QByteArray("version");
        QTest::newRow("other unit") << QByteArray("\"mm\"") << QByteArray("\"inch\"")
                                    << QByteArray("\"unit\"");
        QTest::newRow("no start") << QByteArray("\"start\"") << QByteArray("\"strat\"")
                                  << QByteArray("\"start\" is missing");
        QTest::newRow("text for a number")
            << QByteArray("\"finish\": 265.31") << QByteArray("\"finish\": \"far\"")
            << QByteArray("\"finish\" is not a number");
        QTest::newRow("finish beyond the end")
            << QByteArray("\"finish\": 265.31") << QByteArray("\"finish\": 365.31")
            << QByteArray("\"finish\"");
        QTest::newRow("sections out of order")
            << QByteArray("125.68") << QByteArray("25.68") << QByteArray("section 3 is not beyond");
        QTest::newRow("a point of one number")
            << QByteArray("-23.57,") << QByteArray("") << QByteArray("point 1 of section 2");
        QTest::newRow("too many lead-out segments")
            << QByteArray("\"leadOutSegments\": 2") << QByteArray("\"leadOutSegments\": 7")
            << QByteArray("leadOutSegments");
        QTest::newRow("no feeder type")
            << QByteArray("\"linear\"") << QByteArray("\"spiral\"") << QByteArray("spiral");
        QTest::newRow("a wall below nothing")
            << QByteArray("\"start\":") << QByteArray("\"innerWall\": -2, \"start\":")
            << QByteArray("inner wall is -2 mm high");
        QTest::newRow("too steep") << QByteArray("\"linear\"") << QByteArray("\"linear\", \"slope_deg\": 16")
                                   << QByteArray("slope is 16 deg");
        QTest::newRow("an array") << QByteArray("{") << QByteArray("[{") << QByteArray("not JSON");
    }
    void refuses() {
        QFETCH(QByteArray, from);
        QFETCH(QByteArray, to);
        QFETCH(QByteArray, named);
        std::string text = *base::readFile(kScene);
        const auto place = text.find(from.toStdString());
        QVERIFY(place != std::string::npos);
        text.replace(place, static_cast<std::size_t>(from.size()), to.toStdString());
        const auto file = track::trackFromJson(text);
        QVERIFY(!file.ok());
        QVERIFY2(file.error().message.find(named.toStdString()) != std::string::npos,
                 file.error().message.c_str());
    }

    void refusesOtherJson_data() {
        QTest::addColumn<QByteArray>("text");
        for (const char* text : {"", "[]", "3", "null", "{}", "{\"sections\": 3}", "{\"sections\": [3]}"}) {
            QTest::newRow(text) << QByteArray(text);
        }
    }
    void refusesOtherJson() {
        QFETCH(QByteArray, text);
        QVERIFY(!track::trackFromJson(text.toStdString()).ok());
    }

    void namesAMissingFile() {
        const auto file = track::readTrackFile("/nowhere/track.json");
        QVERIFY(!file.ok());
        QVERIFY(file.error().message.find("/nowhere/track.json") != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(TrackFileTest)
#include "track_file_test.moc"
