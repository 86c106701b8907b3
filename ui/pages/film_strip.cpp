#include "ui/pages/film_strip.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QListView>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QSlider>
#include <QStackedLayout>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>

#include "core/study/selection.h"
#include "ui/look/icon.h"
#include "ui/look/theme.h"
#include "ui/pages/film_frame.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::StudyRuns;

namespace {

constexpr int kSeenDelay = 60;  // [ms] until what scrolled into view gets pictures

}  // namespace

FilmStrip::FilmStrip(QWidget* parent)
    : QWidget(parent),
      pictures_(new WinnerPictures(model_, FilmFrame::kPicture, this)),
      stack_(new QStackedLayout),
      seen_(new QTimer(this)) {
    setObjectName("filmStrip");
    setAccessibleName(tr("Winners of all generations"));
    setAttribute(Qt::WA_StyledBackground);
    setStyleSheet("#filmStrip { border-top: 1px solid palette(mid); }");
    seen_->setSingleShot(true);
    seen_->setInterval(kSeenDelay);
    connect(seen_, &QTimer::timeout, this, &FilmStrip::wantSeen);

    auto* empty =
        new QLabel(tr("The best track of each generation appears here while learning (F5) runs."), this);
    empty->setObjectName("filmStrip.empty");
    empty->setAlignment(Qt::AlignCenter);
    empty->setForegroundRole(QPalette::PlaceholderText);
    auto* contents = new QWidget(this);
    auto* column = new QVBoxLayout(contents);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(makeList());
    column->addWidget(makeControls());
    stack_->addWidget(empty);
    stack_->addWidget(contents);
    setLayout(stack_);
    setFixedHeight(contents->sizeHint().height() + 1);
    refresh();
}

QWidget* FilmStrip::makeList() {
    list_ = new QListView(this);
    list_->setObjectName("filmStrip.list");
    list_->setAccessibleName(tr("Winners"));
    list_->setModel(&model_);
    list_->setItemDelegate(new FilmFrame(list_));
    list_->setFlow(QListView::LeftToRight);
    list_->setWrapping(false);
    list_->setUniformItemSizes(true);
    list_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    list_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    // The slider below is the way through; a second bar would only confuse.
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setFixedHeight(FilmFrame::size().height());
    list_->viewport()->installEventFilter(this);
    connect(list_->horizontalScrollBar(), &QScrollBar::valueChanged, seen_, qOverload<>(&QTimer::start));
    connect(list_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this](const QModelIndex& index) {
                if (!setting_ && index.isValid()) emit picked(model_.winnerAt(index.row())->generation);
            });
    connect(list_, &QListView::clicked, this,
            [this](const QModelIndex& index) { emit picked(model_.winnerAt(index.row())->generation); });
    return list_;
}

QWidget* FilmStrip::makeControls() {
    auto* controls = new QWidget(this);
    slider_ = new QSlider(Qt::Horizontal, controls);
    slider_->setObjectName("filmStrip.slider");
    slider_->setAccessibleName(tr("Generation whose winner is shown"));
    slider_->setPageStep(10);
    connect(slider_, &QSlider::valueChanged, this, [this](int row) {
        if (const study::Individual* winner = model_.winnerAt(row); !setting_ && winner != nullptr)
            emit picked(winner->generation);
    });
    caption_ = new QLabel(controls);
    caption_->setObjectName("filmStrip.caption");
    follow_ = new QToolButton(controls);
    follow_->setObjectName("filmStrip.follow");
    follow_->setText(tr("Follow the best"));
    follow_->setToolTip(
        tr("Show the winner with the greatest success, and each better one as soon as it is there (Esc)"));
    look::drawAsButton(*follow_);
    follow_->setCheckable(true);
    follow_->setIcon(look::icon("to-end"));
    // Checked as long as it is so; a click cannot end it, looking at another winner does.
    connect(follow_, &QToolButton::clicked, this, [this] {
        follow_->setChecked(true);
        emit followWanted();
    });
    auto* row = new QHBoxLayout(controls);
    row->setContentsMargins(12, 2, 8, 4);
    row->setSpacing(12);
    row->addWidget(caption_);
    row->addWidget(slider_, 1);
    row->addWidget(follow_);
    return controls;
}

void FilmStrip::setRuns(const StudyRuns* runs) {
    if (runs_) runs_->disconnect(this);
    runs_ = runs;
    if (runs_) {
        connect(runs_, &StudyRuns::generationSaved, this, [this] {
            const QScopedValueRollback<bool> setting(setting_, true);
            model_.append(runs_->winners().back());
            slider_->setMaximum(model_.rowCount() - 1);
            stack_->setCurrentIndex(1);
            seen_->start();
        });
    }
    refresh();
}

void FilmStrip::setCurrent(int generation, const QString& caption, bool following) {
    const QScopedValueRollback<bool> setting(setting_, true);
    const int row = model_.rowOf(generation);
    caption_->setText(caption);
    follow_->setChecked(following);
    if (row < 0) return;
    slider_->setValue(row);
    list_->setCurrentIndex(model_.index(row));
    list_->scrollTo(model_.index(row), QAbstractItemView::EnsureVisible);
    seen_->start();
}

void FilmStrip::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && slider_ != nullptr) redraw();
}

void FilmStrip::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    seen_->start();
}

bool FilmStrip::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize) seen_->start();
    // A wheel turns the strip sideways.
    if (event->type() == QEvent::Wheel) {
        const QPoint turned = static_cast<QWheelEvent*>(event)->angleDelta();
        QScrollBar* bar = list_->horizontalScrollBar();
        bar->setValue(bar->value() - (turned.x() != 0 ? turned.x() : turned.y()));
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void FilmStrip::refresh() {
    const QScopedValueRollback<bool> setting(setting_, true);
    const bool dark = look::schemeOf(palette()) == look::Scheme::dark;
    pictures_->setTracks(runs_ ? runs_->design().settings().track : study::TrackSettings());
    pictures_->setLook(dark, devicePixelRatioF());
    model_.setForgiving(runs_ && study::forgivesFalls(runs_->design().settings().evolution));
    model_.setWinners(runs_ ? runs_->winners() : std::vector<study::Individual>());
    slider_->setRange(0, std::max(model_.rowCount() - 1, 0));
    stack_->setCurrentIndex(model_.rowCount() > 0 ? 1 : 0);
    seen_->start();
}

void FilmStrip::redraw() {
    const int row = slider_->value();
    refresh();
    const QScopedValueRollback<bool> setting(setting_, true);
    slider_->setValue(row);
    list_->setCurrentIndex(model_.index(row));
}

void FilmStrip::wantSeen() {
    if (!isVisible() || model_.rowCount() == 0) return;
    const QRect area = list_->viewport()->rect();
    const int y = area.center().y();
    const int first = std::max(list_->indexAt({area.left(), y}).row(), 0);
    const QModelIndex atEnd = list_->indexAt({area.right(), y});
    const int last = atEnd.isValid() ? atEnd.row() : model_.rowCount() - 1;
    std::deque<int> seen;
    for (int row = last; row >= first; --row)
        seen.push_back(model_.winnerAt(row)->generation);
    pictures_->want(std::move(seen));
}

}  // namespace trapwright::pages
