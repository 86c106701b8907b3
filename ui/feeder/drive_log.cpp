#include "ui/feeder/drive_log.h"

#include <QDateTime>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QScrollBar>
#include <QStackedLayout>
#include <QTreeWidget>
#include <cmath>
#include <limits>

#include "core/base/file.h"
#include "ui/feeder/drive_link.h"
#include "ui/feeder/drive_texts.h"
#include "ui/look/file_dialog.h"
#include "ui/look/icon.h"
#include "ui/look/theme.h"
#include "ui/look/whole_headers.h"
#include "ui/session/study_feeder.h"

namespace trapwright::feeder {

using drive::LogEntry;
using drive::LogKind;

namespace {

enum Columns { Time, What };

constexpr int kMost = 5000;  // lines
constexpr int kSign = 14;

QPixmap signOf(const LogEntry& entry, const QWidget& widget) {
    if (entry.kind == LogKind::fault)
        return look::signPixmap("error", look::toneColour(look::Tone::bad, widget.palette()), kSign,
                                widget.devicePixelRatioF());
    return look::signPixmap("info", widget.palette().color(QPalette::PlaceholderText), kSign,
                            widget.devicePixelRatioF());
}

}  // namespace

DriveLog::DriveLog(DriveLink& link, QWidget* parent)
    : QWidget(parent),
      link_(link),
      list_(new QTreeWidget(this)),
      stack_(new QStackedLayout),
      remark_(new QLineEdit(this)) {
    setObjectName("driveLog");
    list_->setObjectName("driveLog.list");
    list_->setIconSize({kSign, kSign});
    list_->setAccessibleName(tr("What happened to the drive"));
    list_->setHeaderLabels({tr("Time"), tr("What happened")});
    list_->setRootIsDecorated(false);
    list_->setUniformRowHeights(true);
    list_->setFrameShape(QFrame::NoFrame);
    list_->header()->setSectionResizeMode(Time, QHeaderView::ResizeToContents);
    look::keepHeadersWhole(*list_->header());
    auto* empty =
        new QLabel(tr("Connect a drive: states, faults and remarks are listed here, and every command and "
                      "reading is saved in the study."),
                   this);
    empty->setAlignment(Qt::AlignCenter);
    empty->setWordWrap(true);
    empty->setMargin(16);
    empty->setForegroundRole(QPalette::PlaceholderText);
    stack_->addWidget(empty);
    stack_->addWidget(list_);

    remark_->setObjectName("driveLog.remark");
    remark_->setAccessibleName(tr("Remark"));
    remark_->setPlaceholderText(tr("A remark for the log"));
    connect(remark_, &QLineEdit::returnPressed, this, [this] {
        if (!remark_->text().trimmed().isEmpty()) link_.note(remark_->text().trimmed());
        remark_->clear();
    });
    auto* save = new QPushButton(look::icon("save-as"), tr("Save the whole log..."), this);
    save->setObjectName("driveLog.save");
    save->setToolTip(tr("Every command and every reading of this study, with times, as CSV"));
    connect(save, &QPushButton::clicked, this, &DriveLog::askAndSave);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(8, 4, 8, 0);
    row->addWidget(remark_, 1);
    row->addWidget(save);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addLayout(row);
    column->addLayout(stack_, 1);
    connect(&link_, &DriveLink::logged, this, &DriveLog::add);
    connect(&link_, &DriveLink::linkChanged, this, [this] { remark_->setEnabled(link_.linked()); });
    remark_->setEnabled(false);
}

void DriveLog::setFeeder(const session::StudyFeeder* feeder) {
    feeder_ = feeder;
    list_->clear();
    stack_->setCurrentIndex(0);
}

void DriveLog::add(const std::vector<LogEntry>& entries) {
    const QScrollBar* bar = list_->verticalScrollBar();
    const bool atEnd = bar->value() == bar->maximum();
    for (const LogEntry& entry : entries) {
        if (entry.kind == LogKind::command || entry.kind == LogKind::reading) continue;
        const QDateTime time = QDateTime::fromMSecsSinceEpoch(std::llround(1e3 * entry.time));
        auto* item = new QTreeWidgetItem({QLocale().toString(time, "hh:mm:ss.zzz"), entryText(entry)});
        item->setIcon(What, signOf(entry, *this));
        item->setToolTip(What, item->text(What));
        if (list_->topLevelItemCount() >= kMost) delete list_->takeTopLevelItem(0);
        list_->addTopLevelItem(item);
        stack_->setCurrentIndex(1);
    }
    if (atEnd) list_->scrollToBottom();
}

void DriveLog::askAndSave() {
    if (!feeder_) return;
    look::askForNewFile(
        this,
        {"table", tr("Save the log of the drive"), tr("Save"), tr("CSV (*.csv)"), "csv", tr("drive-log")},
        [this](const std::filesystem::path& file) {
            if (!feeder_) return;
            const auto log = feeder_->loadDriveLog(0.0, std::numeric_limits<double>::max());
            const base::Status saved =
                log ? base::writeFile(file, drive::toCsv(*log)) : base::Status(log.error());
            if (!saved)
                emit failed(tr("The log cannot be saved"), QString::fromStdString(saved.error().message));
        });
}

}  // namespace trapwright::feeder
