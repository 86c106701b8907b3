#pragma once

#include <QString>
#include <string>
#include <string_view>
#include <vector>

#include "core/trial/engine_registry.h"

namespace trapwright::pages {

/// What people are told of one setting.
struct FieldText {
    std::string_view key;               // as in core/study/settings_fields.h
    QString label;                      // "Segment width"
    QString help;                       // one sentence
    std::vector<QString> choices = {};  // labels of a choice, in the order of its names
};

/// The text of a setting. The key must be one of study::listFields().
FieldText findFieldText(std::string_view key);

/// A value that can be chosen for a setting: as study::setField takes it, and as people read it.
struct Choice {
    std::string value;
    QString label;
};

/// What track.traps can be: each kind of trap, and each two of them one after the other.
std::vector<Choice> trapChoices();

/// Sums of objectives that make sense for evolution.objectives; the command line takes any.
std::vector<Choice> objectiveChoices();
std::vector<Choice> tradeOffChoices();

/// What simulation.engine can be.
std::vector<Choice> engineChoices(const trial::EngineRegistry& engines);

/// The unit for people that a key ends with: "mm", "°", "kg/m³"; empty for a bare number.
QString unitOf(std::string_view key);

/// Settings that belong together on a form.
struct FieldGroup {
    QString name;   // stable
    QString title;  // for people
    std::vector<std::string_view> keys;
    bool foldedAtFirst = false;
};

/// Table 1 of the paper and the decisions around it, as the Track page shows them.
std::vector<FieldGroup> trackGroups();

/// The page of the help that lists every setting, in Markdown: label, what it means, unit, range, value at
/// first, and its key in files. resources/docs/help/settings.md is this text.
QString settingsReference();
/// The heading of a setting on that page.
QString settingHeading(std::string_view key);

}  // namespace trapwright::pages
