// A Modbus device, as small as one can be: answers every read of input registers with the values that it is given.

import { createServer } from 'node:net';

const REQUEST_BYTES = 12;

// `register(address)`: the value of an input register, 0 to 65535; asked at each read. `port` 0: any that is free.
export async function startDevice(register = () => 0, port = 0) {
  const open = new Set();
  const server = createServer((socket) => {
    open.add(socket);
    socket.setNoDelay(true);
    socket.on('close', () => open.delete(socket));
    socket.on('error', () => {});
    let waiting = Buffer.alloc(0);
    socket.on('data', (data) => {
      waiting = Buffer.concat([waiting, data]);
      while (waiting.length >= REQUEST_BYTES) {
        socket.write(answerTo(waiting.subarray(0, REQUEST_BYTES), register));
        waiting = waiting.subarray(REQUEST_BYTES);
      }
    });
  });
  await new Promise((resolve) => server.listen(port, '127.0.0.1', resolve));
  return {
    port: server.address().port,
    stop: () => {
      server.close();
      for (const socket of open) socket.destroy();
    },
  };
}

// Frame of Modbus/TCP: transaction, protocol, length, unit, function; then how many bytes, and the registers.
function answerTo(request, register) {
  const first = request.readUInt16BE(8);
  const count = request.readUInt16BE(10);
  const answer = Buffer.alloc(9 + 2 * count);
  request.copy(answer, 0, 0, 8);
  answer.writeUInt16BE(3 + 2 * count, 4);
  answer.writeUInt8(2 * count, 8);
  for (let i = 0; i < count; ++i) answer.writeUInt16BE(register(first + i), 9 + 2 * i);
  return answer;
}
