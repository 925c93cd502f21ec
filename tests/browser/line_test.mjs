// The sorting line as a person sees it: its own processes at twice real time, drawn from above on the same page
// as the bench.

import { startDemo } from './demo_process.mjs';
import { leadOverPage } from './page_run.mjs';
import { asks, BY_OPERATOR, isAccessible, startsTheRun } from './people.mjs';
import { check, drawn, fitsWidth, FLUENT, options, pictures, until, waitFor } from './support.mjs';

const SPEED = 2; // a page on a busy machine draws a few pictures a second

const given = options();
const shot = pictures(given, 'line-', { fullPage: true });

// Notes every place at which the page draws a box, how many there are at once, every paddle and every lit belt and eye.
function keepHistory() {
  const seen = { boxes: {}, most: 0, paddles: {}, belts: new Set(), eyes: new Set() };
  const look = () => {
    const boxes = document.querySelectorAll('[data-box]');
    seen.most = Math.max(seen.most, boxes.length);
    for (const box of boxes) {
      (seen.boxes[box.dataset.box] ??= new Set()).add(box.style.transform);
    }
    for (const paddle of document.querySelectorAll('[data-pusher]')) {
      (seen.paddles[paddle.dataset.pusher] ??= new Set()).add(paddle.style.transform);
    }
    for (const belt of document.querySelectorAll('.belt.on')) seen.belts.add(belt.dataset.belt);
    for (const eye of document.querySelectorAll('.beam.dark')) seen.eyes.add(eye.dataset.beam);
  };
  globalThis.seen = seen;
  new MutationObserver(look).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
}

async function takePictures(page) {
  for (const width of [360, 1440]) {
    await fitsWidth(page, width);
    await shot(page, `${width}`);
  }
}

async function glidesUnlessAskedNotTo(page) {
  const duration = () => page.evaluate(() => getComputedStyle(document.querySelector('[data-pusher]')).transitionDuration);
  const usual = await duration();
  check(usual !== '0s', `pushers glide (${usual})`);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const reduced = await duration();
  check(reduced === '0s', `and jump where somebody wants as little motion as possible (${reduced})`);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
}

// A page that gets little of a busy machine misses a pusher that is out for half a second: that each of them, each belt and each eye
// is drawn as the plant says is in tests/unit/hmi_web/client/line_test.mjs.
async function sawTheLineWork(page) {
  const seen = await page.evaluate(() => ({
    boxes: Object.fromEntries(Object.entries(globalThis.seen.boxes).map(([box, places]) => [box, places.size])),
    paddles: Object.fromEntries(Object.entries(globalThis.seen.paddles).map(([name, places]) => [name, places.size])),
    belts: [...globalThis.seen.belts],
    eyes: [...globalThis.seen.eyes],
  }));
  for (const box of [1, 2, 3, 4, 5]) check(seen.boxes[`box ${box}`] > 5, `box ${box} moved (${seen.boxes[`box ${box}`]} places)`);
  const out = Object.entries(seen.paddles).filter(([, places]) => places > 2);
  check(Object.keys(seen.paddles).join() === '1,2,e,t' && out.length > 0, `pushers went out: ${out.map(([name, places]) => `${name} (${places} places)`).join(', ')}`);
  check(seen.belts.length >= 3, `belts were seen running: ${seen.belts.join(' ')}`);
  check(seen.eyes.length >= 3, `eyes were covered: ${seen.eyes.join(' ')}`);
}

// At the end, when nothing moves any more: what is forced has a letter at its place, and says by name what it is.
async function marksWhatIsForced(page) {
  for (const address of ['%QX0.0', '%IX0.0', '%QX1.0'])
    check((await asks(page, 'POST', '/api/tags/force', { name: address, value: 'FALSE', reason: 'to look at it' })).status === 200, `${address} is forced`);
  await waitFor(page, 'the picture marks the belt, the eye and the pusher', () =>
    ['belt in, forced', 'photo-eye eye_in, forced', 'pusher 1, forced'].every((name) => document.querySelector(`[data-panel=synoptic] [data-forced][aria-label="${name}"]`) !== null));
  check((await page.locator('[data-panel=synoptic] [data-forced]').count()) === 3, 'and nothing else');
  check((await page.locator('[data-panel=tags] [data-forced]').count()) >= 1, 'the table marks what is forced by its address, too');
  for (const width of [1440, 360]) {
    await page.setViewportSize({ width, height: 900 });
    await drawn(page);
    const apart = await page.evaluate(() => {
      const boxes = [...document.querySelectorAll('[data-panel=synoptic] [data-forced] rect')].map((one) => one.getBoundingClientRect());
      return boxes.every((a, i) => boxes.every((b, k) => i === k || a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top));
    });
    check(apart, `at ${width} px no mark hides another`);
    await shot(page.locator('[data-panel=synoptic]'), `forced-${width}`);
  }
  await isAccessible(page, 'the page with forced parts of the line');
}

await leadOverPage(given, {
  name: 'line',
  look: { reducedMotion: 'no-preference' },
  watch: keepHistory,
  start: () => startDemo(given.server, SPEED, 'conveyor', [...BY_OPERATOR, ...FLUENT]),
  steps: async (page, demo) => {
    await waitFor(page, 'belts, chutes and pushers are drawn', () =>
      document.querySelectorAll('[data-belt]').length === 9 && document.querySelectorAll('[data-pusher]').length === 4);
    await waitFor(page, 'the plan has 36 actions', () => document.querySelectorAll('[data-action]').length === 36);
    await startsTheRun(page, demo);
    await waitFor(page, 'three boxes are on the line at once', () => globalThis.seen.most >= 3);
    await takePictures(page);
    await waitFor(page, 'the page says that the goal is reached', () =>
      document.querySelector('[data-testid=phase]')?.textContent.trim() === 'done' &&
      document.querySelector('[data-testid=message]').textContent.includes('the goal is reached'));
    await waitFor(page, 'no box is on the line', () => document.querySelectorAll('[data-box]').length === 0);
    await sawTheLineWork(page);
    await glidesUnlessAskedNotTo(page);
    await marksWhatIsForced(page);
    const code = await demo.end();
    check(code === 0, `the demo ends with 0 when it is told to end (${code})`);
    await until('no process of the demo is left', () => demo.processes().length === 0);
  },
});
