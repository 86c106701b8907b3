#include "ui/models/trial_model.h"

#include <QAbstractItemModelTester>
#include <QIcon>
#include <QtTest>

#include "ui/models/verdict_look.h"

using namespace trapwright;
using models::TrialFilter;
using models::TrialModel;

namespace {

constexpr auto kFatal = QAbstractItemModelTester::FailureReportingMode::QtTest;

models::TrialRow trial(int number, int pose, trial::Verdict verdict, double time) {
    models::TrialRow row;
    row.trial = number;
    row.pose = pose;
    row.verdict = verdict;
    row.outcome.time = time;
    row.outcome.farthest.position.x() = 0.1234;
    if (verdict == trial::Verdict::success) row.angle = 2.5 * base::kDegree;
    return row;
}

std::vector<models::TrialRow> someTrials() {
    return {trial(0, 0, trial::Verdict::success, 10.0), trial(1, 0, trial::Verdict::stuck, 9.0),
            trial(2, 1, trial::Verdict::fellOff, 2.0), trial(3, 1, trial::Verdict::success, 1.0),
            trial(4, -1, trial::Verdict::wrongOrientation, 3.0)};
}

QList<int> trialsIn(const QAbstractItemModel& model) {
    QList<int> trials;
    for (int row = 0; row < model.rowCount(); ++row)
        trials.append(model.index(row, 0).data(models::TrialRole).toInt());
    return trials;
}

}  // namespace

class TrialModelTest : public QObject {
    Q_OBJECT

 private slots:
    void trialsAreShownInUnits() {
        TrialModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setTrials(someTrials());
        QCOMPARE(model.index(0, TrialModel::Verdict).data().toString(), QString("success"));
        QCOMPARE(model.index(0, TrialModel::Distance).data().toString(), QString("123.4"));
        QCOMPARE(model.index(0, TrialModel::Angle).data().toString(), QString("2.5"));
        QCOMPARE(model.index(1, TrialModel::Angle).data().toString(), QString());
        QCOMPARE(model.index(0, TrialModel::Pose).data().toString(), QString("1"));
        QCOMPARE(model.index(4, TrialModel::Pose).data().toString(), QString("any"));
        QCOMPARE(model.count(trial::Verdict::success), 2);
        QCOMPARE(model.count(trial::Verdict::fellOff), 1);
    }

    void filterLeavesSomeOutcomes() {
        TrialModel model;
        TrialFilter filter;
        filter.setSourceModel(&model);
        const QAbstractItemModelTester tester(&filter, kFatal);
        model.setTrials(someTrials());
        QCOMPARE(filter.rowCount(), 5);
        filter.setVerdicts({trial::Verdict::stuck, trial::Verdict::fellOff});
        QCOMPARE(trialsIn(filter), (QList<int>{1, 2}));
        filter.setPose(1);
        QCOMPARE(trialsIn(filter), (QList<int>{2}));
        filter.setPose(std::nullopt);
        filter.setVerdicts({});
        QCOMPARE(filter.rowCount(), 0);
    }

    void filterSortsByNumber() {
        TrialModel model;
        model.setTrials(someTrials());
        TrialFilter filter;
        filter.setSourceModel(&model);
        filter.sort(TrialModel::Time);
        QCOMPARE(trialsIn(filter), (QList<int>{3, 2, 4, 1, 0}));  // as text 10 would come before 2
    }

    void verdictsDifferByColourSignAndWord() {
        std::set<QRgb> colours;
        std::set<QString> words;
        std::vector<QImage> signs;
        for (const trial::Verdict verdict : models::kVerdicts) {
            colours.insert(models::verdictColour(verdict).rgb());
            words.insert(models::verdictText(verdict));
            signs.push_back(models::verdictIcon(verdict)
                                .pixmap(QSize(32, 32))
                                .toImage()
                                .convertToFormat(QImage::Format_Alpha8));
        }
        QCOMPARE(colours.size(), models::kVerdicts.size());
        QCOMPARE(words.size(), models::kVerdicts.size());
        // In black and white: a third of what one sign covers is free in any other.
        for (std::size_t a = 0; a < signs.size(); ++a) {
            for (std::size_t b = 0; b < signs.size(); ++b) {
                if (a == b) continue;
                int covered = 0;
                int different = 0;
                for (int y = 0; y < signs[a].height(); ++y) {
                    for (int x = 0; x < signs[a].width(); ++x) {
                        if (qAlpha(signs[a].pixel(x, y)) < 128) continue;
                        ++covered;
                        if (qAlpha(signs[b].pixel(x, y)) < 128) ++different;
                    }
                }
                QVERIFY(covered > 50);
                QVERIFY2(3 * different > covered, qPrintable(QString("%1 and %2").arg(a).arg(b)));
            }
        }
    }

    void signsAreInsideTheirSquare() {
        for (const trial::Verdict verdict : models::kVerdicts) {
            const QImage sign = models::verdictIcon(verdict).pixmap(QSize(64, 64)).toImage();
            for (int i = 0; i < 64; ++i) {
                QCOMPARE(qAlpha(sign.pixel(i, 0)), 0);
                QCOMPARE(qAlpha(sign.pixel(i, 63)), 0);
                QCOMPARE(qAlpha(sign.pixel(0, i)), 0);
                QCOMPARE(qAlpha(sign.pixel(63, i)), 0);
            }
        }
    }
};

QTEST_MAIN(TrialModelTest)
#include "trial_model_test.moc"
