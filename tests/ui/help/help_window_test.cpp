#include "ui/help/help_window.h"

#include <QAction>
#include <QApplication>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextLayout>
#include <QTextTable>
#include <QtTest>

#include "ui/look/theme.h"

using namespace trapwright;

namespace {

const std::filesystem::path kFolder = TRAPWRIGHT_SOURCE_DIR "/resources/docs/help";

/// What stands in the first line that is seen.
QString firstLine(const QTextBrowser& view) {
    return view.cursorForPosition({30, 12}).block().text();
}

}  // namespace

class HelpWindowTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        window_ = std::make_unique<help::HelpWindow>(nullptr, help::HelpBook(kFolder));
        view_ = window_->findChild<QTextBrowser*>("help.view");
        search_ = window_->findChild<QLineEdit*>("help.search");
        list_ = window_->findChild<QListWidget*>("help.list");
    }
    void cleanup() { window_.reset(); }

    void everySectionCanBeShown_data() {
        QTest::addColumn<QString>("page");
        const help::HelpBook book(kFolder);
        for (const help::Page& page : book.pages())
            QTest::newRow(qPrintable(page.name)) << page.name;
    }
    void everySectionCanBeShown() {
        QFETCH(QString, page);
        const help::Page* found = window_->book().findPage(page);
        for (const help::Section& section : found->sections) {
            window_->showAt(page, section.anchor);
            QCOMPARE(window_->place(), page + '#' + section.anchor);
            // At the top, unless the page ends before.
            const QScrollBar* bar = view_->verticalScrollBar();
            if (bar->value() > 0 && bar->value() < bar->maximum()) {
                QVERIFY2(firstLine(*view_).startsWith(section.title.left(12)), qPrintable(section.anchor));
            }
        }
        QCOMPARE(window_->book().findPage(page)->title, found->title);
    }

    void linksLeadOnAndBack() {
        window_->showAt("track");
        emit view_->anchorClicked(QUrl("drive.md#calibrate"));
        QCOMPARE(window_->place(), QString("drive#calibrate"));
        window_->findChild<QAction*>("help.back")->trigger();
        QCOMPARE(window_->place(), QString("track"));
        window_->findChild<QAction*>("help.forward")->trigger();
        QCOMPARE(window_->place(), QString("drive#calibrate"));
    }

    void itIsSearchedByKeyboard() {
        window_->showAt("index");
        QVERIFY(QTest::qWaitForWindowActive(window_.get()));
        QTest::keyClick(view_, Qt::Key_F, Qt::ControlModifier);
        QTRY_VERIFY(search_->hasFocus());
        QTest::keyClicks(search_, "film strip");
        QVERIFY(list_->count() > 0);
        QTest::keyClick(search_, Qt::Key_Return);
        QCOMPARE(window_->place(), QString("evolve#film-strip"));
        QVERIFY(!view_->extraSelections().isEmpty());
        // Esc leaves the search first, then the help.
        QTest::keyClick(search_, Qt::Key_Escape);
        QVERIFY(search_->text().isEmpty() && window_->isVisible());
        QCOMPARE(list_->count(), static_cast<int>(window_->book().pages().size()));
        QTest::keyClick(search_, Qt::Key_Escape);
        QVERIFY(!window_->isVisible());
    }

    void picturesFitTheWidth() {
        window_->resize(700, 600);
        window_->showAt("part");
        int pictures = 0;
        for (QTextBlock block = view_->document()->begin(); block.isValid(); block = block.next()) {
            for (auto piece = block.begin(); !piece.atEnd(); ++piece) {
                if (!piece.fragment().charFormat().isImageFormat()) continue;
                const QTextImageFormat format = piece.fragment().charFormat().toImageFormat();
                ++pictures;
                QVERIFY(format.width() > 200 && format.width() < view_->viewport()->width());
                // And no gap below, as the lines of text have one.
                QVERIFY(block.layout()->boundingRect().height() < 1.1 * format.height());
            }
        }
        QCOMPARE(pictures, 1);
        QCOMPARE(view_->horizontalScrollBar()->maximum(), 0);
    }

    void withoutPagesItSaysWhereTheyBelong() {
        help::HelpWindow empty(nullptr, help::HelpBook("/nowhere"));
        empty.showAt("track");
        QVERIFY(empty.findChild<QTextBrowser*>("help.view")->toPlainText().contains("not installed"));
    }

 private:
    std::unique_ptr<help::HelpWindow> window_;
    QTextBrowser* view_ = nullptr;
    QLineEdit* search_ = nullptr;
    QListWidget* list_ = nullptr;
};

QTEST_MAIN(HelpWindowTest)
#include "help_window_test.moc"
