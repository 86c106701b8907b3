#pragma once

#include <QStyledItemDelegate>

namespace trapwright::pages {

/// Draws one picture of the film strip: a winner with its generation and its success below, framed while
/// it is the current one.
class FilmFrame : public QStyledItemDelegate {
    Q_OBJECT
 public:
    static constexpr QSize kPicture{96, 54};  // logical pixels

    using QStyledItemDelegate::QStyledItemDelegate;

    static QSize size();

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

}  // namespace trapwright::pages
