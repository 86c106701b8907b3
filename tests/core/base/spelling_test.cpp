#include "core/base/spelling.h"

#include <QTest>
#include <array>
#include <string>

using namespace trapwright::base;

/// Distances counted by hand, and the metric's properties.
class SpellingTest : public QObject {
    Q_OBJECT

 private slots:
    void distance_data() {
        QTest::addColumn<QString>("a");
        QTest::addColumn<QString>("b");
        QTest::addColumn<int>("distance");
        QTest::newRow("equal") << "evolve"
                               << "evolve" << 0;
        QTest::newRow("nothing") << ""
                                 << "" << 0;
        QTest::newRow("all put in") << ""
                                    << "part" << 4;
        QTest::newRow("changed") << "part"
                                 << "pact" << 1;
        QTest::newRow("left out") << "densty"
                                  << "density" << 1;
        QTest::newRow("swapped") << "exprot"
                                 << "export" << 1;
        QTest::newRow("swapped at the end") << "swepe"
                                            << "sweep" << 1;
        QTest::newRow("capitals") << "POM"
                                  << "pom" << 0;
        // Levenshtein's classic.
        QTest::newRow("kitten") << "kitten"
                                << "sitting" << 3;
        // The restricted distance: the swapped pair is not touched again (2 without that rule).
        QTest::newRow("restricted") << "ca"
                                    << "abc" << 3;
    }

    void distance() {
        QFETCH(QString, a);
        QFETCH(QString, b);
        QFETCH(int, distance);
        QCOMPARE(calcEditDistance(a.toStdString(), b.toStdString()), std::size_t(distance));
        QCOMPARE(calcEditDistance(b.toStdString(), a.toStdString()), std::size_t(distance));
    }

    void nearest() {
        const std::array<std::string, 3> names = {"evolve", "export", "replay"};
        QCOMPARE(findNearestName("exprot", names).value(), std::string("export"));
        QVERIFY(!findNearestName("exprot", {}).has_value());
    }

    void suggestion() {
        const std::array<std::string, 3> names = {"evolve", "export", "validate"};
        QCOMPARE(suggestName("evovle", names), std::string("Did you mean \"evolve\"?"));
        QCOMPARE(suggestName("frobnicate", names), std::string("The nearest is \"validate\"."));
        QCOMPARE(suggestName("evovle", {}), std::string());
    }
};

QTEST_APPLESS_MAIN(SpellingTest)
#include "spelling_test.moc"
