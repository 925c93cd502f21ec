// What the page is compared with: pages that read the plant's value straight from this process, without a PLC between. One
// asks every half second, as the monitoring page of OpenPLC v3 does; one is told at once (server-sent events),
// and is the limit: nothing that paints in this browser on this machine is faster.

import { createServer } from 'node:http';

export const POLL_MS = 500;

const PAGE = '<!doctype html><title>value</title><p id="value">-</p><script src="/script.js"></script>';
const SCRIPTS = {
  polling: `setInterval(async () => { document.getElementById('value').textContent = await (await fetch('/value')).text(); }, ${POLL_MS});`,
  pushed: `new EventSource('/events').onmessage = (event) => { document.getElementById('value').textContent = event.data; };`,
};

// `kind`: polling or pushed.
export async function servePage(kind) {
  let value = 0;
  const streams = new Set();
  const types = { '/': 'text/html', '/script.js': 'text/javascript', '/value': 'text/plain' };
  const bodies = { '/': () => PAGE, '/script.js': () => SCRIPTS[kind], '/value': () => String(value) };
  const server = createServer((request, response) => {
    if (request.url === '/events') {
      response.writeHead(200, { 'content-type': 'text/event-stream' });
      response.flushHeaders();
      response.socket.setNoDelay(true);
      streams.add(response);
      response.on('close', () => streams.delete(response));
      return;
    }
    if (!(request.url in bodies)) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[request.url] }).end(bodies[request.url]());
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    set: (next) => {
      value = next;
      for (const stream of streams) stream.write(`data: ${next}\n\n`);
    },
    close: () => {
      for (const stream of streams) stream.end();
      server.close();
    },
  };
}
