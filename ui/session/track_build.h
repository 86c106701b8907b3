#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "core/search/design_space.h"
#include "core/study/settings.h"
#include "core/track/track.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

/// Builds tracks in the background, for a picture of them. The newest request wins: of those before it
/// nothing is heard.
class TrackBuild : public QObject {
    Q_OBJECT

 public:
    explicit TrackBuild(QObject* parent = nullptr);

    /// The empty layout of these settings: a flat trap between lead-in and lead-out (Figure 3).
    void buildLayout(const study::TrackSettings& settings);
    /// The track of an individual.
    void buildIndividual(const study::TrackSettings& settings, const search::Design& design);
    void cancel();

 signals:
    void built(const std::shared_ptr<const trapwright::track::Track>& track);
    void failed(const QString& message);

 private:
    void start(std::function<base::Result<track::Track>()> build);

    NewestTask task_;
};

}  // namespace trapwright::session
