#pragma once

#include <QAction>
#include <QObject>
#include <vector>

#include "core/study/physical_validation.h"

namespace trapwright::feeder {

class DriveLink;
class TrialGuide;

/// What the operator does at the feeder, each by one key. Each is enabled when it can be done.
class GuideActions : public QObject {
    Q_OBJECT
 public:
    GuideActions(TrialGuide& guide, DriveLink& link, QObject* parent);

    QAction* start() { return start_; }
    /// Success, wrong orientation, stuck, fell off.
    [[nodiscard]] const std::vector<QAction*>& outcomes() const { return outcomes_; }
    QAction* undo() { return undo_; }
    QAction* note() { return note_; }
    QAction* pause() { return pause_; }
    QAction* stop() { return stop_; }
    /// All of them, in this order.
    [[nodiscard]] QList<QAction*> all() const;

 private:
    QAction* make(const QString& name, const QString& icon, const QString& text, const QKeySequence& key,
                  const QString& tip);
    void addOutcome(trial::Verdict outcome, const QString& name, const QString& text, Qt::Key key,
                    const QString& tip);
    void update();

    TrialGuide& guide_;
    DriveLink& link_;
    QAction* start_;
    std::vector<QAction*> outcomes_;
    QAction* undo_ = nullptr;
    QAction* note_ = nullptr;
    QAction* pause_ = nullptr;
    QAction* stop_ = nullptr;
};

}  // namespace trapwright::feeder
