// Clients of npm's jsmodbus and modbus-serial against a slave with the tables of this folder:
//   node peer_client.mjs jsmodbus|modbus-serial tcp PORT | rtu DEVICE
// Prints a JSON object: for each function code "ok", or what else it came to. Packages come from the folder of NODE_PATH.

import { createRequire } from 'node:module';
import net from 'node:net';
import path from 'node:path';
import { isDeepStrictEqual as same } from 'node:util';

const require = createRequire(path.join(process.env.NODE_PATH, 'packages.js'));
const [library, kind, where] = process.argv.slice(2);
const PATTERN = [true, false, true, true, false, false, false, true, true, true];
const WORDS = [0x1234, 0xffff, 0, 0x8001];
const found = {};

// What a function came to: `values` of its answer, or the exception that the slave gave.
async function tell(name, promise, expected) {
  try {
    const values = await promise;
    found[name] = expected === undefined || same(values, expected) ? 'ok' : `wrong: ${JSON.stringify(values)}`;
  } catch (error) {
    const code = error.modbusCode ?? error.response?.body?.code;
    found[name] = code === undefined ? String(error.message ?? error.err ?? error) : `exception ${code}`;
  }
}

const range = (first, count, value) => Array.from({ length: count }, (_, i) => value(first + i));
const discrete = (i) => i % 3 === 0;
const input = (i) => 3 * i + 7;

async function all(client) {
  await tell('FC15', client.writeCoils(3, PATTERN));
  await tell('FC5', client.writeCoil(14, true));
  await tell('FC1', client.coils(0, 15), [false, false, false, ...PATTERN, false, true]);
  await tell('FC2', client.discrete(1, 19), range(1, 19, discrete));
  await tell('FC16', client.writeRegisters(10, WORDS));
  await tell('FC6', client.writeRegister(14, 0xabcd));
  await tell('FC3', client.holding(10, 5), [...WORDS, 0xabcd]);
  await tell('FC4', client.input(20, 10), range(20, 10, input));
  if (client.mask) {
    await tell('FC22', client.mask(10, 0xff00, 0x0055));
    await tell('FC22-value', client.holding(10, 1), [0x1255]);
  }
  if (client.readWrite) await tell('FC23', client.readWrite(29, 3, 30, WORDS), [0x1234, 0xffff]);
  await tell('FC43', client.vendor(), 'Stepwright');
  await tell('beyond', client.holding(60000, 2));
  // The first two words of the slave's image are its discrete inputs.
  await tell('most', client.input(0, 125).then((words) => words.slice(2)), range(2, 123, input));
}

function serial(device) {
  const { SerialPort } = require('serialport');
  return new SerialPort({ path: device, baudRate: 19200, parity: 'none', dataBits: 8, stopBits: 1 });
}

async function jsmodbus() {
  const modbus = require('jsmodbus');
  const socket = kind === 'tcp' ? net.connect(Number(where), '127.0.0.1') : serial(where);
  const client = kind === 'tcp' ? new modbus.client.TCP(socket, 1) : new modbus.client.RTU(socket, 1);
  await new Promise((resolve) => socket.on(kind === 'tcp' ? 'connect' : 'open', resolve));
  const bits = (count) => (done) => done.response.body.valuesAsArray.slice(0, count).map(Boolean);
  const words = (done) => [...done.response.body.valuesAsArray];
  await all({
    writeCoils: (at, values) => client.writeMultipleCoils(at, values),
    writeCoil: (at, value) => client.writeSingleCoil(at, value),
    coils: (at, count) => client.readCoils(at, count).then(bits(count)),
    discrete: (at, count) => client.readDiscreteInputs(at, count).then(bits(count)),
    writeRegisters: (at, values) => client.writeMultipleRegisters(at, values),
    writeRegister: (at, value) => client.writeSingleRegister(at, value),
    holding: (at, count) => client.readHoldingRegisters(at, count).then(words),
    input: (at, count) => client.readInputRegisters(at, count).then(words),
    vendor: () => client.readDeviceIdentification(1, 0).then((done) => String(done.response.body.objects[0].value)),
  });
  kind === 'tcp' ? socket.end() : socket.close();
}

async function modbusSerial() {
  const ModbusRTU = require('modbus-serial');
  const client = new ModbusRTU();
  if (kind === 'tcp') await client.connectTCP('127.0.0.1', { port: Number(where) });
  else await client.connectRTUBuffered(where, { baudRate: 19200, parity: 'none', stopBits: 1 });
  client.setID(1);
  client.setTimeout(20_000);
  const data = (count) => (done) => done.data.slice(0, count);
  // It has no method for FC 23 that promises.
  const readWrite = (readAt, count, writeAt, values) => new Promise((resolve, reject) => {
    client.writeFC23(1, readAt, count, writeAt, values.length, values, (error, done) => (error ? reject(error) : resolve(done.data.slice(1))));
  });
  await all({
    writeCoils: (at, values) => client.writeCoils(at, values),
    writeCoil: (at, value) => client.writeCoil(at, value),
    coils: (at, count) => client.readCoils(at, count).then(data(count)),
    discrete: (at, count) => client.readDiscreteInputs(at, count).then(data(count)),
    writeRegisters: (at, values) => client.writeRegisters(at, values),
    writeRegister: (at, value) => client.writeRegister(at, value),
    holding: (at, count) => client.readHoldingRegisters(at, count).then(data(count)),
    input: (at, count) => client.readInputRegisters(at, count).then(data(count)),
    // Over a serial line it does not know how long the answers of FC 22 and 23 are.
    mask: kind === 'tcp' && ((at, and, or) => client.maskWriteRegister(at, and, or)),
    readWrite: kind === 'tcp' && readWrite,
    vendor: () => client.readDeviceIdentification(1, 0).then((done) => String(done.data[0])),
  });
  await new Promise((resolve) => client.close(resolve));
}

await (library === 'jsmodbus' ? jsmodbus() : modbusSerial());
console.log(JSON.stringify(found));
process.exit(0);
