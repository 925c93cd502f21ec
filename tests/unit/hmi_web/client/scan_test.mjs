// The logic of the scan's panel: histograms with logarithmic axes, and states as words.
//
//   node --test scan_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const scan = await load(process.env.CLIENT, ['scan/histogram', 'scan/figures']);

const spread = (buckets, more = {}) => ({ p50_us: 1, p99_us: 10, p999_us: 100, max_us: 1000, buckets, ...more });

test('Histogram_WhenNothingWasCounted_ThenThereIsNone', () => {
  assert.equal(scan.drawHistogram(spread(null)), null);
  assert.equal(scan.drawHistogram(spread([])), null);
  assert.equal(scan.drawHistogram(spread([[1, 2, 0]])), null);
});

test('Histogram_WhenBucketsDoubleInLength_ThenTheirBarsHaveOneWidth', () => {
  const picture = scan.drawHistogram(spread([[1, 2, 5], [2, 4, 50], [4, 8, 500], [8, 16, 5]]));
  assert.equal(picture.bars.length, 4);
  const [width] = picture.bars.map((bar) => bar.width);
  for (const bar of picture.bars) assert.ok(Math.abs(bar.width - width) < 0.01);
  assert.ok(picture.bars.every((bar) => bar.x >= 0 && bar.x + bar.width <= scan.WIDTH + 0.01));
});

test('Histogram_WhenOneOfAMillionIsLate_ThenItIsSeen', () => {
  const picture = scan.drawHistogram(spread([[1, 2, 1_000_000], [2, 4, 0], [4, 8, 1]]));
  assert.deepEqual(picture.bars.map((bar) => bar.height >= 2), [true, true]);
  assert.ok(picture.bars[0].height > picture.bars[1].height);
});

test('Histogram_WhenAllLieInOneBucket_ThenItIsNoWallAndHasATick', () => {
  const picture = scan.drawHistogram(spread([[8, 16, 3]], { p50_us: 9, p99_us: 9, p999_us: 9, max_us: 9 }));
  assert.ok(picture.bars[0].width < scan.WIDTH / 2);
  assert.deepEqual(picture.ticks.map((tick) => tick.label), ['10 µs']);
});

test('Histogram_WhenDurationsAreTooShortToMeasure_ThenTheirBarIsBesideTheNext', () => {
  const { bars } = scan.drawHistogram(spread([[0, 0.016, 3], [0.016, 0.023, 4], [0.023, 0.032, 1]]));
  assert.equal(new Set(bars.map((bar) => bar.x)).size, 3);
  assert.ok(bars.every((bar, i) => i === 0 || bar.x >= bars[i - 1].x + bars[i - 1].width));
});

test('Histogram_WhenMarksLieOnEachOther_ThenTheirLabelsDoNot', () => {
  const picture = scan.drawHistogram(spread([[0, 0.016, 3], [0.016, 0.032, 4]], { p50_us: 0.02, p99_us: 0.02, p999_us: 0.02, max_us: 5_000 }));
  const rows = picture.marks.map((mark) => mark.y);
  assert.deepEqual(rows, [...new Set(rows)]);
  assert.ok(Math.max(...rows) < scan.TOP);
  for (const mark of picture.marks) {
    assert.ok(Number.isFinite(mark.x) && mark.x >= 0 && mark.x <= scan.WIDTH, mark.name);
    assert.equal(mark.left, mark.x > scan.WIDTH * 0.6);
  }
});

test('Watchdog_WhenItIsNearOrExpired_ThenTheWordsSaySo', () => {
  const of = (more) => scan.watchdogOf({ limit_us: 5_000, sensitivity: 3, too_long: 0, expiries: 0, ...more });
  assert.deepEqual(of({}), { word: '5.00 ms × 3, quiet', tone: 'plain' });
  assert.equal(of({ too_long: 2 }).tone, 'warn');
  assert.deepEqual(of({ too_long: 3, expiries: 1 }), { word: '5.00 ms × 3, expired once', tone: 'alarm' });
  assert.equal(of({ limit_us: 0 }).word, 'none');
  assert.equal(of({ sensitivity: 0 }).word, '5.00 ms × 1, quiet');
  assert.equal(scan.watchdogOf(null).word, '–');
});

test('States_WhenSomethingIsMissing_ThenItIsNotTakenForGood', () => {
  assert.deepEqual(scan.stateOf({ alive: false, state: '' }), { word: 'never heard of', tone: 'alarm' });
  assert.deepEqual(scan.stateOf({ alive: false, state: 'running' }), { word: 'does not answer', tone: 'alarm' });
  assert.equal(scan.stateOf({ alive: true, state: 'fault' }).tone, 'alarm');
  assert.equal(scan.deviceState({ online: false, lost: false }).tone, 'warn');
  assert.equal(scan.deviceState({ online: false, lost: true }).tone, 'alarm');
  assert.equal(scan.deviceState({ online: true, lost: true }).tone, 'alarm');
});

test('Topics_WhenWhatComesAllTheTimeIsSilent_ThenItIsMarkedAndEventsAreNot', () => {
  const topic = (name, age_s, refused = 0) => ({ topic: `stepwright/${name}/1`, age_s, refused });
  assert.equal(scan.topicTone(topic('status', 0.1)), 'plain');
  assert.equal(scan.topicTone(topic('status', 30)), 'warn');
  assert.equal(scan.topicTone(topic('snapshot', null)), 'warn');
  assert.equal(scan.topicTone(topic('event', 3_000)), 'plain');
  assert.equal(scan.topicTone(topic('event', 1, 1)), 'warn');
});

test('Words_WhenTimesAndSizesGrow_ThenTheyStayShort', () => {
  assert.deepEqual([0, 0.35, 4.2, 59.9, 190, 7_500, 270_000, null].map(scan.span), ['0 ms', '350 ms', '4.2 s', '59.9 s', '3 min', '2 h 5 min', '3 d 3 h', '–']);
  assert.deepEqual([2_048, 12 << 20].map(scan.bytes), ['2 KiB', '12.0 MiB']);
});
