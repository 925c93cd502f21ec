// What is drawn over the solids of a cell of arms: ways, where tools have been, the distance of the arms, and names.

import type { Distance, SeenThing } from './arms';
import type { Surface } from './arms_document';
import { moved, type Vector } from './space';

// A point of the cell in the picture; `hidden`: something is in front of it.
export type Sighted = (point: Vector) => { x: number; y: number; hidden: boolean };

export interface Ink {
  text: string;
  halo: string;
  surface: string;
  ahead: string;
  behind: string;
  driven: string[]; // of each arm
  near: string; // the distance of arms
  seen: string;
}

export interface Lines {
  surfaces: Surface[];
  ways: { behind: Vector[]; ahead: Vector[] }[];
  trails: readonly Vector[][];
  distance: { line: Distance; text: string } | null;
  seen: SeenThing[];
  names: { text: string; at: Vector }[];
}

const HIDDEN = 0.28;
const RING_M = 0.055;
const RING_SIDES = 20;
const WORD_PX = 13; // high

type Canvas = CanvasRenderingContext2D;

interface Stroke {
  colour: string;
  width: number;
  dash?: number[];
}

// Parts that something hides are faint.
function line(canvas: Canvas, points: readonly Vector[], sighted: Sighted, { colour, width, dash = [] }: Stroke): void {
  const there = points.map(sighted);
  canvas.strokeStyle = colour;
  canvas.lineWidth = width;
  canvas.setLineDash(dash);
  for (let k = 1, from = 0; k < there.length; k++) {
    const hidden = there[from]!.hidden;
    if (k + 1 < there.length && there[k]!.hidden === hidden) continue;
    canvas.globalAlpha = hidden ? HIDDEN : 1;
    canvas.beginPath();
    there.slice(from, k + 1).forEach(({ x, y }, index) => (index === 0 ? canvas.moveTo(x, y) : canvas.lineTo(x, y)));
    canvas.stroke();
    from = k;
  }
  canvas.globalAlpha = 1;
  canvas.setLineDash([]);
}

interface Word {
  x: number;
  y: number;
  half: number;
}

// Not over another one: who looks nearer sees them all.
function word(canvas: Canvas, text: string, x: number, y: number, { text: colour, halo }: Ink, words: Word[], weight = ''): void {
  canvas.font = `${weight} 12px system-ui, sans-serif`;
  const half = canvas.measureText(text).width / 2;
  if (words.some((other) => Math.abs(other.x - x) < other.half + half && Math.abs(other.y - y) < WORD_PX)) return;
  words.push({ x, y, half });
  canvas.lineWidth = 3.5;
  canvas.strokeStyle = halo;
  canvas.fillStyle = colour;
  canvas.strokeText(text, x, y);
  canvas.fillText(text, x, y);
}

function outline({ place, size: [x, y] }: Surface): Vector[] {
  const corner = (i: number, j: number) => moved(place, [(i * x) / 2, (j * y) / 2, 0.001]);
  return [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), corner(-1, -1)];
}

// Around the foot of what the camera reports.
function seenRing(canvas: Canvas, { at: [x, y, z] }: SeenThing, sighted: Sighted, ink: Ink): void {
  const points = Array.from({ length: RING_SIDES + 1 }, (_, k): Vector => {
    const angle = (2 * Math.PI * k) / RING_SIDES;
    return [x + RING_M * Math.cos(angle), y + RING_M * Math.sin(angle), z + 0.001];
  });
  line(canvas, points, sighted, { colour: ink.seen, width: 1.6, dash: [3, 2] });
}

export function drawLines(canvas: Canvas, lines: Lines, sighted: Sighted, ink: Ink): void {
  canvas.lineJoin = canvas.lineCap = 'round';
  canvas.textAlign = 'center';
  for (const surface of lines.surfaces) line(canvas, outline(surface), sighted, { colour: ink.surface, width: 1, dash: [4, 3] });
  for (const { behind, ahead } of lines.ways) {
    line(canvas, behind, sighted, { colour: ink.behind, width: 1 });
    line(canvas, ahead, sighted, { colour: ink.ahead, width: 1.4 });
  }
  lines.trails.forEach((trail, arm) => line(canvas, trail, sighted, { colour: ink.driven[arm % ink.driven.length] ?? ink.text, width: 3.2 }));
  for (const one of lines.seen) seenRing(canvas, one, sighted, ink);
  const words: Word[] = [];
  if (lines.distance) distance(canvas, lines.distance, sighted, ink, words);
  for (const { text, at } of lines.names) {
    const { x, y } = sighted(at);
    word(canvas, text, x, y - 6, ink, words);
  }
}

function distance(canvas: Canvas, { line: near, text }: NonNullable<Lines['distance']>, sighted: Sighted, ink: Ink, words: Word[]): void {
  const [from, to] = [sighted(near.from), sighted(near.to)];
  canvas.strokeStyle = ink.near;
  canvas.lineWidth = 2;
  canvas.beginPath();
  canvas.moveTo(from.x, from.y);
  canvas.lineTo(to.x, to.y);
  canvas.stroke();
  canvas.fillStyle = ink.near;
  for (const { x, y } of [from, to]) {
    canvas.beginPath();
    canvas.arc(x, y, 3, 0, 2 * Math.PI);
    canvas.fill();
  }
  word(canvas, text, (from.x + to.x) / 2, (from.y + to.y) / 2 - 6, ink, words, '700');
}
