#pragma once

#include "core/part/part.h"
#include "core/track/track.h"

namespace trapwright::trial {

/// How a part that ends in this orientation (part frame to track::orientationFrame, decisions.md#track-frame)
/// lies at the finish: turned as told and touching the surface where its centre of mass is lowest, of equally
/// low places the one nearest to the middle. Nothing is simulated: for pictures. Part frame to room.
base::Pose findFinishPose(const track::Track& track, const part::Part& part,
                          const base::Quaternion& orientation);

}  // namespace trapwright::trial
