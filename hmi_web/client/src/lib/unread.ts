// Tags that have no value because the device that they are read from does not answer. What is forced has one all the same: the
// program works with it.

import type { UnreadDevice } from './protocol';

export type Unread = Pick<UnreadDevice, 'device' | 'why'>;

export class UnreadTags {
  private readonly byIndex = new Map<number, Unread>();

  // `isForced`: by the index of a tag.
  constructor(devices: readonly UnreadDevice[], isForced: (index: number) => boolean = () => false) {
    for (const { device, why, tags } of devices)
      for (const [first, count] of tags)
        for (let index = first; index < first + count; ++index) if (!isForced(index)) this.byIndex.set(index, { device, why });
  }

  // By the index of a tag; null: it has a value, or another reason to have none.
  of(index: number): Unread | null {
    return this.byIndex.get(index) ?? null;
  }
}
