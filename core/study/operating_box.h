#pragma once

#include <memory>
#include <vector>

#include "core/part/part.h"
#include "core/study/settings.h"
#include "core/trial/batch.h"
#include "core/trial/conditions.h"

namespace trapwright::study {

/// The part as drawn, and as it comes where the operating box knows tolerances: a few that stand for the
/// range of sizes, smallest first, each with a centre of mass of its own.
struct Specimens {
    std::shared_ptr<const part::Part> drawn;
    std::vector<std::shared_ptr<const part::Part>> varied;  // the drawn one alone without tolerances
};
inline constexpr int kSpecimens = 8;

/// The same for the same seed, box and part.
Specimens makeSpecimens(const Settings& settings, const std::shared_ptr<const part::Part>& part);
/// The specimen that is as large as parts at this share of the range, its centre of mass as drawn.
std::shared_ptr<const part::Part> makeSpecimenAt(const trial::OperatingBox& box,
                                                 const std::shared_ptr<const part::Part>& part, double share);

/// Whether the box has room in this direction about these settings.
bool varies(const SimulationSettings& simulation, const trial::OperatingBox& box, trial::Condition condition);
/// Whether it has room in any: then it has corners, too.
bool hasRoom(const SimulationSettings& simulation, const trial::OperatingBox& box);

/// What a condition is at this share of its range, in SI: a coefficient of kinetic friction, of restitution,
/// m, m/s, Hz, rad; of the part what its extents are more than drawn [m].
double conditionAt(const SimulationSettings& simulation, const trial::OperatingBox& box,
                   trial::Condition condition, double share);

/// Puts a trial of one part on this track there: its contact, its drive, its start, and its place. The part
/// is left to whoever makes its batch.
void putAt(const SimulationSettings& simulation, const trial::OperatingBox& box, const trial::BoxPlace& place,
           const track::Track& track, trial::TrialSpec& spec);

/// Places of trials that fill the box evenly (Sobol 1967, direction numbers of Joe and Kuo 2008, moved by a
/// random digital shift: Lemieux 2009): any first n of them say more of a mean than n random ones. Trial i of
/// equal keys has the same place; StreamKey::trial is not looked at. A share of the trials, evenly among the
/// others, is in corners instead, all of them in turn (the halves in which a sequence of their own is).
class BoxPlaces {
 public:
    BoxPlaces(const SimulationSettings& simulation, const trial::OperatingBox& box, base::StreamKey key,
              double cornerShare = 0.0);

    /// Of trials first ... first + count - 1.
    [[nodiscard]] std::vector<trial::BoxPlace> draw(int first, int count) const;

 private:
    using Shift = std::array<std::uint64_t, trial::kConditions>;

    std::array<bool, trial::kConditions> varies_{};
    trial::BoxDistribution distribution_;
    double cornerShare_;
    Shift shift_{};
    Shift cornerShift_{};
};

}  // namespace trapwright::study
