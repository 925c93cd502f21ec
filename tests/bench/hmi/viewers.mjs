// Pages that only listen: WebSockets that read whatever the server sends and count its bytes. They cost the machine little,
// so that what is measured is the server and not fifty browsers.

import { randomBytes } from 'node:crypto';
import { connect } from 'node:net';

function openViewer(port) {
  return new Promise((resolve, reject) => {
    const socket = connect(port, '127.0.0.1');
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
    let welcome = '';
    const read = (data) => (viewer.bytes += data.length);
    const greet = (data) => {
      welcome += data.toString('latin1');
      if (!welcome.includes('\r\n\r\n')) return;
      socket.off('data', greet);
      if (!welcome.startsWith('HTTP/1.1 101')) return reject(new Error(`a viewer is refused: ${welcome.split('\r\n')[0]}`));
      socket.on('data', read);
      resolve(viewer);
    };
    socket.on('data', greet);
    socket.on('connect', () => socket.write(request));
    socket.on('error', reject);
    socket.on('close', () => (viewer.closed = true));
  });
}

export async function openViewers(port, count) {
  const viewers = [];
  for (let i = 0; i < count; ++i) viewers.push(await openViewer(port));
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
