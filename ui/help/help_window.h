#pragma once

#include <QTextBrowser>
#include <QWidget>

#include "ui/help/help_book.h"

class QLineEdit;
class QListWidget;
class QListWidgetItem;

namespace trapwright::help {

/// A page of the help. Headings have anchors, pictures fit the width, tables have lines.
class HelpView : public QTextBrowser {
    Q_OBJECT
 public:
    explicit HelpView(QWidget* parent);

    /// Shows every place of these words on the page; empty: none.
    void mark(const QString& words);

 protected:
    void doSetSource(const QUrl& url, QTextDocument::ResourceType type) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    void dress();
    void fitPictures();

    QUrl shown_;  // without its anchor
};

/// The help: contents and search at the left, a page at the right. Not modal: it stays open beside the work.
class HelpWindow : public QWidget {
    Q_OBJECT
 public:
    explicit HelpWindow(QWidget* parent, HelpBook book = HelpBook::installed());

    /// Opens it at a section; no anchor: at the page's beginning. An unknown page is the first one.
    void showAt(const QString& page, const QString& anchor = {});
    /// Where it is, "track#drive".
    [[nodiscard]] QString place() const;
    [[nodiscard]] const HelpBook& book() const { return book_; }

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void addKeys();
    void showContents();
    void find(const QString& words);
    void choose(const QListWidgetItem* item);
    void follow(const QUrl& url);

    HelpBook book_;
    QLineEdit* search_;
    QListWidget* list_;
    HelpView* view_;
};

}  // namespace trapwright::help
