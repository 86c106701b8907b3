#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/search/design_space.h"

namespace trapwright::search {

/// A number that a search reports, under its name (NumberInfo::key).
struct NamedNumber {
    std::string key;
    double value = 0.0;

    friend bool operator==(const NamedNumber&, const NamedNumber&) = default;
};

/// The number of that name; none if there is none.
std::optional<double> findNumber(std::span<const NamedNumber> numbers, std::string_view key);

/// A design to be judged.
struct Proposal {
    Design design;
    std::vector<NamedNumber> traits{};  // what else the search knows of it, as its method lists them

    friend bool operator==(const Proposal&, const Proposal&) = default;
};

/// How a proposal did.
struct Judgement {
    double score = 0.0;                     // the higher the better
    int trials = 0;                         // that the score was made of; 0: none, it is known without
    double error = 0.0;                     // its standard error; 0: exact, or not known
    std::vector<NamedNumber> objectives{};  // that the score is the sum of, each the higher the better
};

/// A way of looking for good designs, by ask and tell: ask() says which designs shall be judged next, tell()
/// how they did, and so on, a generation each. It draws from random streams of the seed and the number of the
/// generation alone, so that the same judgements give the same designs, and its state can be saved and loaded
/// between tell() and ask().
class Search {
 public:
    Search() = default;
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;
    virtual ~Search() = default;

    /// Designs that the first ask() shall have among its own; before that. What traits it knows and are given
    /// it takes over, others are its own. A search that cannot makes nothing of it.
    virtual void begin(std::span<const Proposal> /*proposals*/) {}
    /// The next designs, all of the design space; the same until they are told of. At least one.
    virtual std::vector<Proposal> ask() = 0;
    /// One judgement for each of them, in their order.
    virtual void tell(std::span<const Judgement> judgements) = 0;
    /// What the search says of itself after tell(), the numbers that its method lists as curves.
    [[nodiscard]] virtual std::vector<NamedNumber> report() const = 0;

    /// All that ask() needs, as bytes that load() reads, in this and in later versions of the program.
    [[nodiscard]] virtual std::string save() const = 0;
    /// Goes on where save() was called. An error, and no change, if the bytes are not such a state, or one of
    /// another design space.
    virtual base::Status load(std::string_view state) = 0;
};

/// A number of a trait or a curve: how people are told of it.
struct NumberInfo {
    std::string key;     // in files, tables and JSON: "p_x"
    std::string name;    // in legends and lists: "crossover p_x"
    std::string help;    // a sentence
    std::string axis{};  // of the plot that shows it, with its unit; curves of one axis share a plot
    bool logarithmic = false;
    int decimals = 4;  // in tables
};

}  // namespace trapwright::search
