#include "ui/pages/value_edit.h"

#include <QSignalSpy>
#include <QtTest>

#include "ui/look/wheel_focus.h"

using namespace trapwright;

class ValueEditTest : public QObject {
    Q_OBJECT

 private slots:
    void keysStepTheSecondDigit_data() {
        QTest::addColumn<QString>("before");
        QTest::addColumn<int>("key");
        QTest::addColumn<QString>("after");
        QTest::newRow("60 up") << "60" << int(Qt::Key_Up) << "61";
        QTest::newRow("60 down") << "60" << int(Qt::Key_Down) << "59";
        QTest::newRow("0.8 up") << "0.8" << int(Qt::Key_Up) << "0.81";
        QTest::newRow("0.8 page up") << "0.8" << int(Qt::Key_PageUp) << "0.9";
        QTest::newRow("0.002 down") << "0.002" << int(Qt::Key_Down) << "0.0019";
        QTest::newRow("comma") << "0,8" << int(Qt::Key_Up) << "0.81";
        QTest::newRow("ends at the range") << "100" << int(Qt::Key_PageUp) << "100";
        QTest::newRow("no number") << "wide" << int(Qt::Key_Up) << "wide";
    }
    void keysStepTheSecondDigit() {
        QFETCH(QString, before);
        QFETCH(int, key);
        QFETCH(QString, after);
        pages::ValueEdit edit("mm", 0.0, 100.0, false);
        edit.setText(before);
        QSignalSpy stepped(&edit, &pages::ValueEdit::stepped);
        QTest::keyClick(&edit, static_cast<Qt::Key>(key));
        QCOMPARE(edit.text(), after);
        QCOMPARE(stepped.count(), before == "wide" ? 0 : 1);
    }

    void wholeNumbersStayWhole() {
        pages::ValueEdit edit({}, 0, 1000, true);
        edit.setText("5");
        QTest::keyClick(&edit, Qt::Key_Up);
        QCOMPARE(edit.text(), QString("6"));
        edit.setText("200");
        QTest::keyClick(&edit, Qt::Key_Down);
        QCOMPARE(edit.text(), QString("190"));
    }

    // An inspector is scrolled with the wheel: a field in its way must not change.
    void theWheelNeedsTheFocus() {
        const look::WheelFocus wheelFocus;
        pages::ValueEdit edit("mm", 0.0, 100.0, false);
        edit.setText("60");
        QWheelEvent wheel({5, 5}, {5, 5}, {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                          false);
        QCoreApplication::sendEvent(&edit, &wheel);
        QCOMPARE(edit.text(), QString("60"));
    }
};

QTEST_MAIN(ValueEditTest)
#include "value_edit_test.moc"
