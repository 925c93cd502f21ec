// From a change in the plant to the pixel: when a page has painted a value, told by the page itself.

// Runs inside the page from its beginning. Notes for each text that the watched element shows when it was painted: a
// frame's callbacks run before its painting, a message that they post arrives after it.
function watchInPage(selector) {
  window.paintedAt = {};
  const channel = new MessageChannel();
  let shown = '';
  let asked = [];
  channel.port1.onmessage = () => {
    const now = performance.timeOrigin + performance.now();
    for (const text of asked) window.paintedAt[text] ??= now;
    asked = [];
  };
  const look = () => {
    const text = document.querySelector(selector)?.textContent.trim() ?? '';
    if (text !== shown) {
      shown = text;
      asked.push(text);
      channel.port2.postMessage(0);
    }
    requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

export function percentile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * share))];
}

// Opens the page and changes the plant again and again at irregular times; ms from each change to the page's painting it.
// `set(value)`: changes the plant. `selector`: the element whose text is the value.
export async function pixelTimes(context, url, selector, set, changes, random) {
  const page = await context.newPage();
  await page.addInitScript(watchInPage, selector);
  await page.goto(url);
  await page.locator(selector).first().waitFor({ timeout: 600_000 });
  const setAt = new Map();
  const FIRST = 1_000; // four digits for all: no text is wider than the one before
  for (let i = -3; i < changes; ++i) {
    const value = FIRST + i;
    set(value);
    if (i >= 0) setAt.set(value, performance.timeOrigin + performance.now()); // the first ones warm the page
    await new Promise((resolve) => setTimeout(resolve, 250 + 100 * random()));
  }
  const deadline = performance.now() + 600_000;
  let painted;
  do {
    painted = await page.evaluate(() => window.paintedAt);
  } while (!(String(FIRST + changes - 1) in painted) && performance.now() < deadline);
  await page.close();
  // A page that asks seldom skips values: it shows a change when it shows that value or a later one.
  const shown = Object.entries(painted).map(([value, at]) => [Number(value), at]);
  return [...setAt].map(([value, at]) => {
    const first = Math.min(...shown.filter(([other]) => other >= value).map(([, when]) => when));
    if (!Number.isFinite(first)) throw new Error(`${url} never painted ${value}`);
    return first - at;
  });
}
