// State of one run as the page knows it. Sources write it, views read it.
import { SequenceMonitor } from '../math/sequence.js';
import { Emitter } from './emitter.js';
import { LiveEvents } from './live-events.js';
import { PathStore } from './path-store.js';
import { Series } from './series.js';
/** @typedef {import('./types.js').Info} Info */
/** @typedef {import('./types.js').Observability} Observability */
/** @typedef {import('./types.js').RunEvent} RunEvent */
/** @typedef {import('./types.js').SeriesMessage} SeriesMessage */
/** @typedef {import('./types.js').Snapshot} Snapshot */

/** Snapshots kept until the image of their frame arrives. */
const RECENT_SNAPSHOTS = 40;
/** Missing frames above which a path that was put together from single snapshots has a gap. */
const GAP_FRAMES = 20;
/** Events above which the older half is forgotten. */
const MAX_EVENTS = 20000;

/** Emits `info`, `series`, `snapshot`, `image`, `observability`, and `settings` when a viewer changed what
 * `info` says of the decision or of the disturbances. */
export class RunState extends Emitter {
  /** End of the names of files, where two runs with the same name are shown. */
  fileSuffix = '';
  sequence = new SequenceMonitor();
  /** @type {Info | null} */
  info = null;
  series = new Series();
  /** @type {RunEvent[]} in order of frames */
  events = [];
  /** @type {Snapshot | null} the shown frame */
  snapshot = null;
  /** @type {Map<number, Snapshot>} by frame */
  recent = new Map();
  /** Of the newest frame whose image is known; `jpeg` is null if that frame has none.
   * @type {{frame: number, jpeg: Blob | null} | null} */
  image = null;
  /** @type {Observability | null} */
  observability = null;
  /** @type {{estimate: PathStore, truth: PathStore}[]} one per body */
  paths = [];
  liveEvents = new LiveEvents();

  /** @param {number} [index] number of the run at the program, which counts the runs that it starts */
  constructor(index = 0) {
    super();
    this.index = index;
  }

  /** Forgets everything, for a new run. @param {number} index */
  reset(index) {
    this.index = index;
    this.info = null;
    this.series = new Series();
    this.events = [];
    this.snapshot = null;
    this.recent = new Map();
    this.image = null;
    this.observability = null;
    this.paths = [];
    this.liveEvents = new LiveEvents();
    this.sequence.restart();
    for (const name of ['info', 'series', 'snapshot', 'image', 'observability']) this.emit(name);
  }

  /** @param {Info} info */
  setInfo(info) {
    this.info = info;
    this.paths = Array.from({ length: info.bodies }, () => ({
      estimate: new PathStore(),
      truth: new PathStore(),
    }));
    for (const { estimate, truth } of this.paths)
      estimate.longestGapS = truth.longestGapS = GAP_FRAMES / info.rate_hz;
    this.emit('info');
  }

  /** @param {SeriesMessage} message */
  setSeries(message) {
    this.series.assign(message);
    this.events = message.events;
    message.paths?.forEach((path, body) => {
      this.paths[body]?.estimate.assign(message.t, path.estimate);
      if (path.truth) this.paths[body]?.truth.assign(message.t, path.truth);
    });
    this.emit('series');
  }

  /**
   * A new frame of a live run.
   * @param {Snapshot} snapshot
   * @param {Record<string, number | null>} row @param {Record<string, number | null>} timing
   */
  appendSnapshot(snapshot, row, timing) {
    const last = this.events[this.events.length - 1];
    const events = this.liveEvents.of(snapshot);
    if (!last || snapshot.frame > last.frame) this.events.push(...events);
    if (this.events.length > MAX_EVENTS) this.events = this.events.slice(-MAX_EVENTS / 2);
    this.series.append(snapshot.t, snapshot.frame, snapshot.state, row, timing);
    this.emit('series');
    this.#noteInterventions(snapshot);
    this.#show(snapshot);
  }

  /** What viewers changed before this frame. @param {Snapshot} snapshot */
  #noteInterventions({ interventions = [] }) {
    const { info } = this;
    if (!info || interventions.length === 0) return;
    for (const { covered, sigma_gray, factor, settings = [] } of interventions) {
      const changed = Object.entries({ covered, sigma_gray, factor }).filter(([, value]) => value !== undefined);
      info.disturbed = { ...UNDISTURBED, ...info.disturbed, ...Object.fromEntries(changed) };
      for (const setting of settings) {
        const [, key, word] = setting.match(/^decision\.(strategy|gaze)=(.*)$/) ?? [];
        if (key === 'strategy' || key === 'gaze') info[key] = word;
      }
    }
    this.emit('settings');
  }

  /** A frame of a finished run. @param {Snapshot} snapshot */
  showSnapshot(snapshot) {
    this.#show(snapshot);
  }

  /** @param {Snapshot} snapshot */
  #show(snapshot) {
    this.snapshot = snapshot;
    this.recent.set(snapshot.frame, snapshot);
    const oldest = this.recent.keys().next().value;
    if (this.recent.size > RECENT_SNAPSHOTS && oldest !== undefined) this.recent.delete(oldest);
    snapshot.bodies.forEach((body, index) => {
      this.paths[index]?.estimate.add(snapshot.t, body.position);
      this.paths[index]?.truth.add(snapshot.t, body.truth?.position);
    });
    this.emit('snapshot');
  }

  /** @param {number} frame @param {Blob | null} jpeg null: the frame has no image */
  setImage(frame, jpeg) {
    this.image = { frame, jpeg };
    this.emit('image');
  }

  /** @param {Observability} message */
  setObservability(message) {
    this.observability = message;
    this.emit('observability');
  }
}

/** @type {import('./types.js').Disturbed} */
export const UNDISTURBED = { covered: false, sigma_gray: 0, factor: 1 };

/** @param {Info} info @returns {string} */
export const scenarioOf = (info) => info.scenario ?? info.name;

/**
 * Beginning of the names of files saved from this run: its directory, or scenario and seed while it goes on.
 * @param {RunState} run
 */
export function fileStem({ info, fileSuffix }) {
  if (!info) return `run${fileSuffix}`;
  const name = info.scenario ? info.name : `${info.name}-seed-${info.seed}`;
  return name.replace(/[^A-Za-z0-9._-]+/g, '-') + fileSuffix;
}
