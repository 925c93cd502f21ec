// The time axis of the Gantt bars: from the start of the plan to the later of its planned and its actual end.

import type { PlanAction, Value } from '../lib/protocol';

export interface Timeline {
  from: number;
  to: number;
  ticks: number[];
}

export interface Bar {
  left: number; // per cent of the axis
  width: number;
}

const ROUND_SECONDS = [0.5, 1, 2, 5, 10, 15, 20, 30, 60, 120, 300, 600, 900, 1_800, 3_600];

export function timelineOf(actions: PlanAction[], now: number): Timeline {
  const starts: number[] = [];
  const ends: number[] = [];
  for (const action of actions) {
    for (const value of [action.planned_start_s, action.started_s]) if (isNumber(value)) starts.push(value);
    for (const value of [action.planned_finish_s, action.finished_s]) if (isNumber(value)) ends.push(value);
    if (action.state === 'active') ends.push(now);
  }
  const from = starts.length > 0 ? Math.min(...starts) : 0;
  const to = Math.max(from + 1, ...ends);
  return { from, to, ticks: ticksOf(from, to) };
}

export function barOf(timeline: Timeline, start: Value | undefined, end: Value | undefined): Bar | null {
  if (!isNumber(start) || !isNumber(end)) return null;
  const length = timeline.to - timeline.from;
  const left = ((start - timeline.from) / length) * 100;
  return { left, width: Math.max(0.4, ((end - start) / length) * 100) };
}

// A few round times.
export function ticksOf(from: number, to: number): number[] {
  const rough = (to - from) / 7;
  const step = ROUND_SECONDS.find((candidate) => candidate >= rough) ?? Math.ceil(rough / 3_600) * 3_600;
  const ticks: number[] = [];
  for (let tick = Math.ceil(from / step) * step; tick <= to; tick += step) ticks.push(tick);
  return ticks;
}

function isNumber(value: Value | undefined): value is number {
  return typeof value === 'number';
}
