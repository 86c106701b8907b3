#include "core/base/json_object.h"

#include <QtTest>

using namespace trapwright;

/// What cannot be read is an error with words, whatever a file holds.
class JsonObjectTest : public QObject {
    Q_OBJECT

 private slots:
    void badTextsAreErrors_data() {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("word");
        QTest::newRow("no JSON") << QByteArray("{\n\"a\": 1,\n}") << "line 3";
        QTest::newRow("empty") << QByteArray() << "line 1";
        QTest::newRow("no double holds it") << QByteArray("{\"a\": 1e999}") << "1e999";
        QTest::newRow("nor a negative one") << QByteArray("{\"a\": [-1e4000]}") << "1e4000";
        QTest::newRow("no UTF-8") << QByteArray("{\"a\": \"\xff\xfe\"}") << "line 1";
        QTest::newRow("half a pair") << QByteArray("{\"a\": \"\\ud800\"}") << "line 1";
        QTest::newRow("deep lists without an end") << QByteArray(1000000, '[') << "line 1";
        QTest::newRow("deep lists that end")
            << QByteArray(200000, '[') + QByteArray(200000, ']') << "levels deep";
        QByteArray objects;
        for (int i = 0; i < 100000; ++i)
            objects += "{\"a\":";
        QTest::newRow("deep objects") << objects + "1" + QByteArray(100000, '}') << "levels deep";
        QTest::newRow("too long") << QByteArray((64 << 20) + 1, ' ') << "64 MiB";
    }

    void badTextsAreErrors() {
        QFETCH(QByteArray, text);
        QFETCH(QString, word);
        const auto read =
            base::parseJson(std::string_view(text.data(), static_cast<std::size_t>(text.size())));
        QVERIFY(!read.ok());
        const QString message = QString::fromStdString(read.error().message);
        QVERIFY2(message.contains(word), qPrintable(message));
    }

    void asDeepAsOursIsRead() {
        const QByteArray text = QByteArray(30, '[') + "1.5" + QByteArray(30, ']');
        const auto read =
            base::parseJson(std::string_view(text.data(), static_cast<std::size_t>(text.size())));
        QVERIFY(read.ok());
        const base::Json* at = &*read;
        while (at->is_array())
            at = &at->front();
        QCOMPARE(at->get<double>(), 1.5);
    }
};

QTEST_APPLESS_MAIN(JsonObjectTest)
#include "json_object_test.moc"
