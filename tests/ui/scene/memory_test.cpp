#include <malloc.h>
#include <unistd.h>

#include <QApplication>
#include <QFile>
#include <QTest>

#include "core/track/track_builder.h"
#include "tests/ui/scene/scene_samples.h"
#include "ui/scene/picture_maker.h"
#include "ui/scene/scene_view.h"

using namespace trapwright;

namespace {

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TRAPWRIGHT_ADDRESS_SANITIZER
#endif
#endif
/// As the sanitizer of addresses does for a while, to tell of uses after that.
#ifdef TRAPWRIGHT_ADDRESS_SANITIZER
constexpr bool kKeepsWhatIsFreed = true;
#else
constexpr bool kKeepsWhatIsFreed = false;
#endif

}  // namespace

class SceneMemoryTest : public QObject {
    Q_OBJECT

    /// [MB]
    static double residentMemory() {
        malloc_trim(0);
        QFile file("/proc/self/statm");
        if (!file.open(QIODevice::ReadOnly)) return 0.0;
        return file.readAll().split(' ').at(1).toDouble() * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
    }

    /// A track of its own for every number.
    static std::shared_ptr<const track::Track> makeTrack(int number) {
        std::vector<track::CrossSection> trap;
        for (int section = 1; section <= 5; ++section) {
            track::CrossSection made{section * 30e-3, {}};
            for (int point = 0; point < 8; ++point)
                made.points.emplace_back(-26e-3 + point * 7.5e-3,
                                         15e-3 + 10e-3 * std::sin(number + 1.7 * section + 2.3 * point));
            trap.push_back(made);
        }
        return std::make_shared<const track::Track>(track::buildTrack({}, trap).value());
    }

 private slots:
    void twoHundredTracksLeaveNothingBehind() {
        scene::SceneView view;
        view.resize(320, 200);
        view.setEdges(true);
        view.show();
        QVERIFY(QTest::qWaitForWindowExposed(&view));
        scene::PictureMaker pictures;
        std::vector<std::weak_ptr<const track::Track>> shown;
        double settled = 0.0;
        for (int i = 0; i < 220; ++i) {
            const auto track = makeTrack(i);
            view.showTrack(track);
            QVERIFY(!samples::grabSettled(view).isNull());
            QVERIFY(!pictures.trackPicture(track, {160, 90}).result().isNull());
            shown.push_back(track);
            if (i == 19) settled = residentMemory();
        }
        const double grown = residentMemory() - settled;
        qInfo("resident memory after 20 tracks: %.1f MB, grown by %.1f MB in 200 more", settled, grown);
        QVERIFY(grown < 10.0 || kKeepsWhatIsFreed);
        for (std::size_t i = 0; i + 1 < shown.size(); ++i)
            QVERIFY(shown[i].expired());
    }

    void viewsComeAndGo() {
        const auto track = makeTrack(0);
        double settled = 0.0;
        for (int i = 0; i < 30; ++i) {
            scene::SceneView view;
            view.resize(320, 200);
            view.showTrack(track);
            view.show();
            QVERIFY(QTest::qWaitForWindowExposed(&view));
            QVERIFY(!samples::grabSettled(view).isNull());
            if (i == 9) settled = residentMemory();
        }
        const double grown = residentMemory() - settled;
        qInfo("resident memory after 10 views: %.1f MB, grown by %.1f MB in 20 more", settled, grown);
        QVERIFY(grown < 30.0);
    }
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    SceneMemoryTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "memory_test.moc"
