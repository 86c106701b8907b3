#include "ui/scene/scene_view.h"

#include <QAction>
#include <QApplication>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>

#include "core/track/track_builder.h"
#include "tests/ui/scene/scene_samples.h"
#include "ui/scene/orbit_cube.h"
#include "ui/scene/overlay.h"
#include "ui/scene/subject.h"
#include "ui/scene/surface_places.h"
#include "ui/scene/theme.h"

using namespace trapwright;
using scene::SceneView;

/// Runs twice: at one and at two pixels per logical pixel.
class SceneViewTest : public QObject {
    Q_OBJECT

    std::shared_ptr<const track::Track> cuboidTrack_ = samples::loadTrack("cuboid_track.json");
    std::shared_ptr<const track::Track> coneTrack_ = samples::loadTrack("cone_track.json");
    std::shared_ptr<const part::Part> cuboid_ = samples::loadPart("cuboid");
    std::unique_ptr<SceneView> view_;

    [[nodiscard]] QImage grab() const { return samples::grabSettled(*view_); }

    /// A pose on the track's surface.
    [[nodiscard]] base::Pose poseAt(double x) const {
        return {base::Quaternion::Identity(),
                scene::surfacePoint(*cuboidTrack_, x, 0.0) + 6e-3 * base::Vec3::UnitZ()};
    }

    [[nodiscard]] QPoint onScreen(const base::Vec3& point) const {
        return view_->camera().project(point, view_->size())->toPoint();
    }

 private slots:
    void init() {
        view_ = std::make_unique<SceneView>();
        view_->resize(640, 400);
        view_->show();
        QVERIFY(QTest::qWaitForWindowExposed(view_.get()));
    }

    void cleanup() { view_.reset(); }

    // What parts come by and leave by has its own name and length where it is there.
    void spansNameSpiralAndChute() {
        const auto names = [&](const track::Track& track) {
            QStringList told;
            for (const scene::SectionSpan& span : scene::sectionSpans(track, view_->camera()))
                told << QString("%1 %2").arg(span.name).arg(qRound(span.length * 1e3));
            return told;
        };
        track::TrackParameters parameters;
        const track::CrossSection section{50e-3, {{-0.03, 0.0}, {-0.01, 0.0}, {0.01, 0.0}, {0.03, 0.0}}};
        QCOMPARE(names(track::buildTrack(parameters, {{section}}).value()),
                 QStringList({"Lead-in 80", "Trap 50", "Lead-out 72"}));
        parameters.spiral.width = 20e-3;
        parameters.chute.length = 40e-3;
        QCOMPARE(names(track::buildTrack(parameters, {{section}}).value()),
                 QStringList({"Spiral 80", "Trap 50", "Lead-out 72", "Chute 40"}));
    }

    void trackIsDrawn() {
        const QImage empty = grab();
        QCOMPARE(empty.size(), QSize(640, 400) * view_->devicePixelRatioF());
        view_->showTrack(cuboidTrack_);
        const QImage shown = grab();
        const double changed = samples::shareChanged(empty, shown);
        QVERIFY2(changed > 0.15 && changed < 0.7, qPrintable(QString::number(changed)));
        // In the middle of the view lies the track, in its cool colour.
        const QColor middle = shown.pixelColor(shown.width() / 2, shown.height() / 2);
        QVERIFY(middle.blue() > middle.red());
        view_->clear();
        QVERIFY(samples::shareChanged(empty, grab()) < 1e-3);
    }

    void anotherTrackIsAnotherPicture() {
        view_->showTrack(cuboidTrack_);
        const QImage first = grab();
        view_->showTrack(coneTrack_);
        QVERIFY(samples::shareChanged(first, grab()) > 0.05);
        view_->showTrack(cuboidTrack_);
        QVERIFY(samples::shareChanged(first, grab()) < 0.002);
    }

    void marksAreDrawnInTheAccentColour() {
        const QColor accent = scene::SceneTheme::light().accent;
        view_->showTrack(cuboidTrack_, scene::TrackMarks::none());
        const double without = samples::shareOfHue(grab(), accent);
        view_->showTrack(cuboidTrack_);
        QVERIFY(samples::shareOfHue(grab(), accent) > without + 0.002);
    }

    void themeChangesTheLight() {
        view_->showTrack(cuboidTrack_);
        view_->setTheme(scene::SceneTheme::light());
        QVERIFY(samples::meanLightness(grab()) > 0.7);
        view_->setTheme(scene::SceneTheme::dark());
        QVERIFY(samples::meanLightness(grab()) < 0.35);
    }

    void partIsWhereItsPoseIs() {
        view_->showTrack(cuboidTrack_);
        const QColor warm = scene::SceneTheme::light().part;
        const double without = samples::shareOfHue(grab(), warm);  // the orbit cube's x axis
        for (const double x : {20e-3, 200e-3}) {
            view_->setParts({{cuboid_, poseAt(x)}});
            const QImage shown = grab();
            const QPoint place = onScreen(poseAt(x).position) * view_->devicePixelRatioF();
            const QColor there = shown.pixelColor(place);
            QVERIFY2(std::abs(there.hsvHue() - warm.hsvHue()) < 20, qPrintable(there.name()));
        }
        view_->setParts({});
        QVERIFY(std::abs(samples::shareOfHue(grab(), warm) - without) < 1e-4);
    }

    void ghostsHaveTheirColours() {
        view_->showTrack(cuboidTrack_);
        const QColor green(0x009e73);
        std::vector<scene::PartInScene> parts{
            {cuboid_, poseAt(20e-3)}, {cuboid_, poseAt(60e-3), {}, true}, {cuboid_, poseAt(90e-3), {}, true}};
        view_->setParts(parts);
        const double before = samples::shareOfHue(grab(), green);
        parts[1].colour = parts[2].colour = green;
        view_->setParts(parts);
        QVERIFY(samples::shareOfHue(grab(), green) > before + 5e-4);
    }

    // Each of its own kind and colour, all solid; those that are gone are not seen any more.
    void partsOfSeveralKinds() {
        view_->showTrack(cuboidTrack_);
        const QColor green(0x009e73);
        const QColor violet(0xaa00ff);
        const double noGreen = samples::shareOfHue(grab(), green);
        const double noViolet = samples::shareOfHue(grab(), violet);
        auto large = std::make_shared<part::Part>(*cuboid_);
        for (base::Vec3& vertex : large->mesh.vertices)
            vertex *= 2.0;
        view_->setParts({{cuboid_, poseAt(40e-3), green}, {large, poseAt(120e-3), violet}});
        const QImage both = grab();
        const double greenShare = samples::shareOfHue(both, green) - noGreen;
        const double violetShare = samples::shareOfHue(both, violet) - noViolet;
        QVERIFY(greenShare > 5e-4);
        QVERIFY2(violetShare > 2.5 * greenShare,
                 qPrintable(QString("%1 and %2").arg(greenShare).arg(violetShare)));
        view_->setParts({{large, poseAt(120e-3), violet}});
        const QImage one = grab();
        QVERIFY(std::abs(samples::shareOfHue(one, green) - noGreen) < 1e-4);
        QVERIFY(samples::shareOfHue(one, violet) - noViolet > 0.9 * violetShare);
    }

    void tracesContactsAndHighlightsAreDrawn() {
        view_->showTrack(cuboidTrack_, scene::TrackMarks::none());
        view_->setParts({{cuboid_, poseAt(50e-3)}});
        const QColor magenta(0xff00ff);
        QImage before = grab();
        scene::Trace trace{{}, magenta};
        for (int i = 0; i < 60; ++i)
            trace.points.push_back(poseAt(i * 1e-3).position);
        view_->setTraces({trace});
        QVERIFY(samples::shareOfHue(grab(), magenta) > 2e-4);
        view_->setTraces({});
        QVERIFY(samples::shareChanged(before, grab()) < 1e-4);

        view_->setContacts(std::vector<scene::ContactArrow>{{poseAt(50e-3).position, {0.0, 0.0, 0.1}}});
        QVERIFY(samples::shareChanged(before, grab()) > 2e-4);
        view_->setContacts({});

        // What was on a track is not on another.
        view_->setTraces({trace});
        view_->setContacts(std::vector<scene::ContactArrow>{{poseAt(50e-3).position, {0.0, 0.0, 0.1}}});
        view_->showTrack(std::make_shared<track::Track>(*cuboidTrack_), scene::TrackMarks::none());
        view_->setParts({{cuboid_, poseAt(50e-3)}});
        QVERIFY(view_->contents().traces.empty() && view_->contents().contacts.empty());

        // A region of the surface, a line on it, and one inside that is seen all the same.
        auto patch = std::make_shared<geometry::TriangleMesh>();
        patch->vertices = cuboidTrack_->solid.vertices;
        patch->triangles.assign(cuboidTrack_->solid.triangles.begin(),
                                cuboidTrack_->solid.triangles.begin() + 40);
        view_->setHighlights({{patch, {}, magenta}});
        QVERIFY(samples::shareOfHue(grab(), magenta) > 0.01);
        view_->setHighlights({});
        QVERIFY(samples::shareChanged(before, grab()) < 1e-4);
        const double inside = -0.5 * cuboidTrack_->baseThickness;
        const std::vector<base::Vec3> line = {{0.02, 0.0, inside}, {0.1, 0.0, inside}};
        view_->setHighlights({{nullptr, {line}, magenta}});
        QVERIFY(samples::shareOfHue(grab(), magenta) < 1e-5);
        view_->setHighlights({{nullptr, {line}, magenta, true}});
        QVERIFY(samples::shareOfHue(grab(), magenta) > 2e-4);
        view_->setHighlights({{nullptr, {trace.points}, magenta}});
        QVERIFY(samples::shareOfHue(grab(), magenta) > 2e-4);
        view_->setHighlights({});
    }

    void heightIsColoured() {
        view_->showTrack(cuboidTrack_);
        const QColor highest = scene::heightColour(1.0);
        const double before = samples::shareOfHue(grab(), highest);
        view_->setHeightShading(true);
        QVERIFY(samples::shareOfHue(grab(), highest) > before + 0.003);
        // The solid to be printed as well.
        view_->showSolid(std::make_shared<const geometry::TriangleMesh>(cuboidTrack_->solid));
        const double shaded = samples::shareOfHue(grab(), highest);
        view_->setHeightShading(false);
        QVERIFY(shaded > samples::shareOfHue(grab(), highest) + 0.003);
        // Where nothing has heights the switch cannot be used.
        const auto actions = view_->viewActions();
        const auto found = std::find_if(actions.begin(), actions.end(), [](const QAction* one) {
            return one->shortcut() == QKeySequence(Qt::Key_H);
        });
        QVERIFY(found != actions.end());
        const QAction* action = *found;
        QVERIFY(action->isEnabled());
        view_->showStablePoses(cuboid_);
        QVERIFY(!action->isEnabled());
    }

    void theHeightLegendCoversNoMark() {
        scene::SceneContents contents;
        contents.track = cuboidTrack_;
        contents.marks = {false, true, false, false};
        contents.heightShading = true;
        for (const double width : {260.0, 360.0, 480.0, 640.0, 900.0}) {
            const QSizeF screen(width, 420.0);
            const auto fitted = scene::fitted(scene::homeCamera(contents), scene::boxOf(contents), screen);
            const auto items = scene::overlayOf(contents, fitted, screen, std::nullopt);
            QCOMPARE(items.size(), 4U);  // legend, finish, scale bar, orbit cube
            QVERIFY(!items[0].area.intersects(items[1].area));
        }
    }

    void edgesAreDrawn() {
        view_->showTrack(cuboidTrack_);
        const QImage before = grab();
        view_->setEdges(true);
        const double changed = samples::shareChanged(before, grab());
        QVERIFY2(changed > 0.002 && changed < 0.1, qPrintable(QString::number(changed)));
    }

    void stablePosesStandSideBySide() {
        const QImage empty = grab();
        view_->showStablePoses(cuboid_);
        const QImage shown = grab();
        QVERIFY(samples::shareChanged(empty, shown) > 0.15);
        QVERIFY(samples::shareOfHue(shown, scene::SceneTheme::light().part) > 0.01);
        QVERIFY(!view_->contents().track);
    }

    void pictureIsTheViewAtAnySize() {
        view_->showTrack(cuboidTrack_);
        const double ratio = view_->devicePixelRatioF();
        const QImage same = view_->picture(QSize(640, 400) * ratio, ratio).result();
        QVERIFY2(samples::shareChanged(same, grab()) < 0.01,
                 qPrintable(QString::number(samples::shareChanged(same, grab()))));
        const QImage large = view_->picture({2560, 1600}, 4.0).result();
        QCOMPARE(large.size(), QSize(2560, 1600));
        QVERIFY(samples::shareChanged(
                    large.scaled(same.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation), same, 40) <
                0.02);
        QVERIFY(view_->picture({}).result().isNull());
    }

    void pictureNeedsNoWindow() {
        SceneView hidden;
        hidden.resize(640, 400);
        hidden.showTrack(cuboidTrack_);
        QVERIFY(samples::meanLightness(hidden.picture({320, 200}).result()) > 0.5);
    }

    /// The newest is shown in the end, whatever changed while a picture was being drawn.
    void settingWaitsForNoPicture() {
        view_->showTrack(cuboidTrack_);
        const QImage whole = grab();
        for (int i = 0; i < 20; ++i)
            QTest::keyClick(view_.get(), i % 2 == 0 ? Qt::Key_Right : Qt::Key_Left);
        QVERIFY(!view_->isSettled());
        QVERIFY(samples::shareChanged(whole, grab()) < 0.002);
    }

    void hiddenViewIsDrawnWhenItIsSeen() {
        const QImage empty = grab();
        view_->hide();
        view_->showTrack(cuboidTrack_);
        QTest::qWait(100);
        QVERIFY(!view_->isSettled());
        view_->show();
        QVERIFY(samples::shareChanged(empty, grab()) > 0.15);
    }

    void mouseTurnsMovesAndZooms() {
        view_->showTrack(cuboidTrack_);
        const scene::Camera before = view_->camera();
        QTest::mousePress(view_.get(), Qt::LeftButton, {}, {300, 200});
        QTest::mouseMove(view_.get(), {340, 210});
        QTest::mouseRelease(view_.get(), Qt::LeftButton, {}, {340, 210});
        const scene::Camera turned = view_->camera();
        QVERIFY(turned.azimuth != before.azimuth && turned.focus == before.focus);
        QTest::keyClick(view_.get(), Qt::Key_Right, Qt::ShiftModifier);
        QVERIFY(view_->camera().focus != turned.focus);
        QTest::keyClick(view_.get(), Qt::Key_Plus);
        QVERIFY(view_->camera().distance < turned.distance);
        // A new track does not take the view away from who chose it.
        const scene::Camera chosen = view_->camera();
        view_->showTrack(coneTrack_);
        QCOMPARE(view_->camera(), chosen);
        view_->fitView();
        QVERIFY(!(view_->camera() == chosen));
    }

    void orbitCubeChoosesTheView() {
        view_->showTrack(cuboidTrack_);
        const QPoint above = (scene::orbitCubeArea(view_->size()).center() - QPointF(0.0, 22.0)).toPoint();
        QTest::mouseClick(view_.get(), Qt::LeftButton, {}, above);
        QVERIFY((view_->camera().forward() + base::Vec3::UnitZ()).norm() < 1e-9);
    }

    void cameraFollowsThePart() {
        view_->showTrack(cuboidTrack_);
        view_->setParts({{cuboid_, poseAt(20e-3)}});
        view_->setFollow(true);
        const QPoint before = onScreen(poseAt(20e-3).position);
        view_->setParts({{cuboid_, poseAt(150e-3)}});
        QVERIFY((onScreen(poseAt(150e-3).position) - before).manhattanLength() <= 2);
    }

    void everyActionHasANameAndAShortcut() {
        QStringList shortcuts;
        for (const QAction* action : view_->viewActions()) {
            QVERIFY(!action->text().isEmpty());
            shortcuts << action->shortcut().toString();
            QVERIFY(!shortcuts.last().isEmpty());
        }
        QCOMPARE(shortcuts.removeDuplicates(), 0);
        QVERIFY(!view_->accessibleName().isEmpty());
    }
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    SceneViewTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "scene_view_test.moc"
