#pragma once

#include <string>

#include "core/base/result.h"

namespace trapwright::transports {

/// Both ends of a pseudo-terminal in raw mode. Not to be shared between threads.
class PseudoTerminal {
 public:
    PseudoTerminal() = default;
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;
    ~PseudoTerminal() { close(); }

    base::Status open();
    void close();

    /// The descriptor of our end, -1 where it is closed.
    [[nodiscard]] int master() const { return master_; }
    /// What the other side opens: "/dev/pts/7".
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Whoever held the other end for himself and died does not hold it any more.
    void unlock() const;

 private:
    int master_ = -1;
    int slave_ = -1;  // kept open, so that our end lives on between two visitors
    std::string name_;
};

}  // namespace trapwright::transports
