// The corners of a rectangle on a floor, as somebody has typed its sides.

import { readNumber } from '../lib/number_input';

export interface Sides {
  west: string;
  east: string;
  south: string;
  north: string;
}

export type SidesProblem = { key: 'noNumber'; text: string } | { key: 'xTurned' | 'yTurned' };

export function cornersOf(sides: Sides): { corners: number[][] } | { problem: SidesProblem } {
  const numbers: number[] = [];
  for (const text of [sides.west, sides.east, sides.south, sides.north]) {
    const value = readNumber(text);
    if (value === null) return { problem: { key: 'noNumber', text: text.trim() } };
    numbers.push(value);
  }
  const [left = 0, right = 0, low = 0, high = 0] = numbers;
  if (left >= right) return { problem: { key: 'xTurned' } };
  if (low >= high) return { problem: { key: 'yTurned' } };
  return { corners: [[left, low], [right, low], [right, high], [left, high]] };
}
