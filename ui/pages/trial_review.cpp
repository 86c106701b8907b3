#include "ui/pages/trial_review.h"

#include <algorithm>

#include "core/study/pose_weights.h"
#include "core/study/validation.h"
#include "core/trial/orientations.h"
#include "ui/charts/orientation_chart.h"
#include "ui/models/numbers.h"
#include "ui/pages/playback_bar.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::ListedTrials;
using session::StudyReplays;
using workflow::TrialKind;

namespace {

constexpr double kInterval = 1e-3;         // between the samples of a replay [s]
constexpr double kStreamInterval = 10e-3;  // the same of a minute with many parts

bool isSame(const workflow::TrialsRequest& a, const workflow::TrialsRequest& b) {
    return a.kind == b.kind && a.poses == b.poses && a.robustness == b.robustness && a.stream == b.stream &&
           isSameIndividual(a.winner, b.winner);
}

/// Of those in the slice, if there is one.
std::vector<models::TrialRow> makeRows(const ListedTrials& trials, const part::SymmetryGroup& symmetry,
                                       const std::optional<study::BoxSlice>& slice) {
    std::vector<models::TrialRow> rows;
    // As many of each pose, one pose after the other.
    const std::vector<int>& poses = trials.request.poses;
    const std::size_t ofEachPose =
        std::max<std::size_t>(1, static_cast<std::size_t>(trials.wanted) / poses.size());
    for (std::size_t i = 0; i < trials.outcomes.size(); ++i) {
        if (slice && (i >= trials.places.size() || !slice->holds(trials.places[i]))) continue;
        if (trials.request.kind == TrialKind::stream) {
            // Of all its parts together it tells how long it lasts.
            trial::PartOutcome whole;
            whole.ending = trial::Ending::timedOut;
            whole.time = trials.request.stream->settings.warmUp + trials.request.stream->settings.duration;
            rows.push_back({static_cast<int>(i), -1, trials.judged.verdicts[i], whole});
            continue;
        }
        const trial::PartOutcome& outcome = trials.outcomes[i].parts.front();
        const int pose = trials.request.kind == TrialKind::validation
                             ? poses[std::min(i / ofEachPose, poses.size() - 1)]
                             : -1;
        models::TrialRow row{static_cast<int>(i), pose, trials.judged.verdicts[i], outcome};
        if (outcome.ending == trial::Ending::finished)
            row.angle = trial::calcAngleToGoal(outcome.farthest.rotation, trials.judged.goal, symmetry);
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

TrialReview::TrialReview(QObject* parent)
    : QObject(parent),
      player_(this),
      list_(new TrialList),
      bar_(new PlaybackBar(player_)),
      orientation_(new charts::OrientationChart) {
    connect(list_, &TrialList::sourceChosen, this, &TrialReview::setSource);
    connect(list_, &TrialList::stopWanted, this, [this] {
        if (study_) study_->cancelSimulations();
        requested_.clear();
        list_->setTrials(list_->trials().rows(), 0);
    });
    connect(list_, &TrialList::chosenChanged, this, &TrialReview::wantReplays);
    connect(list_, &TrialList::playWanted, this, [this] {
        player_.setTime(0.0);
        player_.play();
    });
    connect(bar_, &PlaybackBar::viewChanged, this, [this](const ReplayView& view) { scene_.setView(view); });
    connect(&player_, &ReplayPlayer::timeChanged, this, [this](double time) { scene_.showTime(time); });
    connect(orientation_, &charts::ChartPanel::failed, this, &TrialReview::failed);
    connect(&build_, &session::TrackBuild::built, this,
            [this](const std::shared_ptr<const track::Track>& track) {
                track_ = track;
                showTrack();
                wantReplays();
            });
    connect(&build_, &session::TrackBuild::failed, this,
            [this](const QString& message) { emit failed(tr("The track cannot be shown"), message); });
    setWinner(std::nullopt);
}

TrialReview::~TrialReview() {
    // What the window took is the window's.
    for (QWidget* widget :
         {static_cast<QWidget*>(list_), static_cast<QWidget*>(bar_), static_cast<QWidget*>(orientation_)})
        if (widget != nullptr && widget->parent() == nullptr) delete widget;
}

TrialList* TrialReview::list() const {
    return list_;
}

PlaybackBar* TrialReview::bar() const {
    return bar_;
}

charts::OrientationChart* TrialReview::orientation() const {
    return orientation_;
}

void TrialReview::setReplays(StudyReplays* study) {
    if (study_) study_->disconnect(this);
    study_ = study;
    setWinner(std::nullopt);
    if (!study_) return;
    bar_->setFrequency(study_->design().settings().simulation.drive.frequency);
    connect(study_, &StudyReplays::trialsArrived, this, &TrialReview::takeTrials);
    connect(study_, &StudyReplays::trialsListed, this, &TrialReview::takeTrials);
    connect(study_, &StudyReplays::replayed, this, &TrialReview::takeReplay);
}

void TrialReview::endWaiting() {
    list_->setTrials(list_->trials().rows(), 0);
}

void TrialReview::setWinner(const std::optional<study::Individual>& winner) {
    winner_ = winner;
    track_.reset();
    build_.cancel();
    source_ = 0;
    place_.reset();
    forgetTrials();
    makeSources();
    showTrack();
    list_->setEmptyText(winner
                            ? tr("This track was never simulated. Compare the winners or validate it first.")
                            : tr("Learn a track first: its trials are listed here."));
    bar_->setHint(winner ? tr("Choose a trial to replay it") : QString());
    if (!winner_) return;
    build_.buildIndividual(study_->design().settings().track, winner_->record.design);
    wantTrials();
}

void TrialReview::refreshSources() {
    std::optional<TrialSource> before;
    if (source_ < static_cast<int>(sources_.size())) before = sources_[static_cast<std::size_t>(source_)];
    makeSources();
    const auto same = std::find_if(sources_.begin(), sources_.end(), [&](const TrialSource& source) {
        return before && isSame(source.request, before->request) && source.count == before->count &&
               source.slice == before->slice;
    });
    // A new validation may expect another orientation.
    if (same == sources_.end() || same->request.kind == TrialKind::validation) return setSource(0);
    source_ = static_cast<int>(same - sources_.begin());
    list_->setSources(sources_, source_);
}

void TrialReview::setScene(scene::SceneView* scene) {
    visible_ = scene != nullptr;
    scene_.setScene(scene);
    if (!visible_) player_.pause();
    wantTrials();
}

void TrialReview::goToTrials(const std::vector<int>& poses, const std::set<trial::Verdict>& verdicts) {
    const auto wanted = std::find_if(sources_.begin(), sources_.end(), [&](const TrialSource& source) {
        const std::vector<int>& own = source.request.poses;
        return source.request.kind == TrialKind::validation && !poses.empty() &&
               std::find(own.begin(), own.end(), poses.front()) != own.end();
    });
    if (wanted == sources_.end()) return;
    list_->setVerdicts(verdicts);
    const auto index = static_cast<int>(wanted - sources_.begin());
    const bool oneOfSeveral = poses.size() == 1 && wanted->request.poses.size() > 1;
    if (index != source_) setSource(index);
    list_->setPose(oneOfSeveral ? std::optional(poses.front()) : std::nullopt);
    playWanted_ = true;
    playFirstShown();
}

void TrialReview::goToRobustness(const workflow::RobustnessTrials& trials, const QString& name,
                                 const std::set<trial::Verdict>& verdicts) {
    if (!winner_) return;
    workflow::TrialsRequest request{workflow::TrialKind::robustness, *winner_};
    request.robustness = trials;
    goToPlace({name, request, trials.trials.count}, verdicts);
}

void TrialReview::goToStream(const workflow::StreamTrials& trials, const QString& name) {
    if (!winner_) return;
    workflow::TrialsRequest request{TrialKind::stream, *winner_};
    request.stream = trials;
    goToPlace({name, request, trials.settings.streams},
              {trial::Verdict::success, trial::Verdict::wrongOrientation, trial::Verdict::stuck,
               trial::Verdict::fellOff});
}

std::vector<trial::Verdict> TrialReview::judgeParts(const workflow::TrialsRequest& request,
                                                    const trial::Outcome& outcome) const {
    std::vector<trial::Verdict> verdicts;
    if (!request.stream) return verdicts;
    const study::Settings& settings = study_->design().settings();
    for (const trial::PartOutcome& part : outcome.parts)
        // Who is still under way at the end may do well.
        verdicts.push_back(part.ending == trial::Ending::timedOut
                               ? trial::Verdict::success
                               : trial::judge(part, request.stream->goal, study_->design().part()->symmetry,
                                              settings.validation.tolerance));
    return verdicts;
}

void TrialReview::goToSlice(const QString& name, const study::BoxSlice& slice, int count,
                            const std::set<trial::Verdict>& verdicts) {
    if (!winner_) return;
    workflow::TrialsRequest request{TrialKind::validation, *winner_, {}};
    for (const TrialSource& source : sources_)
        if (source.request.kind == TrialKind::validation && !source.slice)
            request.poses.insert(request.poses.end(), source.request.poses.begin(),
                                 source.request.poses.end());
    std::sort(request.poses.begin(), request.poses.end());
    goToPlace({tr("Validation, %1").arg(name), request, count, slice}, verdicts);
}

void TrialReview::goToPlace(const TrialSource& place, const std::set<trial::Verdict>& verdicts) {
    const bool isThere = place_ && isSame(place_->request, place.request) && place_->slice == place.slice;
    place_ = place;
    makeSources();
    list_->setVerdicts(verdicts);
    const auto index = static_cast<int>(sources_.size()) - 1;
    if (!isThere || index != source_) setSource(index);
    list_->setPose(std::nullopt);
    playWanted_ = true;
    playFirstShown();
}

void TrialReview::showTrack() {
    scene_.setTrack(track_, study_ && track_ ? study_->design().part() : nullptr);
    player_.setDuration(scene_.duration());
}

void TrialReview::makeSources() {
    sources_.clear();
    if (study_ && winner_) {
        const auto isWinner = [this](const auto& record) { return isSameIndividual(record, *winner_); };
        if (winner_->record.trials > 0)
            sources_.push_back({tr("Learning"), {TrialKind::learning, *winner_}, winner_->record.trials});
        int selected = 0;
        for (const study::SelectionRecord& selection : study_->runs().selections())
            for (const study::SelectionEntry& entry : selection.entries)
                if (isWinner(entry)) selected = entry.trials;
        if (selected > 0) sources_.push_back({tr("Comparison"), {TrialKind::selection, *winner_}, selected});
        const study::ValidationRecord* last = nullptr;
        for (const study::ValidationRecord& validation : study_->runs().validations())
            if (isWinner(validation)) last = &validation;
        if (last != nullptr) {
            const study::ValidationTable table = study::tabulate(
                *last, study::weighPoseGroups(*study_->design().part(), study_->design().settings()));
            for (const study::ValidationGroup& group : table.groups) {
                std::vector<int> poses;
                for (const study::ValidationRow& row : group.rows)
                    poses.push_back(row.pose);
                sources_.push_back({tr("Validation, %1").arg(models::poseName(poses)),
                                    {TrialKind::validation, *winner_, poses},
                                    group.sum.tally.trials()});
            }
        }
        if (place_) sources_.push_back(*place_);
    }
    list_->setSources(sources_, source_);
}

void TrialReview::setSource(int source) {
    source_ = source;
    list_->setSources(sources_, source_);
    forgetTrials();
    wantTrials();
}

void TrialReview::forgetTrials() {
    if (listed_ && study_) study_->cancelSimulations();
    listed_ = false;
    playWanted_ = false;
    counting_.cancel();
    wanted_.clear();
    requested_.clear();
    replays_.clear();
    differences_.clear();
    list_->setTrials({}, 0);
    list_->setOrigin({});
    orientation_->clear();
    showReplays();
}

void TrialReview::wantTrials() {
    if (listed_ || !visible_ || !study_ || source_ < 0 || source_ >= static_cast<int>(sources_.size()))
        return;
    listed_ = true;
    const TrialSource& source = sources_[static_cast<std::size_t>(source_)];
    list_->setEmptyText(tr("The trials are on their way."));
    list_->setTrials({}, source.count);
    study_->requestTrials(source.request);
}

bool TrialReview::isShown(const workflow::TrialsRequest& request) const {
    return listed_ && isSame(request, sources_[static_cast<std::size_t>(source_)].request);
}

void TrialReview::takeTrials(const ListedTrials& trials) {
    if (!isShown(trials.request)) return;
    showOrigin(trials);
    const double tolerance = study_->design().settings().validation.tolerance;
    counting_.start([this, trials, tolerance, slice = sources_[static_cast<std::size_t>(source_)].slice,
                     part = study_->design().part()]() -> session::NewestTask::Deliver {
        auto rows = makeRows(trials, part->symmetry, slice);
        std::vector<trial::Outcome> outcomes;
        outcomes.reserve(rows.size());
        for (const models::TrialRow& row : rows)
            outcomes.push_back(trials.outcomes[static_cast<std::size_t>(row.trial)]);
        auto shares = study::calcOrientationShares(*part, outcomes, trials.judged.goal);
        const bool all = static_cast<int>(trials.outcomes.size()) == trials.wanted;
        const int wanted = all ? static_cast<int>(rows.size()) : trials.wanted;
        return [this, rows = std::move(rows), shares = std::move(shares), tolerance, wanted]() mutable {
            showTrials(std::move(rows), wanted, std::move(shares), tolerance);
        };
    });
}

void TrialReview::showOrigin(const ListedTrials& trials) {
    const QString maker = QString::fromStdString(trial::describe(trials.maker));
    list_->setOrigin(trials.stored ? tr("As stored: %1.").arg(maker)
                                   : tr("Not stored in this study. Simulated again: %1.").arg(maker));
}

void TrialReview::showTrials(std::vector<models::TrialRow> rows, int wanted, study::OrientationShares shares,
                             double tolerance) {
    list_->setTrials(std::move(rows), wanted);
    orientation_->setShares(std::move(shares), tolerance);
    playFirstShown();
}

void TrialReview::playFirstShown() {
    const std::optional<int> first = list_->firstShown();
    if (!first) return;
    // Something to see before anything was asked for; it stands still.
    if (playWanted_ || list_->chosen().empty()) list_->select(*first);
}

void TrialReview::wantReplays() {
    const std::vector<int> chosen = list_->chosen();
    emit chosenChanged();
    if (chosen == wanted_ || !track_ || !listed_) return;
    const bool other = wanted_.empty() || chosen.empty() || chosen.front() != wanted_.front();
    wanted_ = chosen;
    if (other) {
        player_.pause();
        player_.setTime(0.0);
    }
    std::erase_if(replays_, [this](const ReplayedTrial& replay) {
        return std::find(wanted_.begin(), wanted_.end(), replay.trial) == wanted_.end();
    });
    for (const int trial : wanted_) {
        const bool there = std::any_of(replays_.begin(), replays_.end(),
                                       [&](const ReplayedTrial& replay) { return replay.trial == trial; });
        if (there || std::find(requested_.begin(), requested_.end(), trial) != requested_.end()) continue;
        requested_.push_back(trial);
        const workflow::TrialsRequest& request = sources_[static_cast<std::size_t>(source_)].request;
        study_->replay(request, trial, request.stream ? kStreamInterval : kInterval);
    }
    showReplays();
}

void TrialReview::takeReplay(const workflow::TrialsRequest& request, int trial,
                             const std::shared_ptr<const trial::Trajectory>& trajectory,
                             const std::optional<workflow::OutcomeDifference>& difference) {
    if (!isShown(request) || !track_) return;
    std::erase(requested_, trial);
    if (difference) differences_.insert_or_assign(trial, *difference);
    if (std::find(wanted_.begin(), wanted_.end(), trial) == wanted_.end()) return;
    const int row = list_->trials().rowOf(trial);
    replays_.push_back(
        {trial,
         row < 0 ? trial::Verdict::success : list_->trials().rows()[static_cast<std::size_t>(row)].verdict,
         std::make_shared<const trial::RecordedMotion>(*trajectory, track_->shape),
         judgeParts(request, trajectory->outcome)});
    showReplays();
    if (playWanted_ && trial == wanted_.front()) {
        playWanted_ = false;
        player_.play();
    }
}

/// In the order in which they are wanted: the first one is the part itself.
void TrialReview::showReplays() {
    std::vector<ReplayedTrial> shown;
    for (const int trial : wanted_) {
        const auto replay = std::find_if(replays_.begin(), replays_.end(),
                                         [&](const ReplayedTrial& one) { return one.trial == trial; });
        if (replay != replays_.end()) shown.push_back(*replay);
    }
    // Ghosts without the part would take its place.
    if (!shown.empty() && shown.front().trial != wanted_.front()) shown.clear();
    scene_.setTrials(std::move(shown));
    player_.setDuration(scene_.duration());
    showDifferences();
}

void TrialReview::showDifferences() {
    std::vector<int> others;
    for (const ReplayedTrial& replay : scene_.trials())
        if (differences_.contains(replay.trial)) others.push_back(replay.trial);
    if (others.empty()) return bar_->setWarning({}, {});
    QString what = tr("This replay of trial %1 ends otherwise than the stored trial").arg(others.front());
    if (others.size() > 1)
        what += tr("; so do %n more of those shown", "", static_cast<int>(others.size()) - 1);
    bar_->setWarning(what, QString::fromStdString(workflow::describe(differences_.at(others.front()))));
}

}  // namespace trapwright::pages
