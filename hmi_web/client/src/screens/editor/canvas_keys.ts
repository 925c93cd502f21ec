// What the keys do with what is chosen in a drawing, and with a line while it is drawn.

import { grouped, moved, ordered, snapped, stepped, ungrouped } from './arrange';
import type { DrawingBoard } from './drawing_board.svelte';
import { sized, turned } from './sizing';
import { templateOf } from './symbols';

const ARROWS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

const COMMANDS: Record<string, (board: DrawingBoard) => void> = {
  z: (board) => board.undo(),
  y: (board) => board.redo(),
  c: (board) => board.copy(),
  x: (board) => board.cut(),
  v: (board) => board.paste(),
  d: (board) => board.double(),
  a: (board) => board.choose(board.content.items.map(({ key }) => key)),
  g: (board) => {
    const { content, chosen, selection } = board;
    board.setItems(selection.every(({ group }) => group !== '') ? ungrouped(content.items, chosen) : grouped(content.items, chosen));
  },
};

// False: it is none of ours.
function lineKey(board: DrawingBoard, event: KeyboardEvent): boolean {
  const { line } = board;
  if (!line) return false;
  const arrow = ARROWS[event.key];
  const step = event.shiftKey ? 1 : Math.max(1, board.grid);
  if (arrow) board.aimLine({ x: snapped(line.next.x, event.shiftKey ? 0 : board.grid) + arrow[0] * step, y: snapped(line.next.y, event.shiftKey ? 0 : board.grid) + arrow[1] * step });
  else if (event.key === ' ') board.addPoint();
  else if (event.key === 'Backspace') board.takeBackPoint();
  else if (event.key === 'Enter') {
    board.addPoint();
    board.endLine();
  } else if (event.key === 'Escape') board.endLine();
  else return false;
  return true;
}

function arrowKey(board: DrawingBoard, [x, y]: [number, number], event: KeyboardEvent): void {
  const { items } = board.content;
  const step = event.shiftKey ? 1 : Math.max(1, board.grid);
  const deed = `keys ${event.ctrlKey} ${[...board.chosen].join()}`;
  if (!event.ctrlKey && !event.metaKey) return board.setItems(moved(items, board.chosen, x * step, y * step), deed);
  const grip = x !== 0 ? 'e' : 's';
  board.setItems(items.map((item) => (board.chosen.has(item.key) && item.symbol !== 'drawn' ? sized(item, grip, x * step, y * step, 0) : item)), deed);
}

// With Ctrl, wherever the focus is: what is chosen in the drawing is meant. False: it is none of ours.
export function commandKey(board: DrawingBoard, event: KeyboardEvent): boolean {
  const name = event.key.toLowerCase();
  const command = event.ctrlKey || event.metaKey ? COMMANDS[name] : undefined;
  if (!command) return false;
  if (event.shiftKey && name === 'z') board.redo();
  else command(board);
  return true;
}

export function canvasKey(board: DrawingBoard, event: KeyboardEvent, onEdit: () => void): boolean {
  if (lineKey(board, event)) return true;
  const { items } = board.content;
  const name = event.key.toLowerCase();
  const focused = event.target instanceof SVGElement ? (event.target.dataset.item ?? '') : '';
  const arrow = ARROWS[event.key];
  if (commandKey(board, event)) return true;
  if (arrow && board.chosen.size > 0) arrowKey(board, arrow, event);
  else if (event.key === 'Delete' && board.chosen.size > 0) board.remove();
  else if (event.key === 'PageUp') board.setItems(event.shiftKey ? stepped(items, board.chosen, 1) : ordered(items, board.chosen, 'front'));
  else if (event.key === 'PageDown') board.setItems(event.shiftKey ? stepped(items, board.chosen, -1) : ordered(items, board.chosen, 'back'));
  else if (name === 'r' && board.chosen.size > 0 && !event.ctrlKey && !event.metaKey) board.setItems(items.map((item) => (board.chosen.has(item.key) && templateOf(item.symbol)?.turns ? turned(item) : item)));
  else if (event.key === ' ' && focused !== '') board.toggle(focused);
  else if (event.key === 'Enter') onEdit();
  else if (event.key === 'Escape' && board.chosen.size > 0) board.choose([]);
  else return false;
  return true;
}
