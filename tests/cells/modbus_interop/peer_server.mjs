// Slaves of npm's jsmodbus and modbus-serial for our master:
//   node peer_server.mjs jsmodbus|modbus-serial tcp PORT | rtu DEVICE
// It says 'ready' when it listens. Packages come from the folder of NODE_PATH.

import { createRequire } from 'node:module';
import net from 'node:net';
import path from 'node:path';

const require = createRequire(path.join(process.env.NODE_PATH, 'packages.js'));
const COUNT = 200;
const [library, kind, where] = process.argv.slice(2);

// Nobody else opens the line; the lock of a pseudo terminal may still be held by who had its number before.
const ALONE = { lock: false };

function serial(device) {
  const { SerialPort } = require('serialport');
  return new SerialPort({ path: device, baudRate: 19200, parity: 'none', dataBits: 8, stopBits: 1, ...ALONE });
}

function ready() {
  console.log('ready');
}

function jsmodbus() {
  const modbus = require('jsmodbus');
  const tables = {
    coils: Buffer.alloc(COUNT / 8), discrete: Buffer.alloc(COUNT / 8), holding: Buffer.alloc(COUNT * 2), input: Buffer.alloc(COUNT * 2),
  };
  for (let i = 0; i < COUNT; i++) {
    if (i % 3 === 0) tables.discrete[i >> 3] |= 1 << (i & 7);
    tables.input.writeUInt16BE(3 * i + 7, 2 * i);
  }
  if (kind === 'tcp') {
    const server = new net.Server();
    new modbus.server.TCP(server, tables);
    server.listen(Number(where), '127.0.0.1', ready);
  } else {
    const port = serial(where);
    new modbus.server.RTU(port, tables);
    port.on('open', ready);
  }
}

function modbusSerial() {
  const ModbusRTU = require('modbus-serial');
  const coils = new Array(COUNT).fill(false);
  const holding = new Array(COUNT).fill(0);
  const within = (table, address) => {
    if (address >= COUNT) throw Object.assign(new Error('illegal address'), { modbusErrorCode: 2 });
    return table[address];
  };
  const vector = {
    getCoil: (address) => within(coils, address),
    getDiscreteInput: (address) => address % 3 === 0,
    getInputRegister: (address) => 3 * address + 7,
    getHoldingRegister: (address) => within(holding, address),
    setCoil: (address, value) => { coils[address] = value; },
    setRegister: (address, value) => { holding[address] = value; },
  };
  if (kind === 'tcp') {
    const server = new ModbusRTU.ServerTCP(vector, { host: '127.0.0.1', port: Number(where), unitID: 1 });
    server.on('initialized', ready);
  } else {
    const server = new ModbusRTU.ServerSerial(vector, { path: where, baudRate: 19200, parity: 'none', stopBits: 1, unitID: 1,
      openCallback: ready }, ALONE);
    server.on('socketError', () => {});
  }
}

(library === 'jsmodbus' ? jsmodbus : modbusSerial)();
