#pragma once

#include <QWidget>
#include <optional>

#include "core/stats/binomial.h"
#include "core/stats/stratified.h"

class QLabel;

namespace trapwright::pages {

/// The number that a page is about: success in large figures, its bounds, and what it was counted on.
class SuccessCard : public QWidget {
    Q_OBJECT
 public:
    /// `name` is stable: "review" names the number "review.success".
    SuccessCard(const QString& name, QWidget* parent);

    /// `source`: of what, in a few words ("generation 12, best so far"). A dash where success is not known.
    void show(const std::optional<stats::Count>& success, const QString& source);
    /// The same of those parts that arrive alone, where others are thrown back.
    void showCorrect(const std::optional<stats::Count>& correct, const QString& source);
    void showCorrect(const stats::WeightedRate& correct, const QString& source);
    /// The success of all parts that come, where each pose was tried by itself: `weighted` has a rate.
    void showWeighted(const stats::WeightedRate& weighted, const QString& source);

 private:
    void tell(const QString& help, const QString& source);

    QLabel* number_;
    QLabel* bounds_;
    QLabel* source_;
};

}  // namespace trapwright::pages
