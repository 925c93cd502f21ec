// One uPlot chart of the trend: measured levels as full lines, the simulation's truth dashed beside them.

import uPlot from 'uplot';

import { inUnits, marks, roomFor, unitOf } from '../lib/axis';
import { tickText } from '../lib/format';
import type { Point, TagNote } from '../lib/protocol';
import { pointNote, TagNotes, toldNumber } from '../lib/tag_notes';
import type { TrendData } from '../lib/trend_data';

const SERIES_COLOURS = 6;
const LEAST_RANGE = 0.1; // of curves that are no levels, so that noise does not fill the picture

// Points of one tank ("a1.level", "a1.truth") share a colour.
export interface Line {
  label: string;
  unit: string;
  colour: string; // name of the custom property
  dashed: boolean;
  note: TagNote; // what is said of it
}

export function linesOf(points: Point[], notes = new TagNotes()): Line[] {
  const decimals = points.every((point) => (notes.of(point.id)?.unit ?? point.unit) === '%') ? 1 : 2;
  const owners: string[] = [];
  return points.map((point) => {
    const owner = point.id.split('.')[0] ?? point.id;
    if (!owners.includes(owner)) owners.push(owner);
    const colour = `--series-${(owners.indexOf(owner) % SERIES_COLOURS) + 1}`;
    const note = pointNote(point, notes, decimals);
    return { label: note.description ?? point.label, unit: note.unit ?? '', colour, dashed: point.id.endsWith('.truth'), note };
  });
}

// Levels are seen against a full tank, anything else against its own largest value.
export function areLevels(lines: Line[]): boolean {
  return lines.every((line) => line.unit === '%');
}

// The power of ten in whose units a chart is drawn at present.
const units = new WeakMap<uPlot, number>();
const unitFor = (chart: uPlot) => units.get(chart) ?? 1;

export function makeChart(host: HTMLElement, lines: Line[], height: number): uPlot {
  const style = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const top = (high: number) => (areLevels(lines) ? Math.max(100, high) : Math.max(LEAST_RANGE, 1.1 * high));
  const axis: uPlot.Axis = {
    stroke: () => style('--text-soft'),
    grid: { stroke: () => style('--panel-edge'), width: 1 },
    ticks: { stroke: () => style('--panel-edge'), width: 1, size: 4 },
    font: '11px system-ui, sans-serif',
  };
  return new uPlot(
    {
      width: Math.max(host.clientWidth, 200),
      height,
      scales: { x: { time: false }, y: { range: (chart, _low, high) => [0, top(high * unitFor(chart)) / unitFor(chart)] } },
      axes: [
        { ...axis, values: (_, ticks) => ticks.map((tick) => tickText(tick)) },
        { ...axis, size: roomFor(38), values: (chart, ticks) => marks(ticks, unitFor(chart)) },
      ],
      cursor: { points: { size: 6 }, drag: { x: true, y: false } },
      legend: { show: false },
      series: [
        {},
        ...lines.map(
          (line): uPlot.Series => ({
            label: line.label,
            stroke: () => style(line.colour),
            width: line.dashed ? 1 : 2,
            ...(line.dashed ? { dash: [5, 4] } : {}),
            points: { show: false },
            value: (chart, value) => toldNumber(value * unitFor(chart), line.note),
          }),
        ),
      ],
    },
    [[], ...lines.map(() => [])],
    host,
  );
}

export function draw(chart: uPlot, data: TrendData): void {
  // The chart keeps the arrays that it is given; the trend goes on changing its own.
  const unit = unitOf(data.columns);
  units.set(chart, unit);
  chart.setData([data.times.slice(), ...data.columns.map((column) => inUnits(column, unit))] as uPlot.AlignedData);
}
