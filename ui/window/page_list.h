#pragma once

#include <vector>

namespace trapwright::pages {
class Page;
class RunActions;
}  // namespace trapwright::pages

namespace trapwright::window {

/// The pages of the studio in the order of the rail. The window takes them.
std::vector<pages::Page*> makePages(pages::RunActions& run);

}  // namespace trapwright::window
