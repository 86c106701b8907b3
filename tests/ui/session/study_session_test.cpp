#include <QtTest>

#include "core/study/track_design.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/study_curves.h"
#include "ui/session/study_design.h"
#include "ui/session/study_opening.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::session;

/// A study that is open: what it holds, and how settings and part change.
class StudySessionTest : public QObject {
    Q_OBJECT

 private slots:
    void init() { fixture_ = std::make_unique<SessionFixture>(); }

    void newStudyHoldsWhatItWasMadeOf() {
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        QCOMPARE(session->runs().state(), RunState::idle);
        QVERIFY(session->design().settings().part == cuboid().settings);
        QCOMPARE(session->design().part()->symmetry.name, std::string("D2"));
        QVERIFY(session->design().problems().empty() && !session->design().locked());
        QVERIFY(session->runs().summaries().empty() && session->runs().winners().empty());
        // For D2 a perfect feeder scores less than for a part without symmetry, whose best is pi / 2 + 2 /
        // pi.
        QCOMPARE(session->design().attainable()[2].key, std::string("F_O"));
        QVERIFY(session->design().attainable()[2].value > 0.5 &&
                session->design().attainable()[2].value < 2.3);
    }

    void refusesPathsThatCannotBe() {
        const auto first = fixture_->create("a.trap", smallSettings());
        QVERIFY(first);
        const auto again = StudySession::create(fixture_->path("a.trap"), smallSettings(), cuboid(),
                                                fixture_->environment());
        QVERIFY(!again.ok() && fake::messageOf(again).contains("exists"));
        // One window at a time.
        const auto opened = StudySession::open(fixture_->path("a.trap"), fixture_->environment());
        QVERIFY(!opened.ok() && fake::messageOf(opened).contains("a.trap"));
        QVERIFY(!StudySession::open(fixture_->path("none.trap"), fixture_->environment()).ok());
        store::StoredPart flat = cuboid().stored;
        flat.mesh.triangles.resize(2);
        QVERIFY(
            !StudySession::create(fixture_->path("b.trap"), smallSettings(), flat, fixture_->environment())
                 .ok());
        QVERIFY(!std::filesystem::exists(fixture_->path("b.trap")));
    }

    void changesAreUndoneAndSaved() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        QSignalSpy changed(&session->design(), &StudyDesign::settingsChanged);
        const study::Settings before = session->design().settings();
        study::Settings wide = before;
        wide.track.segmentWidth = 50e-3;
        session->design().changeSettings(wide, "Segment width");
        study::Settings steep = wide;
        steep.simulation.drive.angle = 20.0 * base::kDegree;
        session->design().changeSettings(steep, "Vibration angle");
        session->design().changeSettings(steep, "Vibration angle");
        QCOMPARE(changed.count(), 2);
        QCOMPARE(session->design().undoStack()->count(), 2);
        QCOMPARE(session->design().undoStack()->undoText(), QString("Vibration angle"));
        QVERIFY(session->design().settings() == steep);
        session->design().undoStack()->undo();
        QVERIFY(session->design().settings() == wide);
        session->design().undoStack()->undo();
        QVERIFY(session->design().settings() == before);
        session->design().undoStack()->redo();
        QVERIFY(session->design().settings() == wide);
        session.reset();
        session = fixture_->open("a.trap");
        QVERIFY(session && session->design().settings() == wide);
    }

    void draggedValueIsOneChange() {
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        const study::Settings before = session->design().settings();
        for (int step = 1; step <= 5; ++step) {
            study::Settings settings = session->design().settings();
            settings.track.segmentHeight += 1e-3;
            session->design().changeSettings(settings, "Segment height");
        }
        QCOMPARE(session->design().undoStack()->count(), 1);
        session->design().undoStack()->undo();
        QVERIFY(session->design().settings() == before);
    }

    void badValuesAreProblems() {
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        QSignalSpy failed(session.get(), &StudySession::failed);
        study::Settings bad = session->design().settings();
        bad.track.segmentWidth = 5e-3;  // narrower than the part
        session->design().changeSettings(bad, "Segment width");
        QVERIFY(!session->design().problems().empty());
        session->runs().startLearning();
        QCOMPARE(session->runs().state(), RunState::idle);
        QCOMPARE(failed.count(), 1);
        QVERIFY(
            failed[0][1].toString().contains(QString::fromStdString(session->design().problems().front())));
        session->design().undoStack()->undo();
        QVERIFY(session->design().problems().empty());
    }

    void partIsReplacedAndUndone() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        QSignalSpy changed(&session->design(), &StudyDesign::partChanged);
        const ImportedPart cone = workflow::importPart({"cone"}).value();
        session->design().changePart(cone, "Import cone");
        QCOMPARE(changed.count(), 1);
        QVERIFY(session->design().part()->symmetry.continuous);
        QVERIFY(session->design().settings().part == cone.settings);
        session->design().undoStack()->undo();
        QCOMPARE(session->design().part()->symmetry.name, std::string("D2"));
        QVERIFY(session->design().settings().part == cuboid().settings);
        session->design().undoStack()->redo();

        // A denser one, which is built in the background.
        store::StoredPart dense = cone.stored;
        study::PartSettings settings = cone.settings;
        dense.options.density = settings.density = 8000.0;
        session->design().changePart(dense, settings, "Density");
        QTRY_COMPARE(changed.count(), 4);
        QCOMPARE(session->design().part()->density, 8000.0);
        dense.options.density = -1.0;
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->design().changePart(dense, settings, "Density");
        QTRY_COMPARE(failed.count(), 1);
        QVERIFY(failed[0][1].toString().contains("density"));
        QCOMPARE(session->design().part()->density, 8000.0);
        session.reset();
        session = fixture_->open("a.trap");
        QVERIFY(session && session->design().part()->symmetry.continuous);
        QCOMPARE(session->design().part()->density, 8000.0);
        QCOMPARE(session->design().settings().part.density, 8000.0);
    }

    void scoresLockWhatTheyWereMadeWith() {
        const auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session);
        study::Settings wide = session->design().settings();
        wide.track.segmentWidth = 50e-3;
        session->design().changeSettings(wide, "Segment width");
        QVERIFY(learnToTheEnd(*session));
        QVERIFY(session->design().locked() && !session->design().undoStack()->canUndo());
        QSignalSpy failed(session.get(), &StudySession::failed);
        study::Settings narrow = session->design().settings();
        narrow.track.segmentWidth = 40e-3;
        session->design().changeSettings(narrow, "Segment width");
        session->design().changePart(workflow::importPart({"cone"}).value(), "Import cone");
        QCOMPARE(failed.count(), 2);
        QVERIFY(session->design().settings() == wide);
        study::Settings longer = session->design().settings();
        longer.evolution.generations = 3;
        longer.validation.trialsPerPose = 12;
        session->design().changeSettings(longer, "Generations");
        QVERIFY(session->design().settings() == longer);
        QVERIFY(learnToTheEnd(*session));
        QCOMPARE(session->runs().summaries().size(), std::size_t{3});
        QCOMPARE(failed.count(), 2);
    }

    void savingAsGoesOnWithTheCopy() {
        auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session);
        QVERIFY(learnToTheEnd(*session));
        const study::GenerationRecord last = session->runs().loadGeneration(1).value();
        QSignalSpy moved(session.get(), &StudySession::pathChanged);
        QVERIFY(!session->saveAs(fixture_->path("a.trap")).ok());
        QVERIFY(!session->saveAs(fixture_->path("none/b.trap")).ok());
        QCOMPARE(session->runs().loadGeneration(1).value().individuals, last.individuals);
        VERIFY_OK(session->saveAs(fixture_->path("b.trap")));
        QCOMPARE(moved.count(), 1);
        QCOMPARE(session->path(), fixture_->path("b.trap"));
        QCOMPARE(session->runs().loadGeneration(1).value().individuals, last.individuals);
        study::Settings longer = session->design().settings();
        longer.evolution.generations = 3;
        session->design().changeSettings(longer, "Generations");
        QVERIFY(learnToTheEnd(*session));
        // The old one stays as it was and is free.
        const auto old = fixture_->open("a.trap");
        QVERIFY(old);
        QCOMPARE(old->runs().summaries().size(), std::size_t{2});
        session.reset();
        QVERIFY(!std::filesystem::exists(fixture_->path("b.trap-wal")));
        session = fixture_->open("b.trap");
        QVERIFY(session);
        QCOMPARE(session->runs().summaries().size(), std::size_t{3});
    }

    void forkHasNoGenerations() {
        const auto session = fixture_->create("a.trap", smallSettings(1));
        QVERIFY(session);
        QVERIFY(learnToTheEnd(*session));
        const auto forked = session->fork(fixture_->path("b.trap"));
        VERIFY_OK(forked);
        QVERIFY((*forked)->runs().summaries().empty() && !(*forked)->design().locked());
        QVERIFY((*forked)->design().settings() == session->design().settings());
        QVERIFY((*forked)->design().part()->mesh.vertices == session->design().part()->mesh.vertices);
    }

    void forkBeginsWithTheTracksIfItShall() {
        const auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session);
        QVERIFY(fake::messageOf(session->fork(fixture_->path("none.trap"), Fork::knownTracks))
                    .contains("no tracks yet"));
        QVERIFY(learnToTheEnd(*session));
        {
            const auto forked = session->fork(fixture_->path("b.trap"), Fork::knownTracks);
            VERIFY_OK(forked);
            StudySession& other = **forked;
            QVERIFY(other.design().problems().empty());
            // Another way of making tracks has none that are known ...
            study::Settings settings = other.design().settings();
            settings.track.crossSections += 1;
            other.design().changeSettings(settings, "More sections");
            QCOMPARE(other.design().problems().size(), std::size_t{1});
            QVERIFY(other.design().problems()[0].find("a.trap") != std::string::npos);
            settings.track.crossSections -= 1;
            settings.simulation.contact.restitution = 0.31;
            other.design().changeSettings(settings, "Other physics");
            QVERIFY(other.design().problems().empty());
        }
        // ... and what the study begins with is in its file.
        const auto opened = fixture_->open("b.trap");
        QVERIFY(opened && opened->design().problems().empty());
        QVERIFY(learnToTheEnd(*opened));
        const study::GenerationRecord last = session->runs().loadGeneration(1).value();
        const study::GenerationRecord first = opened->runs().loadGeneration(0).value();
        QVERIFY(std::ranges::any_of(last.individuals, [&](const study::IndividualRecord& one) {
            return one.design == first.individuals[0].design;
        }));
    }

    void forkLearnsATrapBehind() {
        const auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session);
        QVERIFY(fake::messageOf(session->fork(fixture_->path("none.trap"), Fork::trapBehind))
                    .contains("no track yet"));
        QVERIFY(learnToTheEnd(*session));
        const auto chosen = session->runs().chosen();
        QVERIFY(chosen);
        const auto forked = session->fork(fixture_->path("b.trap"), Fork::trapBehind);
        VERIFY_OK(forked);
        StudySession& other = **forked;
        QVERIFY(other.design().problems().empty());
        const study::Settings& settings = other.design().settings();
        QVERIFY(settings.track.returns == trial::Returns::anywhere);
        const auto given = study::readSections(settings.track.given);
        VERIFY_OK(given);
        const auto track = study::decodeTrack(session->design().settings().track, chosen->record.design);
        QCOMPARE(given->size(), static_cast<std::size_t>(track->lastTrapSection - track->firstTrapSection));
        const auto& last = track->sections[static_cast<std::size_t>(track->lastTrapSection)].points;
        QCOMPARE(given->back().points.size(), last.size());
        for (std::size_t i = 0; i < last.size(); ++i)
            QVERIFY(std::abs(given->back().points[i].x() - last[i].x()) < 1e-12);
    }

    void opensInTheBackground() {
        auto session = fixture_->create("a.trap", smallSettings(1));
        QVERIFY(session && learnToTheEnd(*session));
        session.reset();
        StudyOpening opening;
        QString message;
        const auto take = [&](base::Result<std::unique_ptr<StudySession>> opened) {
            message = fake::messageOf(opened);
            if (opened) session = std::move(opened).value();
        };
        opening.start(fixture_->path("none.trap"), fixture_->environment(), take);
        QTRY_VERIFY(!opening.busy());
        QVERIFY(message.contains("none.trap"));
        opening.start(fixture_->path("a.trap"), fixture_->environment(), take);
        QVERIFY(opening.busy() && !session);
        QTRY_VERIFY(session);
        QCOMPARE(session->runs().summaries().size(), std::size_t{1});
        QVERIFY(learnToTheEnd(*session) || session->runs().summaries().size() == 1);
    }

    void curvesOfAnotherStudy() {
        const auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session && learnToTheEnd(*session));
        const auto curves = loadCurves(session->path());
        VERIFY_OK(curves);
        QCOMPARE(curves->study.name, std::string("a"));
        QCOMPARE(curves->study.generations.size(), std::size_t{2});
        QCOMPARE(curves->study.generations[1].statistics, session->runs().summaries()[1].statistics);
        QVERIFY(curves->attainable == session->design().attainable());
        QVERIFY(!loadCurves(fixture_->path("none.trap")).ok());
    }

 private:
    std::unique_ptr<SessionFixture> fixture_;
};

QTEST_GUILESS_MAIN(StudySessionTest)
#include "study_session_test.moc"
