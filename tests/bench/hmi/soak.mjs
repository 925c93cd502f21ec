// A tab that stays open: does its heap grow?

const STEP_MS = 15_000;

// Megabytes that are alive, after whatever is not has been collected.
async function liveHeap(session) {
  await session.send('HeapProfiler.collectGarbage');
  const { usedSize } = await session.send('Runtime.getHeapUsage');
  return usedSize / 2 ** 20;
}

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

// The heap of the first and of the last tenth of the time, without the first two minutes or fifth, whichever is less: by
// then the trend's buffer, which is bounded, has grown. The plant changes meanwhile.
export async function soak(context, cell, selector, minutes, progress) {
  const page = await context.newPage();
  await page.goto(cell.url);
  const session = await context.newCDPSession(page);
  await session.send('HeapProfiler.enable');
  const heaps = [];
  const steps = Math.max(10, Math.round((minutes * 60_000) / STEP_MS));
  for (let i = 0; i < steps; ++i) {
    cell.set(i % 1_000);
    await new Promise((resolve) => setTimeout(resolve, STEP_MS));
    // A page that has lost its cell would have a flat heap, too.
    const shown = await page.locator(selector).innerText();
    if (shown !== String(i % 1_000)) throw new Error(`the page shows ${shown} instead of ${i % 1_000}`);
    heaps.push(await liveHeap(session));
    if (i % 20 === 0) progress(`soak: ${((i * STEP_MS) / 60_000).toFixed(0)} of ${minutes} min, heap ${heaps.at(-1).toFixed(1)} MB`);
  }
  await page.close();
  const settled = heaps.slice(Math.min(8, Math.floor(heaps.length / 5)));
  const tenth = Math.max(1, Math.floor(settled.length / 10));
  const first = mean(settled.slice(0, tenth));
  const last = mean(settled.slice(-tenth));
  return { soak_minutes: minutes, heap_first_mb: first, heap_last_mb: last, heap_growth_percent: (100 * (last - first)) / first, heap_mb: heaps };
}
