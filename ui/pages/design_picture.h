#pragma once

#include <QWidget>

#include "core/search/design_space.h"

namespace trapwright::pages {

/// The numbers of a design, the larger the darker, in the lines of their dimensions: of a free-form trap one
/// for each cross-section, then the segments' lengths. Likeness of two individuals is seen at a glance.
class DesignPicture : public QWidget {
    Q_OBJECT
 public:
    explicit DesignPicture(QWidget* parent);

    void show(const search::Design& design, const search::DesignSpace& space);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

 private:
    /// One number and where it is shown.
    struct Cell {
        QRectF area;
        double value = 0.0;
        QString text;  // what it is, for the tool tip
    };
    [[nodiscard]] std::vector<Cell> cells() const;
    [[nodiscard]] double lineHeight() const;

    search::Design design_;
    std::vector<search::Dimension> dimensions_;
    int lines_ = 1;
};

}  // namespace trapwright::pages
