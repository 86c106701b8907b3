#pragma once

#include <QString>
#include <string>

namespace trapwright::pages {

/// A sentence of study::findProblems, findPartProblems or findRecommendations as a form shows it.
struct ProblemText {
    std::string
        key;       // of the setting to be marked: the first that the sentence names; empty if it names none
    QString text;  // with labels in place of keys; without the value that the marked field shows anyway
};

ProblemText describeProblem(const std::string& problem);

}  // namespace trapwright::pages
