// Moving with one pointer, zooming with two. A click that was a movement is none.

export interface Look {
  pan(dx: number, dy: number): void;
  zoom(factor: number, x: number, y: number): void;
}

// A finger that taps is not quite still.
const STILL_PX = 5;

interface Finger {
  x: number;
  y: number;
}

export class Gestures {
  private readonly fingers = new Map<number, Finger>();
  private way = 0;
  private dragged = false;

  constructor(private readonly look: Look) {}

  down(event: PointerEvent): void {
    if (event.button !== 0) return;
    if (this.fingers.size === 0) {
      this.way = 0;
      this.dragged = false;
    }
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  move(event: PointerEvent): void {
    const finger = this.fingers.get(event.pointerId);
    if (!finger) return;
    const dx = event.clientX - finger.x;
    const dy = event.clientY - finger.y;
    this.way += Math.hypot(dx, dy);
    if (!this.dragged && this.way < STILL_PX) return;
    const target = event.currentTarget as HTMLElement;
    if (!this.dragged) target.setPointerCapture(event.pointerId);
    this.dragged = true;
    const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) this.pinch(finger, event, other, target);
    else this.look.pan(dx, dy);
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  up(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
  }

  swallow(event: MouseEvent): void {
    if (this.dragged) event.stopPropagation();
    this.dragged = false;
  }

  private pinch(before: Finger, event: PointerEvent, other: Finger, target: HTMLElement): void {
    const box = target.getBoundingClientRect();
    const was = Math.hypot(before.x - other.x, before.y - other.y);
    const is = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    if (was < 1) return;
    this.look.zoom(is / was, (event.clientX + other.x) / 2 - box.left, (event.clientY + other.y) / 2 - box.top);
    this.look.pan((event.clientX - before.x) / 2, (event.clientY - before.y) / 2);
  }
}
