// The messages of the server as they arrive: hmi_web/doc/protocol.md.

import type { AlarmList } from '../records/records';
import type { TagValue, Value } from './value';

export interface Point {
  id: string;
  label: string;
  unit: string;
  trend: boolean;
}

export interface Place {
  id: string;
  label: string;
  position: number;
  switch: string;
}

export interface Vehicle {
  id: string;
  label: string;
  position: string;
  left: string;
  right: string;
}

export interface Tank {
  id: string;
  label: string;
  side: 'above' | 'below' | 'vehicle';
  at: string;
  level: string;
  truth: string;
  low_percent: number;
  high_percent: number;
}

export interface Pump {
  id: string;
  label: string;
  running: string;
  flow: string;
}

export interface Pipe {
  from: string;
  to: string;
  pump: string;
  at_place: string;
}

type Pair = [number, number]; // x, y in m, seen from above

export interface Belt {
  id: string;
  label: string;
  running: string;
  low: Pair;
  high: Pair;
  direction: Pair;
}

export interface Beam {
  id: string;
  dark: string;
  from: Pair;
  to: Pair;
}

export interface Pusher {
  id: string;
  label: string;
  out: string;
  travel: string;
  home: Pair;
  size: Pair;
  direction: Pair;
  stroke: number;
}

export interface Box {
  id: string;
  label: string;
  size: Pair;
  state: string;
  x: string;
  y: string;
  angle: string;
}

// Closed lines around what is blocked, in cells: column and row, then steps along x and y by turns.
export interface FloorMap {
  low: Pair;
  cell: number; // m
  size: Pair; // columns, rows
  outlines: number[][];
}

export interface Forklift {
  id: string;
  label: string;
  front: number; // m, from the reference point
  rear: number;
  width: number;
  wheelbase: number;
  x: string;
  y: string;
  heading: string;
  speed: string;
  lock: string;
  loaded: string;
  bumper: string;
  enable: string;
  lift: string;
  true_x: string;
  true_y: string;
  true_heading: string;
  carries: string;
}

export interface Pallet {
  id: string;
  label: string;
  size: Pair;
  state: string;
  x: string;
  y: string;
  angle: string;
}

export interface Blockage {
  id: string;
  label: string;
  at: Pair;
  angle: number;
  size: Pair;
  there: string;
}

export interface FloorDescription {
  maps: FloorMap[];
  forklifts: Forklift[];
  pallets: Pallet[];
  blockages: Blockage[];
  estop_ok: string;
}

export interface SynopticDescription {
  points: Point[];
  places: Place[];
  vehicles: Vehicle[];
  tanks: Tank[];
  pumps: Pump[];
  pipes: Pipe[];
  belts: Belt[];
  beams: Beam[];
  pushers: Pusher[];
  boxes: Box[];
  floor: FloorDescription;
}

// What is not said is missing.
export interface TagWords {
  unit?: string;
  description?: string;
  group?: string;
  decimals?: number;
  normal?: [least: number, greatest: number];
  values?: string[]; // names of 0, 1, 2, ...
}

export interface TagNote extends TagWords {
  name: string; // of a tag, or of an array for all its elements
}

export interface HelloMessage {
  type: 'hello';
  protocol: number;
  epoch: string; // of this run of the server
  cell: string;
  version: string;
  recipes: boolean; // the API has some
  drawing: boolean; // the API has one of the plant
  tags?: TagNote[]; // what the cell says of some
  synoptic: SynopticDescription;
}

export interface Step {
  name: string;
  comment: string;
  initial: boolean;
}

export interface Transition {
  name: string;
  from: number[];
  to: number[];
  condition: string;
}

export interface Tag {
  name: string;
  type: string;
  address: string;
  comment?: string; // of its declaration
  note?: TagWords; // what else the declaration says
  enumeration?: number; // index into ProgramMessage.enumerations
}

// So many of the steps and of the transitions, behind those of the chart before.
export interface Chart {
  name: string;
  steps: number;
  transitions: number;
}

export interface ProgramMessage {
  type: 'program';
  revision: number;
  digest: string;
  charts: Chart[];
  steps: Step[];
  transitions: Transition[];
  tags: Tag[];
  enumerations: Record<string, string>[]; // names by value
  left_out?: { name: string; values: number }[]; // arrays whose values are no tags
  points: number[][]; // of each point of the synoptic, the tags at its place
}

export interface ScanFigures {
  overruns: number;
  p50_us: number;
  p99_us: number;
  max_us: number;
  realtime_factor: number;
}

export type { TagValue, Value };

// What travels whole whenever it changes.
export interface LiveFields {
  runtime_alive: boolean;
  runtime_unlinked: boolean; // it runs beside the server, and no link
  supervisor_alive: boolean;
  runtime_state: string;
  runtime_detail: string;
  waiting: boolean;
  program: string;
  scan: number;
  time_s: number;
  trace_hash: string;
  figures: ScanFigures;
  steps: number[];
  transitions: number[];
  unread: UnreadDevice[];
}

// A device that does not answer, and the tags that are read from it, as ranges of indices.
export interface UnreadDevice {
  device: string;
  why: 'lost' | 'never' | 'untold';
  tags: [first: number, count: number][];
}

export interface StateMessage extends LiveFields {
  type: 'state';
  seq: number;
  show?: number;
  points: Value[];
  tags: Record<string, TagValue>; // of those that are wanted all
}

export interface DeltaMessage extends Partial<LiveFields> {
  type: 'delta';
  seq: number;
  show?: number; // the choice with this number is answered: `tags` has all that it wants
  points?: Record<string, Value>;
  tags?: Record<string, TagValue>;
}

export interface TrendMessage {
  type: 'trend';
  run: number;
  first: number;
  restart: boolean;
  rows: Value[][];
}

export interface PlanAction {
  index: number;
  text: string;
  step: string;
  state: 'pending' | 'active' | 'done' | 'failed';
  started_s?: Value;
  finished_s?: Value;
  planned_start_s?: Value;
  planned_finish_s?: Value;
  planned_cost?: Value;
  actual_cost?: Value;
  // Measured fluents after it, counted in the order of the plan.
  expected?: Record<string, Value>;
}

export interface Replan {
  time_s: number;
  cause: string;
  after_action?: string;
}

// Of a monitor of the program.
export interface IncidentAlarm {
  action: string;
  kind: string;
  condition: string;
  scan: number;
  value: Value;
  sensor: string; // empty: the value is that of a switch
}

// What did not go as planned: supervisor/doc/plan_document.md.
export interface Incident {
  time_s: number;
  kind: string;
  action?: string;
  evidence?: string[];
  alarms?: IncidentAlarm[];
  decision: string;
  decision_ms?: Value;
  kept?: number;
  remaining?: number;
  restarts?: number;
}

export interface PlanDocument {
  cell?: string;
  phase?: string;
  message?: string;
  program_digest?: string;
  plan?: {
    cost?: Value;
    bound?: Value;
    proved_optimal?: boolean;
    steps?: Value;
    first_plan_ms?: Value;
    optimal_plan_ms?: Value;
  } | null;
  actions?: PlanAction[];
  // Every plan of the run, the newest last; planned times count from its start.
  episodes?: { started_s: number; planned_makespan_s?: Value; planned_sequential_makespan_s?: Value }[];
  replans?: Replan[];
  incidents?: Incident[]; // oldest first
  expected?: Record<string, Value>;
  observed?: Record<string, Value>;
  goal?: { text: string; met: boolean }[];
  makespan_s?: Value;
  // Of a fleet; src/fleet/document.ts reads it, and the message `routes`.
  fleet?: unknown;
}

export interface PlanMessage {
  type: 'plan';
  revision: number;
  document: PlanDocument;
}

export interface RoutesMessage {
  type: 'routes';
  revision: number;
  routes: unknown;
}

// Of a plan; src/pictures/document.ts reads them.
export interface PicturesMessage {
  type: 'pictures';
  revision: number;
  pictures: unknown;
}

export interface AlarmsMessage extends AlarmList {
  type: 'alarms';
  revision: number;
}

export interface StandingForce {
  name: string;
  value: string;
  user: string; // empty: not forced by this server, which knows neither why nor until when
  reason: string;
  since_s: number | null;
  until_s: number | null;
  also: string[]; // variables that share its place
}

export interface ForcesMessage {
  type: 'forces';
  revision: number;
  forces: StandingForce[];
}

export type ServerMessage =
  | ForcesMessage
  | HelloMessage
  | ProgramMessage
  | StateMessage
  | DeltaMessage
  | TrendMessage
  | PlanMessage
  | RoutesMessage
  | PicturesMessage
  | AlarmsMessage;

// What the page says: which tags it shows, and what else.
export interface ShowMessage {
  number: number;
  digest: string;
  tags: [first: number, count: number][];
  also: string[];
}

// What it has of a run of the server.
export interface Possessions {
  seq: number;
  tags: boolean;
  program: number;
  plan: number;
  routes: number;
  pictures: number;
  alarms: number;
  forces: number;
  trend_run: number;
  trend_next: number;
}

export const PROTOCOL_VERSION = 5;
