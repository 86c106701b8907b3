#include "core/base/csv.h"

#include <QtTest>

using namespace trapwright;

/// RFC 4180, section 2, rules 5 to 7.
class CsvTest : public QObject {
    Q_OBJECT

 private slots:
    void fieldsAreQuotedWhereTheyNeedIt() {
        QCOMPARE(base::csvField("plain text; 3.5"), std::string("plain text; 3.5"));
        QCOMPARE(base::csvField(""), std::string());
        QCOMPARE(base::csvField("a,b"), std::string("\"a,b\""));
        QCOMPARE(base::csvField("a\nb"), std::string("\"a\nb\""));
        QCOMPARE(base::csvField("say \"hot\""), std::string("\"say \"\"hot\"\"\""));
    }
};

QTEST_APPLESS_MAIN(CsvTest)
#include "csv_test.moc"
