#pragma once

#include <string>

#include "sim/native/trial_lanes.h"

/// The kernel of the native engine, compiled once per instruction set; the best that the machine has is taken
/// when the program runs.
namespace trapwright::native {

/// First half of a time step of every lane: gravity, gyroscopic torque, and where the track goes.
void beginStep(TrialLanes& group);
/// Second half: contacts, impulses, new poses.
void finishStep(TrialLanes& group);
/// The same in two: between them the impulses of lanes that are `touched` are whoever steps them's to find.
void findContacts(TrialLanes& group);
void solveAndMove(TrialLanes& group);

/// The instruction set in use: "AVX3", "AVX2", "SSE4", "SCALAR".
std::string instructionSet();
/// All that this machine has and the kernel was compiled for, the best first.
std::vector<std::string> instructionSets();
/// For tests: takes this one from now on, in all threads; "" takes the best again. False if the machine has
/// none of that name.
bool useInstructionSet(const std::string& name);

}  // namespace trapwright::native
