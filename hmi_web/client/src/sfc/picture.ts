// The picture of a chart as GET /api/chart has laid it out (hmi_web/doc/program.md), in px.

import { refusal } from '../access/api';
import { fieldsOf, listOf, numberOf as numberIn, recordsOf, textOf, type Fields } from '../lib/doubt';

export interface StepBox {
  index: number;
  x: number; // of its left side
  y: number; // of its top
  width: number;
  height: number;
  entry: number | null; // where jumps come in above it
}

export interface TransitionBar {
  index: number;
  x: number;
  y: number; // of the bar
  label: string;
}

export interface Jump {
  step: number; // that it leads to
  x: number;
  y: number;
}

export type Line = [x1: number, y1: number, x2: number, y2: number];

export interface ChartPicture {
  digest: string; // of the program
  chart: string; // that was asked for
  width: number;
  height: number;
  exits: number[]; // steps in which the chart ends when something goes wrong
  steps: StepBox[];
  transitions: TransitionBar[];
  jumps: Jump[];
  lines: Line[];
  doubles: Line[];
}

const numberOf = (value: unknown): number => numberIn(value) ?? 0;
const numbersOf = (value: unknown): number[] => listOf(value).map(numberOf);
const linesOf = (value: unknown): Line[] => listOf(value).map(numbersOf).filter((line): line is Line => line.length === 4);
const placed = (of: Fields) => ({ x: numberOf(of.x), y: numberOf(of.y) });

export function readPicture(value: unknown, chart: string): ChartPicture {
  const given = fieldsOf(value) ?? {};
  return {
    digest: textOf(given.digest),
    chart,
    width: numberOf(given.width),
    height: numberOf(given.height),
    exits: numbersOf(given.exits),
    steps: recordsOf(given.steps).map((step) => ({
      ...placed(step), index: numberOf(step.index), width: numberOf(step.width), height: numberOf(step.height),
      entry: numberIn(step.entry),
    })),
    transitions: recordsOf(given.transitions).map((bar) => ({ ...placed(bar), index: numberOf(bar.index), label: textOf(bar.label) })),
    jumps: recordsOf(given.jumps).map((jump) => ({ ...placed(jump), step: numberOf(jump.step) })),
    lines: linesOf(given.lines),
    doubles: linesOf(given.doubles),
  };
}

// `chart`: its name, empty for all together; `shown`: exits that are drawn although the others are not.
export async function fetchPicture(chart: string, exits: boolean, shown: string, signal: AbortSignal): Promise<ChartPicture> {
  const query = new URLSearchParams({ chart, exits: exits ? '1' : '0', shown });
  const response = await fetch(`/api/chart?${query.toString()}`, { credentials: 'same-origin', cache: 'no-store', signal });
  if (!response.ok) throw new Error(refusal(response.status));
  return readPicture(await response.json(), chart);
}
