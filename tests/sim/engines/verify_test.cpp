#include "core/verify/verify.h"

#include <QtTest>

#include "tests/sim/engines/each_engine.h"

using namespace trapwright;

class VerifyTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    void everyRowPasses_data() {
        QTest::addColumn<QString>("name");
        for (const verify::Case& test : verify::allCases())
            QTest::newRow(test.name.c_str()) << QString::fromStdString(test.name);
    }
    void everyRowPasses() {
        QFETCH(QString, name);
        int rows = 0;
        bool passed = true;
        const bool all =
            verify::runCases(testing::engineKind(), name.toStdString(), {}, [&](const verify::Row& row) {
                ++rows;
                passed = passed && row.passed;
                if (!row.passed)
                    qWarning("%s: expected %s, got %s", row.name.c_str(), row.expected.c_str(),
                             row.got.c_str());
            });
        QVERIFY(rows > 0);
        QVERIFY(passed);
        QVERIFY(all);
    }

    void aCancelledRunHasNotPassed() {
        base::RunControl control;
        control.cancel();
        int rows = 0;
        QVERIFY(!verify::runCases(testing::engineKind(), "", control, [&](const verify::Row&) { ++rows; }));
        QCOMPARE(rows, 0);
    }

    void anEngineThatFailsIsReported() {
        // Cancelled after it has begun: the engine's error becomes a row.
        base::RunControl control;
        int failed = 0;
        trial::EngineKind kind = testing::engineKind();
        kind.make = [&](const trial::EngineOptions& options) {
            control.cancel();
            return testing::makeEngine(options);
        };
        QVERIFY(!verify::runCases(kind, "bounce", control, [&](const verify::Row& row) {
            failed += row.passed ? 0 : 1;
            QVERIFY(row.got.find("cancelled") != std::string::npos);
        }));
        QCOMPARE(failed, 1);
    }
};

QTEST_APPLESS_MAIN(VerifyTest)
#include "verify_test.moc"
