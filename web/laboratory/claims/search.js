// Full-text search: all words of the query must occur; "several words" in quotes must occur as they are.

/**
 * Lower case without accents, of the same length as the text, so that positions in it are positions in the
 * text.
 * @param {string} text @returns {string}
 */
export function folded(text) {
  return Array.from(text, (letter) => {
    const base = letter
      .normalize('NFD')
      .replace(/[\u0300-\u036f]/g, '')
      .toLowerCase();
    return base.length === letter.length ? base : letter;
  }).join('');
}

/**
 * The words and quoted phrases of a query, folded, without duplicates.
 * @param {string} query @returns {string[]}
 */
export function termsOf(query) {
  /** @type {string[]} */
  const terms = [];
  for (const [, phrase, word] of folded(query).matchAll(/"([^"]*)"?|([^\s"]+)/g)) {
    const term = (phrase ?? word).trim().replace(/\s+/g, ' ');
    if (term && !terms.includes(term)) terms.push(term);
  }
  return terms;
}

/** Whether every term occurs in the folded text. @param {string} foldedText @param {string[]} terms */
export function matches(foldedText, terms) {
  return terms.every((term) => foldedText.includes(term));
}

/**
 * The text in pieces, where `found` marks occurrences of a term; overlapping ones are one piece.
 * @param {string} text @param {string[]} terms
 * @returns {{text: string, found: boolean}[]}
 */
export function highlighted(text, terms) {
  const haystack = folded(text);
  /** @type {[number, number][]} */
  const covered = [];
  for (const term of terms)
    for (let at = haystack.indexOf(term); at >= 0; at = haystack.indexOf(term, at + 1))
      covered.push([at, at + term.length]);
  covered.sort((a, b) => a[0] - b[0]);
  const pieces = [];
  let done = 0;
  for (const [from, to] of covered) {
    if (to <= done) continue;
    const start = Math.max(from, done);
    if (start > done) pieces.push({ text: text.slice(done, start), found: false });
    const last = pieces.at(-1);
    if (last?.found) last.text += text.slice(start, to);
    else pieces.push({ text: text.slice(start, to), found: true });
    done = to;
  }
  if (done < text.length) pieces.push({ text: text.slice(done), found: false });
  return pieces;
}
