#include "ui/feeder/connection_card.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include "core/drive/profile_folder.h"
#include "ui/feeder/drive_link.h"

namespace trapwright::feeder {

using drive::Protocol;

namespace {

constexpr auto kProfileSetting = "feeder/profile";
constexpr int kMostPort = 65535;
constexpr int kMostUnit = 247;

QString fromText(const std::string& text) {
    return QString::fromStdString(text);
}

QString settingOf(const drive::Profile& profile, const char* what) {
    return QString("feeder/%1/%2").arg(fromText(profile.name), what);
}

}  // namespace

ConnectionCard::ConnectionCard(DriveLink& link, QWidget* parent)
    : QWidget(parent),
      link_(link),
      list_(new QComboBox(this)),
      about_(new QLabel(this)),
      place_(new QWidget(this)),
      form_(new QFormLayout(place_)),
      host_(new QLineEdit(place_)),
      port_(new QSpinBox(place_)),
      line_(new QLineEdit(place_)),
      unit_(new QSpinBox(place_)),
      button_(new QPushButton(this)) {
    list_->setObjectName("feeder.profile");
    list_->setAccessibleName(tr("Drive"));
    list_->setToolTip(tr("Which drive, or which output module in front of it"));
    list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    about_->setObjectName("feeder.profile.about");
    about_->setWordWrap(true);
    about_->setForegroundRole(QPalette::PlaceholderText);
    host_->setObjectName("feeder.host");
    host_->setPlaceholderText("192.168.1.20");
    port_->setObjectName("feeder.port");
    port_->setRange(1, kMostPort);
    line_->setObjectName("feeder.line");
    line_->setPlaceholderText("/dev/ttyUSB0");
    unit_->setObjectName("feeder.unit");
    unit_->setRange(0, kMostUnit);
    form_->setContentsMargins(0, 0, 0, 0);
    form_->addRow(tr("Address"), host_);
    form_->addRow(tr("Port"), port_);
    form_->addRow(tr("Serial port"), line_);
    form_->addRow(tr("Modbus unit"), unit_);
    button_->setObjectName("feeder.connect");

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(list_);
    column->addWidget(about_);
    column->addWidget(place_);
    column->addWidget(button_);
    connect(list_, &QComboBox::currentIndexChanged, this, &ConnectionCard::showProfile);
    connect(button_, &QPushButton::clicked, this, &ConnectionCard::toggle);
    connect(&link_, &DriveLink::linkChanged, this, &ConnectionCard::showLink);
    showProfile();
    showLink();
}

void ConnectionCard::readProfiles() {
    if (link_.linked()) return;
    drive::ProfileFolder found = drive::readAllProfiles(link_.access().ownProfiles);
    for (const std::string& problem : found.problems)
        emit failed(tr("A drive profile cannot be used"), fromText(problem));
    if (found.profiles == profiles_) return;
    profiles_ = std::move(found.profiles);
    const QString wanted = QSettings().value(kProfileSetting, "virtual-modbus").toString();
    {
        const QSignalBlocker blocker(list_);
        list_->clear();
        for (const drive::Profile& profile : profiles_) {
            list_->addItem(fromText(profile.title), fromText(profile.name));
            if (fromText(profile.name) == wanted) list_->setCurrentIndex(list_->count() - 1);
        }
    }
    showProfile();
}

const drive::Profile* ConnectionCard::chosen() const {
    const auto index = static_cast<std::size_t>(list_->currentIndex());
    return index < profiles_.size() ? &profiles_[index] : nullptr;
}

drive::Address ConnectionCard::address() const {
    drive::Address address;
    address.host = host_->text().trimmed().toStdString();
    address.port = port_->value();
    address.line = line_->text().trimmed().toStdString();
    address.unit = unit_->value();
    return address;
}

void ConnectionCard::showProfile() {
    const drive::Profile* profile = chosen();
    button_->setEnabled(profile != nullptr);
    place_->setVisible(profile != nullptr && !profile->isVirtual);
    if (profile == nullptr) return about_->setText(tr("There is no drive profile."));
    const QString checked = tr("Checked against: %1.").arg(fromText(profile->checkedAgainst));
    const QString about = profile->wiring.empty() ? checked : fromText(profile->wiring) + ' ' + checked;
    const QString warning =
        profile->watchdog ? QString()
                          : "<br><b>" +
                                tr("Nothing in this drive is known to stop it when the program or the cable "
                                   "fails. Set up its own watchdog, and keep a switch at hand.") +
                                "</b>";
    about_->setText(about.toHtmlEscaped() + warning);

    const bool tcp = profile->protocol == Protocol::modbusTcp;
    form_->setRowVisible(host_, tcp);
    form_->setRowVisible(port_, tcp);
    form_->setRowVisible(line_, !tcp);
    form_->setRowVisible(unit_, profile->protocol != Protocol::reo);
    const QSettings settings;
    host_->setText(settings.value(settingOf(*profile, "host")).toString());
    port_->setValue(settings.value(settingOf(*profile, "port"), profile->modbus.port).toInt());
    line_->setText(settings.value(settingOf(*profile, "line")).toString());
    unit_->setValue(settings.value(settingOf(*profile, "unit"), profile->modbus.unit).toInt());
}

void ConnectionCard::showLink() {
    const bool linked = link_.linked();
    list_->setEnabled(!linked);
    place_->setEnabled(!linked);
    button_->setEnabled(!link_.leaving());
    button_->setText(link_.leaving() ? tr("Disconnecting...") : linked ? tr("Disconnect") : tr("Connect"));
    button_->setToolTip(linked ? tr("Lets the drive rest, switches it off and ends the connection")
                               : tr("Reaches the drive; nothing moves"));
}

void ConnectionCard::toggle() {
    if (link_.linked()) return link_.leaveDrive();
    const drive::Profile* profile = chosen();
    if (profile == nullptr) return;
    remember();
    link_.connectDrive(*profile, address());
}

void ConnectionCard::remember() const {
    const drive::Profile& profile = *chosen();
    QSettings settings;
    settings.setValue(kProfileSetting, fromText(profile.name));
    if (profile.isVirtual) return;
    settings.setValue(settingOf(profile, "host"), host_->text().trimmed());
    settings.setValue(settingOf(profile, "port"), port_->value());
    settings.setValue(settingOf(profile, "line"), line_->text().trimmed());
    settings.setValue(settingOf(profile, "unit"), unit_->value());
}

}  // namespace trapwright::feeder
