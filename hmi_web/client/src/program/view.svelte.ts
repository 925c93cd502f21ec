// What the panel looks at: a sheet in one of its instances, a variable, and the values of one scan.

import type { Cell } from '../lib/cell.svelte';
import type { TagValue } from '../lib/protocol';
import type { Sheet, Sources, Use } from './document';
import type { LiveOf } from './lines';
import { NOTHING_SEEN, type BodyValues, type Question, type RungFlow, type SheetLive, type Wires } from './live';
import { instancesOf, Scope, TagTable } from './scope';
import { declarationOf, type Place } from './uses';

const MOST_STEPS_BACK = 50;
const LIBRARY_OUTPUTS = ['Q', 'Q1', 'ET', 'CV', 'QU', 'QD', 'Done', 'Busy', 'Error', 'ErrorID'];
const MOST_OUTPUTS = 3;

export class ProgramView {
  sources = $state.raw<Sources>({ digest: '', state: 'absent', instances: [], sheets: [] });
  place = $state.raw<Place>({ sheet: 0, instance: '', block: -1, line: 0 });
  target = $state(''); // the variable whose uses are listed; empty: none
  jumps = $state(0); // grows with every jump, so that the same place is shown again
  private before = $state.raw<Place[]>([]);

  private seen = $state.raw<SheetLive>(NOTHING_SEEN); // the answer to the newest question
  private seenAt = $state(''); // the sheet and instance that it is of
  private readonly asked = new Set<number>(); // tags of the sheet that have been looked up
  private readonly askedBlocks = new Set<number>(); // that are drawn

  readonly tags: TagTable = $derived.by(() => new TagTable(this.cell.program));
  readonly sheet: Sheet | undefined = $derived.by(() => this.sources.sheets[this.place.sheet]);
  readonly scope: Scope | null = $derived.by(() => {
    this.asked.clear();
    return this.sheet ? new Scope(this.sheet, this.place.instance, this.tags, (tag) => this.asked.add(tag)) : null;
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
  // False while the page has heard of another program than that of the sources.
  readonly fits: boolean = $derived.by(() => this.cell.program?.digest === this.sources.digest && this.seen.digest === this.sources.digest);
  // All of one scan.
  readonly values: readonly TagValue[] = $derived.by(() => (this.fits ? this.seen.tags : []));
  readonly steps: ReadonlySet<number> = $derived.by(() => (this.fits ? this.seen.steps : NOTHING_SEEN.steps));
  readonly scan: number = $derived.by(() => this.seen.scan);
  private readonly blocks: SheetLive = $derived.by(() => (this.fits && this.seenAt === this.at ? this.seen : NOTHING_SEEN));

  constructor(private readonly cell: Cell) {}

  private get at(): string {
    return `${this.place.sheet} ${this.place.instance}`;
  }

  // What is shown now.
  question(): Question {
    const tags = [...this.asked, this.tags.index(this.target)].filter((tag) => tag >= 0);
    return { sheet: this.place.sheet, instance: this.place.instance, blocks: this.askedBlocks, tags };
  }

  see({ sheet, instance }: Question, answer: SheetLive): void {
    // What is still drawn is asked for again when it is drawn.
    this.askedBlocks.clear();
    this.seenAt = `${sheet} ${instance}`;
    this.seen = answer;
  }

  rung(block: number): RungFlow | undefined {
    this.askedBlocks.add(block);
    return this.blocks.rungs.get(block);
  }

  body(block: number): BodyValues | undefined {
    this.askedBlocks.add(block);
    return this.blocks.bodies.get(block);
  }

  wires(block: number): Wires | undefined {
    this.askedBlocks.add(block);
    return this.blocks.diagrams.get(block);
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
