#include "core/study/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/parallel.h"
#include "core/objectives/disorder.h"
#include "core/study/orientation_shares.h"
#include "core/study/selection.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/track/track_builder.h"
#include "core/traps/groove.h"
#include "core/traps/trap_chain.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

namespace {

constexpr int kGroovesBefore = 2;      // the first turns parts along the track, the second is the run-up
constexpr int kTrialsOfWays = 3000;    // that tell the ways
constexpr std::size_t kMostWays = 14;  // others are one together
constexpr int kLeastOfWay = 40;        // trials that end so
constexpr double kNearWay = 35.0 * base::kDegree;  // what is farther from all ways is none of them
constexpr std::size_t kTrapsInRound = 32;
constexpr int kRoundsBetweenPlans = 6;
constexpr int kRoundsOfIsland = 24;  // at least
constexpr int kMostIslands = 8;
constexpr double kBitsOfBoldHalving = 0.5 * objectives::kBitsOfHalving;  // of every other island
constexpr int kFirstTrials = 6;            // from each way on average, of a trap that is new
constexpr int kMoreTrials = 24;            // of one that is promising
constexpr std::size_t kMostShared = 8;     // ways that count for the sum of these trials
constexpr double kMostFromWay = 0.3;       // of these trials
constexpr int kTrialsOfFollowed = 300;     // behind each trap, shared by the best chains
constexpr std::size_t kMostTraps = 900;    // that are kept
constexpr std::size_t kLatestTraps = 500;  // and of these, besides those that are used, when there are more
constexpr std::size_t kBeam = 60;          // chains that are followed up
constexpr std::size_t kBeamOfWay = 10;     // of these, in which parts lie one way more than any other
constexpr std::size_t kImproved = 5;       // chains of these whose traps are exchanged for better ones
constexpr std::size_t kSieves = 12;        // whose likes are tried, besides those in use
constexpr double kMutants = 0.65;          // of new traps, that are like one in use
constexpr double kRedrawn = 0.15;          // of a mutant's changes
constexpr double kMostStuck = 0.05;        // of a trap that is of use
constexpr std::size_t kPromising = 5;      // of a round, by each of two measures

/// How well a plan is made.
struct Care {
    std::size_t niches = 0;  // ways to lead parts to, each with its best chain, whose traps' likes are tried
    int trials = 0;          // of each trap that is used, by the ways in which parts come to it
    int inARow = 0;          // plans at most, while what they use is measured
};
constexpr Care kOnTheWay{3, 300, 4};
constexpr Care kAtTheEnd{1, 1000, 12};

/// How many of each way (rows) came to be in which (columns): ways, other, stuck, fallen.
using Counts = std::vector<std::vector<double>>;
/// Shares of parts, in the columns of Counts.
using Belief = std::vector<double>;

/// A trap that is tried by itself.
struct Piece {
    std::size_t kind = 0;  // index of Planner::kinds_
    std::vector<double> numbers;
    Counts counts;
    Counts chances;     // what counts tell: rows that sum up to 1
    double fall = 0.0;  // of the track, from its beginning to its end [m]
};

/// What a piece is still to be tried.
struct Work {
    Piece* piece = nullptr;
    std::vector<int> trials;  // from each way
};

/// A chain: pieces, and where parts are behind it.
struct Chain {
    std::vector<std::size_t> pieces;
    Belief parts;
    double worth = 0.0;  // minus bits
    double fall = 0.0;   // of the track [m]
};

double lowestAt(const track::Track& track, double x) {
    for (std::size_t i = 1; i < track.sections.size(); ++i) {
        const track::CrossSection& from = track.sections[i - 1];
        const track::CrossSection& to = track.sections[i];
        if (x > to.x && i + 1 < track.sections.size()) continue;
        const double share = std::clamp((x - from.x) / (to.x - from.x), 0.0, 1.0);
        return std::lerp(traps::findLowest(from), traps::findLowest(to), share);
    }
    return traps::findLowest(track.sections.back());
}

class Planner {
 public:
    Planner(const StudyInputs& inputs, traps::TrapChain chain,
            const std::function<void(const GenerationPlan&)>& planned, const LearningControl& control)
        : inputs_(&inputs),
          chain_(std::move(chain)),
          planned_(planned),
          control_(control),
          doneBefore_(control_.run.done()),
          forgivesFalls_(forgivesFalls(inputs.settings.evolution)) {
        for (std::size_t i = kGroovesBefore; i < chain_.size(); ++i) {
            auto found = std::find(kinds_.begin(), kinds_.end(), chain_[i]);
            if (found == kinds_.end()) found = kinds_.insert(kinds_.end(), chain_[i]);
            places_.push_back(static_cast<std::size_t>(found - kinds_.begin()));
        }
        for (const traps::TrapKind* kind : kinds_)
            dimensions_.push_back(kind->dimensions(settings().track));
    }

    base::Result<std::vector<search::Design>> run(std::size_t most) {
        if (const auto found = findWays(kTrialsOfWays); !found) return found.error();
        if (ways_.empty()) return std::vector<search::Design>{};
        const int rounds = (settings().evolution.populationSize * kTrapsPerIndividual +
                            static_cast<int>(kTrapsInRound) - 1) /
                           static_cast<int>(kTrapsInRound);
        // What is found first decides in which ways traps lead, and what is tried next. So several plans
        // begin by themselves, and what is best of each is what the last part of the work begins with.
        const int begun = 2 * rounds / 3;
        const int islands = std::min(begun / kRoundsOfIsland, kMostIslands);
        std::vector<Piece> found;
        int round = 0;
        for (int island = 0; islands > 1 && island < islands; ++island) {
            const int end = (island + 1) * begun / islands;
            // To turn parts pays from the first trap on, to throw them out pays late.
            bitsOfHalving_ = island % 2 == 0 ? objectives::kBitsOfHalving : kBitsOfBoldHalving;
            if (const auto done = goOn(round, end, rounds); !done) return done.error();
            round = end;
            leaveIsland(found);
        }
        bitsOfHalving_ = objectives::kBitsOfHalving;
        pieces_ = std::move(found);
        if (!pieces_.empty()) {
            if (const auto joined = plan(kOnTheWay); !joined) return joined.error();
        }
        if (const auto done = goOn(round, rounds, rounds); !done) return done.error();
        if (const auto last = plan(kAtTheEnd); !last) return last.error();
        return listDesigns(most);
    }

    /// Rounds of traps, planned with from time to time.
    base::Status goOn(int round, int end, int rounds) {
        for (; round < end; ++round) {
            if (control_.stopRequested()) return base::Error{"The planning was stopped."};
            tellProgress((control_.run.done() - doneBefore_) * rounds / std::max(1, round));
            if (const auto tried = tryTraps(round); !tried) return tried.error();
            if (round + 1 < end && round % kRoundsBetweenPlans != kRoundsBetweenPlans - 1) continue;
            if (const auto improved = plan(kOnTheWay); !improved) return improved.error();
            if (round + 1 == end || chains_.empty()) continue;
            if (const auto followed = followParts(); !followed) return followed.error();
        }
        return base::success();
    }

    /// What is of use joins `found`, and the next plan begins with nothing.
    void leaveIsland(std::vector<Piece>& found) {
        std::set<std::size_t> kept(used_.begin(), used_.end());
        kept.insert(sieves_.begin(), sieves_.end());
        for (std::size_t i = 0; i < kinds_.size() && found.empty(); ++i)
            kept.insert(i);  // that do nothing
        for (const std::size_t i : kept)
            found.push_back(std::move(pieces_[i]));
        pieces_.clear();
        used_.clear();
        sieves_.clear();
        chains_.clear();
        niches_.clear();
        met_.clear();
    }

    /// From so many trials.
    base::Status findWays(int trials) {
        const auto track = buildWith(nullptr, {});
        if (!track) return track.error();
        const trial::TrialBatch batch = makeBatch(*track, trials);
        tellProgress(trials);
        const auto outcomes = runTrials(*inputs_->engine, {&batch, 1}, control_.run);
        if (!outcomes) return outcomes.error();
        for (const EndMode& mode :
             findEndModes(*inputs_->part, outcomes->front(), settings().validation.tolerance, kMostWays)) {
            if (mode.count * kTrialsOfWays >= kLeastOfWay * trials) ways_.push_back(mode.orientation);
        }
        starts_.resize(ways_.size() + 1);
        arriving_.assign(columns(), 0.0);
        const double bottom = lowestAt(**track, (*track)->finish);
        fallBefore_ = settings().track.segmentHeight - bottom;
        for (const trial::Outcome& outcome : outcomes->front()) {
            const trial::PartOutcome& part = outcome.parts.front();
            const std::size_t column = findColumn(part);
            arriving_[column] += 1.0 / trials;
            if (column >= starts_.size()) continue;
            base::Pose start = part.farthest;
            start.position.z() -= bottom;
            starts_[column].push_back(start);
        }
        // Too few to be tried from count as the most frequent way.
        if (static_cast<int>(starts_.back().size()) * kTrialsOfWays < kLeastOfWay * trials)
            starts_.pop_back();
        return base::success();
    }

    /// That traps are tried from: the ways, and the others together.
    [[nodiscard]] std::size_t rows() const { return starts_.size(); }

 private:
    [[nodiscard]] const Settings& settings() const { return inputs_->settings; }
    [[nodiscard]] std::size_t stuck() const { return ways_.size() + 1; }
    [[nodiscard]] std::size_t fallen() const { return ways_.size() + 2; }
    [[nodiscard]] std::size_t columns() const { return ways_.size() + 3; }
    void tellProgress(std::int64_t trials) const {
        if (!planned_) return;
        const EvolutionSettings& evolution = settings().evolution;
        const int population = evolution.populationSize;
        // Of a race about half.
        const int share = evolution.racingTrials > 0 ? 2 : 1;
        const std::int64_t later = std::int64_t{population} * evolution.trialsPerEvaluation / share;
        planned_({0, population, population, trials, doneBefore_, std::max<std::int64_t>(1, later)});
    }

    base::Result<std::shared_ptr<const track::Track>> buildWith(const traps::TrapKind* kind,
                                                                std::span<const double> numbers) const {
        traps::TrapChain chain(kGroovesBefore, chain_.front());
        search::Design design = designOfGrooves();
        if (kind != nullptr) {
            chain.push_back(kind);
            design.insert(design.end(), numbers.begin(), numbers.end());
        }
        return build(chain, design);
    }

    base::Result<std::shared_ptr<const track::Track>> build(const traps::TrapChain& chain,
                                                            const search::Design& design) const {
        // Parts must be seen as they go on: they creep along a level lead-out, and lie better behind it.
        TrackSettings shortened = settings().track;
        shortened.leadOutSegments = 1;
        shortened.maxSegmentLength = 2.0 * inputs_->part->boundingRadius;
        auto track = track::buildTrack(shortened, traps::build(chain, settings().track, design));
        if (!track) return track.error();
        return std::make_shared<const track::Track>(std::move(track).value());
    }

    [[nodiscard]] base::Result<std::shared_ptr<const track::Track>> buildChain(
        std::span<const std::size_t> pieces) const {
        traps::TrapChain chain(kGroovesBefore, chain_.front());
        search::Design design = designOfGrooves();
        for (const std::size_t i : pieces) {
            chain.push_back(kinds_[pieces_[i].kind]);
            design.insert(design.end(), pieces_[i].numbers.begin(), pieces_[i].numbers.end());
        }
        return build(chain, design);
    }

    [[nodiscard]] search::Design designOfGrooves() const {
        search::Design design;
        for (int i = 0; i < kGroovesBefore; ++i) {
            for (const double number : traps::restingGroove(settings().track))
                design.push_back(number);
        }
        return design;
    }

    trial::TrialBatch makeBatch(std::shared_ptr<const track::Track> track, int trials) {
        // Behind those of all individuals of generation 0.
        const int individual = settings().evolution.populationSize + batches_++;
        return makeLearningBatch(makeScene(settings(), inputs_->part, std::move(track)), {0, individual},
                                 trials);
    }

    [[nodiscard]] std::size_t findColumn(const trial::PartOutcome& part) const {
        if (part.ending == trial::Ending::fellOff) return fallen();
        if (part.ending != trial::Ending::finished) return stuck();
        std::size_t nearest = ways_.size();
        double least = kNearWay;
        for (std::size_t way = 0; way < ways_.size(); ++way) {
            const double angle =
                trial::calcOrientationAngle(part.farthest.rotation, ways_[way], inputs_->part->symmetry,
                                            trial::OrientationDistance::symmetric);
            if (angle < least) {
                least = angle;
                nearest = way;
            }
        }
        return nearest;
    }

    const base::Pose& chooseStart(std::size_t way, base::Random& random) const {
        const bool isMet = random.uniform() < 0.5 && way < met_.size() && !met_[way].empty();
        const std::vector<base::Pose>& own = isMet ? met_[way] : starts_[way];
        // All of a way may be nearer to another one.
        const std::vector<base::Pose>& from = own.empty() ? starts_.front() : own;
        return from[random.below(static_cast<std::uint32_t>(from.size()))];
    }

    /// Trials, each from its way, at the beginning of the second groove: what is put there at rest conveys as
    /// quickly as any other when it comes to the trap.
    void placeParts(trial::TrialBatch& batch, const std::vector<std::size_t>& ways) const {
        const track::Track& track = *batch.track;
        const double x = track.sections[2].x + 0.1 * inputs_->part->boundingRadius;
        const double bottom = lowestAt(track, x);
        const base::Quaternion fall(Eigen::AngleAxisd(traps::kRestingFall, base::Vec3::UnitY()));
        constexpr double kAbove = 0.3e-3;  // so that it touches nothing when it is turned [m]
        for (std::size_t i = 0; i < batch.trials.size(); ++i) {
            trial::TrialSpec& spec = batch.trials[i];
            base::Random random(
                {spec.stream.seed, 0, spec.stream.individual, spec.stream.trial, base::Purpose::planning});
            const base::Pose& start = chooseStart(ways[i], random);
            base::Pose& pose = spec.parts.front().pose;
            pose.position = track.shape.toRoom({x, start.position.y(), bottom + start.position.z() + kAbove});
            pose.rotation = base::Quaternion(track.shape.tangentFrame(x)) * fall * start.rotation;
        }
    }

    /// So many trials more of each piece, from each way.
    base::Status measure(std::span<const Work> works) {
        std::vector<trial::TrialBatch> batches;
        std::vector<std::vector<std::size_t>> from;
        batches.reserve(works.size());
        for (const Work& work : works) {
            const auto track = buildWith(kinds_[work.piece->kind], work.piece->numbers);
            if (!track) return track.error();
            work.piece->fall =
                settings().track.segmentHeight - lowestAt(**track, (*track)->finish) - fallBefore_;
            std::vector<std::size_t>& ways = from.emplace_back();
            for (std::size_t way = 0; way < rows(); ++way)
                ways.insert(ways.end(), static_cast<std::size_t>(work.trials[way]), way);
            batches.push_back(makeBatch(*track, static_cast<int>(ways.size())));
        }
        base::parallelFor(batches.size(), inputs_->threads,
                          [&](std::size_t i, unsigned /*worker*/) { placeParts(batches[i], from[i]); });
        const auto outcomes = runTrials(*inputs_->engine, batches, control_.run);
        if (!outcomes) return outcomes.error();
        for (std::size_t i = 0; i < works.size(); ++i) {
            Piece& piece = *works[i].piece;
            for (std::size_t k = 0; k < from[i].size(); ++k)
                piece.counts[from[i][k]][findColumn((*outcomes)[i][k].parts.front())] += 1.0;
            piece.chances = calcChances(piece.counts);
        }
        return base::success();
    }

    /// Counts as probabilities. A few trials that none saw spoil what few trials make look perfect: parts may
    /// always get stuck or be turned.
    [[nodiscard]] Counts calcChances(const Counts& counts) const {
        constexpr double kUnseenTurns = 1.0;
        constexpr double kUnseenStuck = 0.2;
        Counts chances(columns(), Belief(columns(), 0.0));
        for (std::size_t from = 0; from < rows(); ++from) {
            double sum = 0.0;
            for (std::size_t to = 0; to < columns(); ++to) {
                double& chance = chances[from][to];
                chance = counts[from][to];
                if (to == stuck()) chance += kUnseenStuck;
                if (to != from && to < stuck()) chance += kUnseenTurns / static_cast<double>(ways_.size());
                sum += chance;
            }
            for (double& chance : chances[from])
                chance /= sum;
        }
        if (rows() == ways_.size()) chances[ways_.size()] = chances[0];
        chances[stuck()][stuck()] = 1.0;
        chances[fallen()][fallen()] = 1.0;
        return chances;
    }

    [[nodiscard]] Belief pass(const Belief& parts, const Counts& chances) const {
        Belief after(columns(), 0.0);
        for (std::size_t from = 0; from < columns(); ++from) {
            if (parts[from] == 0.0) continue;
            for (std::size_t to = 0; to < columns(); ++to)
                after[to] += parts[from] * chances[from][to];
        }
        return after;
    }

    /// Minus the bits of objectives::sorting(), or of objectives::disorder().
    [[nodiscard]] double worthOf(const Belief& parts) const {
        constexpr double kLeast = 1.0 / 256.0;
        double alike = 0.0;
        for (std::size_t way = 0; way < ways_.size(); ++way)
            alike += parts[way] * parts[way];
        const double staying = 1.0 - parts[fallen()];
        if (!forgivesFalls_) return std::log2(alike + kLeast);
        if (staying < kLeast) return std::log2(kLeast);
        return std::log2(alike / (staying * staying) + kLeast) + bitsOfHalving_ * std::log2(staying);
    }

    static double drawNumber(const search::Dimension& dimension, base::Random& random) {
        return search::roundToBits(random.uniform(), dimension.bits);
    }

    [[nodiscard]] Piece makePiece(std::size_t kind, std::vector<double> numbers) const {
        return {kind, std::move(numbers), Counts(rows(), Belief(columns(), 0.0)), {}, 0.0};
    }

    Piece drawPiece(std::size_t kind, base::Random& random) const {
        Piece piece = makePiece(kind, {});
        for (const search::Dimension& dimension : dimensions_[kind])
            piece.numbers.push_back(drawNumber(dimension, random));
        return piece;
    }

    Piece mutate(const Piece& parent, base::Random& random) const {
        Piece piece = makePiece(parent.kind, parent.numbers);
        const std::vector<search::Dimension>& dimensions = dimensions_[parent.kind];
        const std::uint32_t changes = 1 + random.below(3);
        const double step = std::exp(random.uniform(std::log(0.01), std::log(0.25)));
        for (std::uint32_t change = 0; change < changes; ++change) {
            const std::size_t i = random.below(static_cast<std::uint32_t>(dimensions.size()));
            double& number = piece.numbers[i];
            number = random.uniform() < kRedrawn
                         ? drawNumber(dimensions[i], random)
                         : search::roundToBits(std::clamp(number + step * random.normal(), 0.0, 1.0),
                                               dimensions[i].bits);
        }
        return piece;
    }

    /// A round of new traps: all a few times, and those that do something more often.
    base::Status tryTraps(int round) {
        base::Random random(
            {settings().evolution.seed, 0, static_cast<std::uint32_t>(round), 0, base::Purpose::planning});
        std::vector<Piece> tried;
        for (std::size_t i = 0; i < kTrapsInRound; ++i) {
            if (pieces_.empty() && i < kinds_.size()) {
                // All numbers in the middle: a cut-out that cuts nothing lets a chain do with fewer.
                Piece typical = drawPiece(i, random);
                for (std::size_t k = 0; k < typical.numbers.size(); ++k)
                    typical.numbers[k] = search::roundToBits(0.5, dimensions_[i][k].bits);
                tried.push_back(std::move(typical));
            } else if (!used_.empty() && random.uniform() < kMutants) {
                const std::vector<std::size_t>& parents = random.boolean() ? used_ : sieves_;
                tried.push_back(mutate(
                    pieces_[parents[random.below(static_cast<std::uint32_t>(parents.size()))]], random));
            } else {
                tried.push_back(drawPiece(i % kinds_.size(), random));
            }
        }
        std::vector<Work> works;
        works.reserve(tried.size());
        for (Piece& piece : tried)
            works.push_back({&piece, shareTrials(kFirstTrials)});
        if (const auto measured = measure(works); !measured) return measured.error();
        works.clear();
        for (const std::size_t i : choosePromising(tried, pieces_.empty() ? kinds_.size() : 0))
            works.push_back({&tried[i], shareTrials(kMoreTrials)});
        if (works.empty()) return base::success();
        if (const auto measured = measure(works); !measured) return measured.error();
        for (const Work& work : works)
            pieces_.push_back(std::move(*work.piece));
        return base::success();
    }

    /// Of the parts that come to each trap of a chain, the shares that lie in each way.
    [[nodiscard]] std::vector<Belief> listComing(const Chain& chain) const {
        std::vector<Belief> coming;
        Belief parts = arriving_;
        for (const std::size_t used : chain.pieces) {
            const double staying = std::max(1e-9, 1.0 - parts[stuck()] - parts[fallen()]);
            Belief& shares = coming.emplace_back(parts.begin(), parts.begin() + std::ssize(starts_));
            for (double& share : shares)
                share /= staying;
            parts = pass(parts, pieces_[used].chances);
        }
        return coming;
    }

    /// Trials from each way, `each` on average: the more, the larger a share of the parts lies so before any
    /// trap, as what is not known of a way counts by how many come in it.
    [[nodiscard]] std::vector<int> shareTrials(int each) const {
        Belief most(arriving_.begin(), arriving_.begin() + std::ssize(starts_));
        for (const Chain& chain : niches_) {
            for (const Belief& coming : listComing(chain))
                std::transform(coming.begin(), coming.end(), most.begin(), most.begin(),
                               [](double a, double b) { return std::max(a, b); });
        }
        const double sum = std::accumulate(most.begin(), most.end(), 0.0);
        const double all = each * static_cast<double>(std::min(rows(), kMostShared));
        std::vector<int> trials;
        for (const double share : most)
            trials.push_back(std::max(each / 3, static_cast<int>(std::lround(all * share / sum))));
        return trials;
    }

    /// The traps to look at closer: the first `sure` ones, those that would be of most use in the best chains
    /// of today, and those that bring most order by themselves; none that gets parts stuck.
    [[nodiscard]] std::vector<std::size_t> choosePromising(const std::vector<Piece>& tried,
                                                           std::size_t sure) const {
        std::set<std::size_t> chosen;
        for (std::size_t i = 0; i < sure; ++i)
            chosen.insert(i);
        std::vector<std::size_t> fit;
        std::vector<double> alone(tried.size());
        for (std::size_t i = sure; i < tried.size(); ++i) {
            const Belief once = pass(arriving_, tried[i].chances);
            alone[i] = std::max(worthOf(once), worthOf(repeat(tried[i])));
            if (once[stuck()] - arriving_[stuck()] <= kMostStuck) fit.push_back(i);
        }
        const auto choose = [&](const std::vector<double>& worth, std::size_t count) {
            std::stable_sort(fit.begin(), fit.end(),
                             [&](std::size_t a, std::size_t b) { return worth[a] > worth[b]; });
            chosen.insert(fit.begin(),
                          fit.begin() + static_cast<std::ptrdiff_t>(std::min(count, fit.size())));
        };
        choose(alone, niches_.empty() ? 2 * kPromising : kPromising);
        for (std::size_t niche = 0; niche < niches_.size(); ++niche) {
            std::vector<double> inChain(tried.size());
            for (const std::size_t i : fit)
                inChain[i] = worthInChain(tried[i], niches_[niche]);
            // The best chain's share is what the others leave.
            choose(inChain, niche > 0 ? 1 : kPromising + 1 - niches_.size());
        }
        return {chosen.begin(), chosen.end()};
    }

    /// Of a chain if this piece took the place that suits it most.
    [[nodiscard]] double worthInChain(const Piece& piece, const Chain& chain) const {
        double most = -1e300;
        Belief before = arriving_;
        for (std::size_t place = 0; place < places_.size(); ++place) {
            if (places_[place] == piece.kind)
                most = std::max(most, worthOf(passOn(pass(before, piece.chances), chain, place + 1)));
            before = pass(before, pieces_[chain.pieces[place]].chances);
        }
        return most;
    }

    /// Where parts are behind a chain if they are so before one of its places.
    [[nodiscard]] Belief passOn(Belief parts, const Chain& chain, std::size_t place) const {
        for (; place < places_.size(); ++place)
            parts = pass(parts, pieces_[chain.pieces[place]].chances);
        return parts;
    }

    /// Where parts are behind as many of these as there are places of their kind.
    [[nodiscard]] Belief repeat(const Piece& piece) const {
        Belief parts = arriving_;
        for (const std::size_t kind : places_) {
            if (kind == piece.kind) parts = pass(parts, piece.chances);
        }
        return parts;
    }

    /// The way in which most parts lie behind it.
    [[nodiscard]] std::size_t wayOf(const Chain& chain) const {
        const auto ways = std::span(chain.parts).first(ways_.size());
        return static_cast<std::size_t>(std::max_element(ways.begin(), ways.end()) - ways.begin());
    }

    /// Finds the best chains of what is known: a beam search from the first trap on, whose best ones, and the
    /// best for each of so many ways, then have traps exchanged.
    void findChains(std::size_t niches) {
        chains_ = searchBeam(emptyChain(), kBeam);
        std::set<std::size_t> ways;
        for (std::size_t i = 0; i < chains_.size(); ++i) {
            const bool isFirst = ways.size() < niches && ways.insert(wayOf(chains_[i])).second;
            if (isFirst || i < kImproved) exchangeTraps(chains_[i]);
        }
        std::stable_sort(chains_.begin(), chains_.end(),
                         [](const Chain& a, const Chain& b) { return a.worth > b.worth; });
        niches_.clear();
        ways.clear();
        for (const Chain& chain : chains_) {
            if (niches_.size() < niches && ways.insert(wayOf(chain)).second) niches_.push_back(chain);
        }
        used_.clear();
        for (const Chain& chain : niches_) {
            const std::set<std::size_t> pieces(chain.pieces.begin(), chain.pieces.end());
            used_.insert(used_.end(), pieces.begin(), pieces.end());
        }
    }

    [[nodiscard]] Chain append(const Chain& chain, std::size_t index) const {
        const Piece& piece = pieces_[index];
        Chain longer{chain.pieces, pass(chain.parts, piece.chances), 0.0, chain.fall + piece.fall};
        longer.pieces.push_back(index);
        longer.worth = worthOf(longer.parts);
        return longer;
    }

    [[nodiscard]] Chain emptyChain() const { return {{}, arriving_, worthOf(arriving_), 0.0}; }

    /// So that a chain stays within the track's height.
    [[nodiscard]] double mostFall() const { return settings().track.segmentHeight - fallBefore_; }

    /// The best chains that begin like this one, if so many are followed up at each place.
    [[nodiscard]] std::vector<Chain> searchBeam(Chain start, std::size_t width) const {
        std::vector<Chain> beam{std::move(start)};
        for (std::size_t place = beam.front().pieces.size(); place < places_.size(); ++place) {
            const std::size_t kind = places_[place];
            std::vector<Chain> next;
            for (const Chain& chain : beam) {
                for (std::size_t i = 0; i < pieces_.size(); ++i) {
                    const Piece& piece = pieces_[i];
                    if (piece.kind != kind || chain.fall + piece.fall > mostFall()) continue;
                    next.push_back(append(chain, i));
                }
            }
            std::stable_sort(next.begin(), next.end(),
                             [](const Chain& a, const Chain& b) { return a.worth > b.worth; });
            beam.clear();
            std::vector<std::size_t> ofWay(ways_.size(), 0);
            for (Chain& chain : next) {
                if (beam.size() == width) break;
                std::size_t& alike = ofWay[wayOf(chain)];
                // Chains of the same worth are the same traps in another order.
                constexpr double kSame = 1e-9;
                if (alike == kBeamOfWay || (!beam.empty() && beam.back().worth - chain.worth <= kSame))
                    continue;
                ++alike;
                beam.push_back(std::move(chain));
            }
        }
        return beam;
    }

    /// Exchanges the one trap for the one other that makes a chain worth most, as long as it gains.
    void exchangeTraps(Chain& chain) const {
        constexpr double kGain = 1e-6;
        for (bool gained = true; gained;) {
            gained = false;
            Chain best = chain;
            Belief before = arriving_;
            for (std::size_t place = 0; place < places_.size(); ++place) {
                const Piece& current = pieces_[chain.pieces[place]];
                for (std::size_t i = 0; i < pieces_.size(); ++i) {
                    const double fall = chain.fall - current.fall + pieces_[i].fall;
                    if (pieces_[i].kind != places_[place] || fall > mostFall()) continue;
                    Belief parts = pass(before, pieces_[i].chances);
                    for (std::size_t later = place + 1; later < places_.size(); ++later)
                        parts = pass(parts, pieces_[chain.pieces[later]].chances);
                    const double worth = worthOf(parts);
                    if (worth <= best.worth + kGain) continue;
                    best = {chain.pieces, std::move(parts), worth, fall};
                    best.pieces[place] = i;
                    gained = true;
                }
                before = pass(before, current.chances);
            }
            chain = std::move(best);
        }
    }

    /// Those that would be worth most one after the other, at every place of their kind: what throws one way
    /// out and lets another pass does it better every time, even where the best chain of today uses others.
    [[nodiscard]] std::vector<std::size_t> findSieves() const {
        std::vector<std::pair<double, std::size_t>> worths;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            worths.emplace_back(-worthOf(repeat(pieces_[i])), i);
        }
        std::sort(worths.begin(), worths.end());
        std::vector<std::size_t> sieves;
        for (const auto& [worth, i] : worths) {
            if (sieves.size() < kSieves) sieves.push_back(i);
        }
        return sieves;
    }

    /// Finds the best chains, and measures what they use, until that is known well enough.
    base::Status plan(const Care& care) {
        sieves_ = findSieves();
        if (pieces_.size() > kMostTraps) {
            forget();
            sieves_ = findSieves();
        }
        for (int again = 0; again < care.inARow; ++again) {
            findChains(care.niches);
            if (chains_.empty()) return base::success();
            sieves_ = findSieves();
            std::set<std::size_t> looked(used_.begin(), used_.end());
            looked.insert(sieves_.begin(),
                          sieves_.begin() + std::min<std::ptrdiff_t>(2, std::ssize(sieves_)));
            std::vector<Work> works;
            for (const std::size_t i : looked) {
                Work work = findUncertain(i, care.trials);
                if (work.piece != nullptr) works.push_back(std::move(work));
            }
            if (works.empty()) break;
            if (const auto measured = measure(works); !measured) return measured.error();
        }
        findChains(care.niches);
        return base::success();
    }

    /// Parts before each trap of the best chains: what their traps do is counted with them from then on,
    /// beside those of the plain groove, as within its way a part lies as the traps before have laid it.
    base::Status followParts() {
        std::vector<trial::TrialBatch> batches;
        std::vector<double> bottoms;
        const int each = kTrialsOfFollowed / static_cast<int>(niches_.size());
        for (const Chain& chain : niches_) {
            for (std::size_t place = 1; place < places_.size(); ++place) {
                const auto track = buildChain(std::span(chain.pieces).first(place));
                if (!track) return track.error();
                bottoms.push_back(lowestAt(**track, (*track)->finish));
                batches.push_back(makeBatch(*track, each));
            }
        }
        const auto outcomes = runTrials(*inputs_->engine, batches, control_.run);
        if (!outcomes) return outcomes.error();
        met_.assign(rows(), {});
        for (std::size_t i = 0; i < batches.size(); ++i) {
            for (const trial::Outcome& outcome : (*outcomes)[i]) {
                const std::size_t column = findColumn(outcome.parts.front());
                if (column >= rows()) continue;
                met_[column].push_back(outcome.parts.front().farthest);
                met_[column].back().position.z() -= bottoms[i];
            }
        }
        for (const std::size_t i : std::set<std::size_t>(used_.begin(), used_.end())) {
            for (Belief& counts : pieces_[i].counts)
                for (double& count : counts)
                    count *= 0.5;
        }
        return base::success();
    }

    /// Trials that tell more of a piece, from the ways in which parts come to it in the chains that use it;
    /// none if all of them are known well.
    Work findUncertain(std::size_t index, int trials) {
        Belief coming(rows(), 0.0);
        bool isUsed = false;
        for (const Chain& chain : niches_) {
            const std::vector<Belief> before = listComing(chain);
            for (std::size_t place = 0; place < chain.pieces.size(); ++place) {
                if (chain.pieces[place] != index) continue;
                isUsed = true;
                for (std::size_t way = 0; way < rows(); ++way)
                    coming[way] = std::max(coming[way], before[place][way]);
            }
        }
        if (!isUsed) coming = arriving_;
        Work work{nullptr, std::vector<int>(rows(), 0)};
        for (std::size_t way = 0; way < rows(); ++way) {
            const Belief& counts = pieces_[index].counts[way];
            const auto known = static_cast<int>(std::accumulate(counts.begin(), counts.end(), 0.0));
            const auto wanted = static_cast<int>(std::min(kMostFromWay, coming[way]) * trials);
            if (known >= wanted) continue;
            work.trials[way] = wanted - known;
            work.piece = &pieces_[index];
        }
        return work;
    }

    void forget() {
        std::vector<Piece> kept;
        std::vector<std::size_t> used;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            const bool isUsed = std::find(used_.begin(), used_.end(), i) != used_.end();
            const bool isSieve = std::find(sieves_.begin(), sieves_.end(), i) != sieves_.end();
            if (!isUsed && !isSieve && i >= kinds_.size() && i + kLatestTraps < pieces_.size()) continue;
            if (isUsed) used.push_back(kept.size());
            kept.push_back(std::move(pieces_[i]));
        }
        pieces_ = std::move(kept);
        used_ = std::move(used);
    }

    [[nodiscard]] std::vector<search::Design> listDesigns(std::size_t most) const {
        std::vector<search::Design> designs;
        for (const Chain& chain : chains_) {
            if (designs.size() == most) break;
            search::Design design = designOfGrooves();
            for (const std::size_t i : chain.pieces)
                design.insert(design.end(), pieces_[i].numbers.begin(), pieces_[i].numbers.end());
            if (std::find(designs.begin(), designs.end(), design) == designs.end())
                designs.push_back(std::move(design));
        }
        return designs;
    }

    const StudyInputs* inputs_;
    traps::TrapChain chain_;
    const std::function<void(const GenerationPlan&)>& planned_;
    LearningControl control_;
    std::int64_t doneBefore_;
    double fallBefore_ = 0.0;  // of the grooves [m]
    int batches_ = 0;          // so far
    bool forgivesFalls_;
    double bitsOfHalving_ = objectives::kBitsOfHalving;
    std::vector<const traps::TrapKind*> kinds_;               // of the traps behind the grooves, each once
    std::vector<std::vector<search::Dimension>> dimensions_;  // of each kind
    std::vector<std::size_t> places_;                         // kinds, along the track
    std::vector<base::Quaternion> ways_;                      // in which parts lie
    std::vector<std::vector<base::Pose>> starts_;  // of each way, and of others; z from the groove's bottom
    std::vector<std::vector<base::Pose>> met_;     // the same, behind the traps of the best chains
    Belief arriving_;                              // at the first trap
    std::vector<Piece> pieces_;                    // that are known
    std::vector<std::size_t> used_;                // of these, by the niches' chains, in their order
    std::vector<std::size_t> sieves_;              // of these, findSieves()
    std::vector<Chain> chains_;                    // best first
    std::vector<Chain> niches_;  // of these, the best for each of the ways that most parts can be brought to
};

}  // namespace

std::string findPlanningProblem(const TrackSettings& settings) {
    const auto chain = traps::readTraps(settings.traps);
    if (!chain) return chain.error().message;
    const std::string_view groove = traps::groove().key;
    bool isRight = chain->size() > kGroovesBefore;
    for (std::size_t i = 0; i < chain->size(); ++i) {
        const traps::TrapKind& kind = *(*chain)[i];
        isRight = isRight && (i < kGroovesBefore ? kind.key == groove : kind.endsInGroove);
    }
    if (isRight) return {};
    return fmt::format(
        "Traps can be planned that begin with two grooves and go on with drops, cut-outs and gaps, as in "
        "\"groove, groove, 3 x gap\"; these are \"{}\".",
        settings.traps);
}

bool isPlanned(const EvolutionSettings& settings) {
    return settings.search == search::Method::genetic &&
           settings.firstGeneration == search::ga::FirstGeneration::planned;
}

base::Result<int> countWays(const StudyInputs& inputs, const base::RunControl& control) {
    constexpr int kTrials = 600;
    LearningControl counting;
    counting.run = control;
    Planner planner(inputs, traps::readTraps(inputs.settings.track.traps).value(), {}, counting);
    const auto found = planner.findWays(kTrials);
    if (!found) return found.error();
    return static_cast<int>(planner.rows());
}

std::int64_t estimatePlanningTrials(const EvolutionSettings& settings, int ways) {
    if (!isPlanned(settings)) return 0;
    // Of a trap by itself, from the ways that share trials and from each of the others, and what the plans
    // from time to time take.
    constexpr int kShared = 14;
    constexpr int kOthers = 2;
    constexpr int kPlans = 12;
    constexpr int kMost = kMostShared;
    const int each = kShared * std::min(ways, kMost) + kOthers * std::max(0, ways - kMost) + kPlans;
    return kTrialsOfWays + std::int64_t{settings.populationSize} * kTrapsPerIndividual * each;
}

TrackSettings planningTrack(const TrackSettings& settings) {
    TrackSettings track = settings;
    track.leadOutSegments = 1;
    const auto chain = traps::readTraps(settings.traps);
    if (!chain || chain->size() <= kGroovesBefore) return track;
    track.traps = fmt::format("{}, {}, {}", (*chain)[0]->key, (*chain)[1]->key, (*chain)[2]->key);
    return track;
}

base::Result<std::vector<search::Design>> planDesigns(
    const StudyInputs& inputs, std::size_t most, const std::function<void(const GenerationPlan&)>& planned,
    const LearningControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    if (const std::string problem = findPlanningProblem(inputs.settings.track); !problem.empty())
        return base::Error{problem};
    auto chain = traps::readTraps(inputs.settings.track.traps);
    return Planner(inputs, std::move(chain).value(), planned, control).run(most);
}

}  // namespace trapwright::study
