// Colors of theme.css for three.js.
import { Color } from './three.js';

/** @param {string} name such as '--blue' @returns {string} the value in the present theme */
export function themeColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** @param {string} name such as '--blue' @returns {Color} */
export function sceneColor(name) {
  return new Color(themeColor(name));
}
