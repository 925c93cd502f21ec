// A page whose connection is cut for some seconds: what it missed comes afterwards and nothing else, the trend has no hole, values
// are right. And: what it is told of the program's variables is what it shows of them. Against the real server over a scripted bench.

import { cuttableLine } from './cut_line.mjs';
import { check, endInTime, launchBrowser, openPage, options, pictures, startServer, until, waitFor } from './support.mjs';

const SPEED = 2;
const CUT_MS = 6_000; // the page gives up after 3 s without a word

endInTime();
const given = options();

// Everything that page and server say to each other, one list for each connection.
function listenTo(page, lines) {
  page.on('websocket', (socket) => {
    const line = { sent: [], received: [] };
    lines.push(line);
    socket.on('framesent', ({ payload }) => line.sent.push(JSON.parse(payload)));
    socket.on('framereceived', ({ payload }) => line.received.push(JSON.parse(payload)));
  });
}

const ofType = (line, type) => line.received.filter((message) => message.type === type);
const rowsOf = (line) => ofType(line, 'trend').flatMap(({ rows }) => rows);
const tagsIn = (messages) => new Set(messages.flatMap(({ tags }) => Object.keys(tags ?? {})).map(Number));
const wantedBy = ({ show = null, tags = show.tags }) => tags.flatMap(([first, count]) => Array.from({ length: count }, (_, i) => first + i));
const isLive = (page, what) => waitFor(page, what, () =>
  document.querySelector('[data-testid=link]')?.innerText === 'live' && document.querySelector('[data-testid=banner]') === null);

async function asksForWhatItShows(page, lines) {
  await waitFor(page, 'the table has values', () =>
    [...document.querySelectorAll('[data-panel=tags] tbody tr')].slice(0, 4).every((row) => /TRUE|FALSE|\d/.test(row.cells[3].innerText)) &&
    document.querySelectorAll('[data-panel=tags] tbody tr').length > 4);
  const [line] = lines;
  check(line.sent[0].type === 'begin' && line.sent[0].has === undefined, 'a new page begins with nothing');
  await until('it says which variables it shows', () => line.sent.some(({ type, tags }) => type === 'show' && tags.length > 0));
  const newest = line.sent.at(-1);
  const wanted = wantedBy(newest);
  const [{ tags }] = ofType(line, 'program');
  check(wanted.length > 0 && wanted.length < tags.length, `which are not all (${wanted.length} of ${tags.length})`);
  const asked = new Set(line.sent.flatMap((message) => wantedBy(message)));
  const told = tagsIn([...ofType(line, 'state'), ...ofType(line, 'delta')]);
  const others = [...told].filter((index) => !asked.has(index));
  check(others.length === 0, `and is told of no others (${others.join()})`);
  await page.locator('[data-panel=tags]').getByRole('button', { name: 'All' }).click();
  const last = page.locator('[data-panel=tags] tbody tr').last();
  await last.scrollIntoViewIfNeeded();
  await waitFor(page, 'what is scrolled to has its value soon', () =>
    /TRUE|FALSE|\d/.test([...document.querySelectorAll('[data-panel=tags] tbody tr')].at(-1).cells[3].innerText));
}

async function comesBackWithoutAHole(page, lines, line, shot) {
  const note = () => page.locator('[data-panel=trend] .note').innerText();
  const since = await note();
  check(since.startsWith('recorded since'), `the trend is there (${since})`);
  const before = lines.at(-1);
  const connections = lines.length;
  line.cut();
  await waitFor(page, 'the page says that it has lost its server', () =>
    document.querySelector('[data-testid=banner]')?.innerText.includes('No connection'));
  await page.waitForTimeout(CUT_MS);
  line.mend();
  await isLive(page, 'it comes back by itself');
  await until('with news', () => lines.length > connections && ofType(lines.at(-1), 'trend').length > 1);
  const after = lines.at(-1);
  const [begin] = after.sent;
  check(begin.type === 'begin' && begin.epoch === before.received[0].epoch, 'it says from which server it knows what it has');
  check(begin.has.tags === true && begin.has.seq === before.received.filter(({ seq }) => seq).at(-1).seq, 'and how far that goes');
  check(after.received[0].epoch === begin.epoch, 'the server is the same');
  for (const type of ['program', 'state', 'plan']) {
    const newer = type === 'plan' && ofType(after, 'plan').every(({ revision }) => revision > begin.has.plan);
    check(newer || ofType(after, type).length === 0, `no ${type} comes again`);
  }
  const delta = ofType(after, 'delta')[0];
  check(delta.show === undefined && delta.scan !== undefined, 'one delta has what has changed');
  const first = ofType(after, 'trend')[0];
  const end = ofType(before, 'trend').at(-1);
  check(!first.restart && first.run === end.run && first.first === end.first + end.rows.length, 'the trend goes on with the row behind the newest');
  const times = [...rowsOf(before), ...rowsOf(after)].map(([time]) => time);
  const widest = Math.max(...times.slice(1).map((time, i) => time - times[i]));
  const missed = (CUT_MS / 1_000) * SPEED;
  check(widest < missed / 3, `it has no hole: at most ${widest.toFixed(2)} s between two rows, and ${missed} s were cut out`);
  check((await note()) === since, 'and begins where it began');
  await shot(page, 'gap-after');
}

// What the page shows of its variables, by name.
const shownTags = (page) =>
  page.evaluate(() => Object.fromEntries([...document.querySelectorAll('[data-panel=tags] tbody tr')].map((row) => [row.cells[0].firstChild.textContent.trim(), row.cells[3].innerText])));

async function showsTheSameAsANewPage(page, server) {
  server.tell('runtime off'); // from now on nothing changes
  await waitFor(page, 'the plant stands', () => document.querySelector('[data-testid=banner]')?.innerText.includes('runtime does not answer'));
  const { page: fresh } = await openPage(page.context(), server.url);
  await waitFor(fresh, 'another page sees it, too', () => document.querySelector('[data-testid=banner]')?.innerText.includes('runtime does not answer'));
  await fresh.locator('[data-panel=tags]').getByRole('button', { name: 'All' }).click();
  for (const one of [page, fresh]) await one.locator('[data-panel=tags] tbody tr').first().scrollIntoViewIfNeeded();
  const known = (tags) => Object.entries(tags).filter(([, value]) => value !== '–');
  await until('both show the same values', async () => {
    const [old, anew] = [await shownTags(page), await shownTags(fresh)];
    const common = known(old).filter(([name]) => anew[name] !== '–');
    return common.length > 5 && common.every(([name, value]) => anew[name] === value);
  });
  await fresh.close();
}

const server = await startServer(given.server, 0, SPEED, 24);
const line = await cuttableLine(server.port);
const browser = await launchBrowser(given);
const shot = pictures(given, '', { fullPage: true });
try {
  const lines = [];
  browser.context.once('page', (page) => listenTo(page, lines));
  const { page, problems } = await openPage(browser.context, line.url);
  await isLive(page, 'the page is live');
  server.tell('run');
  await asksForWhatItShows(page, lines);
  await comesBackWithoutAHole(page, lines, line, shot);
  await showsTheSameAsANewPage(page, server);
  check(problems.length === 0, `no errors, no foreign requests, no policy violations ${problems.join('; ')}`);
} finally {
  await browser.close();
  line.end();
  await server.stop();
}
