// The image of the camera with the matches of the same frame.
import { onDemand } from '../state/draw-scheduler.js';
import { drawMatches } from './overlay.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/types.js').Info} Info */
/** @typedef {import('../state/types.js').Match} Match */
/** @typedef {import('../state/types.js').Snapshot} Snapshot */

/** Pixels of a saved picture per pixel of the page, at least. */
export const PNG_RATIO = 2;

export class CameraView {
  /** @type {ImageBitmap | null} */
  #bitmap = null;
  #bitmapFrame = -1;
  #decoding = false;
  /** Lowest number of a camera of body 1 with matches in this run: its image is shown. */
  #sensor = Infinity;
  options = { overlay: true, ids: false };

  /** @param {HTMLCanvasElement} canvas @param {RunState} run @param {(words: string) => void} setNote */
  constructor(canvas, run, setNote) {
    this.canvas = canvas;
    this.run = run;
    this.setNote = setNote;
    this.draw = onDemand(() => this.drawNow());
    run.on('info', () => this.#forget());
    run.on('image', () => this.#decode());
    run.on('snapshot', () => this.draw());
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** @returns {Promise<Blob | null>} the present view as PNG */
  async png() {
    this.drawNow(Math.max(PNG_RATIO, window.devicePixelRatio));
    const png = new Promise((/** @type {(png: Blob | null) => void} */ resolve) => this.canvas.toBlob(resolve));
    this.drawNow();
    return png;
  }

  #forget() {
    this.#sensor = Infinity;
    this.#bitmap?.close();
    this.#bitmap = null;
    this.#bitmapFrame = -1;
    this.draw();
    this.#decode();
  }

  /** Decodes the newest image; those that arrive meanwhile are skipped. */
  async #decode() {
    if (this.#decoding) return;
    this.#decoding = true;
    while (this.run.image && this.run.image.frame !== this.#bitmapFrame) {
      const { frame, jpeg } = this.run.image;
      const bitmap = jpeg && (await createImageBitmap(jpeg).catch(() => null));
      if (!this.run.image) bitmap?.close(); // of the run before
      if ((jpeg && !bitmap) || !this.run.image) break;
      this.#bitmap?.close();
      this.#bitmap = bitmap;
      this.#bitmapFrame = frame;
      this.draw();
    }
    this.#decoding = false;
  }

  /** @param {number} [ratio] pixels drawn per pixel of the page */
  drawNow(ratio = window.devicePixelRatio) {
    const camera = this.run.info?.camera;
    const context = this.canvas.getContext('2d');
    if (!camera || !context || this.canvas.clientWidth === 0) return;
    const width = Math.round(this.canvas.clientWidth * ratio);
    const height = Math.round((width * camera.height) / camera.width);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const style = getComputedStyle(document.documentElement);
    context.fillStyle = style.getPropertyValue('--line');
    context.fillRect(0, 0, width, height);
    context.imageSmoothingEnabled = false;
    if (this.#bitmap) context.drawImage(this.#bitmap, 0, 0, width, height);
    const snapshot = this.#snapshotOfImage();
    const matches = this.#cameraMatches(snapshot);
    if (this.options.overlay) {
      drawMatches(context, matches, {
        scale: width / camera.width,
        line: ratio,
        patchSize: this.run.info?.patch_size_px ?? 11,
        color: brightColor,
        ids: this.options.ids,
      });
    }
    this.setNote(this.#note(snapshot));
  }

  /** @returns {Snapshot | null} */
  #snapshotOfImage() {
    return this.run.recent.get(this.#bitmapFrame) ?? this.run.snapshot;
  }

  /**
   * Matches in the first camera of body 1, whose image the program sends. Simulated cameras measure image
   * positions without images.
   * @param {Snapshot | null} snapshot @returns {Match[]}
   */
  #cameraMatches(snapshot) {
    const ofLandmarks = (snapshot?.matches ?? []).filter(({ kind, body }) => kind !== 'body' && body === 1);
    const inImages = ofLandmarks.filter((match) => match.image);
    this.#sensor = Math.min(this.#sensor, ...inImages.map((match) => match.sensor));
    const all = this.#sensor < Infinity ? inImages : ofLandmarks;
    const sensor = this.#sensor < Infinity ? this.#sensor : all[0]?.sensor;
    return all.filter((match) => match.sensor === sensor);
  }

  /** @param {Snapshot | null} snapshot */
  #note(snapshot) {
    if (withoutImages(this.run.info)) return 'no images';
    if (!this.#bitmap) return this.#bitmapFrame < 0 ? 'no image yet' : `no image of frame ${this.#bitmapFrame}`;
    if (!snapshot || snapshot.frame === this.#bitmapFrame) return `frame ${this.#bitmapFrame}`;
    return `image of frame ${this.#bitmapFrame}, matches of frame ${snapshot.frame}`;
  }
}

/**
 * Whether a live run has image positions without images: the lens of its camera cannot be covered then. Of a
 * recorded run it is not known, it takes no disturbances.
 * @param {Info | null} info
 */
function withoutImages(info) {
  const disturbances = info?.disturbances ?? [];
  return disturbances.length > 0 && !disturbances.includes('cover-lens');
}

/** Colors over an image are the same in both themes: the light ones of the Okabe-Ito palette. */
const OVER_IMAGE = {
  '--green': '#2cc295',
  '--vermilion': '#ff7f3a',
  '--purple': '#f09fd0',
  '--orange': '#ffb000',
  '--gray': '#c8ced8',
  '--sky': '#7fd0ff',
  '--blue': '#4aa8e0',
};

/** @param {string} name @returns {string} */
export function brightColor(name) {
  return /** @type {Record<string, string>} */ (OVER_IMAGE)[name] ?? '#ffffff';
}
