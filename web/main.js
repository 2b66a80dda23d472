// Start of the page: asks the program what it shows, then builds sources, state and views. Data flows one
// way: a source writes the state, views read it.
import { RefusedError, fetchFinalObservability, fetchInfo, fetchMode, fetchSeries } from './connection/api.js';
import { followLiveRun } from './connection/live-run.js';
import { ReplayRun } from './connection/replay-run.js';
import { robotStop } from './math/robot-stop.js';
import { announcer } from './panels/announcer.js';
import { button, element, labeled, select } from './panels/dom.js';
import { helpDialog } from './panels/help.js';
import { loopBar } from './panels/loop-bar.js';
import { messages } from './panels/messages.js';
import { newRunDialog } from './panels/new-run.js';
import { runView } from './panels/run-view.js';
import { listenToShortcuts } from './panels/shortcuts.js';
import { applyTheme, themeButton } from './panels/theme.js';
import { timeline } from './panels/timeline.js';
import { Clock } from './state/clock.js';
import { RunState } from './state/run-state.js';
import { Session } from './state/session.js';
import { exposeForTests } from './test-access.js';
/** @typedef {import('./state/types.js').Mode} Mode */

const RETRY_MS = 2000;
/** @type {[string, string][]} */
const SPANS = [
  ['Infinity', 'whole run'],
  ['60', '60 s'],
  ['20', '20 s'],
  ['5', '5 s'],
];

/** @param {string} id @returns {HTMLElement} */
const byId = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

async function start() {
  applyTheme();
  /** @type {Mode} */
  let mode;
  try {
    mode = await fetchMode();
  } catch (error) {
    if (error instanceof RefusedError && /token/.test(error.message)) return showTokenError(error.message);
    byId('mode').textContent =
      `The program does not answer (${/** @type {Error} */ (error).message}). Trying again …`;
    setTimeout(start, RETRY_MS);
    return;
  }
  const newest = mode.runs.length - 1;
  const asked = new URLSearchParams(location.search).get('run');
  if (mode.mode !== 'live') buildPage(new Session(mode), [0, 1]);
  else if (asked === null || asked === String(newest)) buildPage(new Session(mode), [newest]);
  else if (mode.runs[Number(asked)]) buildPage(new Session({ ...mode, mode: 'replay', control: false }), [Number(asked)]);
  else byId('runs').textContent = `The program has had no run ${asked} (counted from 0) since it was started.`;
}

/** @param {string} message of the program */
function showTokenError(message) {
  byId('mode').textContent = message;
  byId('runs').replaceChildren(
    element('p', { class: 'loading', role: 'alert' }, 'Open the address that the program printed: it contains a token.'),
  );
}

/** @param {Session} session @param {number[]} indices of the shown runs, as far as there are so many */
function buildPage(session, indices) {
  const { mode, runs: named, version } = session.mode;
  if (named.length === 0) {
    byId('runs').textContent = 'The program shows no run.';
    return;
  }
  const shown = indices.filter((index) => index < named.length);
  const runs = shown.map((index) => new RunState(index));
  if (new Set(shown.map((index) => named[index].name)).size < shown.length)
    runs.forEach((run, k) => (run.fileSuffix = `-${k + 1}`));
  const clock = new Clock(runs);
  const views = runs.map((run, k) => runView(run, named[shown[k]].name, session, clock));
  const replays = runs.map(
    (run) =>
      new ReplayRun(run, (text, error) => {
        // fetch throws a TypeError without a connection, whose loss the socket of a live page reports
        if (mode !== 'live' || !(error instanceof TypeError)) session.report(text);
      }),
  );
  exposeForTests(
    runs,
    () => views.map((view) => view.scene()),
    () => views[0]?.deviceCamera ?? null,
  );

  const showMode = () =>
    (byId('mode').textContent = `${session.loop.ended ? 'live run, ended' : mode}, version ${version}`);
  session.on('loop', showMode);
  showMode();
  const showTitle = () =>
    (document.title = `${runs.map((run, k) => run.info?.name ?? named[shown[k]].name).join(' and ')} – incognita`);
  runs.forEach((run) => run.on('info', showTitle));
  showTitle();
  byId('runs').classList.toggle('two', runs.length > 1);
  byId('runs').replaceChildren(...views.map((view) => view.element));
  const newRun = newRunDialog(runs[0], session);
  const help = helpDialog();
  const theme = themeButton(() => views.forEach((view) => view.updateTheme()));
  document.body.append(announcer(runs, session, clock), newRun.dialog, help);
  byId('messages').replaceWith(messages(session));
  buildTools(clock, () => views.forEach((view) => view.savePlots()), theme, help);
  const loop = loopBar(session, newRun.open);
  const line = timeline(runs, clock);
  byId('bar').append(...(mode === 'live' ? [loop] : []), line);

  const replaying = () => clock.replaying;
  const preset = (/** @type {import('./scene/view-control.js').Preset} */ which) => () =>
    views.forEach((view) => view.preset(which));
  listenToShortcuts({
    ' ': () => (replaying() ? line.togglePlay() : session.control && loop.space()),
    '.': () => (replaying() ? line.frame(1) : session.control && loop.step()),
    ',': () => replaying() && line.frame(-1),
    ']': () => replaying() && line.event(1),
    '[': () => replaying() && line.event(-1),
    1: preset('top'),
    2: preset('side'),
    3: preset('follow'),
    4: preset('map'),
    0: preset('reset'),
    n: () => session.control && newRun.open(),
    t: () => theme.click(),
    '?': () => help.showModal(),
  }, (key) => key === ' ' && !replaying() && robotStop(session.loop).shown);
  clock.on(
    'time',
    () => replaying() && replays.forEach((replay) => replay.showTime(clock.time, clock.playing)),
  );
  clock.on('playing', () => (line.hidden = !replaying()));
  clock.setReplaying(false);
  if (mode === 'live') startLive(runs[0], session, clock);
  else startReplay(runs, session, clock);
}

/** @param {Clock} clock @param {() => void} savePlots @param {HTMLElement} theme @param {HTMLDialogElement} help */
function buildTools(clock, savePlots, theme, help) {
  const span = select(SPANS, (value) => clock.setSpan(Number(value)), { 'aria-label': 'time shown by the plots' });
  byId('tools').append(
    labeled('plots', span),
    button('Save plots', savePlots, { class: 'quiet save-plots', title: 'Save every plot as an SVG file' }),
    theme,
    button('? Help', () => help.showModal(), { class: 'quiet' }),
  );
}

/**
 * A live run that has ended can be replayed.
 * @param {RunState} run
 * @param {Session} session
 * @param {Clock} clock
 */
function startLive(run, session, clock) {
  let ended = false;
  /** Runs whose end has been shown, and whose whole series has been asked for. */
  let [shown, whole] = [-1, -1];
  const show = () => {
    if (!ended || run.series.t.length === 0) return;
    if (!run.snapshot || run.index !== shown) clock.seek(run.index === shown ? clock.time : clock.range[1]);
    shown = run.index;
    if (!run.series.hasGaps || run.index === whole) return;
    whole = run.index;
    readWholeSeries(run, session, clock);
  };
  session.on('loop', () => {
    const now = session.loop.ended !== null;
    if (now === ended) return;
    ended = now;
    clock.setReplaying(ended);
    show();
  });
  run.on('series', show);
  followLiveRun(run, session);
}

/**
 * What this page missed of a live run is in its files after the end.
 * @param {RunState} run @param {Session} session @param {Clock} clock
 */
async function readWholeSeries(run, session, clock) {
  const { index } = run;
  try {
    const series = await fetchSeries(index);
    if (index !== run.index) return;
    run.setSeries(series);
    clock.seek(clock.time);
  } catch (error) {
    session.report(/** @type {Error} */ (error).message, 'The whole run could not be read:');
  }
}

/** @param {RunState[]} runs @param {Session} session @param {Clock} clock */
async function startReplay(runs, session, clock) {
  try {
    await Promise.all(
      runs.map(async (run) => {
        const { index } = run;
        const [info, series, observability] = await Promise.all([
          fetchInfo(index),
          fetchSeries(index),
          fetchFinalObservability(index),
        ]);
        run.setInfo(info);
        run.setSeries(series);
        if (observability) run.setObservability(observability);
      }),
    );
  } catch (error) {
    session.report(/** @type {Error} */ (error).message, 'The run could not be read:');
  }
  clock.setReplaying(true);
  clock.seek(clock.range[0]);
}

start();
