#include "ui/pages/page.h"

namespace trapwright::pages {

Page::Page(PageFace face, QWidget* parent) : QWidget(parent), face_(std::move(face)) {
    setObjectName("page." + face_.name);
    setAccessibleName(face_.title);
    setAccessibleDescription(face_.tip);
}

bool Page::takeFile(const std::filesystem::path&) {
    return false;
}

}  // namespace trapwright::pages
