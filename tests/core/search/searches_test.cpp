// What every search must do, whichever it is, and what is each one's own.

#include <QtTest>
#include <cmath>
#include <set>

#include "core/search/ga/genetic_search.h"
#include "core/search/methods.h"
#include "core/search/ranking.h"

using namespace trapwright;
using search::Method;
namespace ga = trapwright::search::ga;

namespace {

/// Points of 10 bits among numbers of 6 bits and one that may be any: in no order of genes.
search::DesignSpace someSpace() {
    search::DesignSpace space;
    for (int i = 0; i < 6; ++i) {
        space.dimensions.push_back({"single " + std::to_string(i), "mm", 0.0, 1.0, 6});
        space.dimensions.push_back({"y " + std::to_string(i), "mm", 0.0, 1.0, 10, true});
        space.dimensions.push_back({"z " + std::to_string(i), "mm", 0.0, 1.0, 10, true});
    }
    space.dimensions.push_back({"real", "", 0.0, 1.0});
    return space;
}

constexpr std::size_t kLines = 6;
constexpr std::size_t kOfLine = 5;

/// Lines that are alike, as those of a chain of one kind of trap, and a number by itself.
search::DesignSpace chainSpace() {
    search::DesignSpace space;
    for (std::size_t line = 0; line < kLines; ++line) {
        for (std::size_t i = 0; i < kOfLine; ++i) {
            search::Dimension& dimension = space.dimensions.emplace_back();
            dimension.key = "trap " + std::to_string(line) + ": number " + std::to_string(i);
            dimension.bits = 10;
            dimension.line = static_cast<int>(line);
        }
    }
    space.dimensions.push_back({"alone", "mm", 0.0, 1.0});
    space.dimensions.back().line = kLines;
    return space;
}

search::Design lineOf(const search::Design& design, std::size_t line) {
    const auto begin = design.begin() + static_cast<std::ptrdiff_t>(line * kOfLine);
    return {begin, begin + static_cast<std::ptrdiff_t>(kOfLine)};
}

search::SearchParameters someParameters() {
    search::SearchParameters parameters;
    parameters.seed = 3;
    parameters.populationSize = 40;
    parameters.genetic = {6, {0.002, 0.3, 0.0005}};
    return parameters;
}

/// Best where all numbers are 0.7.
std::vector<search::Judgement> judge(const std::vector<search::Proposal>& proposals) {
    std::vector<search::Judgement> judgements;
    for (const search::Proposal& proposal : proposals) {
        double sum = 0.0;
        for (const double number : proposal.design)
            sum -= (number - 0.7) * (number - 0.7);
        judgements.push_back({sum, 10});
    }
    return judgements;
}

bool same(const std::vector<search::Proposal>& a, const std::vector<search::Proposal>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.design == y.design && x.traits == y.traits;
    });
}

std::vector<std::string> keysOf(const std::vector<search::NamedNumber>& numbers) {
    std::vector<std::string> keys;
    keys.reserve(numbers.size());
    for (const search::NamedNumber& number : numbers)
        keys.push_back(number.key);
    return keys;
}

std::vector<std::string> keysOf(const std::vector<search::NumberInfo>& infos) {
    std::vector<std::string> keys;
    keys.reserve(infos.size());
    for (const search::NumberInfo& info : infos)
        keys.push_back(info.key);
    return keys;
}

QString messageOf(const base::Status& status) {
    return QString::fromStdString(status.ok() ? "" : status.error().message);
}

void addMethods() {
    QTest::addColumn<int>("method");
    for (const auto& [name, method] : search::kMethods)
        QTest::newRow(name.data()) << static_cast<int>(method);
}

}  // namespace

class SearchesTest : public QObject {
    Q_OBJECT

 private slots:
    void designsAreOfTheSpace_data() { addMethods(); }
    void designsAreOfTheSpace() {
        QFETCH(int, method);
        const search::DesignSpace space = someSpace();
        const auto search = search::makeSearch(Method(method), space, someParameters());
        for (int generation = 0; generation < 3; ++generation) {
            const auto proposals = search->ask();
            QCOMPARE(proposals.size(), std::size_t{40});
            for (const search::Proposal& proposal : proposals) {
                QVERIFY(space.check(proposal.design).ok());
                for (std::size_t i = 0; i < space.dimensions.size(); ++i)
                    QCOMPARE(search::roundToBits(proposal.design[i], space.dimensions[i].bits),
                             proposal.design[i]);
            }
            search->tell(judge(proposals));
        }
    }

    void tellsOfItselfWhatItsMethodLists_data() { addMethods(); }
    void tellsOfItselfWhatItsMethodLists() {
        QFETCH(int, method);
        const search::MethodInfo& info = search::describeMethod(Method(method));
        const auto search = search::makeSearch(Method(method), someSpace(), someParameters());
        const auto proposals = search->ask();
        search->tell(judge(proposals));
        QVERIFY(!info.curves.empty());
        QVERIFY(keysOf(search->report()) == keysOf(info.curves));
        for (const search::Proposal& proposal : proposals)
            QVERIFY(keysOf(proposal.traits) == keysOf(info.traits));
        for (const search::NumberInfo& curve : info.curves) {
            QVERIFY(!curve.name.empty() && curve.help.ends_with('.') && !curve.axis.empty());
            QCOMPARE(search::findCurve(curve.key), &curve);
        }
        QVERIFY(search::findCurve("nothing") == nullptr);
    }

    // Rates gene by gene are told of, saved and loaded; the state of one scope is none of the other.
    void ratesByGeneAreToldOf() {
        search::SearchParameters parameters = someParameters();
        parameters.genetic.scope = ga::StrategyScope::gene;
        const search::MethodInfo& info = search::describeMethod(Method::genetic, ga::StrategyScope::gene);
        QCOMPARE(info.curves.size(), std::size_t{7});
        const auto search = search::makeSearch(Method::genetic, someSpace(), parameters);
        const auto proposals = search->ask();
        search->tell(judge(proposals));
        QVERIFY(keysOf(search->report()) == keysOf(info.curves));
        for (const search::Proposal& proposal : proposals)
            QVERIFY(keysOf(proposal.traits) == keysOf(info.traits));
        for (const search::NumberInfo& curve : info.curves) {
            QVERIFY(!curve.name.empty() && curve.help.ends_with('.') && !curve.axis.empty());
            QVERIFY(search::findCurve(curve.key) != nullptr);
        }
        const auto resumed = search::makeSearch(Method::genetic, someSpace(), parameters);
        QVERIFY(resumed->load(search->save()).ok());
        const auto next = search->ask();
        const auto nextResumed = resumed->ask();
        QCOMPARE(nextResumed.size(), next.size());
        for (std::size_t i = 0; i < next.size(); ++i)
            QVERIFY(nextResumed[i].design == next[i].design && nextResumed[i].traits == next[i].traits);
        const auto other = search::makeSearch(Method::genetic, someSpace(), someParameters());
        const auto refused = other->load(search->save());
        QVERIFY(!refused.ok());
        QVERIFY2(refused.error().message.find("140 bits") != std::string::npos,
                 refused.error().message.c_str());
    }

    void askingTwiceGivesTheSame_data() { addMethods(); }
    void askingTwiceGivesTheSame() {
        QFETCH(int, method);
        const auto one = search::makeSearch(Method(method), someSpace(), someParameters());
        const auto other = search::makeSearch(Method(method), someSpace(), someParameters());
        for (int generation = 0; generation < 3; ++generation) {
            const auto proposals = one->ask();
            QVERIFY(same(proposals, one->ask()));
            QVERIFY(same(proposals, other->ask()));
            one->tell(judge(proposals));
            other->tell(judge(proposals));
        }
        search::SearchParameters seeded = someParameters();
        ++seeded.seed;
        QVERIFY(!same(search::makeSearch(Method(method), someSpace(), seeded)->ask(),
                      search::makeSearch(Method(method), someSpace(), someParameters())->ask()));
    }

    void goesOnFromItsState_data() { addMethods(); }
    void goesOnFromItsState() {
        QFETCH(int, method);
        auto whole = search::makeSearch(Method(method), someSpace(), someParameters());
        std::string state;
        for (int generation = 0; generation < 5; ++generation) {
            const auto resumed = search::makeSearch(Method(method), someSpace(), someParameters());
            if (generation > 0) QVERIFY(resumed->load(state).ok());
            const auto proposals = whole->ask();
            QVERIFY(same(resumed->ask(), proposals));
            whole->tell(judge(proposals));
            resumed->tell(judge(proposals));
            QVERIFY(whole->report() == resumed->report());
            state = whole->save();
            QCOMPARE(resumed->save(), state);
        }
    }

    // Whatever is wrong with the bytes: an error, no crash, and the search as it was.
    void damagedStateIsRefused_data() { addMethods(); }
    void damagedStateIsRefused() {
        QFETCH(int, method);
        const auto search = search::makeSearch(Method(method), someSpace(), someParameters());
        const auto first = search->ask();
        search->tell(judge(first));
        const std::string state = search->save();
        const auto next = search->ask();
        for (std::size_t length = 0; length < state.size(); length += 1 + length / 50)
            QVERIFY(!search->load(std::string_view(state).substr(0, length)).ok());
        QVERIFY(!search->load(state + "x").ok());
        base::Random random({.seed = 8});
        for (int run = 0; run < 300; ++run) {
            std::string damaged = state;
            damaged[random.below(static_cast<std::uint32_t>(damaged.size()))] ^=
                static_cast<char>(1 + random.below(255));
            const auto other = search::makeSearch(Method(method), someSpace(), someParameters());
            if (other->load(damaged).ok()) QVERIFY(!other->ask().empty());
        }
        QVERIFY(same(search->ask(), next));
        for (const auto& [name, another] : search::kMethods) {
            if (another == Method(method)) continue;
            QVERIFY(messageOf(search::makeSearch(another, someSpace(), someParameters())->load(state))
                        .startsWith("This is not the state of a"));
        }
    }

    void genesOfAnotherSpaceAreRefused() {
        const auto search = search::makeSearch(Method::genetic, someSpace(), someParameters());
        search->tell(judge(search->ask()));
        search::DesignSpace smaller = someSpace();
        smaller.dimensions.pop_back();
        const auto other = search::makeSearch(Method::genetic, smaller, someParameters());
        QVERIFY(messageOf(other->load(search->save())).contains("120, 56 and 60 bits"));
    }

    // The paper's algorithm and exchanges do what they are there for, drawing at random does not.
    void breedingAndExchangingBeatChance() {
        const auto bestOf = [](Method method) {
            const auto search = search::makeSearch(method, someSpace(), someParameters());
            double best = -1e9;
            for (int generation = 0; generation < 60; ++generation) {
                const auto judgements = judge(search->ask());
                for (const search::Judgement& judgement : judgements)
                    best = std::max(best, judgement.score);
                search->tell(judgements);
            }
            return best;
        };
        const double bred = bestOf(Method::genetic);
        const double drawn = bestOf(Method::random);
        QVERIFY2(bred > -0.1 && drawn < -0.4, qPrintable(QString("%1, %2").arg(bred).arg(drawn)));
        const double exchanged = bestOf(Method::exchange);
        QVERIFY2(exchanged > -0.1, qPrintable(QString::number(exchanged)));
    }

    // Lines of a kind are exchanged whole or a little, and all others stay.
    void exchangesTouchOneLineOrTwoUnlessTheyMove() {
        const search::DesignSpace space = chainSpace();
        search::SearchParameters parameters = someParameters();
        parameters.populationSize = 400;
        const auto search = search::makeSearch(Method::exchange, space, parameters);
        std::vector<search::Proposal> begun(2);
        for (std::size_t line = 0; line < kLines; ++line) {
            for (std::size_t i = 0; i < kOfLine; ++i) {
                begun[0].design.push_back(search::roundToBits(0.1 * static_cast<double>(line), 10));
                begun[1].design.push_back(search::roundToBits(0.05 + 0.1 * static_cast<double>(line), 10));
            }
        }
        begun[0].design.push_back(0.5);
        begun[1].design.push_back(0.25);
        search->begin(begun);
        const auto first = search->ask();
        QVERIFY(first[0].design == begun[0].design && first[1].design == begun[1].design);
        std::vector<search::Judgement> judgements(first.size(), {0.0, 10});
        judgements[0].score = 1.0;
        search->tell(judgements);

        const auto children = search->ask();
        QVERIFY(children[0].design == begun[0].design);
        int little = 0;
        int adopted = 0;
        int moved = 0;
        for (std::size_t child = 1; child < children.size(); ++child) {
            QVERIFY(children[child].design != begun[0].design);
            int changed = 0;
            int few = 0;
            std::multiset<search::Design> lines;
            std::multiset<search::Design> before;
            for (std::size_t line = 0; line < kLines; ++line) {
                const search::Design now = lineOf(children[child].design, line);
                const search::Design old = lineOf(begun[0].design, line);
                lines.insert(now);
                before.insert(old);
                if (now == old) continue;
                ++changed;
                int numbers = 0;
                for (std::size_t i = 0; i < kOfLine; ++i)
                    numbers += now[i] != old[i] ? 1 : 0;
                few += numbers <= 3 ? 1 : 0;
                for (std::size_t other = 0; other < kLines; ++other)
                    adopted += now == lineOf(begun[1].design, other) ? 1 : 0;
            }
            if (changed == few) ++little;
            if (changed > 1 && lines == before) ++moved;
            QVERIFY(changed <= 2 || few < changed);
        }
        QVERIFY2(little > 100 && adopted > 30 && moved > 20,
                 qPrintable(QString("%1, %2, %3").arg(little).arg(adopted).arg(moved)));
    }

    // What a plan holds for the best was judged by many trials: it is not given up for one that was lucky.
    void exchangesBeginWithTheFirstThatIsKnown() {
        const auto source = search::makeSearch(Method::random, someSpace(), someParameters());
        const std::vector<search::Proposal> begun(source->ask());
        for (const double lead : {0.5, 2.0}) {
            const auto search = search::makeSearch(Method::exchange, someSpace(), someParameters());
            search->begin(begun);
            std::vector<search::Judgement> judgements(search->ask().size(), {0.0, 10, 1.0});
            judgements[3].score = lead;
            search->tell(judgements);
            const auto next = search->ask();
            QVERIFY(next[0].design == begun[lead > 1.5 ? 3 : 0].design);
            QCOMPARE(next[1].design == begun[3].design, lead < 1.5);
        }
    }

    // Who is best once meets the one of before on other trials, and takes its place if it is better again;
    // what was lucky in few trials is behind all that have more.
    void exchangesGoOnFromWhatIsBetterTwice() {
        const auto search = search::makeSearch(Method::exchange, someSpace(), someParameters());
        const auto numberOf = [&](const char* key) {
            return search::findNumber(search->report(), key).value();
        };
        const auto tell = [&](std::size_t best, double score, double ofParent) {
            auto proposals = search->ask();
            std::vector<search::Judgement> judgements(proposals.size(), {0.0, 10, 1.0});
            judgements[0].score = ofParent;
            judgements[best].score = score;
            judgements[8] = {50.0, 4};
            search->tell(judgements);
            return proposals;
        };
        const search::Design first = tell(7, 3.0, 0.0)[7].design;
        QVERIFY(search->ask()[0].design == first);
        // None is better: nobody challenges.
        tell(9, 1.0, 2.0);
        QVERIFY(search->ask()[0].design == first);
        // One is better, and is not the next time.
        const search::Design lucky = tell(5, 2.5, 2.0)[5].design;
        QVERIFY(search->ask()[0].design == first && search->ask()[1].design == lucky);
        tell(1, 1.5, 2.0);
        QVERIFY(search->ask()[0].design == first && search->ask()[1].design != lucky);
        QCOMPARE(numberOf("exchanges"), 0.0);
        // One is better twice, also where another one is better still.
        const search::Design right = tell(5, 2.5, 2.0)[5].design;
        tell(1, 2.75, 2.25);
        QVERIFY(search->ask()[0].design == right);
        QCOMPARE(numberOf("gain"), 0.5);
        QCOMPARE(numberOf("exchanges"), 1.0);
        for (std::size_t child = 1; child < search->ask().size(); ++child)
            QVERIFY(search->ask()[child].design != right);
        // One is better by more than chance would have it.
        const search::Design better = tell(5, 4.0, 2.25)[5].design;
        QVERIFY(search->ask()[0].design == better);
        QCOMPARE(numberOf("gain"), 1.75);
        // Where the parent left the race early that cannot be told.
        std::vector<search::Judgement> judgements(search->ask().size(), {0.0, 4, 1.0});
        judgements[5] = {40.0, 10, 1.0};
        const search::Design pure = search->ask()[5].design;
        search->tell(judgements);
        QVERIFY(search->ask()[0].design == better && search->ask()[1].design == pure);
        // Nor what is gained where only one of the two has all trials.
        judgements.assign(search->ask().size(), {0.0, 4, 1.0});
        judgements[1] = {40.0, 10, 1.0};
        search->tell(judgements);
        QVERIFY(search->ask()[0].design == pure);
        QCOMPARE(numberOf("gain"), 0.0);
    }

    void exchangesOfAnotherSpaceAreRefused() {
        const auto search = search::makeSearch(Method::exchange, someSpace(), someParameters());
        search->tell(judge(search->ask()));
        const auto other = search::makeSearch(Method::exchange, chainSpace(), someParameters());
        QVERIFY(messageOf(other->load(search->save())).contains("in this design space"));
    }

    void designsAreTheirGenes() {
        const search::DesignSpace space = someSpace();
        const ga::ChromosomeLayout layout = ga::layOut(space, ga::StrategyScope::individual);
        QCOMPARE(layout.pointBits, std::vector<int>(12, 10));
        QCOMPARE(layout.singleBits, (std::vector<int>{6, 6, 6, 6, 6, 6, ga::kRealBits}));
        base::Random random({.seed = 2});
        for (int run = 0; run < 100; ++run) {
            const ga::Chromosome chromosome = ga::createRandomChromosome(layout, random);
            QVERIFY(ga::fits(chromosome, layout));
            const search::Design design = ga::decodeDesign(chromosome, space);
            QCOMPARE(design.size(), space.dimensions.size());
            ga::Chromosome back = chromosome;
            ga::encodeDesign(design, space, back);
            QCOMPARE(back, chromosome);
        }
    }

    // What is reported is the geometric mean over the best 30 % of what the individuals' traits say.
    void strategyValuesAreThoseOfTheTop30Percent() {
        const auto search = search::makeSearch(Method::genetic, someSpace(), someParameters());
        const auto proposals = search->ask();
        const auto judgements = judge(proposals);
        search->tell(judgements);
        std::vector<double> scores;
        scores.reserve(judgements.size());
        for (const search::Judgement& judgement : judgements)
            scores.push_back(judgement.score);
        for (const char* key : {"p_x", "p_dm", "p_s"}) {
            double sum = 0.0;
            for (const std::size_t i : search::findTop(scores))
                sum += std::log(search::findNumber(proposals[i].traits, key).value());
            const double mean = std::exp(sum / 12.0);
            const double reported = search::findNumber(search->report(), key).value();
            QVERIFY2(std::abs(reported - mean) < 1e-12, key);
        }
        for (const search::Proposal& proposal : proposals) {
            QVERIFY(search::findNumber(proposal.traits, "p_dm").value() >= 0.0005);
            QVERIFY(search::findNumber(proposal.traits, "p_s").value() <= 0.3);
        }
    }

    void smoothingIsTheSpaces() {
        search::DesignSpace space = someSpace();
        const auto plain = search::makeSearch(Method::genetic, space, someParameters());
        int calls = 0;
        space.smooth = [&](search::Design design, double probability, base::Random&) {
            ++calls;
            if (probability > 0.3 || design.size() != 19) ++calls;
            std::fill(design.begin(), design.end(), 1.0);
            return design;
        };
        const auto smoothed = search::makeSearch(Method::genetic, space, someParameters());
        const auto first = plain->ask();
        QVERIFY(same(smoothed->ask(), first));
        for (const auto* search : {&plain, &smoothed})
            (*search)->tell(judge(first));
        QVERIFY(!same(plain->ask(), smoothed->ask()));
        QCOMPARE(calls, 40);
        for (const search::Proposal& proposal : smoothed->ask())
            QCOMPARE(proposal.design, search::Design(19, 1.0));
    }

    // Every value of a dimension is as likely as any other, and none depends on another.
    void randomDesignsAreUniform() {
        search::SearchParameters parameters = someParameters();
        parameters.populationSize = 6400;
        const auto search = search::makeSearch(Method::random, someSpace(), parameters);
        std::vector<int> counts(64);
        double sum = 0.0;
        double product = 0.0;
        const auto proposals = search->ask();
        for (const search::Proposal& proposal : proposals) {
            ++counts[static_cast<std::size_t>(std::lround(proposal.design[0] * 63.0))];
            sum += proposal.design.back();
            product += (proposal.design[1] - 0.5) * (proposal.design[2] - 0.5);
        }
        for (const int count : counts)
            QVERIFY(count > 50 && count < 150);  // 100 +- 10
        QVERIFY(std::abs(sum / 6400.0 - 0.5) < 4.0 * 0.289 / 80.0);
        QVERIFY(std::abs(product / 6400.0) < 4.0 * 0.0833 / 80.0);
        search->tell(judge(proposals));
        QVERIFY(!same(search->ask(), proposals));  // another generation
    }

    void randomSearchTellsBestAndMedian() {
        const auto search = search::makeSearch(Method::random, someSpace(), someParameters());
        const auto tell = [&](double first, double step) {
            std::vector<search::Judgement> judgements;
            for (std::size_t i = 0; i < search->ask().size(); ++i)
                judgements.push_back({first + step * static_cast<double>(i), 1});
            search->tell(judgements);
        };
        tell(0.0, 1.0);
        QCOMPARE(search::findNumber(search->report(), "best_so_far").value(), 39.0);
        QCOMPARE(search::findNumber(search->report(), "median_score").value(), 19.5);
        tell(-10.0, 0.0);
        QCOMPARE(search::findNumber(search->report(), "best_so_far").value(), 39.0);
        QCOMPARE(search::findNumber(search->report(), "median_score").value(), -10.0);
    }
};

QTEST_APPLESS_MAIN(SearchesTest)
#include "searches_test.moc"
