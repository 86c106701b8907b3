#pragma once

#include <QWidget>

#include "core/part/part.h"
#include "core/study/settings.h"

class QLabel;
class QPushButton;

namespace trapwright::pages {

class FactList;

/// The settings that a study learns with, in a few lines to read, and the way to change them.
class EvolveSummary : public QWidget {
    Q_OBJECT
 public:
    explicit EvolveSummary(QWidget* parent);

    /// `locked`: scores belong to them.
    void show(const study::Settings& settings, const part::Part& part, bool locked);

 signals:
    void changeWanted();

 private:
    FactList* facts_;
    QLabel* reason_;
    QPushButton* change_;
};

}  // namespace trapwright::pages
