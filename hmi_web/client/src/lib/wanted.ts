// What the page wants to be told (hmi_web/doc/protocol.md): the tags that its panels show, put together as ranges of indices.

import type { ShowMessage } from './protocol';

export type Range = [first: number, count: number];

const MOST_RANGES = 200;

// Ascending, none touches another. If there are more than allowed, those with the least between them become one.
export function rangesOf(indices: Iterable<number>, most = MOST_RANGES): Range[] {
  const sorted = [...new Set(indices)].sort((a, b) => a - b);
  const ranges: Range[] = [];
  for (const index of sorted) {
    const last = ranges.at(-1);
    if (last && last[0] + last[1] === index) last[1] += 1;
    else ranges.push([index, 1]);
  }
  if (ranges.length <= most) return ranges;
  const gapBehind = (i: number) => (ranges[i + 1] as Range)[0] - (ranges[i] as Range)[0] - (ranges[i] as Range)[1];
  const cuts = ranges.slice(0, -1).map((_, i) => i).sort((a, b) => gapBehind(b) - gapBehind(a)).slice(0, most - 1).sort((a, b) => a - b);
  let from = 0;
  return [...cuts, ranges.length - 1].map((to): Range => {
    const [first] = ranges[from] as Range;
    const [last, count] = ranges[to] as Range;
    from = to + 1;
    return [first, last + count - first];
  });
}

export class Wanted {
  private readonly byPanel = new Map<object, readonly number[]>();
  private digest = '';
  private tagCount = 0;
  private trends = 0;
  private sent = ''; // the newest choice without its number
  private number = 0;
  private answered = 0; // the number of the choice whose values have come

  // Indices of another program mean other tags: panels say anew what they show.
  setProgram(digest: string, tagCount: number): void {
    if (digest === this.digest && tagCount === this.tagCount) return;
    this.digest = digest;
    this.tagCount = tagCount;
    this.byPanel.clear();
  }

  show(panel: object, tags: readonly number[]): void {
    if (tags.length > 0) this.byPanel.set(panel, tags);
    else this.byPanel.delete(panel);
  }

  // Panels that draw values over time, one more or one less.
  showTrend(more: 1 | -1): void {
    this.trends += more;
  }

  answer(number: number): void {
    this.answered = number;
  }

  // All values of what is wanted now have come.
  get isAnswered(): boolean {
    return this.number > 0 && this.answered === this.number && this.sent === this.text();
  }

  // Numbers of another run of the server mean nothing to it.
  forget(): void {
    this.answered = 0;
  }

  // What is to be said; null: that was the last that was said.
  next(): ShowMessage | null {
    const text = this.text();
    if (text === this.sent) return null;
    this.sent = text;
    this.number += 1;
    return this.current();
  }

  // The same for a connection that has heard nothing yet.
  first(): ShowMessage {
    return this.next() ?? this.current();
  }

  private current(): ShowMessage {
    return { number: this.number, ...(JSON.parse(this.sent) as Omit<ShowMessage, 'number'>) };
  }

  private text(): string {
    const all = [...this.byPanel.values()].flat().filter((index) => index >= 0 && index < this.tagCount);
    const also = ['plan', 'routes', 'pictures', ...(this.trends > 0 ? ['trend'] : [])];
    return JSON.stringify({ digest: this.digest, tags: rangesOf(all), also });
  }
}
