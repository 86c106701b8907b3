#include "ui/pages/film_frame.h"

#include <QApplication>
#include <QFontMetrics>
#include <QPainter>
#include <QPixmap>

#include "ui/models/roles.h"

namespace trapwright::pages {

namespace {

constexpr int kMargin = 4;
constexpr int kFrame = 2;
constexpr int kRadius = 3;
constexpr int kInset = 3;

}  // namespace

QSize FilmFrame::size() {
    return {kPicture.width() + 2 * kMargin,
            kPicture.height() + 2 * kMargin + QFontMetrics(QApplication::font()).height()};
}

QSize FilmFrame::sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const {
    return size();
}

void FilmFrame::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
    const QPalette& palette = option.palette;
    const bool current = option.state.testFlag(QStyle::State_Selected);
    const QRect picture(option.rect.topLeft() + QPoint(kMargin, kMargin), kPicture);
    const auto pixmap = index.data(Qt::DecorationRole).value<QPixmap>();
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (pixmap.isNull()) {
        painter->setPen(Qt::NoPen);
        painter->setBrush(palette.color(QPalette::Midlight));
        painter->drawRoundedRect(picture, kRadius, kRadius);
    } else {
        painter->drawPixmap(picture, pixmap);
    }
    if (current) {
        painter->setBrush(Qt::NoBrush);
        painter->setPen(QPen(palette.color(QPalette::Highlight), kFrame));
        painter->drawRoundedRect(picture.adjusted(-1, -1, 1, 1), kRadius, kRadius);
    }
    QFont font = option.font;
    font.setBold(current);
    painter->setFont(font);
    painter->setPen(palette.color(current ? QPalette::WindowText : QPalette::PlaceholderText));
    const QRect label(picture.left() + kInset, picture.bottom() + 1, picture.width() - 2 * kInset,
                      option.rect.bottom() - picture.bottom());
    painter->drawText(label, Qt::AlignLeft | Qt::AlignVCenter, index.data().toString());
    painter->setPen(palette.color(QPalette::WindowText));
    painter->drawText(label, Qt::AlignRight | Qt::AlignVCenter, index.data(models::SuccessRole).toString());
    painter->restore();
}

}  // namespace trapwright::pages
