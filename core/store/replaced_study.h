#pragma once

#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace trapwright::store {

/// A file whose name a study is going to have. Moved out of the way; put back at the end of this object,
/// unless the new study is there by then and discard() was called.
class ReplacedStudy {
 public:
    /// Nothing is moved if there is no such file. An error if it is a folder, or a study that somebody has
    /// open for writing, or its folder cannot be written.
    static base::Result<ReplacedStudy> setAside(const std::filesystem::path& path);

    ReplacedStudy(ReplacedStudy&& other) noexcept;
    ReplacedStudy& operator=(ReplacedStudy&&) = delete;
    ~ReplacedStudy();

    /// Deletes it for good.
    void discard();

 private:
    struct Moved {
        std::filesystem::path path;   // that it had
        std::filesystem::path aside;  // where it is; a name that nobody had
    };
    explicit ReplacedStudy(std::optional<Moved> moved);

    std::optional<Moved> moved_;  // none if there was no such file
};

}  // namespace trapwright::store
