// What is pressed twice by a double click is pressed once, and nothing that has come under the pointer meanwhile.
//
//   node --test double_click_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { DoubleClicks, Once } = await load(process.env.CLIENT, ['lib/double_click']);

const click = (control, at, x = 100, y = 100) => ({ control, at, x, y });

test('DoubleClick_WhenAnotherControlLiesThereByThen_ThenItIsNotMeant', () => {
  for (const gap of [5, 130, 500]) {
    const clicks = new DoubleClicks();
    assert.equal(clicks.isStray(click('Write', 1_000)), false);
    assert.equal(clicks.isStray(click('a button below', 1_000 + gap, 103, 98)), true, `${gap} ms`);
  }
});

test('DoubleClick_WhenItIsTheSameControlOrNoDoubleClick_ThenItIsMeant', () => {
  const clicks = new DoubleClicks();
  for (const [one, other] of [
    [click('7', 0), click('7', 90)],
    [click('Write', 0), click('a button', 501)],
    [click('Write', 0), click('a button', 200, 140, 100)],
    [click('Write', 0), click('a button', 200, 100, 60)],
  ]) {
    clicks.isStray(click('elsewhere', -10_000));
    assert.equal(clicks.isStray(one), false);
    assert.equal(clicks.isStray(other), false, JSON.stringify(other));
  }
});

test('DoubleClick_WhenAKeyWasPressedBetween_ThenTheyAreTwoClicks', () => {
  const clicks = new DoubleClicks();
  clicks.isStray(click('Suppress', 0));
  clicks.forget();
  assert.equal(clicks.isStray(click('End suppression', 300)), false);
});

test('DoubleClick_WhenMoreThanTwoCome_ThenAllMeanTheFirst', () => {
  const clicks = new DoubleClicks();
  clicks.isStray(click('Write', 0));
  assert.equal(clicks.isStray(click('below', 200)), true);
  assert.equal(clicks.isStray(click('below', 600)), true);
  assert.equal(clicks.isStray(click('below', 1_200)), false, 'somebody clicks on it once more: it is seen by now');
});

test('Once_WhenAControlIsPressedAgain_ThenOnlyBehindTheDoubleClick', () => {
  const once = new Once();
  assert.equal(once.isFirst('start', 0), true);
  assert.equal(once.isFirst('start', 300), false);
  assert.equal(once.isFirst('stop', 320), true, 'another one is never held up');
  assert.equal(once.isFirst('start', 340), true);
  assert.equal(once.isFirst('start', 900), true);
});
