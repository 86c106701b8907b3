// No document of the repository leads nowhere: links to files and to headings, pictures, and papers that are
// cited by surname and year.

#include <QDirIterator>
#include <QLocale>
#include <QRegularExpression>
#include <QtTest>

#include "ui/help/help_book.h"

using namespace trapwright;

namespace {

const QString kRoot = QStringLiteral(TRAPWRIGHT_SOURCE_DIR);

QString readText(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QStringList findDocuments() {
    QStringList documents;
    QDirIterator files(kRoot, {"*.md"}, QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) {
        const QString path = files.next();
        if (!path.startsWith(kRoot + "/build")) documents << path;
    }
    documents.sort();
    return documents;
}

/// What stands between back quotes is no link.
QString withoutCode(QString text) {
    static const QRegularExpression block("```.*?```", QRegularExpression::DotMatchesEverythingOption);
    static const QRegularExpression span("`[^`\n]*`");
    return text.remove(block).remove(span);
}

bool hasHeading(const QString& file, const QString& anchor) {
    for (const help::Section& section : help::readSections(readText(file)))
        if (section.anchor == anchor) return true;
    return false;
}

/// Links of a text that lead nowhere, seen from its file.
QStringList findDeadLinks(const QString& file, const QString& text) {
    static const QRegularExpression link(R"(\]\(([^)\s]+)\))");
    QStringList dead;
    for (const QRegularExpressionMatch& match : link.globalMatch(withoutCode(text))) {
        const QString target = match.captured(1);
        if (target.startsWith("http://") || target.startsWith("https://") || target.startsWith("mailto:"))
            continue;
        const QString path = target.section('#', 0, 0);
        const QString anchor = target.section('#', 1);
        const QString place =
            path.isEmpty() ? file : QDir::cleanPath(QFileInfo(file).absolutePath() + '/' + path);
        if (!QFileInfo::exists(place) || (!anchor.isEmpty() && !hasHeading(place, anchor))) dead << target;
    }
    return dead;
}

/// What a source cites in the project's documents, "decisions.md#bowl", and is not there.
QStringList findDeadReferences(const QString& text, int& found) {
    static const QRegularExpression reference(R"(\b([a-z_-]+\.md)#([a-z0-9-]+))");
    QStringList dead;
    for (const QRegularExpressionMatch& match : reference.globalMatch(text)) {
        ++found;
        const QString docs = kRoot + "/resources/docs/";
        const QString file = match.captured(1);
        if (!hasHeading(docs + file, match.captured(2)) &&
            !hasHeading(docs + "help/" + file, match.captured(2)))
            dead << match.captured();
    }
    return dead;
}

/// All sources of the project's own folders.
QStringList findSources() {
    QStringList sources;
    for (const char* folder : {"app", "core", "sim", "tests", "ui"}) {
        QDirIterator files(kRoot + '/' + folder, {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
        while (files.hasNext())
            sources << files.next();
    }
    return sources;
}

/// "Clopper and Pearson (1934" and the like: the last surname and the year.
QList<QPair<QString, QString>> findCitations(const QString& text) {
    static const QRegularExpression citation(
        R"(\b([A-Z][a-z]{2,}(?:-[A-Z][a-z]+)?)(?: et al\.|'s [a-z -]*)?,? \(?((?:18|19|20)\d\d)\b(?!-))");
    QList<QPair<QString, QString>> found;
    for (const QRegularExpressionMatch& match : citation.globalMatch(withoutCode(text)))
        found.push_back({match.captured(1), match.captured(2)});
    return found;
}

bool isListed(const QString& bibliography, const QString& surname, const QString& year) {
    for (const QString& line : bibliography.split('\n')) {
        if (line.startsWith("- ") && line.contains(surname) && line.contains(year)) return true;
    }
    return false;
}

}  // namespace

class DocsTest : public QObject {
    Q_OBJECT

 private slots:
    void noLinkLeadsNowhere_data() {
        QTest::addColumn<QString>("file");
        for (const QString& file : findDocuments())
            QTest::newRow(qPrintable(QDir(kRoot).relativeFilePath(file))) << file;
    }
    void noLinkLeadsNowhere() {
        QFETCH(QString, file);
        const QStringList dead = findDeadLinks(file, readText(file));
        QVERIFY2(dead.isEmpty(), qPrintable("dead: " + dead.join(", ")));
    }

    // What is held above would be worth nothing if nothing were ever found.
    void aDeadLinkIsFound_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<int>("dead");
        QTest::newRow("file that is there") << "[a](track.md)" << 0;
        QTest::newRow("heading that is there") << "[a](track.md#drive)" << 0;
        QTest::newRow("no such file") << "[a](trakc.md)" << 1;
        QTest::newRow("no such heading") << "[a](track.md#drvie)" << 1;
        QTest::newRow("no such picture") << "![a](../../pictures/none.png)" << 1;
        QTest::newRow("code") << "`[a](none.md)`" << 0;
        QTest::newRow("elsewhere") << "[a](https://example.org/none)" << 0;
    }
    void aDeadLinkIsFound() {
        QFETCH(QString, text);
        QFETCH(int, dead);
        QCOMPARE(findDeadLinks(kRoot + "/resources/docs/help/index.md", text).size(), dead);
    }

    void noReferenceLeadsNowhere() {
        QStringList dead;
        int found = 0;
        for (const QString& file : findSources()) {
            if (file.endsWith("docs_test.cpp")) continue;
            for (const QString& reference : findDeadReferences(readText(file), found))
                dead << QString("%1 (%2)").arg(reference, QDir(kRoot).relativeFilePath(file));
        }
        QVERIFY2(dead.isEmpty(), qPrintable(dead.join("; ")));
        QVERIFY2(found > 30, qPrintable(QString("only %1 references were seen").arg(found)));
    }

    void aDeadReferenceIsFound() {
        int found = 0;
        const QString text =
            "(decisions.md#bowl, decisions.md#ball; bibliography.md#standards, none.md#bowl)";
        QCOMPARE(findDeadReferences(text, found), QStringList({"decisions.md#ball", "none.md#bowl"}));
        QCOMPARE(found, 4);
    }

    // Numbers of a list that only some have say nothing to others.
    void nothingIsCitedThatIsNotHere() {
        static const QRegularExpression elsewhere(R"(design\.md|\b[Dd]ecisions? \d)");
        for (const QString& file : findDocuments() + findSources()) {
            if (file.endsWith("docs_test.cpp")) continue;
            const auto match = elsewhere.match(readText(file));
            QVERIFY2(!match.hasMatch(),
                     qPrintable(QDir(kRoot).relativeFilePath(file) + ": " + match.captured()));
        }
    }

    void everyPaperIsInTheBibliography() {
        const QString bibliography = readText(kRoot + "/resources/docs/bibliography.md");
        QStringList noAuthors = {"GDC", "Qt", "Detection", "Properties", "Nov", "Debian"};
        for (int month = 1; month <= 12; ++month)
            noAuthors << QLocale::c().monthName(month);
        int checked = 0;
        QStringList missing;
        QStringList files = findDocuments();
        for (const char* folder : {"core", "sim", "ui"}) {
            QDirIterator sources(kRoot + '/' + folder, {"*.h", "*.cpp"}, QDir::Files,
                                 QDirIterator::Subdirectories);
            while (sources.hasNext())
                files << sources.next();
        }
        for (const QString& file : files) {
            if (file.endsWith("bibliography.md") || file.contains("/tests/")) continue;
            QString text = readText(file);
            if (!file.endsWith(".md")) text.replace(QRegularExpression("\n\\s*//[/]?\\s*"), " ");
            for (const auto& [surname, year] : findCitations(text)) {
                if (noAuthors.contains(surname)) continue;
                ++checked;
                if (!isListed(bibliography, surname, year))
                    missing << QString("%1 %2 (%3)").arg(surname, year, QDir(kRoot).relativeFilePath(file));
            }
        }
        QVERIFY2(missing.isEmpty(), qPrintable(missing.join("; ")));
        QVERIFY2(checked > 30, qPrintable(QString("only %1 citations were seen").arg(checked)));
    }

    // A page for each page of the studio, and what else a user asks for.
    void theHelpHasItsPages() {
        const help::HelpBook book((kRoot + "/resources/docs/help").toStdString());
        QStringList names;
        for (const help::Page& page : book.pages())
            names << page.name;
        for (const char* name :
             {"index", "part", "track", "evolve", "review", "export", "validate", "drive", "settings",
              "command-line", "glossary", "paper", "decisions", "bibliography"})
            QVERIFY2(names.contains(name), name);
        QCOMPARE(names.front(), QString("index"));
        // And the first page leads to all of them.
        const QString contents = readText(kRoot + "/resources/docs/help/index.md");
        for (const QString& name : names)
            QVERIFY2(name == "index" || contents.contains(name + ".md)"), qPrintable(name));
    }

    void everyCommandIsTold() {
        const QString page = readText(kRoot + "/resources/docs/help/command-line.md");
        const QStringList sources = QDir(kRoot + "/app/trapwright").entryList({"command_*.cpp"}, QDir::Files);
        QVERIFY(sources.size() > 10);
        for (const QString& source : sources) {
            if (source == "command_line.cpp") continue;  // holds the commands together
            const QString command = source.section('_', 1).section('.', 0, 0).replace('_', '-');
            QVERIFY2(page.contains("| `trapwright " + command), qPrintable(command));
        }
    }

    void theGlossaryHasEverySymbol() {
        const QString glossary = readText(kRoot + "/resources/docs/help/glossary.md");
        for (const char* symbol : {"F", "F_C", "F_D", "F_O", "O(x)", "d_i", "N", "P", "s", "b", "p_x", "p_dm",
                                   "p_sm", "p_m", "p_s", "T, F, P [%]"})
            QVERIFY2(glossary.contains(QString("\n| %1 | ").arg(symbol)), symbol);
    }

    void wordsAreFound_data() {
        QTest::addColumn<QString>("words");
        QTest::addColumn<QString>("place");
        QTest::newRow("a title") << "film strip"
                                 << "evolve#film-strip";
        QTest::newRow("several words, any case") << "BOSCHLOO holm"
                                                 << "validate#results";
        QTest::newRow("a setting") << "halfStroke_mm"
                                   << "settings#half-stroke-simulationdrivehalfstroke_mm";
        QTest::newRow("in a table") << "crossover rate, a strategy value"
                                    << "glossary#symbols";
        QTest::newRow("nothing") << "xylophone"
                                 << "";
        QTest::newRow("no words") << "  "
                                  << "";
    }
    void wordsAreFound() {
        QFETCH(QString, words);
        QFETCH(QString, place);
        const help::HelpBook book((kRoot + "/resources/docs/help").toStdString());
        const std::vector<help::Hit> hits = book.search(words);
        if (place.isEmpty()) {
            QVERIFY(hits.empty());
            return;
        }
        QVERIFY(!hits.empty());
        QCOMPARE(hits.front().page + '#' + hits.front().anchor, place);
    }
};

QTEST_GUILESS_MAIN(DocsTest)
#include "docs_test.moc"
