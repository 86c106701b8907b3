#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace trapwright::base {

// Inside core/base only.

/// A descriptor of the system's, closed with this object.
class Descriptor {
 public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    [[nodiscard]] int get() const { return number_; }
    void close();

 private:
    int number_;
};

/// The same file under a number from `least` on, none of those that a child gets, also where this program was
/// started without input or output.
Descriptor lift(int number, int least);

Error cannotStart(const std::string& program, int reason);

/// Starts a program, which is looked for in PATH unless its name has a slash. `arrange` tells what becomes of
/// the descriptors. In a group of its own, so that Ctrl-C is the parent's to answer; signals as in a new
/// program.
Result<pid_t> spawn(const std::string& program, std::vector<std::string> arguments,
                    const std::function<void(posix_spawn_file_actions_t&)>& arrange);

/// Kills and reaps a child that is still there when its parent is done with it.
class Child {
 public:
    explicit Child(pid_t process) : process_(process) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();
    /// Kills it and all that it started.
    void killGroup() const;
    /// Its status, as of waitpid.
    int wait();

 private:
    pid_t process_;
};

}  // namespace trapwright::base
