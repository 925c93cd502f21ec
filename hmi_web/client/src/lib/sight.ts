// Which elements can be seen in a region that scrolls, or nearly: what comes into sight next is there already.

const AROUND_PX = 120;

export class Sight {
  private observer: IntersectionObserver | null = null;
  private readonly names = new Map<Element, number>();

  // `room`: the region, once it is there. `changed` is called with the number of an element.
  constructor(
    private readonly room: () => Element | undefined,
    private readonly changed: (name: number, seen: boolean) => void,
  ) {}

  // An action: use:sight.watch={number}.
  readonly watch = (element: Element, name: number) => {
    this.names.set(element, name);
    // The region is bound when its content is there.
    queueMicrotask(() => {
      if (this.names.has(element)) this.observe(element);
    });
    return {
      update: (next: number) => {
        this.tell(element, false);
        this.names.set(element, next);
        this.observer?.unobserve(element);
        this.observe(element);
      },
      destroy: () => {
        this.observer?.unobserve(element);
        this.tell(element, false);
        this.names.delete(element);
      },
    };
  };

  end(): void {
    this.observer?.disconnect();
    this.names.clear();
  }

  private observe(element: Element): void {
    const root = this.room();
    if (!root) return;
    this.observer ??= new IntersectionObserver(
      (entries) => entries.forEach((entry) => this.tell(entry.target, entry.isIntersecting)),
      { root, rootMargin: `${AROUND_PX}px 0px` },
    );
    this.observer.observe(element);
  }

  private tell(element: Element, seen: boolean): void {
    const name = this.names.get(element);
    if (name !== undefined) this.changed(name, seen);
  }
}
