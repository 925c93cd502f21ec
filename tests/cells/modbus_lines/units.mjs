// Slaves of npm's modbus-serial on one serial line: node units.mjs DEVICE UNIT... Input register 0 is 100 times the unit,
// input register 1 repeats the unit's holding register 0. A line "silence UNIT" on standard input switches a unit off,
// "speak UNIT" on. It says 'ready' when it listens. Packages come from the folder of NODE_PATH.

import { createRequire } from 'node:module';
import path from 'node:path';
import readline from 'node:readline';

const require = createRequire(path.join(process.env.NODE_PATH, 'packages.js'));
const ModbusRTU = require('modbus-serial');
const [device, ...names] = process.argv.slice(2);
const units = new Map(names.map((name) => [Number(name), { setpoint: 0, silent: false }]));

function answer(unit, value) {
  const known = units.get(unit);
  return known && !known.silent ? value(known) : new Promise(() => {});
}

const vector = {
  getInputRegister: (address, unit) => answer(unit, (known) => (address === 0 ? 100 * unit : known.setpoint)),
  getHoldingRegister: (address, unit) => answer(unit, (known) => known.setpoint),
  setRegister: (address, value, unit) => answer(unit, (known) => { known.setpoint = value; }),
};
const server = new ModbusRTU.ServerSerial(vector, { path: device, baudRate: 19200, parity: 'none', stopBits: 1, unitID: 255,
  openCallback: () => console.log('ready') });
server.on('error', (error) => console.log(error.message));
server.on('socketError', () => {});
readline.createInterface({ input: process.stdin }).on('line', (line) => {
  const [word, unit] = line.split(' ');
  units.get(Number(unit)).silent = word === 'silence';
  console.log(line);
});
