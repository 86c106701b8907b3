#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/search/methods.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// The state of a search, the first byte says which: refused, or one that it goes on from.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    search::DesignSpace space;
    for (int i = 0; i < 2; ++i)
        space.dimensions.push_back({i == 0 ? "y" : "z", "mm", 0.0, 1.0, 10, true});
    space.dimensions.push_back({"length", "mm", 0.0, 1.0, 6});
    search::SearchParameters parameters;
    parameters.populationSize = 4;
    parameters.genetic.tournamentSize = 2;
    const search::Method method = search::kMethods[data[0] % search::kMethods.size()].second;
    const auto search = search::makeSearch(method, space, parameters);
    const std::string_view state(reinterpret_cast<const char*>(data + 1), size - 1);
    if (const auto loaded = search->load(state); !loaded) {
        fuzz::require(!loaded.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    const auto proposals = search->ask();
    fuzz::require(!proposals.empty(), "there is something to be judged");
    for (const search::Proposal& proposal : proposals)
        fuzz::require(space.check(proposal.design).ok(), "a proposal is of the space");
    search->tell(std::vector<search::Judgement>(proposals.size(), {1.0, 1}));
    fuzz::require(search::makeSearch(method, space, parameters)->load(search->save()).ok(),
                  "what is saved can be loaded");
    return 0;
}
