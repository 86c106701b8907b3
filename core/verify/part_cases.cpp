#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/part/stable_poses.h"
#include "core/verify/cases.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

std::vector<Row> runStablePoses(const trial::EngineKind&, const base::RunControl&) {
    const auto cuboid = makePaperCuboid();
    std::vector<double> got;
    for (const part::StablePose& pose : part::computeStablePoses(cuboid->hull, cuboid->symmetry, true))
        got.push_back(pose.probability);
    const double expected[3] = {0.645, 0.243, 0.112};
    bool passed = got.size() == 3;
    std::string text;
    for (std::size_t i = 0; i < got.size(); ++i) {
        text += fmt::format("{}{:.3f}", i > 0 ? ", " : "", got[i]);
        passed = passed && std::abs(got[i] - expected[std::min<std::size_t>(i, 2)]) < 0.0006;
    }
    return {{"stable poses of the 4 x 8 x 12 mm cuboid", "0.645, 0.243, 0.112 per face pair", text, passed}};
}

}  // namespace trapwright::verify
