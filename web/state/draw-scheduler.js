// Drawing on demand: at most once per animation frame, optionally at a limited rate.

/** Pause after a drawing at a limited rate, at least, in times of its duration: a long run must leave time for the rest. */
const PAUSE = 4;

/**
 * @param {() => void} draw
 * @param {number} [minIntervalMs] 0: once per animation frame
 * @returns {() => void} requests a drawing
 */
export function onDemand(draw, minIntervalMs = 0) {
  let requested = false;
  let next = -Infinity;
  const run = () => {
    requested = false;
    const start = performance.now();
    draw();
    const end = performance.now();
    next = minIntervalMs > 0 ? Math.max(start + minIntervalMs, end + PAUSE * (end - start)) : start;
  };
  return () => {
    if (requested) return;
    requested = true;
    const wait = next - performance.now();
    if (wait > 4) setTimeout(() => requestAnimationFrame(run), wait);
    else requestAnimationFrame(run);
  };
}
