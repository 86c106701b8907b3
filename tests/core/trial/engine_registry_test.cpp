#include "core/trial/engine_registry.h"

#include <QtTest>

using namespace trapwright;
using trial::EngineRole;
using trial::EngineUse;

namespace {

/// Only a name, and the options that it was made with.
class NamedEngine : public trial::Engine {
 public:
    NamedEngine(std::string name, const trial::EngineOptions& options)
        : name_(std::move(name)), step_(options.step) {}

    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] double step() const override { return step_; }
    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch>, base::RunControl) const override {
        return base::Error{"none"};
    }
    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch&, std::size_t, double,
                                                         base::RunControl) const override {
        return base::Error{"none"};
    }

 private:
    std::string name_;
    double step_;
};

trial::EngineKind kind(const std::string& name, EngineRole role) {
    const auto make = [name](const trial::EngineOptions& options) {
        return std::make_unique<NamedEngine>(name, options);
    };
    return {name, make, name, role};
}

trial::EngineRegistry registry() {
    return trial::EngineRegistry({kind("slow", EngineRole::certifying), kind("new", EngineRole::other),
                                  kind("sure", EngineRole::reference), kind("fast", EngineRole::quick)});
}

}  // namespace

class EngineRegistryTest : public QObject {
    Q_OBJECT

 private slots:
    void enginesAreMadeByName() {
        const auto engine = registry().make("new", {1, 0.25});
        QVERIFY(engine.ok());
        QCOMPARE((*engine)->name(), std::string("new"));
        QCOMPARE((*engine)->step(), 0.25);
        QCOMPARE(registry().quick().name, std::string("fast"));
        QCOMPARE(registry().reference().name, std::string("sure"));
    }

    void anUnknownNameIsToldWithThoseThatThereAre() {
        const trial::EngineRegistry engines = registry();
        QVERIFY(engines.find("abacus") == nullptr);
        const auto engine = engines.make("abacus", {});
        QVERIFY(!engine.ok());
        QCOMPARE(engine.error().message,
                 std::string("There is no engine named \"abacus\". The engines are: slow, new, sure, fast."));
        // It is a setting, and no engine.
        QVERIFY(engines.find(trial::kHybrid) == nullptr);
    }

    void hybridLearnsWithTheQuickEngineAndJudgesByTheReference() {
        const trial::EngineRegistry engines = registry();
        QCOMPARE(engines.nameFor("hybrid", EngineUse::learning), std::string("fast"));
        QCOMPARE(engines.nameFor("hybrid", EngineUse::judging), std::string("sure"));
        QCOMPARE(engines.referenceFor("hybrid")->name, std::string("sure"));
        for (const char* name : {"fast", "sure", "slow", "abacus"}) {
            QCOMPARE(engines.nameFor(name, EngineUse::learning), std::string(name));
            QCOMPARE(engines.nameFor(name, EngineUse::judging), std::string(name));
            QVERIFY(engines.referenceFor(name) == nullptr);
        }
    }

    void withoutEnginesEveryNameIsUnknown() {
        const trial::EngineRegistry none;
        QVERIFY(none.settings().empty() && none.referenceFor("hybrid") == nullptr);
        QVERIFY(!none.make(none.nameFor("hybrid", EngineUse::learning), {}).ok());
    }

    void whatCannotLearnIsNoSettingToChoose() {
        QCOMPARE(registry().settings(), (std::vector<std::string>{"hybrid", "fast", "sure", "new"}));
    }
};

QTEST_APPLESS_MAIN(EngineRegistryTest)
#include "engine_registry_test.moc"
