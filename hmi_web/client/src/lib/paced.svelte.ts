// Something that changes often, looked at no more often than its reader can follow; the last change is always seen.

import { untrack } from 'svelte';

export class Paced {
  // Grows with each look.
  version = $state(0);
  private at = -Infinity;
  private timer = 0;

  // `changed` reads what changes; `pace` is read at each change. For the time of a component.
  constructor(changed: () => unknown, pace: () => number) {
    $effect(() => {
      void changed();
      const rest = pace() - (performance.now() - this.at);
      if (rest <= 0) this.look();
      else this.timer ||= window.setTimeout(() => this.look(), rest);
    });
    $effect(() => () => window.clearTimeout(this.timer));
  }

  private look(): void {
    window.clearTimeout(this.timer);
    this.timer = 0;
    this.at = performance.now();
    this.version = untrack(() => this.version) + 1;
  }
}
