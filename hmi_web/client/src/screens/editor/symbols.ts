// The symbols that screens are put together from: templates with parameters, drawn after ISA-101 in the colours of the page. Each
// makes plain SVG with the bindings of drawings (hmi_web/doc/drawings.md), so that any program shows it. Pure.

import { labelOf } from '../parts';
import { LINE_SYMBOLS } from './line_symbols';
import { byName, partLabel } from './part_label';
import { isComplete, partAttributes } from './part_symbols';
import { alive, attribute, escaped, states, titled, type Params, type SymbolTemplate } from './template';

const LINE = 'stroke="var(--line-strong)" stroke-width="2"';
const BODY = `fill="var(--equipment)" ${LINE}`;

const below = (p: Params, w: number, h: number) => (p.label ? `<text x="${w / 2}" y="${h + 15}" text-anchor="middle" font-size="13">${escaped(p.label)}</text>` : '');
const range = (p: Params) => attribute('data-from', p.from) + attribute('data-to', p.to);
const valueText = (p: Params, x: number, y: number, anchor: string, size: number) =>
  `<text x="${x}" y="${y}" text-anchor="${anchor}" font-size="${size}" font-weight="600"${attribute('data-text', p.value)}${p.value ? attribute('data-digits', p.digits) + attribute('data-unit', p.unit) : ''}>–</text>`;

const VALUE = ['value', 'from', 'to', 'digits', 'unit'] as const;
const STATES = ['on', 'warn', 'alarm'] as const;

const equipment = (kind: string, width: number, height: number, draw: (w: number, h: number) => string): SymbolTemplate => ({
  kind,
  family: 'equipment',
  width,
  height,
  fields: ['label', ...STATES],
  turns: true,
  draw: (p, w, h) => alive(p, draw(w, h)),
  beside: below,
});

const SHAPES: SymbolTemplate[] = [
  {
    kind: 'tank', family: 'equipment', width: 120, height: 160, fields: ['label', ...VALUE, 'alarm'],
    draw: (p, w, h) =>
      `<rect width="${w}" height="${h}" rx="8" fill="var(--equipment)"/>` +
      (p.value ? `<rect x="2" y="2" width="${w - 4}" height="${h - 4}" rx="6" fill="var(--liquid)"${attribute('data-fill', p.value)}${range(p)}>${titled(p)}</rect>` : '') +
      `<rect width="${w}" height="${h}" rx="8" fill="none" ${LINE}${attribute('data-alarm', p.alarm)}/>` +
      valueText(p, w / 2, h / 2 + 5, 'middle', 16),
    beside: below,
  },
  {
    kind: 'pipe', family: 'equipment', width: 120, height: 12, fields: ['label', 'on'], turns: true,
    draw: (p, w, h) => alive(p, `<rect width="${w}" height="${h}" fill="var(--equipment-dark)" stroke="var(--line)"/>`),
  },
  ...LINE_SYMBOLS,
  equipment('valve', 60, 40, (w, h) => `<path d="M0 0L${w} ${h}V0L0 ${h}Z" ${BODY}/>`),
  equipment('pump', 60, 60, (w, h) => `<ellipse cx="${w / 2}" cy="${h / 2}" rx="${w / 2}" ry="${h / 2}" ${BODY}/><path d="M${w / 2} 0L${w} ${h / 2}L${w / 2} ${h}" ${BODY}/>`),
  equipment('motor', 60, 60, (w, h) => `<ellipse cx="${w / 2}" cy="${h / 2}" rx="${w / 2}" ry="${h / 2}" ${BODY}/><text x="${w / 2}" y="${h / 2 + 7}" text-anchor="middle" font-size="20" font-weight="600">M</text>`),
  equipment('conveyor', 200, 36, (w, h) => {
    const rolls = Math.max(2, Math.round(w / 40));
    const step = (w - h) / (rolls - 1);
    const each = Array.from({ length: rolls }, (_, k) => `<circle cx="${h / 2 + k * step}" cy="${h / 2}" r="${h / 2 - 7}" fill="var(--panel)" stroke="var(--line-strong)"/>`);
    return `<rect width="${w}" height="${h}" rx="${h / 2}" ${BODY}/>${each.join('')}`;
  }),
  equipment('heater', 60, 60, (w, h) => `<rect width="${w}" height="${h}" ${BODY}/><path d="M6 ${h / 2}L${w * 0.25} ${h * 0.2}L${w * 0.42} ${h * 0.8}L${w * 0.58} ${h * 0.2}L${w * 0.75} ${h * 0.8}L${w - 6} ${h / 2}" fill="none" stroke="var(--line-strong)" stroke-width="2.5"/>`),
  {
    kind: 'gauge', family: 'values', width: 120, height: 120, fields: ['label', ...VALUE],
    draw: (p, w, h) => {
      const [x, y, r] = [w / 2, h / 2, Math.min(w, h) / 2 - 4];
      const at = (degrees: number) => `${(x + r * Math.cos((degrees * Math.PI) / 180)).toFixed(1)} ${(y + r * Math.sin((degrees * Math.PI) / 180)).toFixed(1)}`;
      const needle = `<circle cx="${x}" cy="${y}" r="${r}" fill="none"/><path d="M${x} ${y - r + 8}L${x + 4} ${y}H${x - 4}Z" fill="var(--text)"/>`;
      return (
        `<path d="M${at(135)}A${r} ${r} 0 1 1 ${at(45)}" fill="none" stroke="var(--equipment-dark)" stroke-width="8"/>` +
        `<g transform="rotate(-135 ${x} ${y})"><g${p.value ? `${attribute('data-turn', p.value)}${range(p)} data-degrees="270"` : ''}>${titled(p)}${needle}</g></g>` +
        `<circle cx="${x}" cy="${y}" r="5" fill="var(--line-strong)"/>` +
        valueText(p, x, y + r * 0.75, 'middle', 15)
      );
    },
    beside: below,
  },
  {
    kind: 'bar', family: 'values', width: 36, height: 140, fields: ['label', ...VALUE],
    draw: (p, w, h) =>
      `<rect width="${w}" height="${h}" fill="var(--panel)" stroke="var(--line)"/>` +
      (p.value ? `<rect x="2" y="2" width="${w - 4}" height="${h - 4}" fill="var(--liquid)"${attribute('data-fill', p.value)}${range(p)}>${titled(p)}</rect>` : '') +
      valueText(p, w / 2, -6, 'middle', 13),
    beside: below,
  },
  {
    kind: 'number', family: 'values', width: 150, height: 32, fields: ['label', 'value', 'digits', 'unit', 'alarm'],
    draw: (p, w, h) =>
      `<rect width="${w}" height="${h}" rx="4" fill="var(--panel)" stroke="var(--panel-edge)"${attribute('data-alarm', p.alarm)}/>` +
      (p.label ? `<text x="6" y="${h / 2 + 5}" font-size="13">${escaped(p.label)}</text>` : '') +
      valueText(p, w - 6, h / 2 + 5, 'end', 15),
  },
  {
    kind: 'text', family: 'values', width: 120, height: 24, fields: ['text', 'size'],
    draw: (p, _w, h) => `<text y="${h - 6}" font-size="${Number(p.size) || 16}">${escaped(p.text || 'Text')}</text>`,
  },
  {
    kind: 'lamp', family: 'values', width: 32, height: 32, fields: ['label', ...STATES],
    draw: (p, w, h) => `<ellipse cx="${w / 2}" cy="${h / 2}" rx="${w / 2}" ry="${h / 2}" ${BODY}${states(p)}>${titled(p)}</ellipse>`,
    beside: below,
  },
  {
    kind: 'box', family: 'values', width: 200, height: 120, fields: ['label'],
    draw: (p, w, h) => `<rect width="${w}" height="${h}" rx="4" fill="none" stroke="var(--line)" stroke-dasharray="6 4"/>${p.label ? `<text x="8" y="20" font-size="14">${escaped(p.label)}</text>` : ''}`,
  },
  {
    kind: 'picture', family: 'values', width: 160, height: 120, fields: ['picture'],
    draw: (p, w, h) => (p.picture ? `<image width="${w}" height="${h}" href="${escaped(p.picture)}"/>` : `<rect width="${w}" height="${h}" fill="none" stroke="var(--line)"/>`),
  },
];

const part = (kind: string, family: SymbolTemplate['family'], width: number, height: number, fields: SymbolTemplate['fields']): SymbolTemplate => ({
  kind,
  family,
  width,
  height,
  fields,
  draw: (p, w, h, called = byName) =>
    `<rect width="${w}" height="${h}" rx="6" fill="var(--panel)" ${isComplete(kind, p) ? 'stroke="var(--line-strong)"' : 'stroke="var(--line)" stroke-dasharray="6 4"'} stroke-width="2"/>` + partLabel(labelOf(p, called) || kind, w, h),
  attributes: (p, key) => partAttributes(kind, p, key),
});

const ASKS = ['confirm', 'least'] as const;
const PARTS: SymbolTemplate[] = [
  part('button', 'operator', 120, 44, ['label', 'write', 'literal', ...ASKS]),
  part('switch', 'operator', 160, 44, ['label', 'write', ...ASKS]),
  part('setpoint', 'operator', 180, 44, ['label', 'write', 'from', 'to', 'unit', ...ASKS]),
  part('slider', 'operator', 240, 56, ['label', 'write', 'from', 'to', 'step', 'unit', ...ASKS]),
  part('choice', 'operator', 240, 44, ['label', 'write', 'values', ...ASKS]),
  part('startstop', 'operator', 260, 44, ['label', 'write', 'stop', 'on', ...ASKS]),
  part('navigate', 'operator', 140, 44, ['label', 'go']),
  part('trend', 'lists', 360, 180, ['label', 'tags', 'minutes']),
  part('alarms', 'lists', 320, 140, ['label']),
  part('tags', 'lists', 260, 160, ['label', 'tags']),
];

export const SYMBOLS: readonly SymbolTemplate[] = [...SHAPES, ...PARTS];
export const FAMILIES = ['equipment', 'values', 'operator', 'lists'] as const;

export const templateOf = (kind: string): SymbolTemplate | undefined => SYMBOLS.find((each) => each.kind === kind);

// What a new one begins with.
const USUAL: Params = { from: '0', to: '100', literal: 'TRUE', minutes: '5', size: '16', arrow: 'end', points: '0,0 120,0' };
export function usualOf(kind: string): Params {
  return Object.fromEntries((templateOf(kind)?.fields ?? []).flatMap((field) => (USUAL[field] ? [[field, USUAL[field]]] : [])));
}
