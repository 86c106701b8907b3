// What every kind of trap must do, whichever it is, and what is a step's own.

#include <QtTest>
#include <cmath>
#include <set>

#include "core/geometry/mesh_check.h"
#include "core/track/track_builder.h"
#include "core/traps/step.h"
#include "core/traps/trap_chain.h"

using namespace trapwright;
using traps::TrapChain;
using traps::TrapParameters;

namespace {

search::Design drawDesign(const search::DesignSpace& space, std::uint64_t seed) {
    base::Random random({.seed = seed});
    search::Design design;
    for (const search::Dimension& dimension : space.dimensions)
        design.push_back(search::roundToBits(random.uniform(), dimension.bits));
    return design;
}

QString messageOf(const base::Result<TrapChain>& chain) {
    return QString::fromStdString(chain.ok() ? "" : chain.error().message);
}

}  // namespace

class TrapKindsTest : public QObject {
    Q_OBJECT

 private slots:
    void everyKindGivesATrack_data() {
        QTest::addColumn<QString>("chain");
        for (const traps::TrapKind& kind : traps::trapKinds())
            QTest::newRow(kind.key.data()) << QString::fromUtf8(kind.key.data());
        QTest::newRow("several") << "step, free-form,step";
    }
    void everyKindGivesATrack() {
        QFETCH(QString, chain);
        const auto read = traps::readTraps(chain.toStdString());
        QVERIFY2(read.ok(), qPrintable(messageOf(read)));
        const TrapParameters parameters;
        const search::DesignSpace space = traps::designSpace(*read, parameters);
        std::set<std::string> keys;
        for (const search::Dimension& dimension : space.dimensions) {
            keys.insert(dimension.key);
            QVERIFY(dimension.low < dimension.high && !dimension.unit.empty() && dimension.line >= 0);
        }
        QCOMPARE(keys.size(), space.dimensions.size());
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const search::Design design = drawDesign(space, seed);
            const auto sections = traps::build(*read, parameters, design);
            double before = 0.0;
            for (const track::CrossSection& section : sections) {
                QVERIFY(section.x > before);
                before = section.x;
                QCOMPARE(section.points.size(), std::size_t{8});
                for (const base::Vec2& point : section.points)
                    QVERIFY(std::abs(point.x()) <= 30e-3 + 1e-15 && point.y() >= 0.0 && point.y() <= 30e-3);
            }
            QVERIFY(before <= traps::calcLongest(*read, parameters) + 1e-12);
            const auto track = track::buildTrack({}, sections);
            QVERIFY(track.ok());
            QVERIFY(geometry::checkMesh(track->solid).isSolid());
            if (space.smooth) {
                base::Random random({.seed = seed});
                QVERIFY(space.smooth(design, 0.0, random) == design);
                QVERIFY(space.check(space.smooth(design, 0.5, random)).ok());
            }
        }
        const std::vector<double> places = traps::layOut(*read, parameters);
        QCOMPARE(places.size(), traps::build(*read, parameters, drawDesign(space, 1)).size());
        QVERIFY(std::is_sorted(places.begin(), places.end()) && places.front() > 0.0);
    }

    void aStepIsWhatItsNumbersSay() {
        const traps::TrapKind step = traps::step();
        const TrapParameters parameters;
        const auto dimensions = step.dimensions(parameters);
        QCOMPARE(dimensions.size(), std::size_t{3});
        QCOMPARE(dimensions[0].low, -15.0);
        QCOMPARE(dimensions[0].high, 15.0);
        // 5 mm up, half of the lengths, 10 degrees down to the outer edge.
        const std::vector<double> numbers = {20.0 / 30.0, 0.5, 40.0 / 60.0};
        const auto sections = step.build(parameters, numbers);
        QCOMPARE(sections.size(), std::size_t{2});
        QVERIFY(std::abs(sections[0].x - 1e-3) < 1e-12);
        QVERIFY(std::abs(sections[1].x - 26.5e-3) < 1e-12);
        for (const track::CrossSection& section : sections) {
            for (const base::Vec2& point : section.points) {
                const double expected = 20e-3 - std::tan(10.0 * base::kDegree) * point.x();
                QVERIFY(std::abs(point.y() - expected) < 1e-12);
            }
        }
        QCOMPARE(sections[0].points.front().x(), -30e-3);
        QCOMPARE(sections[0].points.back().x(), 30e-3);
        // Cut off at the box.
        const auto steep = step.build(parameters, std::vector<double>{1.0, 0.0, 1.0});
        QCOMPARE(steep[0].points.front().y(), 30e-3);
        QVERIFY(step.smooth == nullptr);
    }

    void chainsAreReadFromText() {
        const auto chain = traps::readTraps(" step,free-form ");
        QVERIFY(chain.ok());
        QCOMPARE(chain->size(), std::size_t{2});
        QCOMPARE((*chain)[0]->key, std::string_view("step"));
        QCOMPARE(traps::describe(*chain), std::string("Step, free form"));
        QVERIFY(messageOf(traps::readTraps("ledge"))
                    .contains("no kind of trap named \"ledge\". The kinds are: free-form, step"));
        QVERIFY(messageOf(traps::readTraps("")).contains("named \"\""));
        QVERIFY(messageOf(traps::readTraps("step,")).contains("named \"\""));
        const search::DesignSpace space = traps::designSpace(*chain, {});
        QCOMPARE(space.dimensions[0].key, std::string("trap 1: height"));
        QCOMPARE(space.dimensions[3].key, std::string("trap 2: section 1, point 1, y"));
        QVERIFY(space.dimensions[3].line > space.dimensions[2].line);
        // A step has nothing to be smoothed, what follows it has.
        base::Random random({.seed = 4});
        const search::Design design = drawDesign(space, 2);
        const search::Design smoothed = space.smooth(design, 1.0, random);
        QVERIFY(std::equal(design.begin(), design.begin() + 3, smoothed.begin()));
        QVERIFY(design != smoothed);
        QVERIFY(!traps::designSpace({(*chain)[0]}, {}).smooth);
    }
};

QTEST_APPLESS_MAIN(TrapKindsTest)
#include "trap_kinds_test.moc"
