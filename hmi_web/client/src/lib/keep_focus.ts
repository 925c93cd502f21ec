// Whoever goes by keys keeps a place: when what has the focus goes away, because it was acknowledged, released or removed, the
// focus goes to what stands nearest to where it was, and not to the top of the page. What is returned ends it.

const FOCUSABLE = 'button:not(:disabled), input:not(:disabled), select:not(:disabled), textarea:not(:disabled), a[href], [tabindex="0"]';

// Of the element that had the focus and of all around it: where each stood.
type Place = { parent: Element; index: number }[];

function placeOf(element: Element): Place {
  const place: Place = [];
  for (let at = element; at.parentElement && at !== document.body; at = at.parentElement)
    place.push({ parent: at.parentElement, index: [...at.parentElement.children].indexOf(at) });
  return place;
}

// The order in which neighbours are looked at: what has moved up into the place, what follows, then what stands before.
export function neighbours(index: number, count: number): number[] {
  const behind = Array.from({ length: Math.max(0, count - index) }, (_, i) => index + i);
  const before = Array.from({ length: Math.min(index, count) }, (_, i) => Math.min(index, count) - 1 - i);
  return [...behind, ...before];
}

function nearest(place: Place): HTMLElement | null {
  for (const { parent, index } of place) {
    if (!parent.isConnected) continue;
    for (const i of neighbours(index, parent.children.length)) {
      const child = parent.children[i];
      const found = child?.matches(FOCUSABLE) ? child : child?.querySelector(FOCUSABLE);
      if (found instanceof HTMLElement && found.checkVisibility()) return found;
    }
  }
  return null;
}

export function keepFocus(): () => void {
  let last: HTMLElement | null = null;
  let place: Place = [];
  let outside: Place = []; // of the page around a dialog, while that has the focus
  let waits = false; // it cannot be used for a moment

  const isAnywhere = (): boolean => document.activeElement !== null && document.activeElement !== document.body && document.activeElement !== last;
  const enter = (event: FocusEvent): void => {
    if (!(event.target instanceof HTMLElement)) return;
    last = event.target;
    waits = false;
    place = placeOf(last);
    if (!last.closest('dialog')) outside = place;
  };
  // By a click beside it: that was meant.
  const leave = (): void =>
    queueMicrotask(() => {
      if (last?.isConnected && !last.matches(':disabled') && document.activeElement === document.body) last = null;
    });
  const look = (): void => {
    if (!last || isAnywhere()) return;
    if (last.isConnected) {
      const disabled = last.matches(':disabled');
      if (waits && !disabled && document.activeElement === document.body) last.focus({ preventScroll: true });
      waits = disabled;
      return;
    }
    const dialog = place.find(({ parent }) => parent.matches('dialog'));
    const next = nearest(dialog && !dialog.parent.isConnected ? outside : place);
    last = null;
    next?.focus();
  };

  const changed = new MutationObserver(look);
  changed.observe(document.body, { subtree: true, childList: true, attributes: true, attributeFilter: ['disabled'] });
  document.addEventListener('focusin', enter);
  document.addEventListener('focusout', leave);
  return () => {
    changed.disconnect();
    document.removeEventListener('focusin', enter);
    document.removeEventListener('focusout', leave);
  };
}
