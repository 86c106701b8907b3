#include "ui/window/study_card.h"

#include <QDir>
#include <QFileInfo>
#include <QKeyEvent>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/stats/binomial.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"

namespace trapwright::window {

namespace {

constexpr int kMargin = 2;
constexpr int kTextMargin = 10;
constexpr int kRemoveSize = 22;

QLabel* addLabel(QVBoxLayout& layout, QWidget* parent, bool faint) {
    auto* label = new QLabel(parent);
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    label->setContentsMargins(kTextMargin, 0, kTextMargin, 0);
    if (faint) label->setForegroundRole(QPalette::PlaceholderText);
    layout.addWidget(label);
    return label;
}

QString elided(const QLabel& label, const QString& text) {
    return label.fontMetrics().elidedText(text, Qt::ElideMiddle,
                                          StudyCard::kPicture.width() - 2 * kTextMargin);
}

QString percent(double share, int decimals = 1) {
    return QLocale().toString(100.0 * share, 'f', decimals);
}

}  // namespace

QString ageText(const QDateTime& then, const QDateTime& now) {
    const qint64 minutes = then.secsTo(now) / 60;
    const qint64 days = then.date().daysTo(now.date());
    if (minutes < 1) return StudyCard::tr("just now");
    if (minutes < 60) return StudyCard::tr("%1 min ago").arg(minutes);
    if (days == 0) return StudyCard::tr("%1 h ago").arg(minutes / 60);
    if (days == 1) return StudyCard::tr("yesterday");
    if (days < 14) return StudyCard::tr("%1 days ago").arg(days);
    if (days < 60) return StudyCard::tr("%1 weeks ago").arg(days / 7);
    return QLocale().toString(then.date(), QLocale::ShortFormat);
}

StudyCard::StudyCard(const QString& study, bool draft, QWidget* parent)
    : QPushButton(parent), study_(study), missing_(!QFileInfo::exists(study)), draft_(draft) {
    setObjectName("welcome.recent");
    setFixedSize(kSize);
    setCursor(Qt::PointingHandCursor);
    setToolTip(study);
    // Its height as well: the theme's least height of buttons would take the place of the fixed one.
    setStyleSheet(
        QString(
            "trapwright--window--StudyCard { border: 1px solid palette(mid); border-radius: 8px; "
            "background: palette(base); padding: 0px; min-height: %1px; }"
            "trapwright--window--StudyCard:hover, trapwright--window--StudyCard:focus { border: 2px solid "
            "palette(highlight); }")
            .arg(kSize.height() - 2));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(kMargin, kMargin, kMargin, 8);
    layout->setSpacing(1);
    picture_ = addLabel(*layout, this, true);
    picture_->setFixedHeight(kPicture.height());
    picture_->setContentsMargins(0, 0, 0, 0);
    picture_->setAlignment(Qt::AlignCenter);
    picture_->setWordWrap(true);

    const QFileInfo file(study);
    QLabel* name = addLabel(*layout, this, false);
    QFont bold = name->font();
    bold.setBold(true);
    name->setFont(bold);
    name->setText(elided(*name, file.completeBaseName()));
    success_ = addLabel(*layout, this, false);
    success_->setObjectName("card.success");
    QLabel* where = addLabel(*layout, this, true);
    where->setObjectName("card.age");

    const QString folder = look::pathText(file.absolutePath().toStdString());
    if (missing_) {
        picture_->setPixmap(look::icon("warning").pixmap({28, 28}, devicePixelRatioF()));
        success_->setText(tr("The file is missing"));
        where->setText(elided(*where, folder));
    } else {
        const QString age = ageText(file.lastModified(), QDateTime::currentDateTime());
        success_->setText(" ");
        where->setText(elided(*where, draft ? tr("%1, not saved yet").arg(age) : age + " · " + folder));
    }
    setAccessibleName(tr("Open %1").arg(file.completeBaseName()));
    setAccessibleDescription(success_->text().trimmed() + ' ' + where->text());
    connect(this, &QPushButton::clicked, this, [this] { emit openWanted(study_); });
    if (draft_) return;
    remove_ = new QToolButton(this);
    remove_->setObjectName("card.remove");
    remove_->setIcon(look::icon("close"));
    remove_->setIconSize({12, 12});
    remove_->setAutoRaise(true);
    remove_->setFixedSize(kRemoveSize, kRemoveSize);
    remove_->move(kSize.width() - kRemoveSize - 6, 6);
    remove_->setToolTip(tr("Take it off this list (Delete); the file stays"));
    remove_->setAccessibleName(tr("Take %1 off the list").arg(file.completeBaseName()));
    remove_->setFocusPolicy(Qt::NoFocus);
    connect(remove_, &QToolButton::clicked, this, [this] { emit removeWanted(study_); });
}

void StudyCard::setCover(const StudyCover& cover) {
    if (missing_) return;
    if (!cover.picture.isNull()) {
        picture_->setPixmap(QPixmap::fromImage(cover.picture));
    } else {
        picture_->setText(cover.part);
    }
    if (cover.success) {
        const auto& [ofArriving, rate, bounds, count, finished] = *cover.success;
        success_->setText(
            (ofArriving ? tr("<b>%1 %</b> correct (%2 … %3)") : tr("<b>%1 %</b> success (%2 … %3)"))
                .arg(percent(rate, stats::countPercentDecimals(rate)), percent(bounds.low),
                     percent(bounds.high)));
        const QString told =
            ofArriving ? tr("%L1 of the %L2 parts that arrived are right, of %L3 that were fed; in brackets "
                            "the 95 % bounds.")
                             .arg(count.successes)
                             .arg(finished)
                             .arg(count.trials)
                       : tr("%L1 of %L2 parts ended as wanted; in brackets the 95 % bounds.")
                             .arg(count.successes)
                             .arg(count.trials);
        setToolTip(study_ + '\n' + told);
    } else if (cover.generations > 0) {
        success_->setText(tr("%1 of %2 generations").arg(cover.generations).arg(cover.wanted));
    } else {
        success_->setText(tr("Nothing learned yet"));
    }
    QString plain = success_->text();
    setAccessibleDescription(plain.remove("<b>").remove("</b>"));
}

void StudyCard::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Delete && !draft_) {
        emit removeWanted(study_);
    } else {
        QPushButton::keyPressEvent(event);
    }
}

}  // namespace trapwright::window
