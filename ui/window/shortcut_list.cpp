#include "ui/window/shortcut_list.h"

#include <QAction>
#include <QDialog>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/pages/page.h"

namespace trapwright::window {

namespace {

QString plain(QString text) {
    text.remove('&');
    while (text.endsWith("…") || text.endsWith('.'))
        text.chop(1);
    return text;
}

class Collector {
 public:
    std::vector<Shortcut> found;

    void menu(const QMenu& menu, const QString& place) {
        for (QAction* action : menu.actions()) {
            if (action->menu() != nullptr) {
                this->menu(*action->menu(), place);
            } else {
                add(*action, place);
            }
        }
    }
    void add(QAction& action, const QString& place) {
        if (action.shortcuts().isEmpty() || seen_.contains(&action)) return;
        seen_.push_back(&action);
        QStringList keys;
        for (const QKeySequence& key : action.shortcuts())
            keys.push_back(key.toString(QKeySequence::NativeText));
        // Undo's text tells what would be undone at the moment.
        const QVariant lasting = action.property(kLastingText);
        found.push_back({place, plain(lasting.isValid() ? lasting.toString() : action.text()),
                         keys.join(QObject::tr(" or "))});
    }

 private:
    QList<const QAction*> seen_;
};

}  // namespace

std::vector<Shortcut> findShortcuts(const QWidget& window) {
    Collector collector;
    if (const auto* bar = window.findChild<QMenuBar*>()) {
        for (const QAction* action : bar->actions())
            if (action->menu() != nullptr) collector.menu(*action->menu(), plain(action->text()));
    }
    for (const pages::Page* page : window.findChildren<pages::Page*>())
        for (QAction* action : page->actions())
            collector.add(*action, page->face().title);
    return collector.found;
}

QString shortcutTable(const std::vector<Shortcut>& shortcuts) {
    QString table = "| where | what | keys |\n|---|---|---|\n";
    for (const Shortcut& shortcut : shortcuts)
        table += QString("| %1 | %2 | %3 |\n").arg(shortcut.place, shortcut.text, shortcut.keys);
    return table;
}

void showShortcuts(QWidget* parent, const std::vector<Shortcut>& shortcuts) {
    auto* dialog = new QDialog(parent);
    dialog->setObjectName("dialog.shortcuts");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(QObject::tr("Keyboard shortcuts"));
    auto* search = new QLineEdit(dialog);
    search->setObjectName("shortcuts.search");
    search->setPlaceholderText(QObject::tr("Search"));
    search->setAccessibleName(QObject::tr("Search"));
    search->setClearButtonEnabled(true);

    auto* tree = new QTreeWidget(dialog);
    tree->setStyleSheet("QTreeWidget::item { padding: 3px 0px; }");
    tree->setObjectName("shortcuts.list");
    tree->setAccessibleName(dialog->windowTitle());
    tree->setHeaderHidden(true);
    tree->setColumnCount(2);
    tree->setRootIsDecorated(false);
    tree->setSelectionMode(QAbstractItemView::NoSelection);
    QTreeWidgetItem* place = nullptr;
    for (const Shortcut& shortcut : shortcuts) {
        if (place == nullptr || place->text(0) != shortcut.place) {
            place = new QTreeWidgetItem(tree, {shortcut.place});
            QFont font = tree->font();
            font.setBold(true);
            place->setFont(0, font);
        }
        new QTreeWidgetItem(place, {shortcut.text, shortcut.keys});
    }
    tree->expandAll();
    tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    tree->header()->setStretchLastSection(false);
    QObject::connect(search, &QLineEdit::textChanged, tree, [tree](const QString& text) {
        for (int i = 0; i < tree->topLevelItemCount(); ++i) {
            QTreeWidgetItem* group = tree->topLevelItem(i);
            bool any = false;
            for (int j = 0; j < group->childCount(); ++j) {
                QTreeWidgetItem* item = group->child(j);
                const bool matches =
                    (item->text(0) + ' ' + item->text(1)).contains(text, Qt::CaseInsensitive);
                item->setHidden(!matches);
                any = any || matches;
            }
            group->setHidden(!any);
        }
    });

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto* layout = new QVBoxLayout(dialog);
    layout->addWidget(search);
    layout->addWidget(tree, 1);
    layout->addWidget(buttons);
    dialog->resize(480, 560);
    dialog->open();
}

}  // namespace trapwright::window
