// Breaks a long result into its parts, so that it can be read as a list, and folded.

/**
 * The text at its semicolons outside parentheses: "a (b; c); d" has two parts.
 * @param {string} text @returns {string[]}
 */
export function partsOf(text) {
  const parts = [];
  let depth = 0;
  let start = 0;
  for (let i = 0; i < text.length; ++i) {
    if (text[i] === '(') ++depth;
    else if (text[i] === ')') depth = Math.max(0, depth - 1);
    else if (text[i] === ';' && depth === 0 && text[i + 1] === ' ') {
      parts.push(text.slice(start, i));
      start = i + 2;
    }
  }
  parts.push(text.slice(start));
  return parts.map((part) => part.trim()).filter(Boolean);
}

/**
 * The parts that are shown at once, about `letters` long together but one at least, and the rest. A long text without
 * semicolons has its sentences as parts.
 * @param {string} text @param {number} letters @returns {{shown: string[], folded: string[]}}
 */
export function foldedParts(text, letters) {
  const whole = partsOf(text);
  if (text.length <= 1.3 * letters) return { shown: whole, folded: [] };
  const parts = whole.length > 1 ? whole : text.split(/(?<=\.) +(?=[A-Z])/);
  let length = 0;
  const over = parts.findIndex((part, i) => (length += part.length) > letters && i > 0);
  return over < 0 ? { shown: parts, folded: [] } : { shown: parts.slice(0, over), folded: parts.slice(over) };
}
