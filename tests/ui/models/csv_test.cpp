#include "ui/models/csv.h"

#include <QStandardItemModel>
#include <QtTest>

#include "ui/models/roles.h"

using namespace trapwright;

class CsvTest : public QObject {
    Q_OBJECT

 private slots:
    void fieldsAreQuotedWhereRfc4180AsksForIt() {
        QStandardItemModel model(1, 3);
        model.setHorizontalHeaderLabels({"plain", "with, comma", "with \"quotes\""});
        model.setData(model.index(0, 0), QString("a"), models::ValueRole);
        model.setData(model.index(0, 1), QString("b,c"), models::ValueRole);
        model.setData(model.index(0, 2), QString("two\nlines"), models::ValueRole);
        QCOMPARE(models::toCsv(model),
                 QString("plain,\"with, comma\",\"with \"\"quotes\"\"\"\na,\"b,c\",\"two\nlines\"\n"));
    }

    void numbersComeBackBitForBit_data() {
        QTest::addColumn<double>("number");
        QTest::newRow("third") << 1.0 / 3.0;
        QTest::newRow("tiny") << 4.9e-324;
        QTest::newRow("large") << 1.7976931348623157e308;
        QTest::newRow("tenth") << 0.1;
        QTest::newRow("whole") << -12.0;
    }
    void numbersComeBackBitForBit() {
        QFETCH(double, number);
        QStandardItemModel model(1, 1);
        model.setData(model.index(0, 0), number, models::ValueRole);
        QCOMPARE(models::toCsv(model).split('\n')[1].toDouble(), number);
    }

    void languageDoesNotMatter() {
        const QLocale before;
        QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
        QStandardItemModel model(1, 1);
        model.setData(model.index(0, 0), 1234.5, models::ValueRole);
        QCOMPARE(models::toCsv(model).split('\n')[1], QString("1234.5"));
        QLocale::setDefault(before);
    }

    void nothingIsAnEmptyField() {
        QStandardItemModel model(1, 2);
        QCOMPARE(models::toCsv(model).split('\n')[1], QString(","));
    }
};

QTEST_GUILESS_MAIN(CsvTest)
#include "csv_test.moc"
