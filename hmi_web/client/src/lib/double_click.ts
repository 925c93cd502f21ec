// The second click of a double click means what the first one meant. Where another control lies under the pointer by then, since a
// dialog has opened or closed there, it is a stray one: nobody has aimed at that.

const DOUBLE_MS = 500; // as long as most systems wait for the second click
const NEAR_PX = 10;
const CONTROLS = ['button', 'a', 'input', 'select', 'textarea', 'summary', 'label', '[role=button]', '[role=switch]'].join();

interface Click {
  at: number; // ms
  x: number;
  y: number;
  control: unknown;
}

export class DoubleClicks {
  private last: Click | null = null;

  // Somebody has done something else meanwhile: the next click is one of its own.
  forget(): void {
    this.last = null;
  }

  // Each click of the pointer once. `control`: what lies under it; null: nothing that acts.
  isStray(click: Click): boolean {
    const { last } = this;
    const near = last !== null && Math.abs(click.x - last.x) <= NEAR_PX && Math.abs(click.y - last.y) <= NEAR_PX;
    const stray = near && click.control !== last.control && click.at - last.at <= DOUBLE_MS;
    // A third one means what the first one meant, too.
    this.last = stray ? { ...click, control: last.control } : click;
    return stray;
  }
}

// The same control pressed again within a double click is pressed once.
export class Once {
  private last: { at: number; control: unknown } | null = null;

  isFirst(control: unknown, now = performance.now()): boolean {
    const again = this.last !== null && this.last.control === control && now - this.last.at <= DOUBLE_MS;
    if (!again) this.last = { at: now, control };
    return !again;
  }
}

// A label stands for what it labels, whose click follows at once.
function controlOf(target: EventTarget | null): Element | null {
  const control = target instanceof Element ? target.closest(CONTROLS) : null;
  return control instanceof HTMLLabelElement ? (control.control ?? control) : control;
}

// On the whole page, from now on. What is pressed by a key is meant.
export function ignoreStrayClicks(page: Window): void {
  const clicks = new DoubleClicks();
  page.addEventListener('keydown', () => clicks.forget(), true);
  page.addEventListener(
    'click',
    (event) => {
      if (event.detail === 0) return;
      if (!clicks.isStray({ at: event.timeStamp, x: event.clientX, y: event.clientY, control: controlOf(event.target) })) return;
      event.preventDefault();
      event.stopImmediatePropagation();
    },
    true,
  );
}

// A key that is held down presses a button again and again.
export function ignoreHeldKey(event: KeyboardEvent): void {
  if (event.repeat && (event.key === 'Enter' || event.key === ' ') && controlOf(event.target) instanceof HTMLButtonElement) event.preventDefault();
}
