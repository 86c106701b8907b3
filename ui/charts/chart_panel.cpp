#include "ui/charts/chart_panel.h"

#include <QAction>
#include <QApplication>
#include <QBuffer>
#include <QClipboard>
#include <QEvent>
#include <QGraphicsView>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QStackedLayout>
#include <QSvgGenerator>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/base/file.h"
#include "ui/charts/legend.h"
#include "ui/charts/plot.h"
#include "ui/look/file_dialog.h"
#include "ui/look/icon.h"

namespace trapwright::charts {

namespace {

constexpr int kMargin = 8;
constexpr double kPictureRatio = 2.0;

QToolButton* makeButton(QWidget* parent, const QString& icon, const QString& name, const QString& tip) {
    auto* button = new QToolButton(parent);
    button->setAutoRaise(true);
    button->setIcon(look::icon(icon));
    button->setToolTip(tip);
    button->setAccessibleName(name);
    return button;
}

}  // namespace

ChartPanel::ChartPanel(const QString& name, const QString& title, QWidget* parent)
    : QWidget(parent),
      title_(title),
      theme_(ChartTheme::from(palette())),
      legend_(new Legend(this)),
      empty_(new QLabel),
      stack_(new QStackedLayout),
      fitButton_(makeButton(this, "fit", tr("Show all"), {})),
      more_(makeButton(this, "more", tr("Save or copy"), tr("Save or copy the chart"))) {
    setObjectName(name);
    setAccessibleName(title);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    empty_->setMargin(2 * kMargin);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    legend_->setTheme(theme_);

    savePicture_ = addPanelAction(tr("Save picture..."), QKeySequence::Save, &ChartPanel::askAndSavePicture);
    saveCsv_ =
        addPanelAction(tr("Save numbers as CSV..."), QKeySequence("Ctrl+E"), &ChartPanel::askAndSaveCsv);
    copyPicture_ = addPanelAction(tr("Copy picture"), QKeySequence::Copy, &ChartPanel::copyPicture);
    auto* menu = new QMenu(this);
    menu->addActions({savePicture_, saveCsv_, copyPicture_});
    more_->setMenu(menu);
    more_->setPopupMode(QToolButton::InstantPopup);
    fitButton_->hide();

    auto* top = new QHBoxLayout;
    top->setContentsMargins(kMargin, kMargin / 2, kMargin / 2, 0);
    top->setSpacing(2);
    top->addWidget(legend_, 1);
    top->addWidget(fitButton_, 0, Qt::AlignTop);
    top->addWidget(more_, 0, Qt::AlignTop);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(top);
    column->addLayout(stack_, 1);
    stack_->addWidget(empty_);
    setContextMenuPolicy(Qt::ActionsContextMenu);
}

QAction* ChartPanel::addPanelAction(const QString& text, const QKeySequence& key, void (ChartPanel::*act)()) {
    auto* action = new QAction(text, this);
    action->setShortcut(key);
    // Only in the chart, so no menu shows the key.
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    action->setShortcutVisibleInContextMenu(false);
    connect(action, &QAction::triggered, this, act);
    addAction(action);
    return action;
}

void ChartPanel::setEmptyText(const QString& text) {
    empty_->setText(text);
}

void ChartPanel::setBody(QWidget* body, QWidget* content) {
    body_ = body;
    content_ = content != nullptr ? content : body;
    stack_->addWidget(body);
    showEmpty(true);
}

void ChartPanel::setFitAction(QAction* action) {
    fitButton_->setDefaultAction(action);
    action->setIcon(look::icon("fit"));
    fitButton_->setVisible(body_ != nullptr && stack_->currentWidget() == body_);
}

void ChartPanel::showEmpty(bool empty) {
    stack_->setCurrentWidget(empty ? static_cast<QWidget*>(empty_) : body_);
    legend_->setVisible(!empty);
    fitButton_->setVisible(!empty && fitButton_->defaultAction() != nullptr);
    more_->setVisible(!empty);
    for (QAction* action : {savePicture_, saveCsv_, copyPicture_})
        action->setEnabled(!empty);
}

void ChartPanel::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    const bool looksOther = event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange;
    if (!looksOther || body_ == nullptr) return;
    theme_ = ChartTheme::from(palette());
    legend_->setTheme(theme_);
    applyTheme(theme_);
}

QSize ChartPanel::pictureSize() const {
    return size().expandedTo({content_ != nullptr ? content_->minimumSizeHint().width() : 0, 0});
}

QImage ChartPanel::picture(QSize size, double devicePixelRatio) {
    QImage image(size * devicePixelRatio, QImage::Format_RGB32);
    image.setDevicePixelRatio(devicePixelRatio);
    QPainter painter(&image);
    paintPicture(painter, size);
    return image;
}

void ChartPanel::paintPicture(QPainter& painter, QSize size) {
    const ChartTheme paper = ChartTheme::paper();
    const QRect shown = content_->geometry();
    legend_->setTheme(paper);
    applyTheme(paper);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(QRect(QPoint(0, 0), size), paper.background);
    QFont titleFont = font();
    titleFont.setBold(true);
    painter.setFont(titleFont);
    painter.setPen(paper.text);
    const int titleHeight = QFontMetrics(titleFont).height();
    const QRect line(kMargin, kMargin, size.width() - 2 * kMargin, titleHeight);
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, title_);
    const int top =
        line.bottom() + kMargin / 2 + legend_->paint(painter, line.translated(0, titleHeight + kMargin / 2));

    content_->resize(size.width(), size.height() - top);
    content_->layout()->activate();
    // Lays out what was never shown, too.
    content_->grab();
    for (QGraphicsView* view : content_->findChildren<QGraphicsView*>()) {
        if (!view->isVisibleTo(content_)) continue;
        auto* const plot = qobject_cast<Plot*>(view);
        if (plot != nullptr) plot->setPicturing(true);
        view->render(&painter, QRectF(view->geometry().translated(0, top)), view->viewport()->rect());
        if (plot != nullptr) plot->setPicturing(false);
    }

    content_->setGeometry(shown);
    legend_->setTheme(theme_);
    applyTheme(theme_);
}

base::Status ChartPanel::savePicture(const std::filesystem::path& path) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    const QSize area = pictureSize();
    if (path.extension() == ".svg") {
        QSvgGenerator generator;
        generator.setOutputDevice(&buffer);
        generator.setSize(area);
        generator.setResolution(logicalDpiX());  // letters as large as on the screen
        generator.setViewBox(QRect(QPoint(0, 0), area));
        generator.setTitle(title_);
        QPainter painter(&generator);
        paintPicture(painter, area);
    } else if (path.extension() == ".png") {
        picture(area, kPictureRatio).save(&buffer, "PNG");
    } else {
        return base::Error{path.string() + ": a chart is saved as .png or .svg. Choose such a name."};
    }
    return base::writeFile(path, std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
}

base::Status ChartPanel::saveCsv(const std::filesystem::path& path) const {
    return base::writeFile(path, csv().toStdString());
}

void ChartPanel::askAndSavePicture() {
    const look::FileQuestion question{"chart",    tr("Save picture of %1").arg(title_),
                                      tr("Save"), tr("Pictures (*.png *.svg)"),
                                      "png",      objectName()};
    look::askForNewFile(this, question, [this](const std::filesystem::path& path) {
        report(tr("Saving the picture"), savePicture(path), path);
    });
}

void ChartPanel::askAndSaveCsv() {
    const look::FileQuestion question{
        "chart", tr("Save numbers of %1").arg(title_), tr("Save"), tr("Tables (*.csv)"), "csv", objectName()};
    look::askForNewFile(this, question, [this](const std::filesystem::path& path) {
        report(tr("Saving the numbers"), saveCsv(path), path);
    });
}

void ChartPanel::copyPicture() {
    QApplication::clipboard()->setImage(picture(pictureSize(), kPictureRatio));
}

void ChartPanel::report(const QString& what, const base::Status& status, const std::filesystem::path& path) {
    if (status) {
        emit saved(QString::fromStdString(path.string()));
    } else {
        emit failed(what, QString::fromStdString(status.error().message));
    }
}

}  // namespace trapwright::charts
