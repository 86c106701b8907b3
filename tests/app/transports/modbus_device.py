"""A Modbus device by pymodbus, over TCP (argument "tcp") or RTU on a pseudo-terminal ("rtu").

Prints where it is reached. Then, for each line of its input:
  get TABLE ADDRESS COUNT        prints the values (tables by the function code that reads them: 1, 2, 3, 4)
  set TABLE ADDRESS VALUE...     writes them and prints "done"
"""

import asyncio
import logging
import os
import sys
import tty

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.factory import ServerDecoder
from pymodbus.server.async_io import ModbusTcpServer
from pymodbus.transaction import ModbusRtuFramer

UNIT = 1


def make_context():
    def block():
        return ModbusSequentialDataBlock(0, [0] * 64)

    slave = ModbusSlaveContext(di=block(), co=block(), hr=block(), ir=block(), zero_mode=True)
    return ModbusServerContext(slaves={UNIT: slave}, single=False)


def say(text):
    print(text, flush=True)


def obey(context, line):
    verb, table, address, *values = line.split()
    slave = context[UNIT]
    if verb == "get":
        say(" ".join(str(int(value)) for value in slave.getValues(int(table), int(address), int(values[0]))))
    else:
        slave.setValues(int(table), int(address), [int(value) for value in values])
        say("done")


def listen_to_input(context):
    line = sys.stdin.readline()
    if not line:
        os._exit(0)
    obey(context, line)


async def serve_tcp(context):
    server = ModbusTcpServer(context, address=("127.0.0.1", 0))
    task = asyncio.ensure_future(server.serve_forever())
    await server.serving
    say(server.server.sockets[0].getsockname()[1])
    await task


async def serve_rtu(context):
    master, slave = os.openpty()
    tty.setraw(slave)
    framer = ModbusRtuFramer(ServerDecoder(), client=None)

    def execute(request):
        response = request.execute(context[request.unit_id])
        response.unit_id = request.unit_id
        os.write(master, framer.buildPacket(response))

    def receive():
        framer.processIncomingPacket(os.read(master, 256), execute, [UNIT])

    asyncio.get_running_loop().add_reader(master, receive)
    say(os.ttyname(slave))
    await asyncio.Event().wait()


async def main():
    context = make_context()
    asyncio.get_running_loop().add_reader(sys.stdin.fileno(), listen_to_input, context)
    await (serve_rtu if sys.argv[1] == "rtu" else serve_tcp)(context)


# What the tests provoke is no news.
logging.disable(logging.CRITICAL)
asyncio.run(main())
