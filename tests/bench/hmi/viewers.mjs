// Pages that only listen: WebSockets that read whatever the server sends, count its bytes and answer its pings. They cost the
// machine little, so that what is measured is the server and not fifty browsers.

import { randomBytes } from 'node:crypto';
import { connect } from 'node:net';

const PING = 0x9;
const PONG = Buffer.from([0x8a, 0x80, 0, 0, 0, 0]); // empty, masked with zeros

// Walks over frames (RFC 6455, 5.2) in whatever pieces they come; calls `onPing` for each ping.
function frameWalker(onPing) {
  let header = Buffer.alloc(0);
  let left = 0; // of the payload
  return (data) => {
    let at = 0;
    while (at < data.length) {
      if (left > 0) {
        const step = Math.min(left, data.length - at);
        left -= step;
        at += step;
        continue;
      }
      header = Buffer.concat([header, data.subarray(at, at + 1)]);
      ++at;
      if (header.length < 2) continue;
      const short = header[1] & 0x7f;
      const size = short === 126 ? 4 : short === 127 ? 10 : 2;
      if (header.length < size) continue;
      left = size === 2 ? short : size === 4 ? header.readUInt16BE(2) : Number(header.readBigUInt64BE(2));
      if ((header[0] & 0xf) === PING) onPing();
      header = Buffer.alloc(0);
    }
  };
}

// A text frame as a page sends it, masked with zeros. Shorter than 126 bytes.
function textFrame(text) {
  return Buffer.concat([Buffer.from([0x81, 0x80 | text.length, 0, 0, 0, 0]), Buffer.from(text)]);
}

// What a page says that shows all tags, or none of them.
const BEGIN = {
  all: '{"type":"begin","protocol":5,"show":{"number":1,"tags":"all","also":["plan","routes","trend"]}}',
  none: '{"type":"begin","protocol":5,"show":{"number":1,"also":["plan","routes","trend"]}}',
};

// `tags`: all, none, or "silent" of a server that wants to hear nothing (protocol 2).
// `from`: its own address.
function openViewer(port, tags, from) {
  return new Promise((resolve, reject) => {
    const socket = connect({ port, host: '127.0.0.1', localAddress: from });
    const viewer = { bytes: 0, closed: false, close: () => socket.destroy() };
    const request = [
      'GET /live HTTP/1.1',
      `Host: 127.0.0.1:${port}`,
      `Origin: http://127.0.0.1:${port}`,
      'Upgrade: websocket',
      'Connection: Upgrade',
      'Sec-WebSocket-Version: 13',
      `Sec-WebSocket-Key: ${randomBytes(16).toString('base64')}`,
      '\r\n',
    ].join('\r\n');
    const walk = frameWalker(() => socket.write(PONG));
    const read = (data) => {
      viewer.bytes += data.length;
      walk(data);
    };
    let welcome = Buffer.alloc(0);
    const greet = (data) => {
      welcome = Buffer.concat([welcome, data]);
      const end = welcome.indexOf('\r\n\r\n');
      if (end < 0) return;
      socket.off('data', greet);
      const [status] = welcome.toString('latin1').split('\r\n');
      if (!status.startsWith('HTTP/1.1 101')) return reject(new Error(`a viewer is refused: ${status}`));
      socket.on('data', read);
      if (tags !== 'silent') socket.write(textFrame(BEGIN[tags]));
      read(welcome.subarray(end + 4));
      resolve(viewer);
    };
    socket.on('data', greet);
    socket.on('connect', () => socket.write(request));
    socket.on('error', reject);
    socket.on('close', () => (viewer.closed = true));
  });
}

// Of so many displays that each has a few pages, as a server takes only some from one address.
const DISPLAYS = 20;

export async function openViewers(port, count, tags = 'all') {
  const viewers = [];
  for (let i = 0; i < count; ++i) viewers.push(await openViewer(port, tags, `127.0.0.${2 + (i % DISPLAYS)}`));
  const bytes = () => viewers.reduce((sum, viewer) => sum + viewer.bytes, 0);
  return {
    bytes,
    // A server that throws viewers out would look fast.
    check: () => {
      const gone = viewers.filter((viewer) => viewer.closed).length;
      if (gone > 0) throw new Error(`${gone} of ${count} viewers were thrown out`);
    },
    close: () => viewers.forEach((viewer) => viewer.close()),
  };
}
