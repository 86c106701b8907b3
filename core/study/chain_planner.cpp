#include "core/study/chain_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/objectives/success_share.h"
#include "core/search/racing.h"
#include "core/search/ranking.h"
#include "core/study/chain_search.h"
#include "core/study/evaluator.h"
#include "core/study/selection.h"
#include "core/study/trap_trials.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

namespace {

constexpr std::size_t kLastAgain = 2;  // ledges behind a long chain that are its last one again
constexpr std::size_t kLongChain = 7;  // of so many at least
constexpr std::size_t kTrapsInRound = 32;
constexpr int kRoundsBetweenPlans = 6;
constexpr int kRoundsOfIsland = 24;  // at least
constexpr int kTrapsOfPlan = 500;    // at least, where two are made
constexpr int kMostIslands = 8;
constexpr double kBitsOfDearHalving = 2.0 * objectives::kBitsOfHalving;  // of every other island
constexpr int kFirstTrials = 6;         // from each way on average, of a trap that is new
constexpr int kMoreTrials = 24;         // of one that is promising
constexpr std::size_t kMostShared = 8;  // ways that count for the sum of these trials
constexpr double kMostFromWay = 0.3;    // of these trials
constexpr int kTrialsOfFollowed = 300;  // behind each trap, shared by the best chains
constexpr int kTrialsOfFollowedForPurity = 900;
constexpr std::size_t kMostTraps = 900;    // that are kept
constexpr std::size_t kLatestTraps = 500;  // and of these, besides those that are used, when there are more
constexpr double kMutants = 0.65;          // of new traps, that are like one in use
constexpr double kMostStuck = 0.05;        // of a trap that is of use
constexpr std::size_t kPromising = 5;      // of a round, by each of two measures

// Of a chain that is put together by trials.
struct StageOfPlace {
    std::size_t chains;  // that differ in the trap at one place
    int trials;          // of each, up to that trap
};
constexpr std::array<StageOfPlace, 3> kStagesOfPlace{{{16, 60}, {6, 240}, {3, 800}}};
constexpr int kTrapsOfFullStages = 1500;  // planned; fewer: fewer trials
constexpr int kLeastOfStage = 12;         // trials

// Of whole tracks, of the chains that are judged.
constexpr int kFirstOfJudged = 25;    // trials of each
constexpr int kTrialsOfJudged = 400;  // of the best

/// How well a plan is made.
struct Care {
    std::size_t niches = 0;  // ways to lead parts to, each with its best chain, whose traps' likes are tried
    int trials = 0;          // of each trap that is used, by the ways in which parts come to it
    int inARow = 0;          // plans at most, while what they use is measured
};
constexpr Care kOnTheWay{3, 300, 4};
constexpr Care kAtTheEnd{1, 1000, 12};
constexpr Care kAtTheEndOfPurity{1, 2500, 5};
constexpr int kFollowedAtTheEnd = 2;
constexpr double kUnseenTurnsOfPurity = 0.2;  // one would hide how few of many are turned

/// How many plans are made by themselves, with an equal share of the traps each. Where right ones count by
/// their logarithm every other one goes by that, and the others by their share.
int countPlans(const EvolutionSettings& settings) {
    const bool seeksYield = objectives::contains(summedObjectives(settings), objectives::kYield);
    return seeksYield && seeksPurity(settings) && settings.plannedTraps >= 2 * kTrapsOfPlan ? 2 : 1;
}

/// Trials of whole tracks by which chains are judged: of each, and of the best. Nines are told by many.
std::pair<int, int> judgingTrials(const EvolutionSettings& settings) {
    constexpr int kTimesOfPurity = 5;
    const int times = seeksPurity(settings) ? kTimesOfPurity : 1;
    return {times * kFirstOfJudged, times * kTrialsOfJudged};
}

int trialsOfStage(const EvolutionSettings& settings, const StageOfPlace& stage) {
    const double share = std::min(1.0, settings.plannedTraps / double{kTrapsOfFullStages});
    return std::max(kLeastOfStage, static_cast<int>(share * stage.trials));
}

/// Whether one of the chains that are judged is put together by trials. A plan for purity follows parts along
/// its chains instead, and gained nothing by it; a short one has better use for its time.
bool isPutTogether(const EvolutionSettings& settings) {
    constexpr int kFewTraps = 1000;
    return !seeksPurity(settings) && settings.plannedTraps >= kFewTraps;
}

/// Trials after the last trap was tried by itself, of chains of about seven traps; an estimate.
std::int64_t estimateEnd(const EvolutionSettings& settings) {
    constexpr std::int64_t kPurity = 37000;
    if (seeksPurity(settings)) return kPurity;
    if (!isPutTogether(settings)) return 0;
    constexpr int kTraps = 7;
    std::int64_t trials = 0;
    for (const StageOfPlace& stage : kStagesOfPlace)
        trials += static_cast<std::int64_t>(stage.chains) * trialsOfStage(settings, stage);
    return kTraps * trials;
}

constexpr int kTrialsOfSample = 600;  // that tell the ways
constexpr std::string_view kStopped = "The planning was stopped.";
constexpr double kBitsOfRightAlone = 1.0;  // of halving: log2(right / staying) + log2(staying)

/// What is planned of a chain: not the last ledges of a long one that is to be pure, which are its last but
/// these again.
ChainFrame planFrame(const StudyInputs& inputs, const traps::TrapChain& chain, const ChainAim& aim) {
    ChainFrame frame = makeFrame(chain, aim.then, aim.room, inputs.settings.track);
    if (chain.front()->isLedge && seeksPurity(inputs.settings.evolution) && frame.places.size() >= kLongChain)
        frame.places.resize(frame.places.size() - kLastAgain);
    return frame;
}

class ChainPlanner {
 public:
    ChainPlanner(const StudyInputs& inputs, const traps::TrapChain& chain, const ChainAim& aim,
                 std::function<void(const GenerationPlan&)> planned, const LearningControl& control)
        : inputs_(&inputs),
          aim_(aim),
          trials_(inputs, planFrame(inputs, chain, aim), control.run),
          lastAgain_(chain.size() - frame().before.traps.size() - frame().places.size()),
          planned_(std::move(planned)),
          control_(control),
          doneBefore_(control_.run.done()) {
        for (const traps::TrapKind* kind : frame().kinds)
            dimensions_.push_back(kind->dimensions(settings().track));
    }

    base::Result<std::vector<search::Design>> run(std::size_t most) {
        if (const auto found = findWays(kTrialsOfWays); !found) return found.error();
        if (const auto checked = trials_.checkWays(); !checked) return checked.error();
        const int inRound = static_cast<int>(kTrapsInRound);
        const int rounds = (settings().evolution.plannedTraps + inRound - 1) / inRound;
        const int plans = countPlans(settings().evolution);
        // Plans that are worth the same by arithmetic end far apart, and none of the prices is the right one
        // for all parts: trials of whole tracks decide between them.
        std::vector<search::Design> designs;
        for (int i = 0; i < plans; ++i) {
            search_.seekYield(i % 2 == 1);
            plansLeft_ = plans - i;
            if (const auto found = planRounds(i * rounds / plans, (i + 1) * rounds / plans, rounds); !found)
                return found.error();
            const auto share = static_cast<std::size_t>(plans);
            const auto tried = putTogether();
            if (!tried) return tried.error();
            if (*tried) designs.push_back(designOf(**tried));
            for (search::Design& design : listDesigns((most + share - 1) / share))
                if (std::ranges::find(designs, design) == designs.end()) designs.push_back(std::move(design));
            if (i + 1 == plans) break;
            search_.leave(0);
            trials_.forgetFollowed();
        }
        auto judged = judge(std::move(designs));
        if (judged && judged->size() > most) judged->resize(most);
        return judged;
    }

    /// From nothing, of so many rounds of all; the best chains are search_'s then.
    base::Status planRounds(int first, int last, int rounds) {
        // What is found first decides in which ways traps lead, and what is tried next. So several plans
        // begin by themselves, and what is best of each is what the last part of the work begins with.
        const int begun = 2 * (last - first) / 3;
        const int islands = std::min(begun / kRoundsOfIsland, kMostIslands);
        std::vector<KnownTrap> found;
        int round = first;
        for (int island = 0; islands > 1 && island < islands; ++island) {
            const int end = first + (island + 1) * begun / islands;
            // Where throwing parts out costs more, a plan turns as many as it can.
            if (!aim_.isRightAlone && island % 2 == 0) search_.setBitsOfHalving(kBitsOfDearHalving);
            if (const auto done = goOn(round, end, rounds); !done) return done.error();
            round = end;
            // What is of use joins the others', and the next plan begins with nothing.
            std::ranges::move(search_.leave(found.empty() ? frame().kinds.size() : 0),
                              std::back_inserter(found));
            trials_.forgetFollowed();
            search_.setBitsOfHalving(bitsOfHalving());
        }
        search_.traps() = std::move(found);
        if (!search_.traps().empty()) {
            if (const auto joined = plan(kOnTheWay); !joined) return joined.error();
        }
        if (const auto done = goOn(round, last, rounds); !done) return done.error();
        return planAtTheEnd();
    }

    /// Where purity is sought, again with what comes through the chain that was found: a part in a thousand
    /// is met by no trial that begins before all traps.
    base::Status planAtTheEnd() {
        if (!search_.problem().seeksPurity) return plan(kAtTheEnd);
        const auto tellLeft = [&](int plans) {
            // Another plan takes as much as this one.
            const std::int64_t done = control_.run.done() - doneBefore_;
            tellProgress(plansLeft_ *
                         (done + plans * estimateEnd(settings().evolution) / (1 + kFollowedAtTheEnd)));
        };
        tellLeft(1 + kFollowedAtTheEnd);
        if (const auto first = plan(kAtTheEndOfPurity); !first) return first.error();
        for (int again = 0; again < kFollowedAtTheEnd && frame().places.size() > 1; ++again) {
            if (search_.chains().empty()) break;
            tellLeft(kFollowedAtTheEnd - again);
            if (const auto followed = followParts(); !followed) return followed.error();
            if (const auto planned = plan(kAtTheEndOfPurity); !planned) return planned.error();
        }
        return base::success();
    }

    /// Rounds of traps, planned with from time to time.
    base::Status goOn(int round, int end, int rounds) {
        for (; round < end; ++round) {
            if (control_.stopRequested()) return base::Error{std::string(kStopped)};
            tellProgress((control_.run.done() - doneBefore_) * rounds / std::max(1, round) +
                         plansLeft_ * estimateEnd(settings().evolution));
            if (const auto tried = tryTraps(round); !tried) return tried.error();
            if (round + 1 < end && round % kRoundsBetweenPlans != kRoundsBetweenPlans - 1) continue;
            if (const auto improved = plan(kOnTheWay); !improved) return improved.error();
            if (round + 1 == end || search_.chains().empty()) continue;
            if (const auto followed = followParts(); !followed) return followed.error();
        }
        return base::success();
    }

    /// In which ways parts come to the first trap, by so many trials, and what chains are worth.
    base::Status findWays(int trials) {
        ChainProblem problem;
        problem.forgivesFalls = aim_.isRightAlone || forgivesFalls(settings().evolution);
        const objectives::ObjectiveList summed = summedObjectives(settings().evolution);
        problem.seeksPurity = seeksPurity(settings().evolution);
        // Where right parts are not in the sum they decide between chains that are as pure.
        if (!objectives::contains(summed, objectives::kYield) &&
            !objectives::contains(summed, objectives::kSuccess))
            problem.rightAsNines = 0.1;
        if (problem.seeksPurity) problem.unseenTurns = kUnseenTurnsOfPurity;
        tellProgress(trials);
        if (const auto found = trials_.findWays(trials, problem); !found) return found.error();
        search_ = ChainSearch(std::move(problem));
        search_.setBitsOfHalving(bitsOfHalving());
        return base::success();
    }

    /// Seconds of a trial of traps at random, by so many traps as take about `budget` seconds; 0 if parts
    /// come through no groove.
    base::Result<double> timeTraps(double budget) {
        using Clock = std::chrono::steady_clock;
        if (search_.problem().ways == 0) return 0.0;
        base::Random random({settings().evolution.seed, 0, 0, 0, base::Purpose::planning});
        for (std::size_t count = kTrapsInRound / 4;; count *= 2) {
            std::vector<KnownTrap> tried;
            for (std::size_t i = 0; i < count; ++i)
                tried.push_back(drawTrap(i % frame().kinds.size(), random));
            std::vector<Work> works;
            works.reserve(count);
            for (KnownTrap& trap : tried)
                works.push_back({&trap, shareTrials(kFirstTrials)});
            const std::int64_t before = control_.run.done();
            const Clock::time_point begin = Clock::now();
            if (const auto measured = trials_.measure(works); !measured) return measured.error();
            const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
            if (2.0 * seconds < budget && count < kMostTraps) continue;
            return seconds / static_cast<double>(std::max<std::int64_t>(1, control_.run.done() - before));
        }
    }

    /// What so many traps at random do by themselves; the best of them are measured again.
    base::Result<AloneSample> tryAlone(int count) {
        const ChainProblem& problem = search_.problem();
        AloneSample sample;
        if (problem.ways == 0) return sample;
        const auto mostOf = [&](const WayShares& parts) {
            return *std::max_element(parts.begin(),
                                     parts.begin() + static_cast<std::ptrdiff_t>(problem.ways));
        };
        const double coming = 1.0 - problem.arriving[problem.stuck()] - problem.arriving[problem.fallen()];
        sample.unturned = mostOf(problem.arriving) / coming;
        base::Random random({settings().evolution.seed, 0, 0, 0, base::Purpose::planning});
        std::vector<KnownTrap> tried;
        const auto traps = static_cast<std::size_t>(count);
        tried.reserve(traps);
        for (std::size_t i = 0; i < traps; ++i)
            tried.push_back(drawTrap(i % frame().kinds.size(), random));
        for (const int each : {kFirstTrials, kMoreTrials}) {
            std::vector<Work> works;
            works.reserve(tried.size());
            for (KnownTrap& trap : tried)
                works.push_back({&trap, shareTrials(each)});
            if (const auto measured = trials_.measure(works); !measured) return measured.error();
            std::ranges::stable_sort(tried, std::greater(), [&](const KnownTrap& trap) {
                return mostOf(pass(problem.arriving, trap.chances));
            });
            tried.resize(std::min(tried.size(), kPromising));
        }
        sample.best = mostOf(pass(problem.arriving, tried.front().chances)) / coming;
        return sample;
    }

    [[nodiscard]] std::size_t rows() const { return trials_.rows(); }

 private:
    [[nodiscard]] const Settings& settings() const { return inputs_->settings; }
    [[nodiscard]] const ChainFrame& frame() const { return trials_.frame(); }
    [[nodiscard]] double bitsOfHalving() const {
        return aim_.isRightAlone ? kBitsOfRightAlone : objectives::kBitsOfHalving;
    }
    void tellProgress(std::int64_t trials) const {
        if (!planned_) return;
        const EvolutionSettings& evolution = settings().evolution;
        const int population = evolution.populationSize;
        // Of a race about half.
        const int share = evolution.racingTrials > 0 ? 2 : 1;
        const std::int64_t later = std::int64_t{population} * evolution.trialsPerEvaluation / share;
        planned_({0, population, population, trials, doneBefore_, std::max<std::int64_t>(1, later),
                  calcWantedUnturned(search_.problem())});
    }

    [[nodiscard]] KnownTrap makeTrap(std::size_t kind, std::vector<double> numbers) const {
        WayMatrix counts(rows(), WayShares(search_.problem().columns(), 0.0));
        return {kind, std::move(numbers), std::move(counts), {}, 0.0};
    }

    KnownTrap drawTrap(std::size_t kind, base::Random& random) const {
        KnownTrap trap = makeTrap(kind, {});
        for (const search::Dimension& dimension : dimensions_[kind])
            trap.numbers.push_back(search::drawNumber(dimension, random));
        return trap;
    }

    KnownTrap mutate(const KnownTrap& parent, base::Random& random) const {
        KnownTrap trap = makeTrap(parent.kind, parent.numbers);
        search::mutateNumbers(trap.numbers, dimensions_[parent.kind], random);
        return trap;
    }

    /// A round of new traps: all a few times, and those that do something more often.
    base::Status tryTraps(int round) {
        base::Random random(
            {settings().evolution.seed, 0, static_cast<std::uint32_t>(round), 0, base::Purpose::planning});
        std::vector<KnownTrap> tried;
        for (std::size_t i = 0; i < kTrapsInRound; ++i) {
            if (search_.traps().empty() && i < frame().kinds.size()) {
                // All numbers in the middle: a cut-out that cuts nothing lets a chain do with fewer.
                KnownTrap typical = drawTrap(i, random);
                for (std::size_t k = 0; k < typical.numbers.size(); ++k)
                    typical.numbers[k] = search::roundToBits(0.5, dimensions_[i][k].bits);
                tried.push_back(std::move(typical));
            } else if (!search_.used().empty() && random.uniform() < kMutants) {
                const std::vector<std::size_t>& parents =
                    random.boolean() ? search_.used() : search_.sieves();
                tried.push_back(
                    mutate(search_.traps()[parents[random.below(static_cast<std::uint32_t>(parents.size()))]],
                           random));
            } else {
                tried.push_back(drawTrap(i % frame().kinds.size(), random));
            }
        }
        std::vector<Work> works;
        works.reserve(tried.size());
        for (KnownTrap& trap : tried)
            works.push_back({&trap, shareTrials(kFirstTrials)});
        if (const auto measured = trials_.measure(works); !measured) return measured.error();
        works.clear();
        for (const std::size_t i : choosePromising(tried, search_.traps().empty() ? frame().kinds.size() : 0))
            works.push_back({&tried[i], shareTrials(kMoreTrials)});
        if (works.empty()) return base::success();
        if (const auto measured = trials_.measure(works); !measured) return measured.error();
        for (const Work& work : works)
            search_.traps().push_back(std::move(*work.trap));
        return base::success();
    }

    /// Trials from each way, `each` on average: the more, the larger a share of the parts lies so before any
    /// trap, as what is not known of a way counts by how many come in it.
    [[nodiscard]] std::vector<int> shareTrials(int each) const {
        WayShares most(search_.problem().arriving.begin(),
                       search_.problem().arriving.begin() + static_cast<std::ptrdiff_t>(rows()));
        for (const Chain& chain : search_.niches()) {
            for (const WayShares& coming : search_.listComing(chain))
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
    [[nodiscard]] std::vector<std::size_t> choosePromising(const std::vector<KnownTrap>& tried,
                                                           std::size_t sure) const {
        const ChainProblem& problem = search_.problem();
        std::set<std::size_t> chosen;
        for (std::size_t i = 0; i < sure; ++i)
            chosen.insert(i);
        std::vector<std::size_t> fit;
        std::vector<double> alone(tried.size());
        for (std::size_t i = sure; i < tried.size(); ++i) {
            const WayShares once = pass(problem.arriving, tried[i].chances);
            alone[i] = std::max(search_.worthOf(once), search_.worthOf(search_.repeat(tried[i])));
            if (once[problem.stuck()] - problem.arriving[problem.stuck()] <= kMostStuck) fit.push_back(i);
        }
        const auto choose = [&](const std::vector<double>& worth, std::size_t count) {
            std::stable_sort(fit.begin(), fit.end(),
                             [&](std::size_t a, std::size_t b) { return worth[a] > worth[b]; });
            chosen.insert(fit.begin(),
                          fit.begin() + static_cast<std::ptrdiff_t>(std::min(count, fit.size())));
        };
        choose(alone, search_.niches().empty() ? 2 * kPromising : kPromising);
        for (std::size_t niche = 0; niche < search_.niches().size(); ++niche) {
            std::vector<double> inChain(tried.size());
            for (const std::size_t i : fit)
                inChain[i] = search_.worthInChain(tried[i], search_.niches()[niche]);
            // The best chain's share is what the others leave.
            choose(inChain, niche > 0 ? 1 : kPromising + 1 - search_.niches().size());
        }
        return {chosen.begin(), chosen.end()};
    }

    /// Finds the best chains, and measures what they use, until that is known well enough.
    base::Status plan(const Care& care) {
        search_.findSieves();
        if (search_.traps().size() > kMostTraps) search_.forget(frame().kinds.size(), kLatestTraps);
        for (int again = 0; again < care.inARow; ++again) {
            search_.findChains(care.niches);
            if (search_.chains().empty()) return base::success();
            search_.findSieves();
            const std::vector<std::size_t>& sieves = search_.sieves();
            std::set<std::size_t> looked(search_.used().begin(), search_.used().end());
            looked.insert(sieves.begin(), sieves.begin() + std::min<std::ptrdiff_t>(2, std::ssize(sieves)));
            std::vector<Work> works;
            for (const std::size_t i : looked) {
                Work work = findUncertain(i, care.trials);
                if (work.trap != nullptr) works.push_back(std::move(work));
            }
            if (works.empty()) break;
            if (const auto measured = trials_.measure(works); !measured) return measured.error();
        }
        search_.findChains(care.niches);
        return base::success();
    }

    [[nodiscard]] TrapRow rowOf(std::span<const std::size_t> traps) const {
        TrapRow row;
        for (const std::size_t i : traps)
            row.push_back(&search_.traps()[i]);
        return row;
    }

    /// What the traps of the best chains do is counted with the parts that come to them from then on.
    base::Status followParts() {
        std::vector<TrapRow> chains;
        for (const Chain& chain : search_.niches())
            chains.push_back(rowOf(chain.traps));
        const bool isPure = search_.problem().seeksPurity;
        const int trials =
            (isPure ? kTrialsOfFollowedForPurity : kTrialsOfFollowed) / static_cast<int>(chains.size());
        if (const auto followed = trials_.followParts(chains, trials, isPure); !followed)
            return followed.error();
        for (const std::size_t i : std::set<std::size_t>(search_.used().begin(), search_.used().end())) {
            for (WayShares& counts : search_.traps()[i].counts)
                for (double& count : counts)
                    count *= 0.5;
        }
        return base::success();
    }

    /// A chain whose traps are chosen one after the other, in a race of those that arithmetic holds for the
    /// best, by trials of all that is before and of the trap; what follows is told by arithmetic. None if no
    /// chain was found, or none is wanted.
    base::Result<std::optional<Chain>> putTogether() {
        std::optional<Chain> best;
        if (search_.chains().empty() || !isPutTogether(settings().evolution)) return best;
        Chain begun{{}, search_.problem().arriving, 0.0, 0.0};
        for (std::size_t place = 0; place < frame().places.size(); ++place) {
            if (control_.stopRequested()) return base::Error{std::string(kStopped)};
            const auto told = search_.complete(begun);
            if (!told) break;
            std::vector<Chain> chains = search_.exchangeNext(begun, *told, kStagesOfPlace.front().chains);
            for (const StageOfPlace& stage : kStagesOfPlace) {
                chains.resize(std::min(chains.size(), stage.chains));
                const int trials = trialsOfStage(settings().evolution, stage);
                if (const auto tried = tryBeginnings(chains, place + 1, trials); !tried) return tried.error();
            }
            best = std::move(chains.front());
            begun = {{best->traps.begin(), best->traps.begin() + std::ssize(begun.traps) + 1},
                     best->parts,
                     best->worth,
                     begun.fall + search_.traps()[best->traps[place]].fall};
        }
        return best;
    }

    /// So many of the traps of each chain, all with the same parts: where these are behind them, and what the
    /// chain is worth then. Best first.
    base::Status tryBeginnings(std::vector<Chain>& chains, std::size_t count, int trials) {
        std::vector<TrapRow> beginnings;
        beginnings.reserve(chains.size());
        for (const Chain& chain : chains)
            beginnings.push_back(rowOf(std::span(chain.traps).first(count)));
        auto shares = trials_.findShares(beginnings, trials);
        if (!shares) return shares.error();
        for (std::size_t i = 0; i < chains.size(); ++i) {
            chains[i].worth = search_.worthOf(search_.passOn((*shares)[i], chains[i], count));
            chains[i].parts = std::move((*shares)[i]);
        }
        std::ranges::stable_sort(chains, std::greater(), &Chain::worth);
        return base::success();
    }

    /// Trials that tell more of a trap, from the ways in which parts come to it in the chains that use it;
    /// none if all of them are known well.
    Work findUncertain(std::size_t index, int trials) {
        WayShares coming(rows(), 0.0);
        bool isUsed = false;
        for (const Chain& chain : search_.niches()) {
            const std::vector<WayShares> before = search_.listComing(chain);
            for (std::size_t place = 0; place < chain.traps.size(); ++place) {
                if (chain.traps[place] != index) continue;
                isUsed = true;
                for (std::size_t way = 0; way < rows(); ++way)
                    coming[way] = std::max(coming[way], before[place][way]);
            }
        }
        if (!isUsed) coming = search_.problem().arriving;
        Work work{nullptr, std::vector<int>(rows(), 0)};
        for (std::size_t way = 0; way < rows(); ++way) {
            const WayShares& counts = search_.traps()[index].counts[way];
            const auto known = static_cast<int>(std::accumulate(counts.begin(), counts.end(), 0.0));
            const auto wanted = static_cast<int>(std::min(kMostFromWay, coming[way]) * trials);
            if (known >= wanted) continue;
            work.trials[way] = wanted - known;
            work.trap = &search_.traps()[index];
        }
        return work;
    }

    /// The last ledge lets right parts pass, and throws out again what it should have thrown out, which no
    /// arithmetic of shares below a thousandth tells. Where the track is too low for that: ledges not cut.
    void repeatLast(search::Design& design, const Chain& chain) const {
        const KnownTrap& last = search_.traps()[chain.traps.back()];
        double fall = chain.fall;
        for (std::size_t again = 0; again < lastAgain_; ++again) {
            fall += last.fall;
            const search::Design& numbers =
                fall <= search_.problem().mostFall ? last.numbers : frame().before.numbers;
            design.insert(design.end(), numbers.begin(), numbers.end());
        }
    }

    [[nodiscard]] search::Design designOf(const Chain& chain) const {
        search::Design design = frame().before.numbers;
        for (const std::size_t i : chain.traps) {
            const std::vector<double>& numbers = search_.traps()[i].numbers;
            design.insert(design.end(), numbers.begin(), numbers.end());
        }
        repeatLast(design, chain);
        return design;
    }

    [[nodiscard]] std::vector<search::Design> listDesigns(std::size_t most) const {
        std::vector<search::Design> designs;
        for (const Chain& chain : search_.chains()) {
            if (designs.size() == most) break;
            search::Design design = designOf(chain);
            if (std::find(designs.begin(), designs.end(), design) == designs.end())
                designs.push_back(std::move(design));
        }
        return designs;
    }

    /// The best by arithmetic are judged again by trials of whole tracks, as a generation is, in a race
    /// (core/search/racing.h): what a trap does to parts depends a little on the traps before it, and the
    /// one that looks best of many is often one that was lucky. The others follow as they were.
    base::Result<std::vector<search::Design>> judge(std::vector<search::Design> designs) {
        const std::size_t judged = std::min(designs.size(), kJudgedChains);
        StudyInputs race = *inputs_;
        std::tie(race.settings.evolution.racingTrials, race.settings.evolution.trialsPerEvaluation) =
            judgingTrials(settings().evolution);
        race.settings.evolution.racingShare = search::kTopShare;
        std::vector<search::Proposal> proposals(judged);
        const FixedTraps& then = frame().then;
        for (const traps::TrapKind* kind : then.traps)
            race.settings.track.traps += fmt::format(", {}", kind->key);
        for (std::size_t i = 0; i < judged; ++i) {
            proposals[i].design = designs[i];
            proposals[i].design.insert(proposals[i].design.end(), then.numbers.begin(), then.numbers.end());
        }
        const auto tell = [&](const GenerationPlan& plan) {
            tellProgress(plan.doneBefore - doneBefore_ + plan.trials);
        };
        const auto judgement = evaluateGeneration(race, 0, proposals, tell, control_.run);
        if (!judgement) return judgement.error();
        std::vector<double> totals;
        for (const IndividualRecord& record : judgement->individuals)
            totals.push_back(record.fitness.total);
        const std::vector<search::Design> before = designs;
        const std::vector<std::size_t> ranking = search::rankByFitness(totals);
        std::transform(ranking.begin(), ranking.end(), designs.begin(),
                       [&](std::size_t i) { return before[i]; });
        return designs;
    }

    const StudyInputs* inputs_;
    ChainAim aim_;
    TrapTrials trials_;
    std::size_t lastAgain_;  // traps behind those that are planned
    std::function<void(const GenerationPlan&)> planned_;
    LearningControl control_;
    std::int64_t doneBefore_;
    int plansLeft_ = 1;                                       // with the one that is made
    std::vector<std::vector<search::Dimension>> dimensions_;  // of each kind of trap
    ChainSearch search_;
};
}  // namespace

bool seeksPurity(const EvolutionSettings& settings) {
    return objectives::contains(summedObjectives(settings), objectives::kPurity);
}

base::Result<std::vector<search::Design>> planChain(const StudyInputs& inputs, const traps::TrapChain& chain,
                                                    const ChainAim& aim, std::size_t most,
                                                    std::function<void(const GenerationPlan&)> planned,
                                                    const LearningControl& control) {
    return ChainPlanner(inputs, chain, aim, std::move(planned), control).run(most);
}

base::Result<ChainSample> sampleChain(const StudyInputs& inputs, const traps::TrapChain& chain,
                                      const ChainAim& aim, double budget, const base::RunControl& control) {
    LearningControl counting;
    counting.run = control;
    ChainPlanner planner(inputs, chain, aim, {}, counting);
    if (const auto found = planner.findWays(kTrialsOfSample); !found) return found.error();
    const auto each = planner.timeTraps(budget);
    if (!each) return each.error();
    return ChainSample{static_cast<int>(planner.rows()), *each};
}

base::Result<AloneSample> sampleAlone(const StudyInputs& inputs, const traps::TrapChain& chain, int traps,
                                      const base::RunControl& control) {
    LearningControl counting;
    counting.run = control;
    ChainPlanner planner(inputs, chain, {}, {}, counting);
    if (const auto found = planner.findWays(kTrialsOfSample); !found) return found.error();
    return planner.tryAlone(traps);
}

std::int64_t estimateAloneTrials(int traps, int ways) {
    const std::int64_t each = std::min(ways, static_cast<int>(kMostShared));
    return kTrialsOfSample +
           each * (std::int64_t{traps} * kFirstTrials + std::int64_t{kPromising} * kMoreTrials);
}

std::int64_t estimateTrapTrials(const EvolutionSettings& settings, int ways) {
    // Of a trap by itself, from the ways that share trials and from each of the others, and what the plans
    // from time to time take.
    constexpr int kShared = 14;
    constexpr int kOthers = 2;
    constexpr int kPlans = 12;
    constexpr int kMost = kMostShared;
    const int each = kShared * std::min(ways, kMost) + kOthers * std::max(0, ways - kMost) + kPlans;
    // For purity parts are followed through longer, and at the end again.
    const bool isPure = seeksPurity(settings);
    const int followed = isPure ? 28 : 0;
    constexpr double kLonger = 2.5;  // half a chain than a trap by itself
    const double end = (isPutTogether(settings) ? kLonger : 1.0) * static_cast<double>(estimateEnd(settings));
    return kTrialsOfWays + std::int64_t{settings.plannedTraps} * (each + followed) +
           countPlans(settings) * std::llround(end);
}

std::int64_t estimateJudgingOf(const EvolutionSettings& settings, std::size_t designs) {
    const std::size_t judged = std::min(kJudgedChains, designs);
    const std::vector<int> none(judged, 0);
    const auto [first, most] = judgingTrials(settings);
    return search::countRacingTrials(none, static_cast<int>(judged),
                                     search::makeRacingStages(judged, first, most, search::kTopShare));
}

}  // namespace trapwright::study
