#include "ui/window/page_list.h"

#include "ui/feeder/validate_page.h"
#include "ui/pages/evolve_page.h"
#include "ui/pages/export_page.h"
#include "ui/pages/part_page.h"
#include "ui/pages/review_page.h"
#include "ui/pages/track_page.h"

namespace trapwright::window {

std::vector<pages::Page*> makePages(pages::RunActions& run, const session::Environment& environment) {
    return {new pages::PartPage,   new pages::TrackPage(run), new pages::EvolvePage(run),
            new pages::ReviewPage, new pages::ExportPage,     new feeder::ValidatePage(environment)};
}

}  // namespace trapwright::window
