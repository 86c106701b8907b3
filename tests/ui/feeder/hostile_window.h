#pragma once

#include <QElapsedTimer>
#include <QLoggingCategory>
#include <QMessageBox>
#include <array>
#include <memory>
#include <random>
#include <string>

#include "tests/app/transports/hostile_sequence.h"
#include "tests/ui/feeder/operator.h"
#include "tests/ui/session/event_loop_probe.h"

namespace trapwright::feeder {

/// What came of a sequence in the window.
struct WindowOutcome {
    std::uint64_t seed = 0;
    QString deed;          // that ended the motion
    QString moods;         // of the peer, from the start on
    bool started = false;  // it moved before
    double rest = 0.0;     // [s] from the deed until the feeder rested
    bool rested = false;   // in time
    bool left = false;     // the deed was done in time: disconnected, closed, exchanged
    double end = 0.0;      // [s] from the deed until it was done
    double late = 0.0;     // the latest event of the window [ms], from the connecting on
};

/// The studio's window, whose virtual feeder is a hostile peer, and an operator who connects, starts, changes
/// the set-point and ends it in one of several ways. Its own event loop runs all the time.
class HostileWindow {
 public:
    /// `study`: two files of the same study, so that one can take the other's place.
    HostileWindow(const QString& link, std::array<QString, 2> studies, std::string folder)
        : profile_(tests::hostileProfile(link)), studies_(std::move(studies)), folder_(std::move(folder)) {
        environment_ = pages::nativeEnvironment();
        environment_.drives.makeDrive = transports::makeDrive;
        environment_.drives.serveFeeder = [this](const drive::Profile& profile) {
            peer_ = std::make_shared<tests::HostilePeer>(profile, ++served_, folder_);
            return session::ServedFeeder{peer_, peer_->address()};
        };
    }

    WindowOutcome run(std::uint64_t seed) {
        random_.seed(seed);
        outcome_ = {};
        outcome_.seed = seed;
        const auto deed = static_cast<Deed>(random_() % kDeeds.size());
        outcome_.deed = kDeeds[static_cast<std::size_t>(deed)];
        if (!open()) return outcome_;
        late_.start();
        if (start()) {
            beHostile();
            end(deed);
        }
        peer_->setMood(tests::Mood::honest);
        if (user_) link().leaveDrive();
        (void)QTest::qWaitFor([&] { return !user_ || !link().linked(); }, kPatience);
        outcome_.late = late_.stop();
        if (user_ && !user_->window.isVisible()) user_.reset();
        return outcome_;
    }

 private:
    enum class Deed { stop, escape, disconnect, closeStudy, exchangeStudy, closeWindow };
    static constexpr std::array<const char*, 6> kDeeds = {
        "stop", "Esc", "disconnect", "close the study", "next study", "close the window"};

    double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    void wait(double low, double high) { QTest::qWait(static_cast<int>(1e3 * draw(low, high))); }
    DriveLink& link() { return user_->window.findChild<ValidatePage*>()->link(); }

    bool open() {
        if (!user_) user_ = std::make_unique<tests::WindowUser>(environment_);
        if (user_->session() == nullptr && !user_->open(studies_[0].toStdString(), "validate")) return false;
        user_->window.showPage("validate");
        // What was told of the sequence before.
        if (auto* box = user_->find<QMessageBox>("dialog.farewell.warning")) box->close();
        return true;
    }

    bool start() {
        link().connectDrive(profile_, {});
        const auto isIn = [&](drive::State state) {
            return QTest::qWaitFor([&] { return link().snapshot().state == state; }, kConnecting);
        };
        if (!isIn(drive::State::idle)) return false;
        link().setTarget(draw(0.3, 0.9));
        QTest::mouseClick(user_->find<QPushButton>("feeder.start"), Qt::LeftButton);
        outcome_.started = QTest::qWaitFor([&] { return !peer_->isAtRest(); }, kConnecting);
        return outcome_.started;
    }

    void changeMood() {
        const auto mood =
            static_cast<tests::Mood>(random_() % (static_cast<unsigned>(tests::Mood::last) + 1));
        outcome_.moods += QString(" %1").arg(static_cast<int>(mood));
        peer_->setMood(mood);
    }

    void beHostile() {
        wait(0.0, 0.3);
        changeMood();
        wait(0.0, 0.4);
        user_->find<QDoubleSpinBox>("feeder.setPoint")->setValue(draw(20.0, 90.0));
        wait(0.0, 0.3);
    }

    void end(Deed deed) {
        const double stated = link().longestFarewell();
        begin(deed);
        QElapsedTimer clock;
        clock.start();
        const auto time = [&] { return 1e-3 * static_cast<double>(clock.elapsed()); };
        double moodAt = draw(0.1, 1.5);
        bool rests = false;
        bool done = false;
        const auto over = [&] {
            if (time() > moodAt && time() < 2.0) {
                changeMood();
                moodAt += draw(0.3, 1.5);
            }
            if (!rests && peer_->isAtRest()) {
                rests = true;
                outcome_.rest = time();
            }
            if (!done && isDone(deed)) {
                done = true;
                outcome_.end = time();
            }
            return rests && done;
        };
        const double limit = tests::HostileSequence::restTime(profile_);
        (void)QTest::qWaitFor(over, static_cast<int>(2e3 * limit));
        outcome_.rested = rests && outcome_.rest < limit;
        outcome_.left = done && outcome_.end < stated + kOpening;
    }

    void begin(Deed deed) {
        window::MainWindow& window = user_->window;
        const QString open = session_ = QString::fromStdString(user_->session()->path().string());
        switch (deed) {
            case Deed::stop:
                QTest::mouseClick(user_->find<QPushButton>("feeder.stop.button"), Qt::LeftButton);
                break;
            case Deed::escape:
                QTest::keyClick(&window, Qt::Key_Escape);
                break;
            case Deed::disconnect:
                QTest::mouseClick(user_->find<QPushButton>("feeder.connect"), Qt::LeftButton);
                break;
            case Deed::closeStudy:
                user_->action("file.close")->trigger();
                break;
            case Deed::exchangeStudy:
                window.openFile((open == studies_[0] ? studies_[1] : studies_[0]).toStdString());
                break;
            case Deed::closeWindow:
                window.close();
                // Who is impatient clicks again.
                if (random_() % 2 == 0) window.close();
                break;
        }
    }

    bool isDone(Deed deed) {
        switch (deed) {
            case Deed::stop:
            case Deed::escape:
                return true;
            case Deed::disconnect:
                return !link().linked();
            case Deed::closeStudy:
                return user_->session() == nullptr;
            case Deed::exchangeStudy:
                return QString::fromStdString(user_->session()->path().string()) != session_;
            case Deed::closeWindow:
                return !user_->window.isVisible();
        }
        return false;
    }

    static constexpr int kConnecting = 10000;  // [ms]
    static constexpr double kOpening = 3.0;    // [s] for the next study on a busy computer

    const drive::Profile profile_;
    const std::array<QString, 2> studies_;
    const std::string folder_;
    session::Environment environment_;
    std::uint64_t served_ = 0;
    std::mt19937_64 random_;
    std::shared_ptr<tests::HostilePeer> peer_;
    std::unique_ptr<tests::WindowUser> user_;
    session::LateEvents late_;
    QString session_;  // its file, when the deed began
    WindowOutcome outcome_;
};

/// Two files of a small study, in a folder that is the program's home as well.
class HostileStudies {
 public:
    explicit HostileStudies(const QString& program) {
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        qputenv("XDG_DATA_HOME", folder_.filePath("data").toLocal8Bit());
        QLoggingCategory::setFilterRules("qt.modbus*=false");
        QCoreApplication::setOrganizationName("Trapwright");
        QCoreApplication::setApplicationName(program);
        QSettings().setValue("tour/offered", true);
        QGuiApplication::setQuitOnLastWindowClosed(false);
        for (const QString& file : files()) {
            (void)session::StudySession::create(file.toStdString(), pages::lowHills(), session::cuboid(),
                                                pages::nativeEnvironment());
        }
    }
    [[nodiscard]] std::array<QString, 2> files() const {
        return {folder_.filePath("one.trap"), folder_.filePath("two.trap")};
    }
    [[nodiscard]] std::string folder() const { return folder_.path().toStdString(); }

 private:
    QTemporaryDir folder_;
};

}  // namespace trapwright::feeder
