#include "tests/peers/transfer.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/file.h"
#include "core/stats/binomial.h"
#include "core/study/evaluator.h"
#include "core/study/robustness.h"

namespace trapwright::peers {

namespace {

constexpr const char* kColumns =
    "{:<12} {:>7} {:<13} {:>11} {:>17} {:>11} {:>7} {:>6} {:>6} {:>9} {:>7} {:>10}\n";

double percent(int count, int of) {
    return 100.0 * count / of;
}

TransferRow runScene(const trial::Engine& engine, const TransferScene& scene, base::RunControl control) {
    TransferRow row;
    row.engine = engine.name();
    row.step = engine.step();
    auto outcomes = study::runTrials(engine, {&scene.batch, 1}, std::move(control));
    if (outcomes)
        row.outcomes = std::move(outcomes->front());
    else
        row.problem = outcomes.error().message;
    return row;
}

void judgeRow(const Transfer& transfer, TransferRow& row) {
    const double tolerance = transfer.settings.validation.tolerance;
    for (const trial::Outcome& outcome : row.outcomes)
        row.verdicts.push_back(
            trial::judge(outcome.parts.front(), transfer.goal, transfer.part->symmetry, tolerance));
    row.tally = trial::tally(row.outcomes, transfer.goal, transfer.part->symmetry, tolerance);
}

int countOtherVerdicts(const TransferRow& row, const TransferRow& reference) {
    int count = 0;
    for (std::size_t i = 0; i < row.verdicts.size(); ++i)
        count += row.verdicts[i] != reference.verdicts[i] ? 1 : 0;
    return count;
}

}  // namespace

Transfer makeTransfer(const study::Settings& settings, const std::shared_ptr<const part::Part>& part,
                      const std::shared_ptr<const track::Track>& track, int trials) {
    // Ranges that are not cut off have what is set in their middle.
    const study::PlaceTrials asSet{trial::kMiddle, 0, trials};
    const study::PlaceTrials anywhere{std::nullopt, 0, trials};
    return {settings,
            part,
            {{"as set", study::makePlaceBatch(settings, part, track, asSet)},
             {"over the box", study::makePlaceBatch(settings, part, track, anywhere)}},
            {},
            {}};
}

base::Status addEngine(Transfer& transfer, const Contender& contender, const base::RunControl& control) {
    const std::shared_ptr<const trial::Engine> engine = contender.kind.make({1, contender.step});
    if (auto checked = study::checkInputs({transfer.settings, transfer.part, engine}); !checked)
        return checked;
    for (std::size_t scene = 0; scene < transfer.scenes.size(); ++scene) {
        TransferRow row = runScene(*engine, transfer.scenes[scene], control);
        const bool first = transfer.rows.empty();
        if (control.cancelled() || (first && !row.problem.empty())) return base::Error{row.problem};
        row.scene = scene;
        if (first)
            transfer.goal = trial::findGoal(std::nullopt, row.outcomes, transfer.part->symmetry,
                                            transfer.settings.validation.tolerance);
        judgeRow(transfer, row);
        transfer.rows.push_back(std::move(row));
    }
    return base::success();
}

std::string transferHeader(const Transfer& transfer) {
    const base::Quaternion& goal = transfer.goal.shown();
    return fmt::format("Success: within {:.0f} degrees of {:.3f} {:.3f} {:.3f} {:.3f} (w x y z)\n",
                       transfer.settings.validation.tolerance / base::kDegree, goal.w(), goal.x(), goal.y(),
                       goal.z()) +
           fmt::format(kColumns, "Engine", "Step ms", "Conditions", "Success [%]", "95 % bounds",
                       "Correct [%]", "Trials", "Wrong", "Stuck", "Fell off", "Points", "Other [%]");
}

std::string describeTransfer(const Transfer& transfer, const TransferRow& row) {
    const std::string step = fmt::format("{:g}", 1e3 * row.step);
    const std::string& conditions = transfer.scenes[row.scene].conditions;
    if (!row.problem.empty())
        return fmt::format("{:<12} {:>7} {:<13} cannot: {}\n", row.engine, step, conditions, row.problem);
    const TransferRow& reference = transfer.rows[row.scene];
    const trial::Tally& tally = row.tally;
    const int trials = tally.trials();
    const stats::Interval bounds = stats::calcClopperPearson(tally.success, trials);
    const double success = percent(tally.success, trials);
    const int arrived = tally.success + tally.wrongOrientation;
    return fmt::format(
        kColumns, row.engine, step, conditions, fmt::format("{:.1f}", success),
        fmt::format("{:.1f} ... {:.1f}", 100.0 * bounds.low, 100.0 * bounds.high),
        arrived > 0 ? fmt::format("{:.1f}", percent(tally.success, arrived)) : "-", trials,
        tally.wrongOrientation, tally.stuck, tally.fellOff,
        fmt::format("{:+.1f}", success - percent(reference.tally.success, reference.tally.trials())),
        fmt::format("{:.1f}", percent(countOtherVerdicts(row, reference), trials)));
}

base::Status writeTransferTrials(const Transfer& transfer, const std::filesystem::path& file) {
    std::string text =
        "conditions,trial,friction,restitution,half_stroke_mm,bounding_radius_mm,engine,step_ms,verdict,"
        "farthest_x_mm,time_s\n";
    for (const TransferRow& row : transfer.rows) {
        const TransferScene& scene = transfer.scenes[row.scene];
        for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
            const trial::TrialSpec& spec = scene.batch.trials[i];
            const trial::ContactParameters& contact = scene.batch.contactOf(spec);
            const trial::PartOutcome& outcome = row.outcomes[i].parts.front();
            text += fmt::format(
                "{},{},{:.4f},{:.4f},{:.4f},{:.4f},{},{:g},{},{:.2f},{:.3f}\n", scene.conditions, i,
                contact.kineticFriction, contact.restitution, 1e3 * scene.batch.driveOf(spec).halfStroke,
                1e3 * scene.batch.partOf(spec).boundingRadius, row.engine, 1e3 * row.step,
                trial::verdictName(row.verdicts[i]), 1e3 * outcome.farthest.position.x(), outcome.time);
        }
    }
    return base::writeFile(file, text);
}

}  // namespace trapwright::peers
