#pragma once

#include <QWidget>

#include "core/evolution/chromosome.h"

namespace trapwright::pages {

/// The bits of an individual's three genes, dark where they are 1: a line for each cross-section, then the
/// lengths, then the strategy values. Likeness of two individuals is seen at a glance.
class GenePicture : public QWidget {
    Q_OBJECT
 public:
    explicit GenePicture(QWidget* parent);

    /// `sections` that gene 1 describes, at least one.
    void show(const evolution::Chromosome& chromosome, int sections);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
    void paintEvent(QPaintEvent* event) override;

 private:
    [[nodiscard]] int pointsHeight() const;  // of gene 1

    evolution::Chromosome chromosome_;
    int sections_ = 1;
};

}  // namespace trapwright::pages
