// The page of a campaign: a list of measures, and of the chosen one the strip plot and the tables.
import { element, svgElement } from '../shared/elements.js';
import { loadJson, loadText } from '../shared/files.js';
import { showProblem } from '../shared/problem.js';
import { measureList, measuresOf } from './measure_list.js';
import { aboutOf, labelOf, shortNames } from './measures.js';
import { percent } from './numbers.js';
import { rowsOf } from './rows.js';
import { readRuns } from './runs.js';
import { saveSvg } from './save_svg.js';
import { drawStripPlot } from './strip_plot.js';
import { failures, seedTable, variantTable } from './tables.js';

const byId = (id) => document.getElementById(id);
const wide = matchMedia('(min-width: 900px)');
let campaign, runs, names, measure, markChosen;
let runsProblem = '';

const asDifferences = () => byId('as-differences').checked;

function highlight(seed) {
  for (const dot of byId('plot').querySelectorAll('[data-seed]'))
    dot.classList.toggle('same-seed', seed !== null && dot.dataset.seed === String(seed));
}

function drawPlot() {
  const frame = byId('plot');
  if (runsProblem) {
    frame.replaceChildren(
      element(
        'p',
        { class: 'problem' },
        `${runsProblem}: without it there are no values of single seeds to plot.`,
      ),
    );
    return;
  }
  const rows = rowsOf(campaign, runs, measure, asDifferences());
  const baseline = names.get(campaign.baseline);
  const less = `less ${baseline.length < 42 ? baseline : 'the baseline'}`;
  const labels = asDifferences() ? [labelOf(measure), less, 'on the same seed'] : [labelOf(measure)];
  const node = svgElement('svg', {
    role: 'img',
    'aria-label': `Strip plot of ${labels.join(' ')}; the tables below hold its numbers`,
  });
  frame.replaceChildren(node);
  drawStripPlot(node, {
    rows,
    names,
    labels,
    asDifferences: asDifferences(),
    symmetricLog: byId('symmetric-log').checked,
    title: [measure, aboutOf(measure)].filter(Boolean).join(': '),
    width: Math.max(300, frame.clientWidth),
    onSeed: highlight,
  });
}

function show() {
  markChosen(measure);
  byId('baseline').textContent = names.get(campaign.baseline);
  byId('tables').replaceChildren(
    element('div', { class: 'scroll wide-table' }, variantTable(campaign, measure, names)),
    runs.length
      ? element(
          'details',
          {},
          element('summary', {}, 'Values of every seed'),
          element('div', { class: 'scroll', tabindex: '0' }, seedTable(campaign, runs, measure, names)),
        )
      : [],
  );
  drawPlot();
}

function choose(chosen) {
  measure = chosen;
  const parameters = new URLSearchParams(location.search);
  parameters.set('measure', measure);
  history.replaceState(null, '', `?${parameters}`);
  if (!wide.matches) byId('measures-fold').open = false;
  show();
}

function showHead() {
  const total = campaign.variants.reduce((sum, variant) => sum + variant.runs, 0);
  const failed = campaign.variants.reduce((sum, variant) => sum + variant.failed, 0);
  const missing = campaign.variants.reduce((sum, variant) => sum + variant.missing, 0);
  byId('title').textContent = `Campaign ${campaign.scenario}`;
  document.title = `${campaign.scenario} campaign · incognita`;
  const counts = [
    `${campaign.variants.length} variants on ${campaign.seeds.length} seeds`,
    failed ? `${failed} of ${total} runs failed` : `none of ${total} runs failed`,
    missing ? `${missing} not ended` : '',
  ];
  byId('about').textContent = counts.filter(Boolean).join(', ');
  const level = percent(campaign.confidence);
  byId('legend').textContent =
    `${level} interval of the paired difference, by variant: ▼ lower than the baseline, ▲ higher, ` +
    `· contains 0. Of equal variants ${percent(1 - campaign.confidence)} of the intervals exclude 0 by chance.`;
  byId('key').textContent =
    `A dot per seed. Diamond and bar: the mean and its ${level} interval. × a failed run, – a run ` +
    'without a value. Point at a dot to see its seed in every row.';
  byId('failures').hidden = failed + missing === 0;
  byId('failures-list').replaceChildren(failures(campaign, names));
}

function connectControls() {
  for (const id of ['as-differences', 'as-values', 'symmetric-log'])
    byId(id).addEventListener('change', drawPlot);
  if (campaign.variants.length === 1) byId('as-values').checked = byId('as-differences').disabled = true;
  byId('save').addEventListener('click', () => {
    const node = byId('plot').querySelector('svg');
    if (node)
      saveSvg(
        node,
        `${campaign.scenario}-${measure.replace(/[^\w.-]+/g, '-')}${asDifferences() ? '-paired' : ''}.svg`,
      );
  });
  byId('measures-fold').open = wide.matches;
  new ResizeObserver(drawPlot).observe(byId('plot'));
}

async function loadRuns() {
  try {
    return readRuns(await loadText('runs.csv'));
  } catch (error) {
    runsProblem = error.message;
    return [];
  }
}

try {
  [campaign, runs] = await Promise.all([loadJson('campaign.json'), loadRuns()]);
  names = shortNames(campaign.variants);
  const all = measuresOf(campaign);
  const asked = new URLSearchParams(location.search).get('measure');
  measure = [asked, 'ate_m', 'entropy.total'].find((name) => all.includes(name)) ?? all[0];
  if (!measure) throw new Error('campaign.json has no measures: no run has ended yet');
  showHead();
  markChosen = measureList(byId('measures'), campaign, names, choose);
  connectControls();
  show();
} catch (error) {
  console.error(error);
  showProblem(
    byId('main'),
    error,
    'A campaign is a folder that incognita campaign --out DIR wrote; incognita view DIR shows it.',
  );
}
