#pragma once

#include <QString>
#include <filesystem>
#include <vector>

namespace trapwright::help {

/// A heading of a page and what stands below it until the next one.
struct Section {
    QString anchor;  // unique on its page
    QString title;   // plain text
    QString text;    // Markdown
    int level = 1;   // of the heading
};

struct Page {
    QString name;  // of its file, "track"
    QString title;
    std::filesystem::path file;
    std::vector<Section> sections;  // the first has the page's title
};

/// A section in which words were found.
struct Hit {
    QString page;
    QString pageTitle;
    QString anchor;
    QString title;
    QString excerpt;  // around the first of the words
};

/// The anchor of a heading, as GitHub makes it; a second one of the same text on a page gets "-1".
QString anchorOf(const QString& heading);

/// The sections of a text in Markdown. What looks like a heading within a block of code is none.
std::vector<Section> readSections(const QString& markdown);

/// The pages of the help.
class HelpBook {
 public:
    /// All pages of a folder, those that have a place in the contents first, and the decisions and the
    /// bibliography beside it. Without the folder there are none.
    explicit HelpBook(const std::filesystem::path& folder);
    /// Those that come with the program (base::findResource).
    static HelpBook installed();

    [[nodiscard]] const std::vector<Page>& pages() const { return pages_; }
    [[nodiscard]] const Page* findPage(const QString& name) const;
    [[nodiscard]] bool has(const QString& page, const QString& anchor) const;
    /// Sections in which every word occurs, whatever its case; those with the words in their titles first.
    [[nodiscard]] std::vector<Hit> search(const QString& words) const;

 private:
    std::vector<Page> pages_;
};

}  // namespace trapwright::help
