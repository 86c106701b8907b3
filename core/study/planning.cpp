#include "core/study/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
constexpr int kPlansInARow = 4;            // at most, while what they use is measured better
constexpr int kFirstTrials = 6;            // from each way, of a trap that is new
constexpr int kMoreTrials = 24;            // of one that brings order
constexpr int kTrialsOfUsed = 100;         // more and more of those that plans use ...
constexpr int kMostOfUsed = 300;           // ... up to so many
constexpr std::size_t kMostTraps = 900;    // that are kept
constexpr std::size_t kLatestTraps = 500;  // and of these, besides those that are used, when there are more
constexpr std::size_t kBeam = 60;          // chains that are followed up
constexpr std::size_t kSieves = 12;        // whose likes are tried, besides those in use
constexpr double kMutants = 0.65;          // of new traps, that are like one in use
constexpr double kRedrawn = 0.15;          // of a mutant's changes
constexpr double kMostStuck = 0.05;        // of a trap that is of use
constexpr double kLeastGain = 0.1;         // [bit]

/// How many of each way (rows) came to be in which (columns): ways, other, stuck, fallen.
using Counts = std::vector<std::vector<double>>;
/// Shares of parts, in the columns of Counts.
using Belief = std::vector<double>;

/// A trap that is tried by itself.
struct Piece {
    std::size_t kind = 0;  // index of Planner::kinds_
    std::vector<double> numbers;
    Counts counts;
    Counts chances;  // what counts tell: rows that sum up to 1
};

/// A chain: pieces, and where parts are behind it.
struct Chain {
    std::vector<std::size_t> pieces;
    Belief parts;
    double worth = 0.0;  // minus bits
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
        if (const auto found = findWays(); !found) return found.error();
        if (ways_.empty()) return std::vector<search::Design>{};
        const int rounds = (settings().evolution.populationSize * kTrapsPerIndividual +
                            static_cast<int>(kTrapsInRound) - 1) /
                           static_cast<int>(kTrapsInRound);
        for (int round = 0; round < rounds; ++round) {
            if (control_.stopRequested()) return base::Error{"The planning was stopped."};
            tellProgress((control_.run.done() - doneBefore_) * rounds / std::max(1, round));
            if (const auto tried = tryTraps(round); !tried) return tried.error();
            if (round % kRoundsBetweenPlans == kRoundsBetweenPlans - 1 || round == rounds - 1) {
                if (const auto improved = plan(); !improved) return improved.error();
            }
        }
        return listDesigns(most);
    }

 private:
    [[nodiscard]] const Settings& settings() const { return inputs_->settings; }
    [[nodiscard]] std::size_t stuck() const { return ways_.size() + 1; }
    [[nodiscard]] std::size_t fallen() const { return ways_.size() + 2; }
    [[nodiscard]] std::size_t columns() const { return ways_.size() + 3; }
    /// That traps are tried from: the ways, and the others together.
    [[nodiscard]] std::size_t rows() const { return starts_.size(); }

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
        auto track = track::buildTrack(settings().track, traps::build(chain, settings().track, design));
        if (!track) return track.error();
        return std::make_shared<const track::Track>(std::move(track).value());
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

    base::Status findWays() {
        const auto track = buildWith(nullptr, {});
        if (!track) return track.error();
        const trial::TrialBatch batch = makeBatch(*track, kTrialsOfWays);
        tellProgress(kTrialsOfWays);
        const auto outcomes = runTrials(*inputs_->engine, {&batch, 1}, control_.run);
        if (!outcomes) return outcomes.error();
        for (const EndMode& mode :
             findEndModes(*inputs_->part, outcomes->front(), settings().validation.tolerance, kMostWays)) {
            if (mode.count >= kLeastOfWay) ways_.push_back(mode.orientation);
        }
        starts_.resize(ways_.size() + 1);
        arriving_.assign(columns(), 0.0);
        const double bottom = lowestAt(**track, (*track)->finish);
        for (const trial::Outcome& outcome : outcomes->front()) {
            const trial::PartOutcome& part = outcome.parts.front();
            const std::size_t column = findColumn(part);
            arriving_[column] += 1.0 / kTrialsOfWays;
            if (column >= starts_.size()) continue;
            base::Pose start = part.farthest;
            start.position.z() -= bottom;
            starts_[column].push_back(start);
        }
        // Too few to be tried from count as the most frequent way.
        if (static_cast<int>(starts_.back().size()) < kLeastOfWay) starts_.pop_back();
        return base::success();
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

    /// Trials from each way in turn, at the beginning of the second groove: what is put there at rest conveys
    /// as quickly as any other when it comes to the trap.
    void placeParts(trial::TrialBatch& batch) const {
        const track::Track& track = *batch.track;
        const double x = track.sections[2].x + 0.1 * inputs_->part->boundingRadius;
        const double bottom = lowestAt(track, x);
        const base::Quaternion fall(Eigen::AngleAxisd(traps::kRestingFall, base::Vec3::UnitY()));
        constexpr double kAbove = 0.3e-3;  // so that it touches nothing when it is turned [m]
        for (std::size_t i = 0; i < batch.trials.size(); ++i) {
            trial::TrialSpec& spec = batch.trials[i];
            base::Random random(
                {spec.stream.seed, 0, spec.stream.individual, spec.stream.trial, base::Purpose::planning});
            // All of a way may be nearer to another one.
            const std::vector<base::Pose>& own = starts_[i % rows()];
            const std::vector<base::Pose>& from = own.empty() ? starts_.front() : own;
            const base::Pose& start = from[random.below(static_cast<std::uint32_t>(from.size()))];
            base::Pose& pose = spec.parts.front().pose;
            pose.position = track.shape.toRoom({x, start.position.y(), bottom + start.position.z() + kAbove});
            pose.rotation = base::Quaternion(track.shape.tangentFrame(x)) * fall * start.rotation;
        }
    }

    /// So many trials more of each piece from each way.
    base::Status measure(std::span<Piece* const> pieces, int trials) {
        std::vector<trial::TrialBatch> batches;
        batches.reserve(pieces.size());
        for (const Piece* piece : pieces) {
            const auto track = buildWith(kinds_[piece->kind], piece->numbers);
            if (!track) return track.error();
            batches.push_back(makeBatch(*track, trials * static_cast<int>(rows())));
        }
        base::parallelFor(batches.size(), inputs_->threads,
                          [&](std::size_t i, unsigned /*worker*/) { placeParts(batches[i]); });
        const auto outcomes = runTrials(*inputs_->engine, batches, control_.run);
        if (!outcomes) return outcomes.error();
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            for (std::size_t k = 0; k < (*outcomes)[i].size(); ++k)
                pieces[i]->counts[k % rows()][findColumn((*outcomes)[i][k].parts.front())] += 1.0;
            pieces[i]->chances = calcChances(pieces[i]->counts);
        }
        return base::success();
    }

    /// Counts as probabilities. A few trials that none saw spoil what few trials make look perfect: parts may
    /// always get stuck or be turned.
    [[nodiscard]] Counts calcChances(const Counts& counts) const {
        constexpr double kUnseenTurns = 0.3;
        constexpr double kUnseenStuck = 0.1;
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
        return std::log2(alike / (staying * staying) + kLeast) +
               objectives::kBitsOfHalving * std::log2(staying);
    }

    static double drawNumber(const search::Dimension& dimension, base::Random& random) {
        return search::roundToBits(random.uniform(), dimension.bits);
    }

    Piece drawPiece(std::size_t kind, base::Random& random) const {
        Piece piece{kind, {}, Counts(rows(), Belief(columns(), 0.0)), {}};
        for (const search::Dimension& dimension : dimensions_[kind])
            piece.numbers.push_back(drawNumber(dimension, random));
        return piece;
    }

    Piece mutate(const Piece& parent, base::Random& random) const {
        Piece piece{parent.kind, parent.numbers, Counts(rows(), Belief(columns(), 0.0)), {}};
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
            if (round == 0 && i < kinds_.size()) {
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
        std::vector<Piece*> all(tried.size());
        std::transform(tried.begin(), tried.end(), all.begin(), [](Piece& piece) { return &piece; });
        if (const auto measured = measure(all, kFirstTrials); !measured) return measured.error();
        std::vector<Piece*> chosen;
        for (std::size_t i = 0; i < tried.size(); ++i) {
            if ((round == 0 && i < kinds_.size()) || isOfUse(tried[i])) chosen.push_back(&tried[i]);
        }
        if (chosen.empty()) return base::success();
        if (const auto measured = measure(chosen, kMoreTrials); !measured) return measured.error();
        for (Piece* piece : chosen)
            pieces_.push_back(std::move(*piece));
        return base::success();
    }

    /// Whether a trap gets few parts stuck and brings order, once or at every place of its kind.
    [[nodiscard]] bool isOfUse(const Piece& piece) const {
        const Belief once = pass(arriving_, piece.chances);
        if (once[stuck()] - arriving_[stuck()] > kMostStuck) return false;
        return std::max(worthOf(once), worthOf(repeat(piece))) - worthOf(arriving_) > kLeastGain;
    }

    /// Where parts are behind as many of these as there are places of their kind.
    [[nodiscard]] Belief repeat(const Piece& piece) const {
        Belief parts = arriving_;
        for (const std::size_t kind : places_) {
            if (kind == piece.kind) parts = pass(parts, piece.chances);
        }
        return parts;
    }

    /// The best chains of what is known, best first, by a beam search from the first trap on.
    [[nodiscard]] std::vector<Chain> findChains() const {
        std::vector<Chain> beam{{{}, arriving_, worthOf(arriving_)}};
        for (const std::size_t kind : places_) {
            std::vector<Chain> next;
            for (const Chain& chain : beam) {
                for (std::size_t i = 0; i < pieces_.size(); ++i) {
                    if (pieces_[i].kind != kind) continue;
                    Chain longer{chain.pieces, pass(chain.parts, pieces_[i].chances), 0.0};
                    longer.pieces.push_back(i);
                    longer.worth = worthOf(longer.parts);
                    next.push_back(std::move(longer));
                }
            }
            std::stable_sort(next.begin(), next.end(),
                             [](const Chain& a, const Chain& b) { return a.worth > b.worth; });
            beam.clear();
            // Chains of the same worth are the same traps in another order.
            for (Chain& chain : next) {
                constexpr double kSame = 1e-9;
                if (beam.size() == kBeam) break;
                if (beam.empty() || beam.back().worth - chain.worth > kSame) beam.push_back(std::move(chain));
            }
        }
        return beam;
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

    /// Finds the best chain, and measures what it uses, until that is known well.
    base::Status plan() {
        sieves_ = findSieves();
        if (pieces_.size() > kMostTraps) forget();
        for (int again = 0; again < kPlansInARow; ++again) {
            chains_ = findChains();
            if (chains_.empty()) return base::success();
            const std::set<std::size_t> used(chains_.front().pieces.begin(), chains_.front().pieces.end());
            used_.assign(used.begin(), used.end());
            sieves_ = findSieves();
            std::set<std::size_t> looked = used;
            looked.insert(sieves_.begin(),
                          sieves_.begin() + std::min<std::ptrdiff_t>(2, std::ssize(sieves_)));
            std::vector<Piece*> uncertain;
            for (const std::size_t i : looked) {
                double trials = 0.0;
                for (const double count : pieces_[i].counts.front())
                    trials += count;
                if (trials < kMostOfUsed) uncertain.push_back(&pieces_[i]);
            }
            if (uncertain.empty()) return base::success();
            if (const auto measured = measure(uncertain, kTrialsOfUsed); !measured) return measured.error();
        }
        chains_ = findChains();
        return base::success();
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
    int batches_ = 0;  // so far
    bool forgivesFalls_;
    std::vector<const traps::TrapKind*> kinds_;               // of the traps behind the grooves, each once
    std::vector<std::vector<search::Dimension>> dimensions_;  // of each kind
    std::vector<std::size_t> places_;                         // kinds, along the track
    std::vector<base::Quaternion> ways_;                      // in which parts lie
    std::vector<std::vector<base::Pose>> starts_;  // of each way, and of others; z from the groove's bottom
    Belief arriving_;                              // at the first trap
    std::vector<Piece> pieces_;                    // that are known
    std::vector<std::size_t> used_;                // of these, by the best chain
    std::vector<std::size_t> sieves_;              // of these, findSieves()
    std::vector<Chain> chains_;                    // best first
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
        "Traps can be planned that begin with two grooves and go on with drops and cut-outs, as in \"groove, "
        "groove, 3 x cut-out\"; these are \"{}\".",
        settings.traps);
}

bool isPlanned(const EvolutionSettings& settings) {
    return settings.search == search::Method::genetic &&
           settings.firstGeneration == search::ga::FirstGeneration::planned;
}

std::int64_t estimatePlanningTrials(const EvolutionSettings& settings) {
    constexpr std::int64_t kTrialsOfTrap = 150;  // of whole tracks
    return isPlanned(settings) ? settings.populationSize * kTrapsPerIndividual * kTrialsOfTrap : 0;
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
