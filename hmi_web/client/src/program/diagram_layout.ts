// Where the elements of a drawing stand on the page, in px: as in the file, stretched until their texts fit.

import type { Diagram, DrawnElement, Pin } from './document';

const LETTER = 7.3;
const ROW = 20;
const HEAD = 30; // of a block: its type
const MARGIN = 24;
const MOST_STRETCH = 6;

export interface PlacedPin {
  pin: Pin;
  x: number;
  y: number;
}

export interface PlacedElement {
  element: DrawnElement;
  index: number;
  x: number;
  y: number;
  width: number;
  height: number;
  inputs: PlacedPin[];
  outputs: PlacedPin[];
}

export interface PlacedWire {
  points: string;
  from: number; // element
  output: string;
  label: [x: number, y: number]; // where its value stands
}

export interface DiagramLayout {
  width: number;
  height: number;
  elements: PlacedElement[];
  wires: PlacedWire[];
}

const longest = (pins: Pin[]) => Math.max(0, ...pins.map((pin) => pin.name.length)) * LETTER;

function needs(element: DrawnElement): [number, number] {
  if (element.kind === 'block') {
    const width = Math.max(element.name.length * LETTER + 16, longest(element.inputs) + longest(element.outputs) + 28);
    return [width, HEAD + ROW * Math.max(element.inputs.length, element.outputs.length, 1)];
  }
  if (element.kind.endsWith('PowerRail')) return [6, 20];
  return [Math.max(30, element.name.length * LETTER + 16), 24];
}

// How much all must grow so that each has room, at most MOST_STRETCH.
function stretch(diagram: Diagram): [number, number] {
  let [x, y] = [1, 1];
  for (const element of diagram.elements) {
    const [width, height] = needs(element);
    if (!element.size || element.kind === 'comment') continue;
    if (element.size[0] > 0) x = Math.max(x, width / element.size[0]);
    if (element.size[1] > 0) y = Math.max(y, height / element.size[1]);
  }
  return [Math.min(x, MOST_STRETCH), Math.min(y, MOST_STRETCH)];
}

export function layOutDiagram(diagram: Diagram): DiagramLayout {
  const [sx, sy] = stretch(diagram);
  const left = Math.min(0, ...diagram.elements.map((one) => one.at[0]));
  const top = Math.min(0, ...diagram.elements.map((one) => one.at[1]));
  const toX = (x: number) => Math.round((x - left) * sx) + MARGIN;
  const toY = (y: number) => Math.round((y - top) * sy) + MARGIN;

  const elements = diagram.elements.map((element, index): PlacedElement => {
    const [x, y] = [toX(element.at[0]), toY(element.at[1])];
    const need = needs(element);
    const width = Math.round(Math.max(need[0], (element.size?.[0] ?? 0) * sx));
    const height = Math.round(Math.max(need[1], (element.size?.[1] ?? 0) * sy));
    const row = (i: number) => (element.kind === 'block' ? y + HEAD + ROW * i + ROW / 2 : y + height / 2);
    // Places of the file hold for pins that have one: at the side where they belong, and inside.
    const place = (pin: Pin, i: number, right: boolean): PlacedPin => {
      const own = pin.at ? y + Math.round(pin.at[1] * sy) : row(i);
      return { pin, x: right ? x + width : x, y: own >= y && own <= y + height ? own : row(i) };
    };
    return {
      element, index, x, y, width, height,
      inputs: element.inputs.map((pin, i) => place(pin, i, false)),
      outputs: element.outputs.map((pin, i) => place(pin, i, true)),
    };
  });

  const wires: PlacedWire[] = [];
  for (const consumer of elements) {
    for (const input of consumer.inputs) {
      for (const { from, output, path } of input.pin.connections) {
        const producer = elements[from];
        if (!producer) continue;
        const pin = producer.outputs.find((one) => one.pin.name.toUpperCase() === output.toUpperCase()) ?? producer.outputs[0];
        const begin: [number, number] = pin ? [pin.x, pin.y] : [producer.x + producer.width, producer.y + producer.height / 2];
        const end: [number, number] = [input.x, input.y];
        const knee = end[0] - Math.max(8, Math.min(16, (end[0] - begin[0]) / 2));
        // Of a path of the file only the columns in between are kept: its ends moved with the texts.
        const bends = path.slice(1, -1).map((point) => toX(point[0]));
        const column = bends.length > 0 ? (bends[0] ?? knee) : knee;
        const back = end[0] < begin[0];
        const below = Math.max(producer.y + producer.height, consumer.y + consumer.height) + 12;
        const points: [number, number][] = back
          ? [begin, [begin[0] + 10, begin[1]], [begin[0] + 10, below], [end[0] - 10, below], [end[0] - 10, end[1]], end]
          : [begin, [column, begin[1]], [column, end[1]], end];
        wires.push({ points: points.map((point) => point.join(',')).join(' '), from, output, label: [begin[0] + 5, begin[1] - 5] });
      }
    }
  }
  const width = Math.max(0, ...elements.map((one) => one.x + one.width)) + 4 * MARGIN;
  const height = Math.max(0, ...elements.map((one) => one.y + one.height)) + MARGIN;
  return { width, height, elements, wires };
}
