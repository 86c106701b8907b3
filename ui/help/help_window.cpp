#include "ui/help/help_window.h"

#include <QAction>
#include <QDesktopServices>
#include <QEvent>
#include <QFileInfo>
#include <QHash>
#include <QImage>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollBar>
#include <QSplitter>
#include <QTextBlock>
#include <QTextList>
#include <QTextTable>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <utility>

#include "ui/look/icon.h"
#include "ui/look/text.h"

namespace trapwright::help {

namespace {

constexpr int kPlace = Qt::UserRole;  // of an item: page and anchor
constexpr int kListWidth = 232;
constexpr int kTextMargin = 20;
constexpr QSize kSize(960, 680);

QUrl urlOf(const Page& page, const QString& anchor) {
    QUrl url = QUrl::fromLocalFile(look::toText(std::filesystem::absolute(page.file).lexically_normal()));
    if (!anchor.isEmpty()) url.setFragment(anchor);
    return url;
}

}  // namespace

HelpView::HelpView(QWidget* parent) : QTextBrowser(parent) {
    setObjectName("help.view");
    setAccessibleName(tr("Help"));
    setOpenLinks(false);
    setFrameShape(QFrame::NoFrame);
    document()->setDocumentMargin(kTextMargin);
}

void HelpView::doSetSource(const QUrl& url, QTextDocument::ResourceType type) {
    QTextBrowser::doSetSource(url, type);
    const QUrl page = url.adjusted(QUrl::RemoveFragment);
    if (shown_ != page) {
        shown_ = page;
        dress();
    }
    mark({});
    if (url.hasFragment()) {
        scrollToAnchor(url.fragment());
    } else {
        verticalScrollBar()->setValue(0);
    }
}

/// What Qt's reader of Markdown leaves to do.
void HelpView::dress() {
    document()->setDocumentMargin(kTextMargin);
    QHash<QString, int> used;
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
        QTextCursor cursor(block);
        QTextBlockFormat format = block.blockFormat();
        const int level = format.headingLevel();
        if (level > 0) {
            const QString anchor = anchorOf(block.text());
            const int before = used[anchor]++;
            QTextCharFormat named;
            named.setAnchor(true);
            named.setAnchorNames({before == 0 ? anchor : QString("%1-%2").arg(anchor).arg(before)});
            cursor.select(QTextCursor::BlockUnderCursor);
            cursor.setPosition(block.position());
            cursor.setPosition(block.position() + block.length() - 1, QTextCursor::KeepAnchor);
            cursor.mergeCharFormat(named);
            format.setTopMargin(level == 1 ? 4 : 18);
            format.setBottomMargin(6);
        } else if (cursor.currentTable() == nullptr && block.textList() == nullptr &&
                   !block.text().contains(QChar::ObjectReplacementCharacter)) {  // a picture is a tall line
            format.setLineHeight(125, QTextBlockFormat::ProportionalHeight);
        }
        cursor.setPosition(block.position());
        cursor.setBlockFormat(format);
    }
    for (QTextFrame* frame : document()->rootFrame()->childFrames()) {
        auto* table = qobject_cast<QTextTable*>(frame);
        if (table == nullptr) continue;
        QTextTableFormat format = table->format();
        format.setBorderCollapse(true);
        format.setBorder(1);
        format.setBorderBrush(palette().mid());
        format.setBorderStyle(QTextFrameFormat::BorderStyle_Solid);
        format.setCellPadding(5);
        format.setCellSpacing(0);
        format.setTopMargin(4);
        format.setBottomMargin(10);
        table->setFormat(format);
        for (int column = 0; column < table->columns(); ++column) {
            QTextTableCell cell = table->cellAt(0, column);
            QTextCharFormat head = cell.format();
            head.setBackground(palette().alternateBase());
            cell.setFormat(head);
        }
    }
    fitPictures();
}

void HelpView::fitPictures() {
    const int room = viewport()->width() - 2 * kTextMargin - 8;
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
        for (QTextBlock::iterator piece = block.begin(); !piece.atEnd(); ++piece) {
            const QTextFragment fragment = piece.fragment();
            if (!fragment.charFormat().isImageFormat()) continue;
            QTextImageFormat picture = fragment.charFormat().toImageFormat();
            const QUrl file = source().resolved(QUrl(picture.name()));
            const QSize size = QImage(file.toLocalFile()).size();
            const double width = std::min(size.width(), room);
            if (size.isEmpty() || picture.width() == width) continue;
            picture.setWidth(width);
            picture.setHeight(width * size.height() / size.width());
            QTextCursor cursor(document());
            cursor.setPosition(fragment.position());
            cursor.setPosition(fragment.position() + fragment.length(), QTextCursor::KeepAnchor);
            cursor.setCharFormat(picture);
            break;  // the block's pieces are others now; a picture has a block of its own
        }
    }
}

void HelpView::mark(const QString& words) {
    QList<ExtraSelection> marks;
    for (const QString& word : words.split(' ', Qt::SkipEmptyParts)) {
        for (QTextCursor place = document()->find(word); !place.isNull();
             place = document()->find(word, place)) {
            ExtraSelection mark;
            mark.cursor = place;
            mark.format.setBackground(palette().highlight());
            mark.format.setForeground(palette().highlightedText());
            marks.push_back(mark);
        }
    }
    setExtraSelections(marks);
}

void HelpView::resizeEvent(QResizeEvent* event) {
    QTextBrowser::resizeEvent(event);
    fitPictures();
}

void HelpView::changeEvent(QEvent* event) {
    QTextBrowser::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && !shown_.isEmpty()) dress();
}

HelpWindow::HelpWindow(QWidget* parent, HelpBook book)
    : QWidget(parent, Qt::Window),
      book_(std::move(book)),
      search_(new QLineEdit(this)),
      list_(new QListWidget(this)),
      view_(new HelpView(this)) {
    setObjectName("window.help");
    setWindowTitle(tr("Trapwright help"));
    search_->setObjectName("help.search");
    search_->setPlaceholderText(tr("Search the help (Ctrl+F)"));
    search_->setAccessibleName(tr("Search the help"));
    search_->setClearButtonEnabled(true);
    search_->installEventFilter(this);
    list_->setObjectName("help.list");
    list_->setAccessibleName(tr("Contents"));
    list_->setFrameShape(QFrame::NoFrame);
    list_->setWordWrap(true);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setStyleSheet("QListWidget::item { padding: 5px 8px; }");

    auto* side = new QWidget(this);
    auto* sideLayout = new QVBoxLayout(side);
    sideLayout->setContentsMargins(8, 8, 0, 0);
    sideLayout->setSpacing(8);
    sideLayout->addWidget(search_);
    sideLayout->addWidget(list_, 1);

    auto* bar = new QToolBar(this);
    bar->setIconSize({18, 18});
    bar->setStyleSheet("QToolBar { border: none; padding: 4px 8px; }");
    auto* main = new QWidget(this);
    auto* mainLayout = new QVBoxLayout(main);
    mainLayout->setContentsMargins(0, 0, 0, 0);
    mainLayout->setSpacing(0);
    mainLayout->addWidget(bar);
    mainLayout->addWidget(view_, 1);
    const auto addButton = [&](const QString& name, const QString& icon, const QString& text,
                               const QKeySequence& key, auto act) {
        QAction* action = bar->addAction(look::icon(icon), text);
        action->setObjectName(name);
        action->setShortcut(key);
        action->setToolTip(QString("%1 (%2)").arg(text, key.toString(QKeySequence::NativeText)));
        connect(action, &QAction::triggered, this, act);
        return action;
    };
    QAction* back = addButton("help.back", "step-back", tr("Back"), QKeySequence(Qt::ALT | Qt::Key_Left),
                              [this] { view_->backward(); });
    QAction* on = addButton("help.forward", "step-forward", tr("Forward"),
                            QKeySequence(Qt::ALT | Qt::Key_Right), [this] { view_->forward(); });
    addButton("help.home", "to-start", tr("Contents"), QKeySequence(Qt::ALT | Qt::Key_Home),
              [this] { showAt("index"); });
    back->setEnabled(false);
    on->setEnabled(false);
    connect(view_, &QTextBrowser::backwardAvailable, back, &QAction::setEnabled);
    connect(view_, &QTextBrowser::forwardAvailable, on, &QAction::setEnabled);

    auto* splitter = new QSplitter(this);
    splitter->addWidget(side);
    splitter->addWidget(main);
    splitter->setSizes({kListWidth, kSize.width() - kListWidth});
    splitter->setStretchFactor(1, 1);
    splitter->setChildrenCollapsible(false);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(splitter);
    resize(kSize);

    connect(search_, &QLineEdit::textChanged, this, &HelpWindow::find);
    connect(list_, &QListWidget::itemClicked, this, &HelpWindow::choose);
    connect(list_, &QListWidget::itemActivated, this, &HelpWindow::choose);
    connect(view_, &QTextBrowser::anchorClicked, this, &HelpWindow::follow);
    connect(view_, &QTextBrowser::sourceChanged, this, [this] {
        if (search_->text().isEmpty()) showContents();
    });
    addKeys();
    showContents();
}

void HelpWindow::addKeys() {
    const auto add = [this](const QKeySequence& key, auto act) {
        auto* action = new QAction(this);
        action->setShortcut(key);
        connect(action, &QAction::triggered, this, act);
        addAction(action);
    };
    add(QKeySequence::Find, [this] {
        search_->setFocus();
        search_->selectAll();
    });
    add(Qt::Key_Escape, [this] {
        if (search_->text().isEmpty()) {
            close();
        } else {
            search_->clear();
        }
    });
}

void HelpWindow::showAt(const QString& page, const QString& anchor) {
    const Page* found = book_.findPage(page);
    if (found == nullptr && !book_.pages().empty()) found = &book_.pages().front();
    if (found == nullptr) {
        view_->setPlainText(
            tr("The help is not installed. It belongs into share/trapwright/resources/docs beside the "
               "program."));
    } else {
        view_->setSource(urlOf(*found, anchor), QTextDocument::MarkdownResource);
    }
    show();
    raise();
    activateWindow();
    view_->setFocus();
}

QString HelpWindow::place() const {
    const QUrl url = view_->source();
    const QString page = QFileInfo(url.toLocalFile()).completeBaseName();
    return url.hasFragment() ? page + '#' + url.fragment() : page;
}

bool HelpWindow::eventFilter(QObject* watched, QEvent* event) {
    if (watched == search_ && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if ((key == Qt::Key_Return || key == Qt::Key_Enter) && list_->count() > 0) {
            list_->setCurrentRow(0);
            choose(list_->item(0));
            return true;
        }
        if (key == Qt::Key_Down && list_->count() > 0) {
            list_->setCurrentRow(0);
            list_->setFocus();
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

void HelpWindow::showContents() {
    list_->clear();
    list_->setAccessibleName(tr("Contents"));
    const QString here = place().section('#', 0, 0);
    for (const Page& page : book_.pages()) {
        auto* item = new QListWidgetItem(page.title, list_);
        item->setData(kPlace, QStringList{page.name, {}});
        if (page.name == here) list_->setCurrentItem(item);
    }
}

void HelpWindow::find(const QString& words) {
    if (words.trimmed().isEmpty()) {
        view_->mark({});
        return showContents();
    }
    list_->clear();
    const std::vector<Hit> hits = book_.search(words);
    list_->setAccessibleName(tr("%n place(s) found", nullptr, static_cast<int>(hits.size())));
    for (const Hit& hit : hits) {
        const QString head = hit.title == hit.pageTitle ? hit.title : hit.pageTitle + ": " + hit.title;
        auto* item = new QListWidgetItem(head + '\n' + hit.excerpt, list_);
        item->setData(kPlace, QStringList{hit.page, hit.anchor});
    }
    if (hits.empty()) {
        auto* none = new QListWidgetItem(tr("Nothing found. Try fewer or other words."), list_);
        none->setFlags(Qt::NoItemFlags);
    }
}

void HelpWindow::choose(const QListWidgetItem* item) {
    const QStringList place = item->data(kPlace).toStringList();
    if (place.isEmpty()) return;
    if (const Page* page = book_.findPage(place.front())) {
        view_->setSource(urlOf(*page, place.back()), QTextDocument::MarkdownResource);
        view_->mark(search_->text());
    }
}

void HelpWindow::follow(const QUrl& url) {
    const QUrl target = view_->source().resolved(url);
    if (target.isLocalFile()) {
        view_->setSource(target, QTextDocument::MarkdownResource);
    } else {
        QDesktopServices::openUrl(target);
    }
}

}  // namespace trapwright::help
