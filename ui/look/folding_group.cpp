#include "ui/look/folding_group.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QSettings>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/look/icon.h"

namespace trapwright::look {

namespace {

QString settingOf(const QString& name) {
    return "folded/" + name;
}

}  // namespace

FoldingGroup::FoldingGroup(const QString& name, const QString& title, bool foldedAtFirst, QWidget* parent)
    : QWidget(parent),
      name_(name),
      title_(new QToolButton(this)),
      summary_(new QLabel(this)),
      contents_(new QWidget(this)),
      body_(new QVBoxLayout(contents_)) {
    setObjectName("group." + name);
    title_->setObjectName("group.title");
    title_->setText(title);
    title_->setAccessibleName(title);
    title_->setCheckable(true);
    title_->setAutoRaise(true);
    title_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    title_->setIconSize({14, 14});
    title_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    title_->setStyleSheet(
        "QToolButton { text-align: left; font-weight: 600; padding: 4px 2px; border: none; }"
        "QToolButton:hover, QToolButton:focus { color: palette(highlight); }");
    summary_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    summary_->setForegroundRole(QPalette::PlaceholderText);

    auto* top = new QHBoxLayout;
    top->setSpacing(8);
    top->addWidget(title_, 1);
    top->addWidget(summary_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(contents_);
    body_->setContentsMargins(18, 2, 0, 6);
    body_->setSpacing(4);

    connect(title_, &QToolButton::toggled, this, [this](bool open) {
        applyFold(!open);
        QSettings().setValue(settingOf(name_), !open);
    });
    const bool folded = QSettings().value(settingOf(name), foldedAtFirst).toBool();
    const QSignalBlocker quiet(title_);
    title_->setChecked(!folded);
    applyFold(folded);
}

void FoldingGroup::setSummary(const QString& text) {
    summary_->setText(text);
}

void FoldingGroup::setFolded(bool folded) {
    title_->setChecked(!folded);
}

bool FoldingGroup::isFolded() const {
    return !title_->isChecked();
}

void FoldingGroup::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) title_->setIcon(icon(isFolded() ? "fold" : "unfold"));
}

void FoldingGroup::applyFold(bool folded) {
    contents_->setVisible(!folded);
    title_->setIcon(icon(folded ? "fold" : "unfold"));
}

}  // namespace trapwright::look
