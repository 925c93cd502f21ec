// Where the chart is scrolled to while it follows the run: every active step if they fit into the view, else those
// that became active last, else the lowest of these. A step that waits long for another branch does not hold the
// view back.

export interface Frame {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

// Which steps became active last.
export class Newest {
  private before = new Set<string>();
  private newest: string[] = [];

  of(active: string[]): string[] {
    const fresh = active.filter((step) => !this.before.has(step));
    const still = this.newest.filter((step) => active.includes(step));
    this.newest = fresh.length > 0 ? fresh : still.length > 0 ? still : active;
    this.before = new Set(active);
    return this.newest;
  }
}

// The part of the chart to be centred in a view of that size. `newest` is a part of `active`, not empty.
export function focusOf(active: Frame[], newest: Frame[], width: number, height: number): Frame {
  for (const candidate of [hull(active), hull(newest)]) {
    if (candidate.right - candidate.left <= width && candidate.bottom - candidate.top <= height) return candidate;
  }
  return newest.reduce((lowest, frame) => (frame.bottom > lowest.bottom ? frame : lowest));
}

function hull(frames: Frame[]): Frame {
  return {
    left: Math.min(...frames.map((frame) => frame.left)),
    top: Math.min(...frames.map((frame) => frame.top)),
    right: Math.max(...frames.map((frame) => frame.right)),
    bottom: Math.max(...frames.map((frame) => frame.bottom)),
  };
}
