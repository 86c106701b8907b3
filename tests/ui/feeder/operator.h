#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

#include "app/transports/make_drive.h"
#include "app/transports/virtual_feeder.h"
#include "tests/ui/pages/review_user.h"
#include "ui/feeder/validate_page.h"
#include "ui/session/study_feeder.h"

namespace trapwright::feeder {

using pages::kPatience;

inline constexpr int kRest = 2500;  // [ms] in which a feeder must rest whatever happens

/// The virtual feeder that the window served last, over real Modbus TCP on the loopback.
struct Bench {
    std::shared_ptr<transports::VirtualFeeder> feeder;

    session::Environment environment() {
        session::Environment environment = pages::nativeEnvironment();
        environment.drives.makeDrive = transports::makeDrive;
        environment.drives.serveFeeder =
            [this](const drive::Profile& profile) -> base::Result<session::ServedFeeder> {
            auto served = transports::serveVirtualFeeder(profile);
            if (!served) return served.error();
            feeder = std::move(*served);
            return session::ServedFeeder{feeder, feeder->address()};
        };
        return environment;
    }
    [[nodiscard]] bool rests() const {
        return QTest::qWaitFor([&] { return feeder->isAtRest(); }, kRest);
    }
    [[nodiscard]] bool moves() const {
        return QTest::qWaitFor([&] { return !feeder->isAtRest(); }, kPatience);
    }
};

/// The window with a study in it, and what an operator does at the feeder.
struct Operator : tests::WindowUser {
    Bench& bench;

    Operator(Bench& at, const QString& study) : WindowUser(at.environment()), bench(at) {
        (void)open(study.toStdString(), "validate");
    }
    ValidatePage& page() { return *window.findChild<ValidatePage*>(); }
    TrialGuide& guide() { return page().guide(); }
    void click(const QString& button) { QTest::mouseClick(find<QAbstractButton>(button), Qt::LeftButton); }
    /// To whatever has the focus, as a keyboard does.
    void press(Qt::Key key) {
        QWidget* focus = QApplication::focusWidget();
        QTest::keyClick(focus != nullptr ? focus : &window, key);
    }
    bool reach() {
        click("feeder.connect");
        return QTest::qWaitFor([&] { return page().link().snapshot().state == drive::State::idle; },
                               kPatience);
    }
    void setSetPoint(double percent) { find<QDoubleSpinBox>("feeder.setPoint")->setValue(percent); }
    void plan(int repetitions, bool shuffled) {
        click("plan.new");
        find<QSpinBox>("plan.repetitions")->setValue(repetitions);
        find<QComboBox>("plan.order")->setCurrentIndex(shuffled ? 1 : 0);
        find<QLineEdit>("plan.operator")->setText("Grace Hopper");
        find<QLineEdit>("plan.note")->setText("PA12, as printed");
        click("plan.begin");
    }
    [[nodiscard]] const std::vector<study::PhysicalTrial>& trials() {
        return session()->feeder().physicalValidations().back().trials;
    }
};

}  // namespace trapwright::feeder
