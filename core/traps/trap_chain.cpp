#include "core/traps/trap_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/spelling.h"
#include "core/traps/free_form.h"
#include "core/traps/groove.h"
#include "core/traps/ledge.h"
#include "core/traps/narrowed.h"
#include "core/traps/step.h"

namespace trapwright::traps {

namespace {

using base::inMillimetres;

base::Error unknownKind(std::string_view name) {
    std::string keys;
    for (const TrapKind& kind : trapKinds())
        keys += (keys.empty() ? "" : ", ") + std::string(kind.key);
    return {fmt::format(
        "There is no kind of trap named \"{}\". The kinds are: {}. Write several with commas between "
        "them, and those that come more than once as \"3 x drop\".",
        name, keys)};
}

/// A name of the list, and how often it comes: "3 x drop".
struct Repeated {
    std::string_view name;
    std::size_t times = 1;
};

Repeated readRepeated(std::string_view word) {
    Repeated repeated{word};
    std::size_t times = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), times);
    if (error != std::errc{}) return repeated;
    const auto begin = word.find_first_not_of(' ', static_cast<std::size_t>(end - word.data()));
    if (begin == std::string_view::npos || word[begin] != 'x') return repeated;
    const auto name = word.find_first_not_of(' ', begin + 1);
    if (name == std::string_view::npos) return repeated;
    return {word.substr(name), times};
}

}  // namespace

std::span<const TrapKind> trapKinds() {
    static const std::array<TrapKind, 12> kinds = {freeForm(),    step(),     groove(),  drop(),
                                                   cutOut(),      gap(),      slot(),    rails(),
                                                   narrowRails(), narrowed(), notched(), ledge()};
    return kinds;
}

base::Status checkParameters(const TrapParameters& parameters) {
    if (parameters.crossSections < 1) {
        return base::Error{fmt::format("The number of cross-sections is {}; a trap needs at least 1.",
                                       parameters.crossSections)};
    }
    if (parameters.pointsPerSection < 2) {
        return base::Error{
            fmt::format("The number of points per cross-section is {}; a surface needs at least 2.",
                        parameters.pointsPerSection)};
    }
    if (!(parameters.minSegmentLength > 0.0 && std::isfinite(parameters.minSegmentLength))) {
        return base::Error{fmt::format("The minimal segment length is {:g} mm; it must be greater than 0.",
                                       inMillimetres(parameters.minSegmentLength))};
    }
    if (const auto surrounds = track::checkParameters(parameters); !surrounds) return surrounds.error();
    if (parameters.minSegmentLength > parameters.maxSegmentLength) {
        return base::Error{fmt::format(
            "The minimal segment length ({:g} mm) is greater than the maximal segment length ({:g} mm).",
            inMillimetres(parameters.minSegmentLength), inMillimetres(parameters.maxSegmentLength))};
    }
    return base::success();
}

base::Result<TrapChain> readTraps(std::string_view text) {
    TrapChain chain;
    for (const std::string_view word : base::splitNames(text)) {
        const Repeated repeated = readRepeated(word);
        const auto kinds = trapKinds();
        const auto found = std::find_if(kinds.begin(), kinds.end(),
                                        [&](const TrapKind& kind) { return kind.key == repeated.name; });
        if (found == kinds.end()) return unknownKind(word);
        if (repeated.times < 1 || repeated.times > kMostTraps - std::min(kMostTraps, chain.size())) {
            return base::Error{
                fmt::format("\"{}\" makes {} traps; a track may have 1 to {} one after the other.", text,
                            repeated.times < 1 ? "no" : "more", kMostTraps)};
        }
        chain.insert(chain.end(), repeated.times, &*found);
    }
    const auto open = std::ranges::find_if(chain, &TrapKind::isLast);
    if (open != chain.end() && std::next(open) != chain.end()) {
        return base::Error{fmt::format(
            "\"{}\" goes on behind its {}. They stay open to the track's end, so they come last; a slot "
            "ends and can be followed.",
            text, (*open)->key)};
    }
    return chain;
}

std::string describe(const TrapChain& chain) {
    std::string text;
    for (std::size_t i = 0, times = 1; i < chain.size(); i += times) {
        for (times = 1; i + times < chain.size() && chain[i + times] == chain[i];)
            ++times;
        std::string title(chain[i]->title);
        if (!text.empty() || times > 1)
            title.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(title.front())));
        text += (text.empty() ? "" : ", ") + (times > 1 ? fmt::format("{} x {}", times, title) : title);
    }
    return text;
}

search::DesignSpace designSpace(const TrapChain& chain, const TrapParameters& parameters) {
    search::DesignSpace space;
    bool isSmoothed = false;
    int lines = 0;  // of the traps before
    for (std::size_t i = 0; i < chain.size(); ++i) {
        int last = lines;
        for (search::Dimension& dimension : chain[i]->dimensions(parameters)) {
            if (chain.size() > 1) dimension.key = fmt::format("trap {}: {}", i + 1, dimension.key);
            dimension.line += lines;
            last = std::max(last, dimension.line);
            space.dimensions.push_back(std::move(dimension));
        }
        lines = last + 1;
        isSmoothed = isSmoothed || chain[i]->smooth != nullptr;
    }
    if (!isSmoothed) return space;
    space.smooth = [chain, parameters](search::Design design, double probability, base::Random& random) {
        std::size_t first = 0;
        for (const TrapKind* kind : chain) {
            const std::size_t count = kind->dimensions(parameters).size();
            if (kind->smooth != nullptr) {
                const std::vector<double> smoothed =
                    kind->smooth(parameters, std::span(design).subspan(first, count), probability, random);
                std::copy(smoothed.begin(), smoothed.end(),
                          design.begin() + static_cast<std::ptrdiff_t>(first));
            }
            first += count;
        }
        return design;
    };
    return space;
}

std::vector<track::CrossSection> build(const TrapChain& chain, const TrapParameters& parameters,
                                       const search::Design& design) {
    return build(chain, parameters, design, levelSection(parameters, 0.5 * parameters.segmentHeight));
}

std::vector<track::CrossSection> build(const TrapChain& chain, const TrapParameters& parameters,
                                       const search::Design& design, const track::CrossSection& before) {
    std::vector<track::CrossSection> sections;
    std::size_t first = 0;
    for (const TrapKind* kind : chain) {
        const std::size_t count = kind->dimensions(parameters).size();
        const double begin = sections.empty() ? 0.0 : sections.back().x;
        const track::CrossSection& last = sections.empty() ? before : sections.back();
        for (track::CrossSection& section :
             kind->build(parameters, last, std::span(design).subspan(first, count))) {
            section.x += begin;
            sections.push_back(std::move(section));
        }
        first += count;
    }
    return sections;
}

std::vector<double> layOut(const TrapChain& chain, const TrapParameters& parameters) {
    std::vector<double> places;
    for (const TrapKind* kind : chain) {
        const double begin = places.empty() ? 0.0 : places.back();
        for (const double x : kind->layOut(parameters))
            places.push_back(begin + x);
    }
    return places;
}

track::CrossSection levelSection(const TrapParameters& parameters, double z) {
    track::CrossSection section;
    for (int j = 0; j < parameters.pointsPerSection; ++j)
        section.points.emplace_back(parameters.segmentWidth * (j / (parameters.pointsPerSection - 1.0) - 0.5),
                                    z);
    return section;
}

double findLowest(const track::CrossSection& section) {
    double lowest = section.points.front().y();
    for (const base::Vec2& point : section.points)
        lowest = std::min(lowest, point.y());
    return lowest;
}

double calcLongest(const TrapChain& chain, const TrapParameters& parameters) {
    double longest = 0.0;
    for (const TrapKind* kind : chain)
        longest += kind->longest(parameters);
    return longest;
}

}  // namespace trapwright::traps
