#pragma once

#include <Qt>

namespace trapwright::models {

/// What the models tell beside Qt's own roles.
enum Role {
    ValueRole = Qt::UserRole,  // the plain number behind the text, for sorting and CSV
    GenerationRole,
    IndividualRole,
    TrialRole,
    PoseRole,     // index into the part's stable poses; -1 for a total
    VerdictRole,  // trial::Verdict as int: of the trial, or that the column counts; -1 otherwise
    IsWinnerRole,
    SuccessRole,  // "95 %", or a dash where it is not known
    CsvRole       // a list: what a cell, or a heading, is in CSV; without it the ValueRole, or the title
};

}  // namespace trapwright::models
