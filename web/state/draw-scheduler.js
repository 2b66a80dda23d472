// Drawing on demand: at most once per animation frame, optionally at a limited rate.

/**
 * @param {() => void} draw
 * @param {number} [minIntervalMs]
 * @returns {() => void} requests a drawing
 */
export function onDemand(draw, minIntervalMs = 0) {
  let requested = false;
  let last = -Infinity;
  const run = () => {
    requested = false;
    last = performance.now();
    draw();
  };
  return () => {
    if (requested) return;
    requested = true;
    const wait = last + minIntervalMs - performance.now();
    if (wait > 4) setTimeout(() => requestAnimationFrame(run), wait);
    else requestAnimationFrame(run);
  };
}
