// Start of the page of a campaign: loads its files, and shows the measure that the address asks for.
import { byId } from '../shared/elements.js';
import { loadJson, loadText } from '../shared/files.js';
import { messageOf, showProblem } from '../shared/problem.js';
import { CampaignView } from './campaign_view.js';
import { readCampaign } from './document.js';
import { showHead } from './head.js';
import { measuresOf } from './measure_list.js';
import { shortNames } from './measures.js';
import { readRuns } from './runs.js';
/** @typedef {import('./campaign_view.js').LoadedRuns} LoadedRuns */

/** @returns {Promise<LoadedRuns>} */
async function loadRuns() {
  try {
    return { runs: readRuns(await loadText('runs.csv')), problem: '' };
  } catch (error) {
    return { runs: [], problem: messageOf(error) };
  }
}

/** The measure that the address asks for, else one that most campaigns have. @param {string[]} all */
function firstMeasure(all) {
  const asked = new URLSearchParams(location.search).get('measure');
  return (
    all.find((name) => name === asked) ??
    ['ate_m', 'entropy.total'].find((name) => all.includes(name)) ??
    all[0]
  );
}

try {
  const [document, loaded] = await Promise.all([loadJson('campaign.json'), loadRuns()]);
  const campaign = readCampaign(document);
  const measure = firstMeasure(measuresOf(campaign));
  if (!measure) throw new Error('campaign.json has no measures: no run has ended yet');
  const names = shortNames(campaign.variants);
  showHead(campaign, names);
  new CampaignView(campaign, loaded, names, measure);
} catch (error) {
  console.error(error);
  showProblem(
    byId('main'),
    error,
    'A campaign is a folder that incognita campaign --out DIR wrote; incognita view DIR shows it.',
  );
}
