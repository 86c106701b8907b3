#include "ui/pages/problem_text.h"

#include <algorithm>
#include <vector>

#include "core/study/field_text.h"
#include "ui/pages/field_texts.h"

namespace trapwright::pages {

namespace {

/// Longest first, so that no key is taken for another that it begins with.
const std::vector<std::string>& keysByLength() {
    static const std::vector<std::string> keys = [] {
        std::vector<std::string> list;
        for (study::FieldInfo& field : study::listFields())
            list.push_back(std::move(field.key));
        std::stable_sort(list.begin(), list.end(),
                         [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
        return list;
    }();
    return keys;
}

}  // namespace

ProblemText describeProblem(const std::string& problem) {
    ProblemText result;
    std::size_t first = std::string::npos;
    result.text = QString::fromStdString(problem);
    for (const std::string& key : keysByLength()) {
        const std::size_t place = problem.find(key);
        if (place == std::string::npos) continue;
        if (place < first) {
            first = place;
            result.key = key;
        }
        result.text.replace(QString::fromStdString(key), findFieldText(key).label);
    }
    // "track.crossSections is 0; it must be ..." -> "It must be ..."
    const qsizetype value = first == 0 ? result.text.indexOf("; ") : -1;
    if (value >= 0) result.text = result.text.mid(value + 2);
    if (!result.text.isEmpty()) result.text[0] = result.text[0].toUpper();
    return result;
}

}  // namespace trapwright::pages
