#include "ui/window/farewell.h"

#include <QDialog>
#include <QLabel>
#include <QMessageBox>
#include <QProgressBar>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/pages/page.h"

namespace trapwright::window {

namespace {

constexpr int kPatience = 250;  // [ms]: a drive that answers is left before anybody could read what is told
constexpr int kWidth = 420;     // [px]
constexpr int kLines = 4;       // of the state, which changes while it is shown

/// Ends by itself only: neither Esc nor the window manager cuts short what it tells of.
class LastingDialog : public QDialog {
 public:
    using QDialog::QDialog;
    void reject() override {}
};

}  // namespace

Farewell::Farewell(const std::vector<pages::Page*>& pages, QWidget* window)
    : QObject(window), pages_(pages), window_(window) {
    patience_.setSingleShot(true);
    patience_.setInterval(kPatience);
    connect(&patience_, &QTimer::timeout, this, &Farewell::showDialog);
    for (pages::Page* page : pages_) {
        connect(page, &pages::Page::releasing, this, &Farewell::tell);
        // What else is told of the end comes first, and whoever tells it is not destroyed by it.
        connect(page, &pages::Page::released, this, &Farewell::goOn, Qt::QueuedConnection);
    }
}

void Farewell::whenReleased(const std::function<void()>& afterwards) {
    if (waiting_.empty() && askPages()) return afterwards();
    waiting_.push_back(afterwards);
    if (!patience_.isActive() && !dialog_) patience_.start();
}

void Farewell::goOn(const QString& what, const QString& message) {
    // Something may have been begun while nothing kept the user from it.
    if (waiting_.empty() || !askPages()) return;
    patience_.stop();
    delete dialog_;
    for (const auto& afterwards : std::exchange(waiting_, {}))
        afterwards();
    // After the window has closed, if that is what was waited for: then nobody could close this.
    if (!what.isEmpty()) QTimer::singleShot(0, this, [this, what, message] { warn(what, message); });
}

bool Farewell::askPages() const {
    // All of them, so that what has to end does so at the same time.
    return std::ranges::count_if(pages_, [](pages::Page* page) { return !page->release(); }) == 0;
}

void Farewell::tell(const QString& what, const QString& state) {
    whatText_ = what;
    stateText_ = state;
    if (!dialog_) return;
    what_->setText(what);
    state_->setText(state);
}

void Farewell::showDialog() {
    auto* dialog = new LastingDialog(window_);
    dialog_ = dialog;
    dialog->setObjectName("dialog.farewell");
    dialog->setMinimumWidth(kWidth);
    what_ = new QLabel(dialog);
    what_->setObjectName("farewell.what");
    QFont bold = what_->font();
    bold.setBold(true);
    what_->setFont(bold);
    state_ = new QLabel(dialog);
    state_->setObjectName("farewell.state");
    state_->setWordWrap(true);
    state_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    state_->setMinimumHeight(kLines * state_->fontMetrics().lineSpacing());
    for (QLabel* label : {what_, state_})
        label->setTextFormat(Qt::PlainText);
    auto* bar = new QProgressBar(dialog);
    bar->setRange(0, 0);
    bar->setTextVisible(false);
    auto* column = new QVBoxLayout(dialog);
    column->setSpacing(12);
    column->addWidget(what_);
    column->addWidget(state_);
    column->addWidget(bar);
    tell(whatText_, stateText_);
    dialog->open();
}

void Farewell::warn(const QString& what, const QString& message) {
    if (!window_->isVisible()) return;
    auto* box = new QMessageBox(QMessageBox::Warning, tr("Trapwright"), what, QMessageBox::Close, window_);
    box->setObjectName("dialog.farewell.warning");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setInformativeText(message);
    for (auto* label : box->findChildren<QLabel*>())
        label->setTextFormat(Qt::PlainText);
    box->open();
}

}  // namespace trapwright::window
