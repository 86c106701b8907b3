#include "ui/window/page_list.h"

#include "ui/pages/export_page.h"
#include "ui/pages/part_page.h"
#include "ui/pages/track_page.h"

namespace trapwright::window {

std::vector<pages::Page*> makePages(pages::RunActions&) {
    return {new pages::PartPage, new pages::TrackPage, new pages::ExportPage};
}

}  // namespace trapwright::window
