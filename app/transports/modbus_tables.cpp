#include "app/transports/modbus_tables.h"

#include <QModbusDataUnit>

namespace trapwright::transports {

int registerType(drive::Table table) {
    switch (table) {
        case drive::Table::coil:
            return QModbusDataUnit::Coils;
        case drive::Table::discreteInput:
            return QModbusDataUnit::DiscreteInputs;
        case drive::Table::inputRegister:
            return QModbusDataUnit::InputRegisters;
        case drive::Table::holdingRegister:
            return QModbusDataUnit::HoldingRegisters;
    }
    return QModbusDataUnit::Invalid;
}

}  // namespace trapwright::transports
