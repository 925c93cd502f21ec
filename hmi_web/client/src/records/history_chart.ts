// The chart of the history: of every tag a band between the least and the greatest value of each column, and
// the last one as a line that holds its value to the next column.

import uPlot from 'uplot';

import { inUnits, marks, roomFor, unitOf } from '../lib/axis';
import { TagNotes } from '../lib/tag_notes';
import type { History } from './records';

const HEIGHT = 300;
const COLOURS = 6;
const PER_TAG = 3; // series of uPlot: greatest, least, last

export interface Range {
  from: number; // ms since 1970
  to: number;
}

export interface Trace {
  tag: string;
  label: string;
  unit: string;
  colour: string; // name of the custom property
}

export interface ChartEvents {
  onRange(range: Range): void;
  // The column that the cursor is in; null: none.
  onCursor(index: number | null): void;
  onPin(index: number): void;
}

export function tracesOf(tags: string[], points: { id: string; label: string; unit: string }[], notes = new TagNotes()): Trace[] {
  return tags.map((tag, index) => {
    const point = points.find((one) => `points/${one.id}` === tag);
    const note = notes.of(tag);
    const label = point ? `${point.label} (${point.id})` : note?.description ? `${note.description} (${tag})` : tag;
    return { tag, label, unit: point?.unit ?? note?.unit ?? '', colour: `--series-${(index % COLOURS) + 1}` };
  });
}

function style(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function seriesOf(trace: Trace): uPlot.Series[] {
  const edge: uPlot.Series = { scale: trace.unit, width: 0, points: { show: false } };
  const line: uPlot.Series = {
    scale: trace.unit,
    stroke: () => style(trace.colour),
    width: 1.5,
    points: { show: false },
    paths: uPlot.paths.stepped?.({ align: 1 }) ?? null,
  } as uPlot.Series;
  return [edge, { ...edge }, line];
}

// The powers of ten in whose units the scales of a chart are drawn at present, in the order of its traces.
const powers = new WeakMap<uPlot, Map<string, number>>();

export function makeChart(host: HTMLElement, traces: Trace[], events: ChartEvents): uPlot {
  const axis: uPlot.Axis = {
    stroke: () => style('--text-soft'),
    grid: { stroke: () => style('--panel-edge'), width: 1 },
    ticks: { stroke: () => style('--panel-edge'), width: 1, size: 4 },
    font: '11px system-ui, sans-serif',
  };
  const units = [...new Set(traces.map((trace) => trace.unit))];
  const chart = new uPlot(
    {
      width: Math.max(host.clientWidth, 200),
      height: HEIGHT,
      // 24 hours whatever the browser's language: a trend is read beside a journal.
      axes: [
        {
          ...axis,
          values: [
            [86400, '{YYYY}-{MM}-{DD}', null, null, null, null, null, null, 1],
            [3600, '{HH}:{mm}', '\n{YYYY}-{MM}-{DD}', null, '\n{MM}-{DD}', null, null, null, 1],
            [60, '{HH}:{mm}', '\n{YYYY}-{MM}-{DD}', null, '\n{MM}-{DD}', null, null, null, 1],
            [1, '{HH}:{mm}:{ss}', '\n{YYYY}-{MM}-{DD}', null, '\n{MM}-{DD}', null, null, null, 1],
            [0.001, ':{ss}.{fff}', '\n{YYYY}-{MM}-{DD} {HH}:{mm}', null, '\n{HH}:{mm}', null, null, null, 1],
          ] as uPlot.Axis.Values,
        },
        ...units.map((unit, index): uPlot.Axis => ({ ...axis, values: (chart, ticks) => marks(ticks, powers.get(chart)?.get(unit) ?? 1), scale: unit, size: roomFor(48), side: index === 0 ? 3 : 1, show: index < 2, grid: { ...axis.grid, show: index === 0 }, ...(unit ? { label: unit, labelSize: 14, labelFont: '11px system-ui, sans-serif' } : {}) })),
      ],
      scales: Object.fromEntries([['x', { time: true, auto: false }], ...units.map((unit) => [unit, { auto: true }])]) as uPlot.Scales,
      cursor: { points: { show: false }, drag: { x: true, y: false, setScale: false } },
      legend: { show: false },
      series: [{}, ...traces.flatMap(seriesOf)],
      bands: traces.map((trace, index): uPlot.Band => ({
        series: [PER_TAG * index + 1, PER_TAG * index + 2],
        // A quarter of the line's colour.
        fill: () => `${style(trace.colour)}40`,
      })),
      hooks: {
        setCursor: [(self) => events.onCursor(self.cursor.idx ?? null)],
        setSelect: [
          (self) => {
            const { left, width } = self.select;
            if (width < 4) return;
            events.onRange({ from: 1e3 * self.posToVal(left, 'x'), to: 1e3 * self.posToVal(left + width, 'x') });
            self.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
          },
        ],
      },
    },
    [[], ...traces.flatMap(() => [[], [], []])],
    host,
  );
  chart.over.addEventListener('click', () => {
    if (typeof chart.cursor.idx === 'number') events.onPin(chart.cursor.idx);
  });
  chart.over.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const at = chart.posToVal(event.offsetX, 'x');
      const { min, max } = chart.scales['x'] ?? {};
      if (typeof min !== 'number' || typeof max !== 'number') return;
      const factor = event.deltaY > 0 ? 1.4 : 1 / 1.4;
      events.onRange({ from: 1e3 * (at - (at - min) * factor), to: 1e3 * (at + (max - at) * factor) });
    },
    { passive: false },
  );
  return chart;
}

export function draw(chart: uPlot, traces: readonly Trace[], history: History): void {
  const count = history.series[0]?.last.length ?? 0;
  const times = Array.from({ length: count }, (_, index) => (history.from_ms + index * history.column_ms) / 1e3);
  const columnsOf = (index: number) => {
    const one = history.series[index];
    return one ? [one.greatest, one.least, one.last] : [];
  };
  const byUnit = new Map<string, number>();
  for (const { unit } of traces)
    if (!byUnit.has(unit)) byUnit.set(unit, unitOf(traces.flatMap((trace, index) => (trace.unit === unit ? columnsOf(index) : []))));
  powers.set(chart, byUnit);
  const columns = traces.flatMap((trace, index) => columnsOf(index).map((column) => inUnits(column, byUnit.get(trace.unit) ?? 1)));
  chart.batch(() => {
    chart.setData([times, ...columns] as uPlot.AlignedData, false);
    chart.setScale('x', { min: history.from_ms / 1e3, max: history.to_ms / 1e3 });
  });
}
