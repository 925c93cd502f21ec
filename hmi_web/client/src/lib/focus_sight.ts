// Panels grow while a run goes on, and push down what stands below them. Whoever goes by keys keeps in sight what has the
// focus; who has scrolled away from it is left alone. What is returned ends it.
export function keepFocusInSight(): () => void {
  let seen = false;
  const focused = (): Element | null => {
    const element = document.activeElement;
    return element && element !== document.body && element.matches(':focus-visible') ? element : null;
  };
  const look = (): void => {
    const box = focused()?.getBoundingClientRect();
    seen = box !== undefined && box.bottom > 0 && box.top < window.innerHeight;
  };
  const grown = new ResizeObserver(() => {
    const before = seen;
    look();
    if (before && !seen) focused()?.scrollIntoView({ block: 'nearest' });
    look();
  });
  grown.observe(document.body);
  document.addEventListener('focusin', look);
  document.addEventListener('scroll', look, { passive: true });
  return () => {
    grown.disconnect();
    document.removeEventListener('focusin', look);
    document.removeEventListener('scroll', look);
  };
}
