// A line between a page and its server that can be cut: a TCP proxy. The names in the headers are the server's own.

import { connect, createServer } from 'node:net';

export async function cuttableLine(port) {
  const open = new Set();
  let whole = true;
  let own = 0;
  const toServer = (data) => {
    // Requests begin with their method; what a WebSocket sends is left alone.
    if (!/^(GET|POST|DELETE|PUT) /.test(data.toString('latin1', 0, 8))) return data;
    return Buffer.from(data.toString('latin1').replaceAll(`127.0.0.1:${own}`, `127.0.0.1:${port}`), 'latin1');
  };
  const server = createServer((page) => {
    if (!whole) return page.destroy();
    const far = connect(port, '127.0.0.1');
    const end = () => [page, far].forEach((one) => one.destroy());
    const both = { end };
    open.add(both);
    page.on('data', (data) => far.write(toServer(data)));
    far.on('data', (data) => page.write(data));
    for (const one of [page, far]) {
      one.setNoDelay(true);
      one.on('error', end);
      one.on('close', () => {
        end();
        open.delete(both);
      });
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  own = server.address().port;
  return {
    url: `http://127.0.0.1:${own}/`,
    cut: () => {
      whole = false;
      for (const both of open) both.end();
    },
    mend: () => (whole = true),
    end: () => {
      for (const both of open) both.end();
      server.close();
    },
  };
}
