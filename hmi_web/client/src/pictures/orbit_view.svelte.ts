// From where a cell of arms is seen, and what changes that: keys, the wheel, one finger or two, and buttons for the usual sights.

import { Gestures } from '../fleet/gestures';
import { between, fitted, orbited, panned, zoomed, type Orbit, type Sight } from './orbit';
import type { Vector } from './space';

const KEY_RAD = Math.PI / 24;
const KEY_PX = 40;
const KEY_ZOOM = 1.25;
const PIXEL_RAD = 0.008;
const GLIDE_MS = 350;

export class OrbitView {
  width = $state(0);
  height = $derived.by(() => Math.round(Math.min(Math.max(this.width * 0.72, 260), 560)));
  // Where somebody has turned to; null: as the sight says.
  moved = $state.raw<Orbit | null>(null);
  sight = $state<Sight>('corner');
  readonly gestures: Gestures;
  private shifts = false; // a pointer moves the picture instead of turning it
  private glide = 0;

  // `points`: what is to be in sight.
  constructor(private readonly points: () => readonly Vector[]) {
    this.gestures = new Gestures({
      pan: (dx, dy) => this.look(this.shifts ? panned(this.orbit, dx, dy) : orbited(this.orbit, -PIXEL_RAD * dx, PIXEL_RAD * dy)),
      zoom: (factor, x, y) => this.zoom(factor, x - this.width / 2, y - this.height / 2),
    });
  }

  readonly whole = $derived.by(() => fitted(this.sight, this.points(), Math.max(this.width, 100), this.height));
  readonly orbit = $derived.by(() => this.moved ?? this.whole);

  look(next: Orbit): void {
    cancelAnimationFrame(this.glide);
    this.moved = next;
  }

  // Glides there, unless people want no motion.
  show(sight: Sight): void {
    const from = this.orbit;
    this.sight = sight;
    cancelAnimationFrame(this.glide);
    if (window.matchMedia('(prefers-reduced-motion: reduce)').matches) {
      this.moved = null;
      return;
    }
    const begun = performance.now();
    const step = () => {
      const share = (performance.now() - begun) / GLIDE_MS;
      this.moved = share < 1 ? between(from, this.whole, share * share * (3 - 2 * share)) : null;
      if (share < 1) this.glide = requestAnimationFrame(step);
    };
    this.moved = from;
    this.glide = requestAnimationFrame(step);
  }

  zoom(factor: number, x = 0, y = 0): void {
    this.look(zoomed(this.orbit, this.whole.scale, factor, x, y));
  }

  nearer(): void {
    this.zoom(KEY_ZOOM);
  }

  further(): void {
    this.zoom(1 / KEY_ZOOM);
  }

  private arrow(dx: number, dy: number, shifts: boolean): void {
    this.look(shifts ? panned(this.orbit, -KEY_PX * dx, -KEY_PX * dy) : orbited(this.orbit, KEY_RAD * dx, -KEY_RAD * dy));
  }

  private readonly keys: Record<string, (shifts: boolean) => void> = {
    '+': () => this.nearer(),
    '=': () => this.nearer(),
    '-': () => this.further(),
    '0': () => this.show('corner'),
    ArrowLeft: (shifts) => this.arrow(-1, 0, shifts),
    ArrowRight: (shifts) => this.arrow(1, 0, shifts),
    ArrowUp: (shifts) => this.arrow(0, -1, shifts),
    ArrowDown: (shifts) => this.arrow(0, 1, shifts),
  };

  key(event: KeyboardEvent): void {
    const act = this.keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(event.shiftKey);
  }

  move(event: PointerEvent): void {
    this.shifts = event.shiftKey;
    this.gestures.move(event);
  }

  // The page scrolls over the picture until somebody turns to it.
  wheel(event: WheelEvent): void {
    const inside = event.currentTarget as HTMLElement;
    if (!event.ctrlKey && !inside.contains(document.activeElement)) return;
    event.preventDefault();
    const box = inside.getBoundingClientRect();
    this.zoom(Math.exp(-event.deltaY / 500), event.clientX - box.left - this.width / 2, event.clientY - box.top - this.height / 2);
  }

  end(): void {
    cancelAnimationFrame(this.glide);
  }
}
