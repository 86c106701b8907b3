// STEP files that were damaged on their way: each is read or refused, none ends the program.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QtTest>
#include <csignal>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/base/child_process.h"
#include "core/base/file.h"
#include "core/part/cad_import.h"

using namespace trapwright;

namespace {

enum class Ending { read, refused, crashed };

constexpr unsigned kPatience = 20;       // [s]
constexpr rlim_t kMemory = 4ULL << 30U;  // [bytes]

/// Reads the file in a process of its own.
Ending readApart(const std::filesystem::path& path) {
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit limit{kMemory, kMemory};
        // A sanitizer takes terabytes of addresses for itself.
        if (!base::kSanitized) ::setrlimit(RLIMIT_AS, &limit);
        ::alarm(kPatience);
        // Qt Test's own would write a stack trace of each.
        for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
            ::signal(signal, SIG_DFL);
        ::_exit(part::readStepFile(path).ok() ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFEXITED(status)) return Ending::crashed;
    return WEXITSTATUS(status) == 0 ? Ending::read : Ending::refused;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

}  // namespace

class CadDamageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        lines_ = linesOf(base::readFile(TRAPWRIGHT_SOURCE_DIR "/resources/parts/bracket.step").value());
        QVERIFY(lines_.size() > 500);
        path_ = folder_.filePath("damaged.step").toStdString();
    }

    void theWholeFileIsRead() {
        QVERIFY(write(lines_).ok());
        QCOMPARE(readApart(path_), Ending::read);
    }

    void aLineThatIsMissing() {
        const auto found = std::find_if(lines_.begin(), lines_.end(),
                                        [](const std::string& line) { return line.starts_with("#398 ="); });
        QVERIFY(found != lines_.end());
        std::vector<std::string> lines = lines_;
        lines.erase(lines.begin() + (found - lines_.begin()));
        QVERIFY(write(lines).ok());
        QCOMPARE(readApart(path_), Ending::refused);
        const auto read = part::readStepFile(path_);
        QVERIFY(QString::fromStdString(read.error().message).contains("#398"));
    }

    // OpenCASCADE's own check of the model would follow the edge until the stack is full.
    void anEdgeThatIsAPartOfItself() {
        const std::string sound = "#20 = ORIENTED_EDGE('',*,*,#21,";
        std::vector<std::string> lines = lines_;
        const auto found = std::find_if(lines.begin(), lines.end(),
                                        [&](const std::string& line) { return line.starts_with(sound); });
        QVERIFY(found != lines.end());
        found->replace(found->find("#21"), 3, "#20");
        QVERIFY(write(lines).ok());
        QCOMPARE(readApart(path_), Ending::refused);
        const auto read = part::readStepFile(path_);
        QVERIFY(QString::fromStdString(read.error().message).contains("#20 is a part of itself"));
    }

    // TRAPWRIGHT_EVERY_LINE=1 tries all of them.
    void anyLineThatIsMissing() {
        const std::size_t step = qEnvironmentVariableIsSet("TRAPWRIGHT_EVERY_LINE") ? 1 : 12;
        int crashed = 0;
        int read = 0;
        int tried = 0;
        for (std::size_t i = 5; i < lines_.size(); i += step, ++tried) {
            std::vector<std::string> lines = lines_;
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
            QVERIFY(write(lines).ok());
            const Ending ending = readApart(path_);
            read += ending == Ending::read ? 1 : 0;
            if (ending != Ending::crashed) continue;
            ++crashed;
            qInfo("without line %zu it crashes: %s", i + 1, lines_[i].c_str());
        }
        qInfo("%d files: %d read, %d crashed", tried, read, crashed);
        QCOMPARE(crashed, 0);
    }

    void numbersThatAreNone() {
        for (const char* number : {"1e999", "-1e300", "1e30", "nan"}) {
            std::vector<std::string> lines = lines_;
            for (std::string& line : lines) {
                if (!line.starts_with("#") || line.find("CARTESIAN_POINT") == std::string::npos) continue;
                const std::size_t from = line.rfind('(') + 1;
                const std::size_t to = line.find_first_of(",)", from);
                line.replace(from, to - from, number);
                break;
            }
            QVERIFY(write(lines).ok());
            QVERIFY2(readApart(path_) != Ending::crashed, number);
        }
    }

 private:
    base::Status write(const std::vector<std::string>& lines) {
        std::string text;
        for (const std::string& line : lines)
            text += line + "\n";
        return base::writeFile(path_, text);
    }

    QTemporaryDir folder_;
    std::filesystem::path path_;
    std::vector<std::string> lines_;
};

QTEST_APPLESS_MAIN(CadDamageTest)
#include "cad_damage_test.moc"
