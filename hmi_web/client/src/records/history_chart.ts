// The chart of the history: of every tag a band between the least and the greatest value of each column, and
// the last one as a line that holds its value to the next column; a truth value as a step between two levels of its own. Beside it,
// dashed, the same a day before.

import uPlot from 'uplot';

import { inUnits, marks, roomFor, unitOf } from '../lib/axis';
import { isTime } from '../lib/format';
import { pointNote, TagNotes } from '../lib/tag_notes';
import type { Value } from '../lib/value';
import type { History } from './records';
import { axisOf, MOST_AXES } from './trend_view';

const HEIGHT = 300;
const COLOURS = 6;
const PER_TAG = 4; // series of uPlot: greatest, least, last, a day before
const BOOL_RANGE: [number, number] = [-0.1, 1.1];

export interface Range {
  from: number; // ms since 1970
  to: number;
}

export interface Trace {
  tag: string;
  label: string;
  unit: string;
  colour: string; // name of the custom property
  dashed: boolean; // the second one of its colour
  scale: string; // tags of one scale share it
  range?: [least: number, greatest: number]; // its ends; without: those of the values
  isBool: boolean;
}

export interface ChartEvents {
  onRange(range: Range): void;
  // The column that the cursor is in; null: none.
  onCursor(index: number | null): void;
  onPin(index: number): void;
}

// `axes` as the server has them; `typeOf`: of a tag of the program, empty if it has none.
export function tracesOf(
  tags: string[],
  points: { id: string; label: string; unit: string }[],
  notes = new TagNotes(),
  axes: Record<string, string> = {},
  typeOf: (tag: string) => string = () => '',
): Trace[] {
  return tags.map((tag, index) => {
    const point = points.find((one) => `points/${one.id}` === tag);
    const note = point ? pointNote(point, notes) : notes.of(tag);
    const said = point ? note?.description : notes.descriptionOf(tag);
    const label = said ? `${said} (${point?.id ?? tag})` : tag;
    const unit = isTime(typeOf(tag)) ? 's' : (note?.unit ?? '');
    const axis = axisOf(axes[tag]);
    const isBool = typeOf(tag) === 'BOOL';
    const scale = axis.kind === 'unit' ? (isBool ? '@bool' : unit) : `@${tag}`;
    const range: [number, number] | null = axis.kind === 'range' ? [axis.least, axis.greatest] : isBool ? BOOL_RANGE : null;
    return { tag, label, unit, colour: `--series-${(index % COLOURS) + 1}`, dashed: index >= COLOURS, scale, isBool, ...(range ? { range } : {}) };
  });
}

function style(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function seriesOf(trace: Trace): uPlot.Series[] {
  const edge: uPlot.Series = { scale: trace.scale, width: 0, points: { show: false } };
  const line: uPlot.Series = {
    scale: trace.scale,
    stroke: () => style(trace.colour),
    width: 1.5,
    points: { show: false },
    paths: uPlot.paths.stepped?.({ align: 1 }) ?? null,
  } as uPlot.Series;
  return [edge, { ...edge }, trace.dashed ? { ...line, dash: [12, 4] } : line, { ...line, width: 1, dash: [4, 4] }];
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
  const scales = [...new Map(traces.map((trace) => [trace.scale, trace])).values()];
  // An axis of one's own has the colour of its line.
  const isOwn = ({ scale }: Trace) => scale.startsWith('@') && scale !== '@bool';
  const rangeOf = (trace: Trace): uPlot.Scale => {
    const range = trace.range;
    if (!range) return { auto: true };
    return { auto: false, range: (chart) => range.map((end) => end / (powers.get(chart)?.get(trace.scale) ?? 1)) as [number, number] };
  };
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
        ...scales.map((trace, index): uPlot.Axis => ({
          ...axis,
          ...(isOwn(trace) ? { stroke: () => style(trace.colour) } : {}),
          values: (chart, ticks) => (trace.scale === '@bool' ? ticks.map((tick) => (tick === 0 || tick === 1 ? String(tick) : '')) : marks(ticks, powers.get(chart)?.get(trace.scale) ?? 1)),
          scale: trace.scale,
          size: roomFor(48),
          side: index % 2 === 0 ? 3 : 1,
          show: index < MOST_AXES,
          grid: { ...axis.grid, show: index === 0 },
          ...(trace.unit ? { label: trace.unit, labelSize: 14, labelFont: '11px system-ui, sans-serif' } : {}),
        })),
      ],
      scales: Object.fromEntries([['x', { time: true, auto: false }], ...scales.map((trace) => [trace.scale, rangeOf(trace)])]) as uPlot.Scales,
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
    [[], ...traces.flatMap(() => [[], [], [], []])],
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

// `before`: of each trace the values a day before, column by column; empty: they are not compared.
export function draw(chart: uPlot, traces: readonly Trace[], history: History, before: readonly Value[][] = []): void {
  const count = history.series[0]?.last.length ?? 0;
  const times = Array.from({ length: count }, (_, index) => (history.from_ms + index * history.column_ms) / 1e3);
  const nothing = Array<Value>(count).fill(null);
  const columnsOf = (index: number) => {
    const one = history.series[index];
    return one ? [one.greatest, one.least, one.last, before[index] ?? nothing] : [];
  };
  const byScale = new Map<string, number>();
  for (const { scale } of traces)
    if (!byScale.has(scale)) byScale.set(scale, unitOf(traces.flatMap((trace, index) => (trace.scale === scale ? columnsOf(index) : []))));
  powers.set(chart, byScale);
  const columns = traces.flatMap((trace, index) => columnsOf(index).map((column) => inUnits(column, byScale.get(trace.scale) ?? 1)));
  chart.batch(() => {
    chart.setData([times, ...columns] as uPlot.AlignedData, false);
    chart.setScale('x', { min: history.from_ms / 1e3, max: history.to_ms / 1e3 });
  });
}
