// The page of the claims ledger: its first screen, the counts that filter, links to claims, and citations.
import assert from 'node:assert/strict';
import test from 'node:test';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openPage } from './harness/page.mjs';
import { runFolder, serve } from './harness/program.mjs';

const SENTENCE = 'Once a linear filter without an anchor has settled, it corrects its landmarks no more, however often they are seen: ' +
  'one of the eigenvalues of its error is 1.';

/** Twelve claims of the thesis in Chapters 3 and 4, all with a headline, and one of ours. */
function ledger() {
  const claim = (id, more) => ({ id, origin: 'thesis', place: 'Figure 3.4', section: '3.1', pages: '42-51', quotation: 'It settles.',
    statement: 'it settles', printed: '', measured: 'yes', rule: 'equality', finding: 'holds', verdict: 'holds', why: '', runs: 20, least_runs: 20, ...more });
  const of = (chapter, finding) => Array.from({ length: 6 }, (_, i) =>
    claim(`${chapter}-${i}`, { section: `${chapter}.1`, finding: i < 2 ? finding : 'holds', why: i < 2 ? 'so' : '', headline: SENTENCE,
      number: { what: 'rms error', value: 0.158, low: 0.143, high: 0.176, unit: 'm' } }));
  const own = { ...claim('ours', { origin: 'own' }), section: undefined, pages: undefined, quotation: undefined };
  const figure = { id: 'fig-3.4', file: 'figures/fig-3.4.svg', data: '' };
  return [{ id: '3.1', title: 'A monobot', claims: of(3, 'misprint'), figures: [figure] },
    { id: '4.1', title: 'Bearings', claims: [...of(4, 'does-not-hold'), own], figures: [] }];
}

/** @param {import('node:test').TestContext} t @param {string} [path] behind the address @param {object} [options] */
async function openLedger(t, path = '', options = {}) {
  const folder = runFolder();
  mkdirSync(join(folder, 'figures'), { recursive: true });
  writeFileSync(join(folder, 'claims.json'), JSON.stringify(ledger()));
  writeFileSync(join(folder, 'figures/fig-3.4.svg'), '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 460"/>');
  const { address } = await serve(t, ['view', folder]);
  const page = new URL('laboratory/claims.html', address).href + new URL(address).search;
  return openPage(t, page + path, { height: 800, ready: () => document.querySelector('.claim, .problem'), ...options });
}

/** Ids of the claims that are shown. @param {import('playwright-core').Page} page */
const shown = (page) => page.locator('.claim').evaluateAll((claims) => claims.map(({ id }) => id));

test('ten findings and the counts are on the first screen, and nothing is wider than a phone', async (t) => {
  const page = await openLedger(t);
  assert.equal(await page.locator('#headlines li').count(), 10);
  const bottom = await page.locator('.front').evaluate((front) => front.getBoundingClientRect().bottom);
  assert(bottom <= 800, `the first screen ends at ${bottom} px`);
  await page.setViewportSize({ width: 390, height: 844 });
  for (const view of ['Claims', 'Errata', 'How a claim is decided']) {
    await page.getByRole('link', { name: view, exact: true }).click();
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert(width <= 390, `${view}: ${width} px wide`);
  }
});

test('a cell of the counts filters, the address says so, and the way back leads to all', async (t) => {
  const page = await openLedger(t);
  await page.getByRole('link', { name: 'Chapter 3, misprint: 2' }).click();
  assert.deepEqual(await shown(page), ['3-0', '3-1']);
  assert.match(page.url(), /[?&]finding=misprint&chapter=3&origin=thesis$/);
  assert.equal(await page.locator('.counts [aria-current]').innerText(), '2');
  await page.reload();
  await page.locator('.claim').first().waitFor();
  assert.deepEqual(await shown(page), ['3-0', '3-1']);
  await page.goBack();
  assert.equal((await shown(page)).length, 13);
  await page.getByLabel('Who makes the claim').selectOption('own');
  assert.deepEqual(await shown(page), ['ours']);
});

test('links to claims work whatever is shown, and one without a claim says so', async (t) => {
  const page = await openLedger(t, '#4-0');
  await page.locator('[id="4-0"]:focus').waitFor();
  await page.getByRole('link', { name: 'Errata' }).click();
  await page.locator('#errata').getByRole('link', { name: '3-1' }).click();
  await page.locator('[id="3-1"]:focus').waitFor();
  await page.locator('[id="3-1"]').getByRole('link', { name: 'equality' }).click();
  await page.getByText('The interval lies within the margin').waitFor();
  await page.getByRole('link', { name: 'Claims', exact: true }).click();
  await page.getByRole('button', { name: 'does not hold' }).click();
  await page.evaluate(() => (location.hash = '#3-2')); // which the filter hides
  await page.locator('[id="3-2"]:focus').waitFor();
  await page.evaluate(() => (location.hash = '#3-old'));
  await page.getByText('This ledger has no claim 3-old').waitFor();
});

test('a citation is copied, or shown where the browser does not allow that', async (t) => {
  const page = await openLedger(t);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.locator('[id="3-0"]').getByRole('button', { name: 'Copy citation' }).click();
  await page.getByText('Copied', { exact: true }).waitFor();
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(copied, /^\[3-0\] “It settles\.” .*Section 3\.1, pp\. 42–51.*Finding: misprint\. Rms error: 0\.158 m \(95 % interval 0\.143 to 0\.176\)/);
  await page.evaluate(() => Object.defineProperty(navigator, 'clipboard', { value: undefined }));
  await page.locator('[id="3-1"]').getByRole('button', { name: 'Copy citation' }).click();
  assert.match(await page.getByRole('textbox', { name: 'Citation' }).inputValue(), /^\[3-1\] /);
});
