#include "core/store/schema.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <QtTest>

using namespace trapwright;
using store::Migration;

namespace {

constexpr std::array<Migration, 3> kSteps = {{
    {1, "CREATE TABLE a (x INTEGER); INSERT INTO a VALUES (1);"},
    {2, "ALTER TABLE a ADD COLUMN y INTEGER DEFAULT 7;"},
    {3, "UPDATE a SET y = y + x;"},
}};

int number(SQLite::Database& database, const char* query) {
    return database.execAndGet(query).getInt();
}

}  // namespace

class SchemaTest : public QObject {
    Q_OBJECT

 private slots:
    void missingStepsAreTakenInOrder_data() {
        QTest::addColumn<int>("from");
        for (int from = 0; from <= 3; ++from)
            QTest::addRow("from %d", from) << from;
    }
    void missingStepsAreTakenInOrder() {
        QFETCH(int, from);
        SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        store::migrate(database, std::span(kSteps).first(static_cast<std::size_t>(from)));
        QCOMPARE(number(database, "PRAGMA user_version"), from);
        store::migrate(database, kSteps);
        QCOMPARE(number(database, "PRAGMA user_version"), 3);
        QCOMPARE(number(database, "SELECT y FROM a"), 8);
        QCOMPARE(number(database, "SELECT count(*) FROM a"), 1);
    }

    void failedStepLeavesAllAsItWas() {
        SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        store::migrate(database, std::span(kSteps).first(1));
        std::array<Migration, 3> broken = kSteps;
        broken[2].sql = "UPDATE a SET y = 100; UPDATE nothing SET z = 1;";
        QVERIFY_THROWS_EXCEPTION(SQLite::Exception, store::migrate(database, broken));
        QCOMPARE(number(database, "PRAGMA user_version"), 1);
        QCOMPARE(number(database, "SELECT count(*) FROM pragma_table_info('a')"), 1);
        store::migrate(database, kSteps);
        QCOMPARE(number(database, "SELECT y FROM a"), 8);
    }

    void ourStepsHaveRisingVersions() {
        int last = 0;
        for (const Migration& step : store::schemaMigrations()) {
            QVERIFY(step.version > last);
            last = step.version;
        }
        QCOMPARE(store::currentSchemaVersion(), last);
    }
};

QTEST_APPLESS_MAIN(SchemaTest)
#include "schema_test.moc"
