// The camera of this device: takes its images, each with the time when it was taken, and sends them as JPEG.
import { CameraSocket } from '../connection/camera-socket.js';
import { Emitter } from '../state/emitter.js';

const JPEG_QUALITY = 0.92;
/** Images whose arrival at the run is waited for. */
const MOST_REMEMBERED = 300;

/**
 * Why a browser gives no camera, in words with the remedy.
 * @param {unknown} error of getUserMedia
 */
export function whyNoCamera(error) {
  const name = error instanceof DOMException ? error.name : '';
  if (name === 'NotAllowedError') return 'The browser did not give the camera: allow it for this page in the bar of the address.';
  if (name === 'NotFoundError') return 'This device has no camera.';
  if (name === 'NotReadableError') return 'The camera is used by another program.';
  return `The camera cannot be used: ${error instanceof Error ? error.message : error}`;
}

/**
 * A device that is turned gives images of another size, of another camera model.
 * @param {number} width px of the images until now @param {number} height @param {number} newWidth @param {number} newHeight
 */
function whyTurned(width, height, newWidth, newHeight) {
  return (
    `The device was turned: its images are ${newWidth}x${newHeight} px now, and were ${width}x${height} px. ` +
    'Hold it as before, and start the camera again.'
  );
}

/** @param {MediaStream} stream */
function stopStream(stream) {
  stream.getTracks().forEach((track) => track.stop());
}

/** Browsers give the camera only to pages that are encrypted, or of the same machine. */
export const INSECURE =
  'Browsers give the camera to encrypted pages only: start the program with --https, and open the address that it prints.';

/** Emits `change` when state or words change, and `used` for each image that the run used. */
export class DeviceCamera extends Emitter {
  /** @type {'off' | 'starting' | 'sending'} */
  state = 'off';
  words = '';
  sent = 0;
  skipped = 0;
  /** ms from the moment an image was taken until the run's answer to it was here. @type {number[]} */
  latenciesMs = [];
  video = document.createElement('video');

  /** @type {MediaStream | null} */
  #stream = null;
  /** @type {CameraSocket | null} */
  #socket = null;
  #canvas = document.createElement('canvas');
  /** Grows with each start and stop: what is pending of an earlier start is void. */
  #starts = 0;
  /** When the images under way were taken, ms on the clock of the page, by their time for the run. @type {Map<number, number>} */
  #takenMs = new Map();

  constructor() {
    super();
    this.video.muted = true;
    this.video.playsInline = true;
  }

  /**
   * @param {{width: number, height: number}} size of the images that the run needs
   * @param {string} [deviceId] empty: that which looks away from the user
   */
  async start({ width, height }, deviceId = '') {
    if (!navigator.mediaDevices) return this.#stopWith(INSECURE);
    const start = ++this.#starts;
    const isVoid = () => start !== this.#starts;
    this.#set('starting', 'Waiting for the camera …');
    try {
      const which = deviceId ? { deviceId: { exact: deviceId } } : { facingMode: { ideal: 'environment' } };
      const stream = await navigator.mediaDevices.getUserMedia({
        video: { ...which, width: { ideal: width }, height: { ideal: height } },
        audio: false,
      });
      if (isVoid()) return stopStream(stream);
      this.#stream = stream;
      this.video.srcObject = stream;
      await this.video.play();
    } catch (error) {
      if (!isVoid()) this.#stopWith(whyNoCamera(error));
      return;
    }
    if (!isVoid()) this.#connect();
  }

  /** The cameras of this device, with their names once one was used. @returns {Promise<{id: string, name: string}[]>} */
  async devices() {
    const all = (await navigator.mediaDevices?.enumerateDevices()) ?? [];
    return all
      .filter(({ kind }) => kind === 'videoinput')
      .map(({ deviceId, label }, k) => ({ id: deviceId, name: label || `camera ${k + 1}` }));
  }

  stop() {
    this.#stopWith('');
  }

  /** The run has used the image of this time. @param {number} runT s */
  noteUsed(runT) {
    const takenMs = this.#takenMs.get(runT);
    if (takenMs === undefined) return;
    this.#takenMs.delete(runT);
    this.latenciesMs.push(performance.now() - takenMs);
    this.emit('used');
  }

  #connect() {
    const { videoWidth: width, videoHeight: height } = this.video;
    Object.assign(this.#canvas, { width, height });
    const label = this.#stream?.getVideoTracks()[0]?.label ?? '';
    this.#socket = new CameraSocket(
      { label, width, height },
      {
        onReady: () => {
          this.#set('sending', '');
          this.#waitForImage();
        },
        onRefused: (words) => this.#stopWith(words),
        onClosed: () => this.#stopWith('The connection to the program ended.'),
        onGot: (t, runT) => this.#remember(t, runT),
      },
    );
  }

  #waitForImage() {
    if (this.state !== 'sending') return;
    this.video.requestVideoFrameCallback((now, { captureTime, presentationTime }) => {
      this.#take(captureTime ?? presentationTime ?? now);
      this.#waitForImage();
    });
  }

  /** @param {number} takenMs on the clock of the page */
  async #take(takenMs) {
    const socket = this.#socket;
    if (!socket) return;
    const { width, height } = this.#canvas;
    const { videoWidth, videoHeight } = this.video;
    if (videoWidth !== width || videoHeight !== height) return this.#stopWith(whyTurned(width, height, videoWidth, videoHeight));
    const wasSent = await socket.send(takenMs / 1000, () => this.#jpeg());
    if (socket !== this.#socket) return;
    if (wasSent) ++this.sent;
    else ++this.skipped;
  }

  /** The image that the camera shows now. @returns {Promise<Blob | null>} */
  #jpeg() {
    this.#canvas.getContext('2d')?.drawImage(this.video, 0, 0);
    return new Promise((resolve) => this.#canvas.toBlob(resolve, 'image/jpeg', JPEG_QUALITY));
  }

  /** @param {number} t s @param {number} runT s */
  #remember(t, runT) {
    this.#takenMs.set(runT, 1000 * t);
    if (this.#takenMs.size > MOST_REMEMBERED) this.#takenMs.delete([...this.#takenMs.keys()][0]);
  }

  /** @param {'off' | 'starting' | 'sending'} state @param {string} words */
  #set(state, words) {
    this.state = state;
    this.words = words;
    this.emit('change');
  }

  /** @param {string} words */
  #stopWith(words) {
    ++this.#starts;
    this.#socket?.close();
    this.#socket = null;
    if (this.#stream) stopStream(this.#stream);
    this.#stream = null;
    this.video.srcObject = null;
    this.#set('off', words);
  }
}
