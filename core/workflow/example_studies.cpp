#include "core/workflow/example_studies.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <system_error>

#include "core/base/resources.h"

namespace trapwright::workflow {

namespace {

constexpr std::array kExamples = {
    ExampleStudy{"cuboid", "the paper's cuboid, turned over by a free-form trap"},
    ExampleStudy{"cuboid-bowl", "the same in the paper's bowl of 175 mm"},
    ExampleStudy{"screw", "a pan-head screw M4 x 10, which leaves hanging between rails, head up"},
    ExampleStudy{"bolt", "a hexagon bolt M4 x 12, which leaves hanging between rails, head up"},
    ExampleStudy{"bracket", "a bracket: ledges behind ten gaps throw out what the gaps leave wrong"},
    ExampleStudy{"pin", "a pin with a head, which hangs in slots and lies down the same way round"},
    ExampleStudy{"washer", "a washer, laid flat by a free-form trap"},
};

}  // namespace

std::span<const ExampleStudy> listExampleStudies() {
    return kExamples;
}

std::string nameExampleStudies() {
    std::string names;
    for (const ExampleStudy& example : kExamples)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", example.name);
    return names;
}

base::Result<ExampleStudy> findExampleStudy(std::string_view name) {
    for (const ExampleStudy& example : kExamples) {
        if (example.name == name) return example;
    }
    return base::Error{
        fmt::format("There is no example study \"{}\". The examples are {}.", name, nameExampleStudies())};
}

std::filesystem::path findExampleFile(const ExampleStudy& example) {
    return base::findResource(std::filesystem::path("studies") / fmt::format("{}.trap", example.name));
}

base::Status copyExample(const ExampleStudy& example, const std::filesystem::path& path) {
    const std::filesystem::path source = findExampleFile(example);
    std::error_code failure;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, failure)))
        return base::Error{path.string() + " exists already. Choose another name for the copy."};
    std::filesystem::copy_file(source, path, failure);
    // An installed one may be read-only.
    if (!failure) {
        using std::filesystem::perms;
        std::filesystem::permissions(path, perms::owner_read | perms::owner_write,
                                     std::filesystem::perm_options::add, failure);
    }
    if (!failure) return base::success();
    const std::string reason = failure.message();
    std::filesystem::remove(path, failure);
    return base::Error{fmt::format("{} cannot be copied to {}: {}.", source.string(), path.string(), reason)};
}

}  // namespace trapwright::workflow
