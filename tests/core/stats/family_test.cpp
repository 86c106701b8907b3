#include "core/stats/rates.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;

class FamilyTest : public QObject {
    Q_OBJECT

 private slots:
    void holm_data() {
        QTest::addColumn<QList<double>>("probabilities");
        QTest::addColumn<QList<double>>("adjusted");
        QTest::newRow("none") << QList<double>{} << QList<double>{};
        QTest::newRow("one") << QList<double>{0.04} << QList<double>{0.04};
        QTest::newRow("large ones") << QList<double>{0.6, 0.7} << QList<double>{1.0, 1.0};
        // As R's p.adjust(..., "holm") has them.
        QTest::newRow("rising") << QList<double>{0.01, 0.02, 0.03, 0.04}
                                << QList<double>{0.04, 0.06, 0.06, 0.06};
        QTest::newRow("any order") << QList<double>{0.01, 0.04, 0.03, 0.005}
                                   << QList<double>{0.03, 0.06, 0.06, 0.02};
        QTest::newRow("equal") << QList<double>{0.02, 0.02, 0.5} << QList<double>{0.06, 0.06, 0.5};
    }
    void holm() {
        QFETCH(QList<double>, probabilities);
        QFETCH(QList<double>, adjusted);
        const std::vector<double> got =
            stats::adjustHolm(std::vector<double>(probabilities.begin(), probabilities.end()));
        QCOMPARE(static_cast<qsizetype>(got.size()), adjusted.size());
        for (std::size_t i = 0; i < got.size(); ++i)
            QVERIFY(std::abs(got[i] - adjusted[static_cast<qsizetype>(i)]) < 1e-12);
    }

    /// Where nothing is to be found, 27 tests find something in 5 % of the tables, not in 75 %.
    void familyWiseError() {
        base::Random random(base::StreamKey{.seed = 7});
        constexpr int kTables = 4000;
        int found = 0;
        int alone = 0;
        for (int table = 0; table < kTables; ++table) {
            std::vector<double> probabilities(27);
            for (double& p : probabilities)
                p = random.uniform(0.0, 1.0);
            const auto rejected = [](const std::vector<double>& all) {
                return std::any_of(all.begin(), all.end(), [](double p) { return p <= 0.05; });
            };
            found += rejected(stats::adjustHolm(probabilities)) ? 1 : 0;
            alone += rejected(probabilities) ? 1 : 0;
        }
        // Three standard deviations.
        QVERIFY(std::abs(static_cast<double>(found) / kTables - 0.05) < 0.011);
        QVERIFY(std::abs(static_cast<double>(alone) / kTables - (1.0 - std::pow(0.95, 27))) < 0.021);
    }
};

QTEST_APPLESS_MAIN(FamilyTest)
#include "family_test.moc"
