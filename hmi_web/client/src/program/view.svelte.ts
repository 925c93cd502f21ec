// What the panel looks at: a sheet in one of its instances, a variable, and the values of one scan.

import type { Cell } from '../lib/cell.svelte';
import type { TagValue } from '../lib/protocol';
import type { Sheet, Sources, Use } from './document';
import { lookupOf, type LiveOf } from './lines';
import { flowOf, type RungFlow } from './power';
import { instancesOf, Scope, TagTable } from './scope';
import { declarationOf, type Place } from './uses';

const MOST_STEPS_BACK = 50;
const LIBRARY_OUTPUTS = ['Q', 'Q1', 'ET', 'CV', 'QU', 'QD', 'Done', 'Busy', 'Error', 'ErrorID'];
const MOST_OUTPUTS = 3;

export class ProgramView {
  sources = $state.raw<Sources>({ digest: '', state: 'absent', instances: [], sheets: [] });
  place = $state.raw<Place>({ sheet: 0, instance: '', block: -1, line: 0 });
  target = $state(''); // the variable whose uses are listed; empty: none
  values = $state.raw<readonly TagValue[]>([]);
  steps = $state.raw<ReadonlySet<number>>(new Set());
  scan = $state(0);
  jumps = $state(0); // grows with every jump, so that the same place is shown again
  private before = $state.raw<Place[]>([]);

  private readonly asked = new Set<number>(); // tags of the sheet that have been looked up
  private asking = false;

  readonly tags: TagTable = $derived.by(() => new TagTable(this.cell.program));
  readonly sheet: Sheet | undefined = $derived.by(() => this.sources.sheets[this.place.sheet]);
  readonly scope: Scope | null = $derived.by(() => {
    this.asked.clear();
    return this.sheet ? new Scope(this.sheet, this.place.instance, this.tags, (tag) => this.ask(tag)) : null;
  });
  readonly instances: string[] = $derived.by(() => (this.sheet ? instancesOf(this.sheet, this.sources.instances) : []));
  // By block.
  readonly uses: Map<number, Use[]> = $derived.by(() => {
    const map = new Map<number, Use[]>();
    for (const use of this.sheet?.uses ?? []) {
      const list = map.get(use.block);
      if (list) list.push(use);
      else map.set(use.block, [use]);
    }
    return map;
  });
  // Null values while the page has heard of another program than that of the sources.
  readonly fits: boolean = $derived.by(() => this.cell.program?.digest === this.sources.digest && this.cell.live.program === this.sources.digest);

  // Of the networks of the sheet, by block.
  readonly flows: Map<number, RungFlow> = $derived.by(() => {
    const rungs = (this.sheet?.blocks ?? []).flatMap((block, index) => (block.kind === 'rung' ? [{ block, index }] : []));
    const flows = flowOf(rungs.map(({ block }) => block), lookupOf(this.live), (name) => this.scope?.declares(name) ?? false);
    return new Map(rungs.map(({ index }, i) => [index, flows[i] as RungFlow]));
  });

  constructor(private readonly cell: Cell) {}

  // What is shown is told of by the server from now on.
  private ask(tag: number): void {
    this.asked.add(tag);
    if (this.asking) return;
    this.asking = true;
    queueMicrotask(() => {
      this.asking = false;
      this.showTags();
    });
  }

  showTags(): void {
    this.cell.showTags(this, [...this.asked, this.tags.index(this.target)]);
  }

  end(): void {
    this.asked.clear();
    this.cell.showTags(this, []);
  }

  // All of one scan, taken at one moment.
  look(): void {
    this.values = this.fits ? [...this.cell.tags] : [];
    this.steps = new Set(this.fits ? this.cell.live.steps : []);
    this.scan = this.cell.live.scan;
  }

  // Outputs of an instance that have a value, by the sheet of its type or by the names that the library gives them.
  outputsOf(instance: string, type: string): string[] {
    const of = this.sources.sheets.find((one) => one.name.toLowerCase() === type.toLowerCase());
    const own = (of?.variables ?? []).filter((one) => one.section === 'VAR_OUTPUT').map((one) => one.name);
    return (own.length > 0 ? own : LIBRARY_OUTPUTS).filter((output) => this.scope?.isTag(`${instance}.${output}`)).slice(0, MOST_OUTPUTS);
  }

  readonly live: LiveOf = (path) => this.scope?.live(path, this.values, this.steps) ?? { value: null, type: '' };

  // Of the instance that is shown.
  isForced(path: string): boolean {
    return this.cell.forced.has(this.scope?.resolve(path) ?? '');
  }

  // By its whole name.
  isTagForced(tag: string): boolean {
    return this.cell.forced.has(tag);
  }

  take(sources: Sources): void {
    this.sources = sources;
    this.before = [];
    const first = sources.sheets.findIndex((sheet) => sheet.kind === 'PROGRAM');
    this.place = this.firstOf(Math.max(0, first));
  }

  private firstOf(sheet: number): Place {
    const of = this.sources.sheets[sheet];
    return { sheet, instance: of ? (instancesOf(of, this.sources.instances)[0] ?? '') : '', block: -1, line: 0 };
  }

  get canGoBack(): boolean {
    return this.before.length > 0;
  }

  goTo(place: Place): void {
    this.before = [...this.before.slice(-MOST_STEPS_BACK), this.place];
    this.place = place;
    this.jumps += 1;
  }

  goBack(): void {
    const last = this.before.at(-1);
    if (!last) return;
    this.before = this.before.slice(0, -1);
    this.place = last;
    this.jumps += 1;
  }

  openSheet(sheet: number): void {
    this.goTo(this.firstOf(sheet));
  }

  openInstance(instance: string): void {
    this.goTo({ ...this.place, instance, block: -1, line: 0 });
  }

  // A variable of the sheet that is shown.
  pick(path: string): void {
    this.target = this.scope?.resolve(path) || '';
  }

  // A tag from anywhere.
  follow(tag: string): void {
    this.target = tag;
    const home = declarationOf(tag, this.sources);
    if (home) this.goTo(home);
  }
}
