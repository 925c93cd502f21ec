// The colours of a cell of arms, those of the page now: read again when people choose others.

import type { Ink } from './arms_lines';
import type { Colour, Palette } from './arms_scene';

const style = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// "#rrggbb"; grey for anything else.
export function colourOf(text: string): Colour {
  const found = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(text);
  return found ? [parseInt(found[1]!, 16), parseInt(found[2]!, 16), parseInt(found[3]!, 16)] : [128, 128, 128];
}

export const mixed = (a: Colour, b: Colour, share: number): Colour => [0, 1, 2].map((k) => Math.round(a[k]! + share * (b[k]! - a[k]!))) as unknown as Colour;

const ARMS = ['--series-3', '--series-2'];

// Grey bodies; arms are told apart by a tinge, what a hand holds is active.
export function paletteNow(): Palette {
  const named = (name: string) => colourOf(style(name));
  const body = named('--equipment-dark');
  return {
    background: named('--page'),
    fixed: named('--equipment'),
    arms: ARMS.map((name) => mixed(body, named(name), 0.38)),
    thing: named('--liquid'),
    held: named('--active'),
    edge: named('--line-strong'),
  };
}

export function inkNow(): Ink {
  return {
    text: style('--text'),
    halo: style('--panel'),
    surface: style('--line'),
    ahead: style('--active-edge'),
    behind: style('--line'),
    driven: ARMS.map(style),
    near: style('--warn'),
    seen: style('--text-soft'),
  };
}
