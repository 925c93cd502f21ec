// Tells elements whether they are in sight or nearly so: of long programs only that is drawn.

const MARGIN = '900px';
const told = new WeakMap<Element, (near: boolean) => void>();
let observer: IntersectionObserver | undefined;

// Returns how to stop it.
export function watchNearby(element: Element, tell: (near: boolean) => void): () => void {
  observer ??= new IntersectionObserver(
    (entries) => {
      for (const entry of entries) told.get(entry.target)?.(entry.isIntersecting);
    },
    { rootMargin: MARGIN },
  );
  told.set(element, tell);
  observer.observe(element);
  return () => {
    told.delete(element);
    observer?.unobserve(element);
  };
}
