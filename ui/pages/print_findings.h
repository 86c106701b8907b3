#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "core/study/selection.h"
#include "ui/look/theme.h"
#include "ui/pages/print_form.h"
#include "ui/scene/contents.h"
#include "ui/session/print_build.h"

class QGridLayout;
class QLabel;
class QListWidget;

namespace trapwright::pages {

class PrintRow;

/// Whether a track should be printed: its success, and what the printer makes of it, each as a line that says
/// whether it is all right, with its number; and a list of thin walls, ridges and overhangs. One of these
/// that is picked is the only one marked in the scene; with none picked all are.
class PrintFindings : public QWidget {
    Q_OBJECT
 public:
    explicit PrintFindings(QWidget* parent);

    /// `counted`: the track's success, if it is known.
    void show(const session::PrintedTrack& printed, const std::optional<study::TrackSuccess>& counted,
              const PrintChoice& choice, const track::Printer& printer);
    void clear();
    /// What is to be marked in the scene now.
    [[nodiscard]] std::vector<scene::Highlight> highlights() const;

    /// The share of parts below which the user wants to be asked before a track is exported. Remembered.
    [[nodiscard]] double leastSuccess() const { return leastSuccess_; }

 signals:
    void highlightsChanged();
    /// Help on the field at which the user is.
    void attended(const QString& label, const QString& help);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    enum Subject { success, solid, walls, overhangs, bed };

    /// A line of the verdict.
    struct Check {
        QLabel* sign;
        QLabel* text;
        look::Tone tone = look::Tone::good;
    };

    Check addCheck(QGridLayout& grid, const QString& key, const QString& name);
    void judge(Subject subject, look::Tone tone, const QString& text);
    void judgeSuccess();
    void judgeSolid(const geometry::PrintReport& report);
    void judgeWalls(const geometry::PrintReport& report, const geometry::PrintLimits& limits);
    void judgeBed(const session::PrintedTrack& printed, const track::Printer& printer);
    void addFlaw(scene::Highlight highlight, const base::Vec3& place, const QString& text);
    void listFlaws(const session::PrintedTrack& printed);
    void colour();

    std::vector<Check> checks_;            // by Subject
    std::vector<scene::Highlight> flaws_;  // by row of the list
    std::optional<study::TrackSuccess> success_;
    double leastSuccess_;
    int picked_ = -1;  // row of the last click; -1: none
    PrintRow* least_;
    QListWidget* list_;
};

/// "98.2 % (97.1 … 98.9 %) of 1,000 parts"
QString successText(const study::TrackSuccess& success);

}  // namespace trapwright::pages
