"""Drives the virtual feeder with a pymodbus client for some seconds, prints what it read, and ends without a word.

Arguments: port, set-point (raw), seconds.
"""

import os
import struct
import sys
import time

from pymodbus.client import ModbusTcpClient

port, set_point, seconds = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
client = ModbusTcpClient("127.0.0.1", port=port)
assert client.connect()
assert not client.write_register(0, set_point, slave=1).isError()
assert not client.write_register(1, 5000, slave=1).isError()
assert not client.write_coil(0, True, slave=1).isError()
end = time.monotonic() + seconds
while time.monotonic() < end:
    registers = client.read_input_registers(0, 6, slave=1).registers
    enabled = client.read_discrete_inputs(0, 1, slave=1).bits[0]
    time.sleep(0.1)
acceleration = struct.unpack(">f", struct.pack(">HH", registers[2], registers[3]))[0]
holding = client.read_holding_registers(0, 2, slave=1).registers
# An address that it has not: exception 2.
beyond = client.read_input_registers(60, 1, slave=1)
print(registers[0], registers[1], round(acceleration, 3), registers[4], registers[5], int(enabled), *holding,
      beyond.exception_code, flush=True)
os._exit(0)
