// Chains by arithmetic: what a product of matrices by hand gives, and every chain of few traps tried.

#include "core/study/chain_search.h"

#include <QtTest>
#include <cmath>
#include <set>

#include "core/base/random.h"

using namespace trapwright;
using study::Chain;
using study::ChainProblem;
using study::ChainSearch;
using study::KnownTrap;
using study::WayMatrix;
using study::WayShares;

namespace {

constexpr std::size_t kWays = 3;

ChainProblem makeProblem(std::vector<std::size_t> places, bool forgivesFalls = true) {
    ChainProblem problem;
    problem.ways = kWays;
    problem.rows = kWays;
    problem.arriving = {0.5, 0.3, 0.2, 0.0, 0.0, 0.0};
    problem.places = std::move(places);
    problem.mostFall = 1.0;
    problem.forgivesFalls = forgivesFalls;
    return problem;
}

/// From each way to three ways, others, stuck, fallen; of a million trials, so that what none saw is nothing.
KnownTrap makeTrap(const ChainSearch& search, std::size_t kind, WayMatrix shares, double fall = 0.01) {
    for (WayShares& row : shares)
        for (double& share : row)
            share *= 1e6;
    KnownTrap trap{kind, {static_cast<double>(kind)}, shares, {}, fall};
    trap.chances = calcChances(search.problem(), trap.counts);
    return trap;
}

WayMatrix leaveAlone() {
    return {{1, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}, {0, 0, 1, 0, 0, 0}};
}

WayMatrix drawMatrix(base::Random& random) {
    WayMatrix matrix(kWays, WayShares(kWays + 3, 0.0));
    for (WayShares& row : matrix) {
        double sum = 0.0;
        for (double& share : row)
            sum += share = std::pow(random.uniform(), 6.0);
        for (double& share : row)
            share /= sum;
    }
    return matrix;
}

}  // namespace

class ChainSearchTest : public QObject {
    Q_OBJECT

 private slots:
    void rowsSumUpToOneAndNothingIsCertain() {
        const ChainSearch search(makeProblem({0}));
        WayMatrix counts(kWays, WayShares(kWays + 3, 0.0));
        counts[0][0] = 6.0;  // of six trials from the first way, none from others
        const WayMatrix chances = calcChances(search.problem(), counts);
        QCOMPARE(chances.size(), kWays + 3);
        for (const WayShares& row : chances) {
            double sum = 0.0;
            for (const double share : row)
                sum += share;
            QVERIFY(std::abs(sum - 1.0) < 1e-12);
        }
        QVERIFY(chances[0][0] < 0.9 && chances[0][1] > 0.02 && chances[0][kWays + 1] > 0.01);
        QCOMPARE(chances[kWays + 2][kWays + 2], 1.0);
        // What is in none of the ways is not tried from: it is taken for the first way.
        QVERIFY(chances[kWays] == chances[0]);
    }

    void worthIsMinusTheBitsOfWhatStays() {
        ChainSearch forgiving(makeProblem({0}, true));
        const ChainSearch strict(makeProblem({0}, false));
        const WayShares halves{0.25, 0.25, 0.0, 0.0, 0.0, 0.5};
        QVERIFY(std::abs(forgiving.worthOf(halves) - (-1.0 - objectives::kBitsOfHalving)) < 0.02);
        QVERIFY(std::abs(strict.worthOf(halves) - (-3.0)) < 0.06);
        forgiving.setBitsOfHalving(0.0);
        QVERIFY(std::abs(forgiving.worthOf(halves) - (-1.0)) < 0.02);
        QVERIFY(forgiving.worthOf({0, 0, 0, 0, 0, 1.0}) <= -8.0);
    }

    void whereAWayIsWantedItsShareCounts() {
        for (const bool forgivesFalls : {false, true}) {
            ChainProblem problem = makeProblem({0}, forgivesFalls);
            problem.wanted = {1, 2};
            ChainSearch search(problem);
            search.setBitsOfHalving(0.0);
            // In either of the two, however few lie in the other one.
            QVERIFY(std::abs(search.worthOf({0, 0.4, 0.6, 0, 0, 0})) < 0.02);
            QVERIFY(std::abs(search.worthOf({0.5, 0.1, 0.4, 0, 0, 0}) - (-1.0)) < 0.02);
            QVERIFY(search.worthOf({1, 0, 0, 0, 0, 0}) <= -7.9);
            // What throws the other way out gains where it comes again.
            QVERIFY(std::abs(search.worthOf({0, 0.5, 0, 0, 0, 0.5}) - (forgivesFalls ? 0.0 : -1.0)) < 0.02);
        }
    }

    // A tenth of the wrong ones is worth one more nine, whatever it costs but most of the right ones.
    void purityCountsInNines() {
        ChainProblem problem = makeProblem({0}, true);
        problem.seeksPurity = true;
        ChainSearch search(problem);
        const double onlyOrder = search.worthOf({0.9, 0.1, 0, 0, 0, 0});
        QVERIFY(std::abs(onlyOrder - (std::log10(2002.0 / 201.0) + 0.9)) < 1e-9);
        const double sieved = search.worthOf({0.45, 0.005, 0, 0, 0, 0.545});
        QVERIFY(std::abs(sieved - (std::log10(912.0 / 11.0) + 0.45)) < 1e-9);
        // None wrong of twice as many is worth more.
        QVERIFY(search.worthOf({0.2, 0, 0, 0, 0, 0.8}) > search.worthOf({0.1, 0, 0, 0, 0, 0.9}) + 0.25);
        problem.rightAsNines = 0.1;
        QVERIFY(std::abs(ChainSearch(problem).worthOf({0.9, 0.1, 0, 0, 0, 0}) -
                         (std::log10(2002.0 / 201.0) + 0.09)) < 1e-9);
        // Three times as many right ones are worth four times as many wrong ones where yield is sought.
        problem.rightAsNines = 1.0;
        const ChainSearch nines(problem);
        problem.seeksYield = true;
        const ChainSearch decades(problem);
        problem.seeksYield = false;
        QVERIFY(std::abs(decades.worthOf({0.9, 0.1, 0, 0, 0, 0}) -
                         (std::log10(2002.0 / 201.0) + std::log10(1801.0 / 2002.0))) < 1e-9);
        const study::WayShares few{0.05, 0.0005, 0, 0, 0, 0.9495};
        const study::WayShares more{0.15, 0.005, 0, 0, 0, 0.845};
        QVERIFY(nines.worthOf(few) > nines.worthOf(more) + 0.1);
        QVERIFY(decades.worthOf(few) < decades.worthOf(more) - 0.1);
        // Bits have it the other way round where half of the parts go for a tenth of the wrong ones.
        problem.seeksPurity = false;
        const ChainSearch bits(problem);
        QVERIFY(bits.worthOf({0.9, 0.1, 0, 0, 0, 0}) > bits.worthOf({0.45, 0.005, 0, 0, 0, 0.545}));
        // What never arrives is right in no way.
        problem.seeksPurity = true;
        QVERIFY(ChainSearch(problem).worthOf({0, 0, 0, 0, 0, 1.0}) < 0.0);
    }

    // A sieve for the second way and one for the third, behind each other; what turns everything into chaos
    // is known, too.
    void findsTheTwoThatLeaveOneWay() {
        ChainSearch search(makeProblem({0, 0}));
        const WayMatrix chaos(kWays, {0.4, 0.3, 0.3, 0, 0, 0});
        search.traps() = {makeTrap(search, 0, chaos), makeTrap(search, 0, leaveAlone()),
                          makeTrap(search, 0, {{1, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 1}, {0, 0, 1, 0, 0, 0}}),
                          makeTrap(search, 0, {{1, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 1}})};
        search.findSieves();
        search.findChains(2);
        QVERIFY(!search.chains().empty());
        const Chain& best = search.chains().front();
        QVERIFY(
            (best.traps == std::vector<std::size_t>{2, 3} || best.traps == std::vector<std::size_t>{3, 2}));
        QVERIFY(std::abs(best.parts[0] - 0.5) < 1e-3 && std::abs(best.parts[kWays + 2] - 0.5) < 1e-3);
        const std::vector<WayShares> coming = search.listComing(best);
        QVERIFY(std::abs(coming[0][0] - 0.5) < 1e-3);
        QVERIFY(coming[1][0] > 0.6);  // of those that still move
        QVERIFY(std::abs(search.worthInChain(search.traps()[1], best) - best.worth) > 0.1);
    }

    // Against every chain of three of twelve traps of two kinds.
    void missesNoBetterChain_data() {
        QTest::addColumn<bool>("forgivesFalls");
        QTest::newRow("what falls comes again") << true;
        QTest::newRow("falls count") << false;
    }
    void missesNoBetterChain() {
        QFETCH(bool, forgivesFalls);
        base::Random random({7, 0, 0, 0, base::Purpose::planning});
        for (int again = 0; again < 20; ++again) {
            ChainSearch search(makeProblem({0, 1, 0}, forgivesFalls));
            for (std::size_t i = 0; i < 12; ++i)
                search.traps().push_back(makeTrap(search, i % 2, drawMatrix(random)));
            search.findChains(1);
            double most = -1e9;
            for (std::size_t a = 0; a < 12; a += 2) {
                for (std::size_t b = 1; b < 12; b += 2) {
                    for (std::size_t c = 0; c < 12; c += 2) {
                        WayShares parts = search.problem().arriving;
                        for (const std::size_t i : {a, b, c})
                            parts = study::pass(parts, search.traps()[i].chances);
                        most = std::max(most, search.worthOf(parts));
                    }
                }
            }
            QVERIFY(std::abs(search.chains().front().worth - most) < 1e-9);
        }
    }

    void keepsWithinTheHeight() {
        ChainSearch search(makeProblem({0, 0, 0}));
        const WayMatrix good{{1, 0, 0, 0, 0, 0}, {0.9, 0.1, 0, 0, 0, 0}, {0.9, 0, 0.1, 0, 0, 0}};
        search.traps() = {makeTrap(search, 0, leaveAlone(), 0.1), makeTrap(search, 0, good, 0.6)};
        search.findChains(1);
        for (const Chain& chain : search.chains()) {
            QVERIFY(chain.fall <= 1.0);
            QCOMPARE(std::count(chain.traps.begin(), chain.traps.end(), 1), 1);
        }
        ChainSearch none(makeProblem({0}));
        none.traps() = {makeTrap(none, 0, good, 1.1)};
        none.findChains(1);
        QVERIFY(none.chains().empty());
    }

    // Two ways that are one behind what follows; the third is none there.
    void howPartsLieBehindWhatFollowsCounts() {
        ChainProblem problem = makeProblem({0});
        const ChainSearch plain(problem);
        WayMatrix then = calcChances(plain.problem(), WayMatrix(kWays, WayShares(kWays + 3, 0.0)));
        for (std::size_t way = 0; way < kWays; ++way)
            then[way] = {way < 2 ? 1.0 : 0.0, 0.0, 0.0, way < 2 ? 0.0 : 1.0, 0.0, 0.0};
        problem.then = then;
        ChainSearch search(problem);
        QCOMPARE(search.worthOf({0.3, 0.3, 0.1, 0, 0, 0.3}), plain.worthOf({0.6, 0, 0, 0.1, 0, 0.3}));
        // What turns the third way into one of the others is better than what throws out one of these.
        search.traps() = {
            makeTrap(search, 0, {{1, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 1}, {0, 0, 0.9, 0, 0, 0.1}}),
            makeTrap(search, 0, {{1, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}})};
        search.findChains(1);
        QCOMPARE(search.chains().front().traps, std::vector<std::size_t>{1});
        QVERIFY(std::abs(search.chains().front().worth) < 0.01);
        QVERIFY(plain.worthOf(search.chains().front().parts) < -0.9);
    }

    // Behind a first trap that is set, and parts that are elsewhere than it was told.
    void goesOnFromWherePartsAre() {
        base::Random random({9, 0, 0, 0, base::Purpose::planning});
        for (int again = 0; again < 10; ++again) {
            ChainSearch search(makeProblem({0, 1, 0}));
            for (std::size_t i = 0; i < 12; ++i)
                search.traps().push_back(makeTrap(search, i % 2, drawMatrix(random), 0.01 * double(1 + i)));
            const Chain begun{{4}, {0.1, 0.2, 0.6, 0.0, 0.0, 0.1}, 0.0, 0.05};
            const std::vector<Chain> chains = search.exchangeNext(begun, search.complete(begun).value(), 4);
            QCOMPARE(chains.size(), std::size_t{4});
            double most = -1e9;
            for (std::size_t b = 1; b < 12; b += 2) {
                for (std::size_t c = 0; c < 12; c += 2) {
                    WayShares parts = study::pass(begun.parts, search.traps()[b].chances);
                    parts = study::pass(parts, search.traps()[c].chances);
                    most = std::max(most, search.worthOf(parts));
                }
            }
            QVERIFY(std::abs(chains.front().worth - most) < 1e-9);
            std::set<std::size_t> seconds;
            for (const Chain& chain : chains) {
                QCOMPARE(chain.traps.size(), std::size_t{3});
                QCOMPARE(chain.traps.front(), std::size_t{4});
                QCOMPARE(chain.traps.back(), chains.front().traps.back());
                seconds.insert(chain.traps[1]);
                const WayShares behind = study::pass(begun.parts, search.traps()[chain.traps[1]].chances);
                QVERIFY(search.passOn(behind, chain, 2) == chain.parts);
                QCOMPARE(chain.worth, search.worthOf(chain.parts));
                QVERIFY(chain.worth <= chains.front().worth);
                double fall = begun.fall;
                for (const std::size_t i : {chain.traps[1], chain.traps[2]})
                    fall += search.traps()[i].fall;
                QVERIFY(std::abs(chain.fall - fall) < 1e-12);
            }
            QCOMPARE(seconds.size(), chains.size());
        }
        ChainSearch low(makeProblem({0, 0}));
        low.traps() = {makeTrap(low, 0, leaveAlone(), 0.6)};
        QVERIFY(!low.complete({{0}, low.problem().arriving, 0.0, 0.6}));
    }

    void whatIsOfUseIsKept() {
        base::Random random({8, 0, 0, 0, base::Purpose::planning});
        ChainSearch search(makeProblem({0, 0}));
        for (std::size_t i = 0; i < 60; ++i)
            search.traps().push_back(makeTrap(search, 0, drawMatrix(random)));
        search.findSieves();
        search.findChains(3);
        QVERIFY(search.niches().size() > 1);
        const double best = search.chains().front().worth;
        search.forget(1, 5);
        QVERIFY(search.traps().size() < 35);
        for (const std::size_t i : search.used())
            QVERIFY(i < search.traps().size());
        search.findChains(3);
        QCOMPARE(search.chains().front().worth, best);

        std::vector<KnownTrap> given = search.leave(0);
        QVERIFY(search.traps().empty() && search.chains().empty() && search.used().empty());
        search.traps() = std::move(given);
        search.findChains(3);
        QCOMPARE(search.chains().front().worth, best);
    }
};

QTEST_APPLESS_MAIN(ChainSearchTest)
#include "chain_search_test.moc"
