#include "ui/help/help_book.h"

#include <QFile>
#include <QHash>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>
#include <array>

#include "core/base/resources.h"
#include "ui/look/text.h"

namespace trapwright::help {

namespace {

/// In the order of the work; pages that are not listed follow.
constexpr std::array kContents = {"index",   "part",     "track", "evolve",   "review",
                                  "export",  "validate", "drive", "settings", "command-line",
                                  "cluster", "glossary", "paper"};
/// For whoever reads the sources as well, and so one folder higher.
constexpr std::array kSharedPages = {"decisions", "bibliography"};

QString readText(const std::filesystem::path& path) {
    QFile file(look::toText(path));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

/// Without the marks of Markdown: for titles and excerpts.
QString plainText(QString text) {
    static const QRegularExpression picture(R"(!\[[^\]]*\]\([^)]*\))");
    static const QRegularExpression link(R"(\[([^\]]*)\]\([^)]*\))");
    static const QRegularExpression rule(R"(\|?[-|: ]{3,}\|)");
    text.remove(picture);
    text.replace(link, "\\1");
    text.remove(rule);
    text.remove('`').remove('*');
    return text.replace('|', ' ').simplified();
}

QString excerptAround(const QString& text, const QString& word) {
    constexpr qsizetype kBefore = 40;
    constexpr qsizetype kLength = 110;
    const qsizetype place = std::max<qsizetype>(text.indexOf(word, 0, Qt::CaseInsensitive), 0);
    qsizetype begin = std::max<qsizetype>(place - kBefore, 0);
    if (begin > 0) begin = text.indexOf(' ', begin) + 1;
    const QString excerpt = text.mid(begin, kLength);
    return (begin > 0 ? "… " : "") + excerpt + (begin + kLength < text.size() ? " …" : "");
}

int placeOf(const QString& name) {
    const auto* found = std::find(kContents.begin(), kContents.end(), name);
    return static_cast<int>(found - kContents.begin());
}

}  // namespace

QString anchorOf(const QString& heading) {
    QString anchor;
    for (const QChar c : plainText(heading).toLower()) {
        if (c.isLetterOrNumber() || c == '_' || c == '-') anchor += c;
        if (c == ' ') anchor += '-';
    }
    return anchor;
}

std::vector<Section> readSections(const QString& markdown) {
    std::vector<Section> sections;
    QHash<QString, int> used;
    bool code = false;
    for (const QString& line : markdown.split('\n')) {
        if (line.startsWith("```")) code = !code;
        const auto level = static_cast<int>(
            std::find_if(line.begin(), line.end(), [](QChar c) { return c != '#'; }) - line.begin());
        if (!code && level >= 1 && level <= 6 && line.mid(level).startsWith(' ')) {
            const QString anchor = anchorOf(line.mid(level + 1));
            const int before = used[anchor]++;
            sections.push_back({before == 0 ? anchor : QString("%1-%2").arg(anchor).arg(before),
                                plainText(line.mid(level + 1)),
                                {},
                                level});
        } else if (!sections.empty()) {
            sections.back().text += line + '\n';
        }
    }
    return sections;
}

HelpBook::HelpBook(const std::filesystem::path& folder) {
    const auto add = [this](const std::filesystem::path& file) {
        Page page{look::toText(file.stem()), {}, file, readSections(readText(file))};
        if (page.sections.empty()) return;
        page.title = page.sections.front().title;
        pages_.push_back(std::move(page));
    };
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
        if (entry.path().extension() == ".md") add(entry.path());
    std::sort(pages_.begin(), pages_.end(), [](const Page& a, const Page& b) {
        const int placeA = placeOf(a.name);
        const int placeB = placeOf(b.name);
        return placeA != placeB ? placeA < placeB : a.name < b.name;
    });
    if (pages_.empty()) return;
    for (const char* name : kSharedPages)
        add(folder.parent_path() / (std::string(name) + ".md"));
}

HelpBook HelpBook::installed() {
    return HelpBook(base::findResource("docs") / "help");
}

const Page* HelpBook::findPage(const QString& name) const {
    const auto found =
        std::find_if(pages_.begin(), pages_.end(), [&](const Page& page) { return page.name == name; });
    return found != pages_.end() ? &*found : nullptr;
}

bool HelpBook::has(const QString& page, const QString& anchor) const {
    const Page* found = findPage(page);
    return found != nullptr && std::any_of(found->sections.begin(), found->sections.end(),
                                           [&](const Section& section) { return section.anchor == anchor; });
}

std::vector<Hit> HelpBook::search(const QString& words) const {
    const QStringList wanted = words.split(' ', Qt::SkipEmptyParts);
    if (wanted.isEmpty()) return {};
    const auto holdsAll = [&](const QString& text) {
        return std::all_of(wanted.begin(), wanted.end(),
                           [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
    };
    std::vector<Hit> inTitles;
    std::vector<Hit> inTexts;
    for (const Page& page : pages_) {
        for (const Section& section : page.sections) {
            const QString text = plainText(section.text);
            const bool titled = holdsAll(section.title);
            if (!titled && !holdsAll(section.title + ' ' + text)) continue;
            (titled ? inTitles : inTexts)
                .push_back({page.name, page.title, section.anchor, section.title,
                            excerptAround(text, wanted.front())});
        }
    }
    inTitles.insert(inTitles.end(), inTexts.begin(), inTexts.end());
    return inTitles;
}

}  // namespace trapwright::help
