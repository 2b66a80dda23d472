// What is drawn over the image: search ellipses, patches, depth particles of rays. Units: pixels of the
// image; pixel (0,0) is the center of the first pixel, so that an image position u lies at u + 0.5 pixel
// widths from the left edge.
import { covarianceEllipse } from '../math/ellipse.js';
import { OUTCOMES } from '../state/outcomes.js';
/** @typedef {import('../state/types.js').Match} Match */
/** @typedef {import('../state/outcomes.js').Shape} Shape */

const SIGMAS = 3;
const MARK_PX = 5;

/**
 * @typedef {object} OverlayStyle
 * @property {number} scale screen pixels per image pixel
 * @property {number} line width of a line, screen pixels
 * @property {number} patchSize side of a patch, image pixels
 * @property {(name: string) => string} color value of a color of the theme
 * @property {boolean} ids whether to write the numbers of landmarks
 */

/**
 * @param {CanvasRenderingContext2D} context in screen pixels
 * @param {Match[]} matches those of the shown image
 * @param {OverlayStyle} style
 */
export function drawMatches(context, matches, style) {
  for (const match of matches) {
    const outcome = OUTCOMES[match.outcome];
    if (!outcome) continue;
    const color = style.color(outcome.color);
    if (match.particles) drawParticles(context, match.particles, color, style);
    const paths = [
      ...(match.predicted && match.innovation_cov ? [ellipsePath(match, style)] : []),
      ...(match.measured ? [patchPath(match.measured, style)] : []),
    ];
    for (const path of paths) {
      context.lineWidth = 2.4 * style.line;
      context.setLineDash([]);
      context.strokeStyle = 'rgba(0, 0, 0, 0.55)';
      context.stroke(path);
      context.lineWidth = 1.5 * style.line;
      context.setLineDash(outcome.dash.map((length) => length * style.line));
      context.strokeStyle = color;
      context.stroke(path);
    }
    const center = match.measured ?? match.predicted;
    if (center)
      drawMark(
        context,
        outcome.shape,
        at(center[0], style),
        at(center[1], style),
        MARK_PX * style.line,
        color,
      );
    if (center && style.ids) drawId(context, match.id, center, style);
  }
  context.setLineDash([]);
}

/** @param {number} coordinate image pixels @param {OverlayStyle} style */
function at(coordinate, style) {
  return (coordinate + 0.5) * style.scale;
}

/** @param {Match} match @param {OverlayStyle} style @returns {Path2D} */
function ellipsePath(match, style) {
  const [u, v] = /** @type {number[]} */ (match.predicted);
  const { major, minor, angle } = covarianceEllipse(/** @type {number[]} */ (match.innovation_cov), SIGMAS);
  const path = new Path2D();
  path.ellipse(at(u, style), at(v, style), major * style.scale, minor * style.scale, angle, 0, 2 * Math.PI);
  return path;
}

/** @param {number[]} measured @param {OverlayStyle} style @returns {Path2D} */
function patchPath([u, v], style) {
  const side = style.patchSize * style.scale;
  const path = new Path2D();
  path.rect(at(u, style) - side / 2, at(v, style) - side / 2, side, side);
  return path;
}

/** Depth hypotheses of a ray: the more probable, the more opaque. @param {CanvasRenderingContext2D} context
 * @param {number[][]} particles @param {string} color @param {OverlayStyle} style */
function drawParticles(context, particles, color, style) {
  const largest = Math.max(...particles.map((particle) => particle[2]), 1e-12);
  context.fillStyle = color;
  const side = 2.5 * style.line;
  for (const [u, v, weight] of particles) {
    context.globalAlpha = 0.25 + 0.75 * (weight / largest);
    context.fillRect(at(u, style) - side / 2, at(v, style) - side / 2, side, side);
  }
  context.globalAlpha = 1;
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number} id
 * @param {number[]} center
 * @param {OverlayStyle} style
 */
function drawId(context, id, [u, v], style) {
  context.font = `${11 * style.line}px system-ui, sans-serif`;
  context.lineWidth = 3 * style.line;
  context.setLineDash([]);
  context.strokeStyle = 'rgba(0, 0, 0, 0.7)';
  context.fillStyle = '#ffffff';
  const [x, y] = [at(u, style) + 8 * style.line, at(v, style) - 6 * style.line];
  context.strokeText(String(id), x, y);
  context.fillText(String(id), x, y);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Shape} shape @param {number} x @param {number} y @param {number} radius @param {string} color
 */
export function drawMark(context, shape, x, y, radius, color) {
  const path = new Path2D();
  const r = radius;
  let stroked = false;
  if (shape === 'disc') path.arc(x, y, 0.55 * r, 0, 2 * Math.PI);
  else if (shape === 'dot') path.arc(x, y, 0.35 * r, 0, 2 * Math.PI);
  else if (shape === 'diamond') {
    path.moveTo(x, y - r);
    for (const [dx, dy] of [
      [r, 0],
      [0, r],
      [-r, 0],
    ])
      path.lineTo(x + dx, y + dy);
    path.closePath();
  } else {
    stroked = true;
    const d = 0.75 * r;
    if (shape === 'cross')
      segments(path, [
        [x - d, y - d, x + d, y + d],
        [x - d, y + d, x + d, y - d],
      ]);
    else if (shape === 'plus')
      segments(path, [
        [x - r, y, x + r, y],
        [x, y - r, x, y + r],
      ]);
    else if (shape === 'ring') path.arc(x, y, 0.7 * r, 0, 2 * Math.PI);
    else path.rect(x - d, y - d, 2 * d, 2 * d);
  }
  context.setLineDash([]);
  context.lineWidth = 0.4 * r;
  context.strokeStyle = context.fillStyle = color;
  if (stroked) context.stroke(path);
  else context.fill(path);
}

/** @param {Path2D} path @param {number[][]} lines x0 y0 x1 y1 each */
function segments(path, lines) {
  for (const [x0, y0, x1, y1] of lines) {
    path.moveTo(x0, y0);
    path.lineTo(x1, y1);
  }
}
