#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/part/materials.h"
#include "core/part/part.h"
#include "core/study/settings.h"

namespace trapwright::study {

/// The names that presetSettings knows.
std::span<const std::string_view> presetNames();

/// The paper's Table 1 with the drive of its section 6: "cuboid" and "cone". The pairs of materials are those
/// that come with Trapwright, the operating box is the default one. Error: an unknown name, or a library that
/// cannot be read.
base::Result<Settings> presetSettings(const std::string& name);

/// Changes settings to the paper's own choices where the defaults go past it: free points, plain angle, p_s
/// up to 1, no floor under p_dm, overlapping tracks simulated, all trials for every individual, each with its
/// own random numbers and as patient as in validation, every trial by Simbody, a bowl of 175 mm.
Settings paperMode(Settings settings);

/// Changes settings to those of a track that turns parts over: the paper's trap and objectives with Table 1's
/// lengths for the cuboid, in proportion to the part. Lengths are whole half millimetres.
Settings turningMode(Settings settings, const part::Part& part);

/// Changes settings to those of a track that throws out what lies wrong, in proportion to the part: two
/// grooves and eight gaps, planned, judged by sorting (decisions.md#sorting), with two generations behind the
/// plan, and time for parts to go all the way. Lengths are whole half millimetres.
Settings sortingMode(Settings settings, const part::Part& part);

/// Changes settings to those of a track in whose slots parts hang by their thicker end, so that it leads or
/// follows as they leave them, in proportion to the part: sortingMode with three slots instead of gaps
/// (decisions.md#slot). Lengths are whole half millimetres.
Settings slotMode(Settings settings, const part::Part& part);

/// What lets parts leave hanging: what stands falls over in the drop, and what does not hang slides off the
/// narrow rails (decisions.md#rails).
inline constexpr std::string_view kRailsTraps = "drop, groove, narrow rails";

/// Changes settings to those of a track that parts leave hanging between two rails, their thicker end up, and
/// wants them so (findHangingTarget), if they are not wanted so already: slotMode with kRailsTraps, without a
/// plan, as rails at random often bring most parts to hang, and with a longer lead-out (decisions.md#rails).
/// Lengths are whole half millimetres.
Settings railsMode(Settings settings, const part::Part& part);

/// Changes settings to those of a track that lets one way pass, in proportion to the part: gaps that bring as
/// many parts as they can to one way (sortingMode), and ledges behind them that throw out the others;
/// planned, then exchanged trap by trap, judged by how few of the parts that leave it are wrong, and how many
/// leave it (decisions.md#ledges). Lengths are whole half millimetres.
Settings ledgeMode(Settings settings, const part::Part& part);

/// Settings that learn traps behind a track that is there, which throw out what still lies wrong, so that it
/// comes again: ledges behind a track with a spiral, one that ends in a groove, as gaps do, or with a ledge,
/// else a notched track, judged by how few of the parts that arrive are wrong, and how many arrive. Part,
/// drive, contact, engine and seed stay. An error if other traps cannot follow that track (placeBehind).
base::Result<Settings> rejectingMode(Settings settings, const track::Track& track);

/// What the engines need of a pair of materials.
trial::ContactParameters contactOf(const part::MaterialPair& pair);
/// Puts a pair's friction and restitution into the settings, with how far they may be off: the half ranges of
/// the operating box become the pair's spreads.
void useContact(Settings& settings, const part::MaterialPair& pair);
/// The same with its density and material.
void usePair(Settings& settings, const part::MaterialPair& pair);
/// Which material of a library the part is of: by its name, or by its density where a study does not tell
/// the name. None where the density is another.
const part::Material* findUsedMaterial(const part::MaterialLibrary& library, const PartSettings& part);
/// Which of that material's pairs these settings have. None where a number is the user's own.
const part::MaterialPair* findUsedPair(const part::MaterialLibrary& library, const Settings& settings);
/// Which pair the part's material suggests: on the surface of `used`, if there is such a pair, else the first
/// of that material on printed plastic, else any of that material. None for a material that the library does
/// not have.
const part::MaterialPair* suggestPair(const part::MaterialLibrary& library, std::string_view material,
                                      const part::MaterialPair* used);

/// Where a track file that comes with Trapwright is: in the folder tracks/ beside that of the bundled parts.
std::filesystem::path findResourceTrack(std::string_view file);

}  // namespace trapwright::study
