#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace trapwright::workflow {

/// A study that comes with Trapwright: learned, selected and validated (resources/docs/results.md).
struct ExampleStudy {
    std::string_view name;         // its file: studies/NAME.trap of the resources
    std::string_view description;  // for people
};

/// The example studies.
std::span<const ExampleStudy> listExampleStudies();

/// "cuboid, ...": all names, for people.
std::string nameExampleStudies();

/// The example study with this name. Error: there is none; names those that there are.
base::Result<ExampleStudy> findExampleStudy(std::string_view name);

/// Where it is (base::findResource).
std::filesystem::path findExampleFile(const ExampleStudy& example);

/// Copies an example to a new file, which can be gone on with as any study. Nothing is left behind on
/// failure. An error if the path exists.
base::Status copyExample(const ExampleStudy& example, const std::filesystem::path& path);

}  // namespace trapwright::workflow
