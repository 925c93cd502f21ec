// A mail server and a web hook of the test's own, at this machine only: they keep what they are sent.

import { createServer } from 'node:http';
import { createServer as createSocketServer } from 'node:net';

const listen = (server) =>
  new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server.address().port)));

// SMTP without TLS (RFC 5321), as far as a client needs it that sends one mail a connection.
export async function startMailServer() {
  const mails = [];
  const server = createSocketServer((socket) => {
    let rest = '';
    let mail = null;
    const say = (line) => socket.write(`${line}\r\n`);
    const envelope = { from: '', to: [] };
    socket.on('error', () => {});
    socket.on('data', (bytes) => {
      rest += bytes.toString('utf8');
      for (let end = rest.indexOf('\r\n'); end >= 0; end = rest.indexOf('\r\n')) {
        const line = rest.slice(0, end);
        rest = rest.slice(end + 2);
        if (mail !== null) {
          if (line !== '.') {
            mail += `${line}\n`;
            continue;
          }
          mails.push({ from: envelope.from, to: envelope.to, text: mail });
          mail = null;
          say('250 kept');
        } else if (/^(EHLO|HELO)/i.test(line)) say('250 test');
        else if (/^MAIL FROM:/i.test(line)) {
          envelope.from = /<(.*)>/.exec(line)[1];
          envelope.to = [];
          say('250 ok');
        } else if (/^RCPT TO:/i.test(line)) {
          envelope.to.push(/<(.*)>/.exec(line)[1]);
          say('250 ok');
        } else if (/^DATA/i.test(line)) {
          mail = '';
          say('354 go on');
        } else if (/^QUIT/i.test(line)) {
          say('221 bye');
          socket.end();
        } else say('502 not here');
      }
    });
    say('220 test');
  });
  return { port: await listen(server), mails, end: () => server.close() };
}

export async function startWebHook() {
  const posts = [];
  const server = createServer((request, response) => {
    let body = '';
    request.on('data', (bytes) => (body += bytes));
    request.on('end', () => {
      posts.push({ method: request.method, type: request.headers['content-type'], secret: request.headers.authorization, body: JSON.parse(body) });
      response.writeHead(204).end();
    });
  });
  return { port: await listen(server), posts, end: () => server.close() };
}

// Takes connections and never says a word.
export async function startSilentServer() {
  const sockets = new Set();
  const server = createSocketServer((socket) => {
    socket.on('error', () => {});
    sockets.add(socket);
  });
  return {
    port: await listen(server),
    end: () => {
      for (const socket of sockets) socket.destroy();
      server.close();
    },
  };
}
