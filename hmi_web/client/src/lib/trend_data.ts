// The trend as columns, the way the chart wants them: times first, then one column per series.

import type { TrendMessage, Value } from './protocol';

const MOST_ROWS = 6_000;

export class TrendData {
  times: number[] = [];
  columns: Value[][];
  // What the server calls it, and the number of the row behind the newest; 0: there is none.
  run = 0;
  next = 0;

  constructor(seriesCount: number) {
    this.columns = Array.from({ length: seriesCount }, () => []);
  }

  add(message: TrendMessage): void {
    if (message.restart) this.clear();
    this.run = message.run;
    this.next = message.first + message.rows.length;
    for (const row of message.rows) {
      const time = row[0];
      if (typeof time !== 'number') continue;
      this.times.push(time);
      this.columns.forEach((column, index) => column.push(row[index + 1] ?? null));
    }
    const surplus = this.times.length - MOST_ROWS;
    if (surplus > 0) {
      this.times.splice(0, surplus);
      this.columns.forEach((column) => column.splice(0, surplus));
    }
  }

  private clear(): void {
    this.times.length = 0;
    this.columns.forEach((column) => (column.length = 0));
  }
}
