// Everything that the page knows about the cell, kept up to date by the connection. Components read it;
// nothing else writes it, but for who looks: App.

import { Connection, liveUrl, type LinkState } from './connection';
import {
  PROTOCOL_VERSION,
  type AlarmsMessage,
  type DeltaMessage,
  type HelloMessage,
  type LiveFields,
  type Possessions,
  type PlanDocument,
  type ProgramMessage,
  type ServerMessage,
  type StandingForce,
  type StateMessage,
  type TagNote,
} from './protocol';
import { ForcedNames } from './forces';
import { enumerationOf, pointNote, told, toldNumber, TagNotes } from './tag_notes';
import { TrendData } from './trend_data';
import { drawnNumber, type TagValue, type Value } from './value';
import { UnreadTags } from './unread';
import { Wanted } from './wanted';

// Planned times count from the start of their plan; everything else is the cell's clock.
function onCellTime(document: PlanDocument): PlanDocument {
  const start = document.episodes?.at(-1)?.started_s ?? 0;
  const shift = (time: Value | undefined) => (typeof time === 'number' ? time + start : time);
  const actions = document.actions?.map((action) => ({
    ...action,
    planned_start_s: shift(action.planned_start_s),
    planned_finish_s: shift(action.planned_finish_s),
  }));
  return { ...document, ...(actions ? { actions } : {}) };
}

const NOTHING: LiveFields = {
  runtime_alive: false,
  runtime_unlinked: false,
  supervisor_alive: false,
  runtime_state: '',
  runtime_detail: '',
  waiting: false,
  program: '',
  scan: 0,
  time_s: 0,
  trace_hash: '',
  figures: { overruns: 0, p50_us: 0, p99_us: 0, max_us: 0, realtime_factor: 0 },
  steps: [],
  transitions: [],
  unread: [],
};

// Of the newest message of each kind, as the server numbers them.
const NO_REVISIONS = { seq: 0, program: 0, plan: 0, routes: 0, pictures: 0, alarms: 0, forces: 0 };
// Of the names in the history.
const POINT_PREFIX = 'points/';
// While somebody scrolls, no more is said than this.
const SHOW_EVERY_MS = 100;

export class Cell {
  link = $state<LinkState>('connecting');
  // Wall clock of the newest message, for "values of 12:03:44".
  heardAt = $state<Date | null>(null);
  hello = $state.raw<HelloMessage | null>(null);
  program = $state.raw<ProgramMessage | null>(null);
  plan = $state.raw<PlanDocument | null>(null);
  // Those that are not normal; null: the server keeps none.
  alarms = $state.raw<AlarmsMessage | null>(null);
  // Paths and polygons of a fleet, as they came.
  routes = $state.raw<unknown>(null);
  // What a mission shows of its plan, as it came.
  pictures = $state.raw<unknown>(null);
  // What is forced in the runtime, whoever has forced it.
  forces = $state.raw<StandingForce[]>([]);
  readonly forced: ForcedNames = $derived.by(() => new ForcedNames(this.forces));
  readonly unread: UnreadTags = $derived.by(() => new UnreadTags(this.live.unread, (index) => this.forced.has(this.program?.tags[index]?.name ?? '')));
  // Points of the plant, by their ids, that show what is forced.
  readonly forcedPoints: ReadonlySet<string> = $derived.by(() => {
    const { program, forced } = this;
    if (this.forces.length === 0 || !program) return new Set<string>();
    const ids = (this.hello?.synoptic.points ?? []).map(({ id }) => id);
    return new Set(ids.filter((_, index) => program.points[index]?.some((tag) => forced.has(program.tags[tag]?.name ?? ''))));
  });
  // What the cell and the declarations say of tags beside their values.
  readonly notes: TagNotes = $derived.by(() => new TagNotes(this.hello?.tags, this.program?.tags));
  scanOpen = $state(false); // the scan in detail is asked for
  faultsOpen = $state(false); // so are the faults of a simulated plant
  programOpen = $state(false); // so are the sources of the program
  changeOpen = $state(false); // so is what changes it
  programSheet = $state(-1); // a part of the program that is asked for there; -1: none
  programTag = $state(''); // a tag whose uses are asked for there; empty: none
  live = $state<LiveFields>({ ...NOTHING });
  points = $state<Value[]>([]);
  // Programs have thousands of tags that change with every scan and are hardly ever looked at: one signal for them all.
  private tagValues: TagValue[] = [];
  private tagVersion = $state(0);
  // Not reactive itself: a chart redraws when `trendVersion` moves.
  trend = new TrendData(0);
  trendVersion = $state(0);

  private connection: Connection | null = null;
  private askWhoLooks: () => Promise<void> = async () => {};
  private epoch = ''; // of the run of the server that the rest here is from; empty: nothing is
  private revisions = { ...NO_REVISIONS };
  private readonly wanted = new Wanted();
  private showTimer = 0;
  private shownAt = -Infinity;

  private pointIndex = new Map<string, number>();
  // By name in lower case: IEC 61131-3 does not tell them apart.
  private tagIndex = $state.raw(new Map<string, number>());

  // `protocols`: for the WebSocket, asked before each attempt; `onLost` is called when one has failed, and when another run of the
  // server answers, which knows nobody of the one before.
  connect(protocols: () => string[], onLost: () => Promise<void>): Connection {
    this.askWhoLooks = onLost;
    this.connection = new Connection(liveUrl(window.location), {
      onMessage: (message) => this.take(message),
      onState: (state) => (this.link = state),
      onLost,
      protocols,
      greeting: () => this.greeting(),
      onOther: () => (this.epoch = ''),
    });
    return this.connection;
  }

  // The tags that a panel shows from now on, by their index in the program; what no panel shows is not sent.
  showTags(panel: object, tags: readonly number[]): void {
    this.wanted.show(panel, tags);
    this.tell();
  }

  showTrend(more: 1 | -1): void {
    this.wanted.showTrend(more);
    this.tell();
  }

  // -1: the program has no variable of that name, in lower case.
  tagNumber(name: string): number {
    return this.tagIndex.get(name) ?? -1;
  }

  private greeting(): string {
    const known = this.epoch !== '';
    const isAnswered = this.wanted.isAnswered;
    const has: Possessions = { ...this.revisions, tags: isAnswered, trend_run: this.trend.run, trend_next: this.trend.next };
    return JSON.stringify({ type: 'begin', protocol: PROTOCOL_VERSION, epoch: this.epoch, ...(known ? { has } : {}), show: this.wanted.first() });
  }

  // Says what is wanted if that has changed: soon, as panels change together.
  private tell(): void {
    if (this.showTimer !== 0) return;
    this.showTimer = window.setTimeout(() => {
      this.showTimer = 0;
      if (!this.connection?.isOpen) return;
      const message = this.wanted.next();
      if (message) this.connection.send(JSON.stringify({ type: 'show', ...message }));
      this.shownAt = performance.now();
    }, Math.max(10, this.shownAt + SHOW_EVERY_MS - performance.now()));
  }

  // What is shown of the cell is of some time ago.
  get isStale(): boolean {
    return this.link !== 'live' || !this.live.runtime_alive;
  }

  // The value of a point by its id; null if there is no such point or it is not known now.
  point(id: string): Value {
    const index = this.pointIndex.get(id);
    return index === undefined ? null : (this.points[index] ?? null);
  }

  isOn(id: string): boolean {
    return (this.point(id) ?? 0) > 0.5;
  }

  // What stands in the image, which of a device that does not answer is no value of the plant: value().
  get tags(): readonly TagValue[] {
    void this.tagVersion;
    return this.tagValues;
  }

  // The value of a tag by its index; null where nobody knows it now.
  value(index: number): TagValue {
    return this.unread.of(index) ? null : (this.tags[index] ?? null);
  }

  // A value of a tag as people read it, with its unit, or with that of the drawing that shows it (`unit`), which comes first.
  told(index: number, value: TagValue | undefined, unit = ''): string {
    const tag = this.program?.tags[index];
    if (!tag) return told(value, '');
    const note = this.notes.of(tag.name);
    return told(value, tag.type, unit === '' ? note : { ...note, name: tag.name, unit }, enumerationOf(this.program, index));
  }

  // What is said of a point of the plant: its unit, its name for people. `decimals`: where the cell says none.
  pointNote(id: string, decimals?: number): TagNote {
    const index = this.pointIndex.get(id);
    const point = index === undefined ? undefined : this.hello?.synoptic.points[index];
    return pointNote(point ?? { id, label: id, unit: '' }, this.notes, decimals);
  }

  // The value of a point as people read it, with its unit.
  toldPoint(id: string, decimals?: number): string {
    return toldNumber(this.point(id), this.pointNote(id, decimals));
  }

  // A number that was kept of a tag in whatever program, or of a point ("a1.level", "points/a1.level").
  toldNumber(name: string, value: Value | undefined): string {
    const id = name.startsWith(POINT_PREFIX) ? name.slice(POINT_PREFIX.length) : name;
    if (this.pointIndex.has(id)) return toldNumber(value, this.pointNote(id));
    const index = this.tagNumber(name.toLowerCase());
    return toldNumber(value, this.notes.of(name), enumerationOf(this.program, index), this.program?.tags[index]?.type);
  }

  // The value of a variable of the program by its whole name in lower case.
  tagValue(name: string): TagValue {
    const index = this.tagIndex.get(name);
    return index === undefined ? null : this.value(index);
  }

  // The same of a number; null for a text.
  tag(name: string): Value {
    const type = this.program?.tags[this.tagNumber(name)]?.type ?? '';
    return drawnNumber(this.tagValue(name), type);
  }

  private take(message: ServerMessage): void {
    this.heardAt = new Date();
    if ('revision' in message) this.revisions[message.type] = message.revision;
    if ('seq' in message) this.revisions.seq = message.seq;
    switch (message.type) {
      case 'hello':
        return this.takeHello(message);
      case 'program':
        this.program = message.digest === '' ? null : message;
        this.wanted.setProgram(message.digest, message.tags.length);
        this.tagIndex = new Map(message.tags.map((tag, index) => [tag.name.toLowerCase(), index]));
        return;
      case 'forces':
        this.forces = message.forces;
        return;
      case 'state':
        return this.takeState(message);
      case 'delta':
        return this.takeDelta(message);
      case 'plan':
        this.plan = onCellTime(message.document);
        return;
      case 'routes':
        this.routes = message.routes;
        return;
      case 'pictures':
        this.pictures = message.pictures;
        return;
      case 'alarms':
        this.alarms = message;
        return;
      case 'trend':
        this.trend.add(message);
        this.trendVersion += 1;
        return;
    }
  }

  private takeHello(message: HelloMessage): void {
    // The server was replaced by one that speaks another language: its own page fits it.
    if (message.protocol !== PROTOCOL_VERSION) return window.location.reload();
    // The same run of the server: it goes on where the page has stopped.
    if (message.epoch === this.epoch) return;
    if (this.epoch !== '') void this.askWhoLooks();
    this.epoch = message.epoch;
    this.revisions = { ...NO_REVISIONS };
    this.wanted.forget();
    this.pointIndex = new Map(message.synoptic.points.map((point, index) => [point.id, index]));
    this.trend = new TrendData(message.synoptic.points.filter((point) => point.trend).length);
    this.trendVersion += 1;
    this.program = null;
    this.plan = null;
    this.routes = null;
    this.pictures = null;
    this.alarms = null;
    this.forces = [];
    this.hello = message;
  }

  private takeState(message: StateMessage): void {
    const { type: _type, seq: _seq, show, points, tags, ...live } = message;
    this.live = live;
    this.points = points;
    if (show !== undefined) this.wanted.answer(show);
    this.tagValues = [];
    this.takeTags(tags);
  }

  private takeDelta(message: DeltaMessage): void {
    const { type: _type, seq: _seq, show, points, tags, ...changed } = message;
    Object.assign(this.live, changed);
    for (const [index, value] of Object.entries(points ?? {})) this.points[Number(index)] = value;
    // Of what was wanted before nothing more is told.
    if (show !== undefined) {
      this.wanted.answer(show);
      this.tagValues = [];
    }
    if (tags) this.takeTags(tags);
  }

  private takeTags(tags: Record<string, TagValue>): void {
    for (const index in tags) this.tagValues[Number(index)] = tags[index] ?? null;
    this.tagVersion += 1;
  }
}
