#include <fmt/format.h>

#include <limits>

#include "core/base/json_object.h"
#include "core/base/math.h"
#include "core/drive/profile.h"
#include "core/drive/profile_fields.h"

namespace trapwright::drive {

using base::Json;
using base::JsonObject;

namespace {

constexpr double kAny = std::numeric_limits<double>::max();
constexpr unsigned kWord = 0xFFFF;

enum class Use { read, write, both };

/// A place: its table is the key, its address from 0 the value.
Place readPlace(JsonObject& object, Use use) {
    Place place;
    int found = 0;
    for (const auto& [table, name] : fields::kTables) {
        const std::string key(name);
        if (object.take(key.c_str()) == nullptr) continue;
        ++found;
        place.table = table;
        object.whole(key.c_str(), place.address, 0, kWord);
        if (use != Use::read && (table == Table::discreteInput || table == Table::inputRegister)) {
            object.fail(key.c_str(), "this can only be read; write to a coil or to a holdingRegister");
        }
    }
    if (found != 1) {
        object.problem().tell(
            object.pathOf("holdingRegister"),
            "name one place: coil, discreteInput, inputRegister or holdingRegister, with its "
            "address from 0 on (a manual's 40011 is holdingRegister 10)");
    }
    const bool isBit = place.table == Table::coil || place.table == Table::discreteInput;
    place.type = isBit ? DataType::bit : DataType::uint16;
    object.choice("type", place.type, fields::kTypes);
    if (isBit != (place.type == DataType::bit)) {
        object.fail("type", "coils and discrete inputs are of type \"bit\", and registers are not");
    }
    object.flag("lowWordFirst", place.lowWordFirst);
    if (place.address + place.count() - 1 > static_cast<int>(kWord)) {
        object.fail("type", "the last address of a table is 65535");
    }
    return place;
}

void readQuantity(JsonObject& parent, const char* key, std::optional<Quantity>& value, Use use) {
    const Json* json = parent.take(key);
    if (json == nullptr) return;
    JsonObject object(*json, parent.pathOf(key), parent.problem());
    Quantity quantity;
    quantity.place = readPlace(object, use);
    object.number("zero", quantity.zero, -kAny, kAny);
    object.number("one", quantity.one, -kAny, kAny);
    if (quantity.zero == quantity.one) {
        object.fail("one",
                    "this must not be as \"zero\"; give the raw number that stands for 1 of the unit "
                    "(100 %, 1 Hz, 1 m/s^2)");
    }
    object.close();
    value = quantity;
}

void readSwitch(JsonObject& parent, const char* key, std::optional<Switch>& value, Use use) {
    const Json* json = parent.take(key);
    if (json == nullptr) return;
    JsonObject object(*json, parent.pathOf(key), parent.problem());
    Switch read;
    read.place = readPlace(object, use);
    object.whole("on", read.on, 0, kWord);
    object.whole("off", read.off, 0, kWord);
    object.whole("mask", read.mask, 1, kWord);
    if ((read.on & read.mask) == (read.off & read.mask)) {
        object.fail("on", "this must not be as \"off\" under the mask");
    }
    object.close();
    value = read;
}

FaultCode readCode(JsonObject& object, FaultCode code) {
    object.whole("mask", code.mask, 1, kWord);
    object.whole("good", code.good, 0, kWord);
    const Json* meanings = object.take("meanings");
    if (meanings == nullptr) return code;
    if (!meanings->is_object()) {
        object.fail("meanings", "write { \"0x57\": \"what it means\", ... }");
        return code;
    }
    for (const auto& [key, meaning] : meanings->items()) {
        const auto number = base::toWhole(Json(key));
        if (!number || !meaning.is_string()) {
            object.problem().tell(object.pathOf("meanings." + key),
                                  "write the code as \"0x57\" and its meaning as a text");
            continue;
        }
        code.meanings[*number] = meaning.get<std::string>();
    }
    return code;
}

void readFault(JsonObject& parent, std::optional<FaultPlace>& value) {
    const Json* json = parent.take("fault");
    if (json == nullptr) return;
    JsonObject object(*json, parent.pathOf("fault"), parent.problem());
    FaultPlace fault;
    fault.place = readPlace(object, Use::read);
    fault.code = readCode(object, {});
    object.close();
    value = fault;
}

void readWrites(JsonObject& parent, const char* key, std::vector<Write>& values) {
    const Json* json = parent.take(key);
    if (json == nullptr) return;
    if (!json->is_array()) return parent.fail(key, "this is no list; write [ { ... }, { ... } ]");
    for (const Json& item : *json) {
        JsonObject object(item, fmt::format("{}[{}]", parent.pathOf(key), values.size()), parent.problem());
        Write write;
        write.place = readPlace(object, Use::write);
        if (!object.has("value")) object.need("value");
        if (const Json* value = object.take("value"); value != nullptr && value->is_string()) {
            unsigned whole = 0;
            object.whole("value", whole, 0, kWord);
            write.value = whole;
        } else {
            object.number("value", write.value, -kAny, kAny);
        }
        object.flag("mayFail", write.mayFail);
        object.close();
        values.push_back(write);
    }
}

void readModbus(JsonObject& parent, ModbusMap& map) {
    const Json* json = parent.take("modbus");
    if (json == nullptr) return parent.need("modbus");
    JsonObject object(*json, "modbus", parent.problem());
    object.whole("unit", map.unit, 0, 255);
    object.whole("port", map.port, 1, static_cast<int>(kWord));
    object.whole("baud", map.baud, 300, 921600);
    object.choice("parity", map.parity, fields::kParities);
    object.whole("stopBits", map.stopBits, 1, 2);
    readQuantity(object, "setPoint", map.setPoint, Use::write);
    readQuantity(object, "setPointReadBack", map.setPointReadBack, Use::read);
    readQuantity(object, "frequency", map.frequency, Use::write);
    readQuantity(object, "frequencyReadBack", map.frequencyReadBack, Use::read);
    readSwitch(object, "enable", map.enable, Use::write);
    readSwitch(object, "enableReadBack", map.enableReadBack, Use::read);
    readFault(object, map.fault);
    readQuantity(object, "acceleration", map.acceleration, Use::read);
    readQuantity(object, "current", map.current, Use::read);
    readWrites(object, "atConnect", map.atConnect);
    readWrites(object, "atHeartbeat", map.atHeartbeat);
    readWrites(object, "whileEnabled", map.whileEnabled);
    readWrites(object, "atDisconnect", map.atDisconnect);
    if (!map.setPoint && !map.enable && map.whileEnabled.empty()) {
        object.fail("setPoint", "nothing here moves a drive; add setPoint, enable or whileEnabled");
    }
    object.close();
}

void readReo(JsonObject& parent, ReoMap& map) {
    const Json* json = parent.take("reo");
    if (json == nullptr) return;
    JsonObject object(*json, "reo", parent.problem());
    object.whole("baud", map.baud, 300, 921600);
    object.whole("enable", map.enable, 1, kWord);
    object.whole("enabled", map.enabled, 0, kWord);
    object.number("fullAcceleration", map.fullAcceleration, 1e-3, 1e5);
    if (const Json* status = object.take("status"); status != nullptr) {
        JsonObject code(*status, "reo.status", parent.problem());
        map.code = readCode(code, map.code);
        code.close();
    }
    object.close();
}

void readProtocol(JsonObject& object, Profile& profile) {
    object.choice("protocol", profile.protocol, fields::kProtocols, true);
    if (profile.protocol == Protocol::reo) {
        readReo(object, profile.reo);
    } else {
        readModbus(object, profile.modbus);
    }
}

Profile readAll(const Json& json, base::JsonProblem& problem) {
    Profile profile;
    JsonObject object(json, "", problem);
    std::string format;
    object.text("format", format, true);
    if (format != fields::kFormat) object.fail("format", fmt::format("this must be \"{}\"", fields::kFormat));
    int version = 0;
    object.whole("version", version, 0, static_cast<int>(kWord));
    if (version != fields::kVersion) {
        object.fail("version",
                    fmt::format("this must be {}, the only one that this program knows", fields::kVersion));
    }
    object.text("name", profile.name, true);
    object.text("title", profile.title, true);
    object.text("maker", profile.maker);
    object.text("checkedAgainst", profile.checkedAgainst, true);
    object.texts("sources", profile.sources);
    object.text("wiring", profile.wiring);
    object.flag("virtual", profile.isVirtual);
    readProtocol(object, profile);
    object.number("timeOut_s", profile.timeOut, 0.05, 2.0);
    object.number("heartbeat_Hz", profile.heartbeat, 2.0, 20.0);
    object.number("watchdog_s", profile.watchdog, 0.1, 60.0);
    object.number("settlingTime_s", profile.settlingTime, 0.0, 10.0);
    object.number("tolerance_percent", profile.tolerance, 0.0, 100.0, 0.01);
    object.number("restAcceleration", profile.restAcceleration, 0.0, 1e4);
    object.number("fullHalfStroke_mm", profile.fullHalfStroke, 1e-3, 50.0, base::kMillimetre);
    object.number("frequency_Hz", profile.frequency, 1.0, 1000.0);
    object.close();
    if (profile.watchdog && 1.0 / profile.heartbeat + profile.timeOut > *profile.watchdog) {
        object.fail("watchdog_s",
                    "heartbeat and time-out together are longer: the drive would stop again and again");
    }
    return profile;
}

}  // namespace

base::Result<Profile> readProfile(std::string_view json) {
    const auto read = base::parseJson(json);
    if (!read) return read.error();
    base::JsonProblem problem;
    const Profile profile = readAll(*read, problem);
    if (!problem.text.empty()) return base::Error{problem.text};
    return profile;
}

}  // namespace trapwright::drive
