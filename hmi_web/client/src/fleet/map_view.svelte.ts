// Which part of a floor is seen, and what moves it: keys, the wheel, one finger or two. A panel makes one and hands it to FloorView,
// which shows it, and to FloorTools, whose buttons do the same.

import { Gestures } from './gestures';
import { fit, keepInSight, pan, zoomAt, type Bounds, type View } from './view';

const KEY_PX = 60;
const KEY_ZOOM = 1.3;
const LEAST_PX = 220; // high
const MOST_PX = 720;
const STILL_MS = 200;

export class MapView {
  width = $state(0);
  // Where somebody has moved or zoomed to; null: everything is seen.
  moved = $state.raw<View | null>(null);
  // While the view moves, vehicles jump with the floor instead of gliding behind it.
  still = $state(true);
  readonly gestures: Gestures;
  private readonly boundsOf: () => Bounds;
  private stillTimer = 0;

  constructor(boundsOf: () => Bounds) {
    this.boundsOf = boundsOf;
    this.gestures = new Gestures({
      pan: (dx, dy) => this.look(pan(this.view, dx, dy)),
      zoom: (factor, x, y) => this.zoom(factor, x, y),
    });
  }

  readonly bounds = $derived.by(() => this.boundsOf());
  readonly height = $derived.by(() => {
    const { low, high } = this.bounds;
    const aspect = (high[1] - low[1]) / Math.max(high[0] - low[0], 1);
    return Math.round(Math.min(Math.max(this.width * aspect, LEAST_PX), MOST_PX));
  });
  readonly whole = $derived.by(() => fit(this.bounds, Math.max(this.width, 100), this.height));
  readonly view = $derived.by(() => this.moved ?? this.whole);

  hold(): void {
    this.still = true;
    window.clearTimeout(this.stillTimer);
    this.stillTimer = window.setTimeout(() => (this.still = false), STILL_MS);
  }

  // Null: everything.
  show(next: View | null): void {
    this.moved = next;
    this.hold();
  }

  look(next: View): void {
    this.show(keepInSight(next, this.bounds, this.width, this.height));
  }

  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    this.look(zoomAt(this.view, this.whole, factor, x, y));
  }

  nearer(): void {
    this.zoom(KEY_ZOOM);
  }

  further(): void {
    this.zoom(1 / KEY_ZOOM);
  }

  private readonly keys: Record<string, () => void> = {
    '+': () => this.nearer(),
    '=': () => this.nearer(),
    '-': () => this.further(),
    '0': () => this.show(null),
    ArrowLeft: () => this.look(pan(this.view, KEY_PX, 0)),
    ArrowRight: () => this.look(pan(this.view, -KEY_PX, 0)),
    ArrowUp: () => this.look(pan(this.view, 0, KEY_PX)),
    ArrowDown: () => this.look(pan(this.view, 0, -KEY_PX)),
  };

  key(event: KeyboardEvent): void {
    const act = this.keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  }

  // The page scrolls over the floor until somebody turns to it.
  wheel(event: WheelEvent): void {
    const inside = event.currentTarget as HTMLElement;
    if (!event.ctrlKey && !inside.contains(document.activeElement)) return;
    event.preventDefault();
    const box = inside.getBoundingClientRect();
    this.zoom(Math.exp(-event.deltaY / 500), event.clientX - box.left, event.clientY - box.top);
  }
}
