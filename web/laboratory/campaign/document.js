// campaign.json, checked to be the document of a campaign.
/** @typedef {import('./types.js').Campaign} Campaign */

/** @param {unknown} document @returns {Campaign} */
export function readCampaign(document) {
  const campaign = /** @type {Partial<Campaign> | null} */ (document);
  if (!Array.isArray(campaign?.variants) || !Array.isArray(campaign.seeds))
    throw new Error(
      'campaign.json is not the document of a campaign: it has no list of variants and of seeds',
    );
  return /** @type {Campaign} */ (campaign);
}
