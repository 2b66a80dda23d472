// Drawn over the camera's picture: which parts of the image had corners, and the corners of the newest image.
/** @typedef {import('../connection/calibration-socket.js').CalibrationState} CalibrationState */

/** Corners in a cell beyond which its color does not change. */
const MANY = 40;

/** @param {HTMLCanvasElement} canvas @param {CalibrationState} state @param {number} width px of the image @param {number} height */
export function drawOverlay(canvas, { newest, result }, width, height) {
  if (!width || !height) return;
  Object.assign(canvas, { width, height });
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.clearRect(0, 0, width, height);
  if (result) drawCoverage(context, result.coverage.corners, width, height);
  context.fillStyle = newest.refusal ? '#e69f00' : '#2cc295';
  const radius = Math.max(2, width / 200);
  for (const [u, v] of newest.corners) {
    context.beginPath();
    context.arc(u, v, radius, 0, 2 * Math.PI);
    context.fill();
  }
}

/** @param {CanvasRenderingContext2D} context @param {number[][]} cells corners by row and column @param {number} width @param {number} height */
function drawCoverage(context, cells, width, height) {
  const cellHeight = height / cells.length;
  cells.forEach((row, i) =>
    row.forEach((count, j) => {
      const cellWidth = width / row.length;
      context.fillStyle = `rgba(44, 194, 149, ${(0.4 * Math.min(1, count / MANY)).toFixed(3)})`;
      context.fillRect(j * cellWidth, i * cellHeight, cellWidth, cellHeight);
      context.strokeStyle = 'rgba(255, 255, 255, 0.25)';
      context.strokeRect(j * cellWidth, i * cellHeight, cellWidth, cellHeight);
    }),
  );
}
