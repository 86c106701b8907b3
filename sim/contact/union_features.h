#pragma once

#include <vector>

#include "sim/contact/contact_body.h"

namespace trapwright::contact {

/// Leaves to convex pieces only those edges and vertices with which their union can touch a plane, each once.
///
/// Cuts between pieces make features that the union does not have: edges within flat faces, in reflex corners
/// or inside, vertices amid faces. Contacts at them are wrong, or stand for nothing new. An edge stays where
/// the union leaves more than half a turn free about it, with the directions into the union's faces there; it
/// is split where that changes. A vertex stays where all of the union is on one side of a plane through it,
/// with the directions that span the union's cone. What the pieces are and where, `faces` and their balls,
/// stays as it is. Pieces may end without vertices or edges.
/// tolerance: places that are nearer are one [m].
void keepUnionFeatures(std::vector<BodyPiece>& pieces, double tolerance);

}  // namespace trapwright::contact
