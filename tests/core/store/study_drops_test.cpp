#include <SQLiteCpp/SQLiteCpp.h>

#include <QTemporaryDir>
#include <QtTest>

#include "core/store/schema.h"
#include "old_study.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

study::DropRecord record(int number) {
    study::DropRecord record;
    record.settings.drops = 17;
    record.settings.height = 1.0 / 30.0;
    record.settings.contact = {0.1 + 0.2, 0.25, 0.15};
    record.settings.gravity = 1.62;
    record.settings.seed = 0xFEDCBA9876543210ULL + static_cast<std::uint64_t>(number);
    record.engine = "simbody";
    record.poses = {base::Quaternion::Identity(), base::Quaternion(0.5, 0.5, -0.5, 0.5)};
    record.result.counts = {10, 5};
    record.result.unsettled = 2;
    record.time = "2026-03-31T10:00:00Z";
    return record;
}

}  // namespace

class StudyDropsTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "dropped.trap";
        sample::write(path_, 1);
    }

    // Also with scores: no trial depends on how a part was dropped.
    void keepsDropTestsToTheLastBit() {
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            QVERIFY(study->loadDropTests().value().empty());
            VERIFY_OK(study->addDropTest(record(0)));
            VERIFY_OK(study->addDropTest(record(1)));
        }
        auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        const auto kept = study->loadDropTests().value();
        QVERIFY(kept == (std::vector{record(0), record(1)}));
        QCOMPARE(kept[0].settings.height, 1.0 / 30.0);
        QVERIFY(kept[1].poses[1].coeffs() == record(1).poses[1].coeffs());
        QVERIFY(sample::messageOf(study->addDropTest(record(2))).contains("reading only"));
    }

    void timeIsNotedIfNoneIsGiven() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        study::DropRecord now = record(0);
        now.time.clear();
        VERIFY_OK(study->addDropTest(now));
        QVERIFY(study->loadDropTests().value()[0].time.ends_with('Z'));
    }

    void weightsMayChangeWithScores() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        study::Settings settings = study->loadSettings().value();
        settings.part.poseWeights = study::PoseWeights::dropped;
        VERIFY_OK(study->changeSettings(settings));
        QVERIFY(study->loadSettings().value().part.poseWeights == study::PoseWeights::dropped);
        settings.part.density += 1.0;
        QVERIFY(!study->changeSettings(settings).ok());
    }

    void studyWithoutDropTestsIsBroughtUpToDate() {
        sample::makeOld(path_, 6);
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE)
            .exec(
                "UPDATE study SET settings = json_remove(settings, '$.part.poseWeights', "
                "'$.part.material', '$.simulation.contact.surface')");
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(study->loadDropTests().value().empty());
        const study::Settings settings = study->loadSettings().value();
        QVERIFY(settings.part.poseWeights == study::PoseWeights::quasiStatic);
        QVERIFY(settings.part.material.empty() && settings.simulation.surface.empty());
        VERIFY_OK(study->addDropTest(record(0)));
        QVERIFY(study->loadDropTests().value() == std::vector{record(0)});
    }

    void damagedSeedIsTold() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->addDropTest(record(0)));
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("UPDATE drop_test SET seed = 'x'");
        QVERIFY(sample::messageOf(study->loadDropTests()).contains("damaged"));
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyDropsTest)
#include "study_drops_test.moc"
