#pragma once

#include <QWidget>

#include "core/study/records.h"
#include "core/study/settings.h"
#include "core/track/track.h"

class QLabel;

namespace trapwright::look {
class FoldingGroup;
}

namespace trapwright::pages {

class DesignPicture;
class FactList;

/// The individual whose track is in the scene: its success and, folded, its scores, what the search knows of
/// it, its design.
class IndividualCard : public QWidget {
    Q_OBJECT
 public:
    explicit IndividualCard(QWidget* parent);

    void show(const study::Settings& settings, const study::Individual& individual);
    /// Its track, as soon as it is built.
    void showTrack(const track::Track& track);
    /// No individual yet.
    void clear();

 private:
    /// What a design of few numbers says.
    void showNumbers(const search::DesignSpace& space, const search::Design& design);

    QLabel* empty_;
    QWidget* contents_;
    FactList* success_;
    FactList* numbers_;
    look::FoldingGroup* details_;
    FactList* scores_;
    FactList* traits_;
    QLabel* lengths_;
    DesignPicture* design_;
};

}  // namespace trapwright::pages
