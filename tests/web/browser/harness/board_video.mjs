// A video of a chessboard before a camera of known intrinsics, as an operator shows it.
import { closeSync, openSync, writeSync } from 'node:fs';

/** The camera of the video: a pinhole without distortion. */
export const CAMERA = { width: 320, height: 240, f: 260, u0: 163, v0: 117.5 };
const SQUARES = { columns: 10, rows: 7 }; // 9x6 inner corners

/** Gray of the plane of the board at (x, y), in squares from its center: squares in a white margin on a gray wall. @param {number} x @param {number} y */
function grayAt(x, y) {
  const column = x + SQUARES.columns / 2;
  const row = y + SQUARES.rows / 2;
  if (column < -1 || row < -1 || column > SQUARES.columns + 1 || row > SQUARES.rows + 1) return 110;
  if (column < 0 || row < 0 || column >= SQUARES.columns || row >= SQUARES.rows) return 225;
  return (Math.floor(column) + Math.floor(row)) % 2 === 0 ? 30 : 225;
}

/** Rows of the rotation from the board to the camera: about x, then y. @param {number} a rad @param {number} b rad */
function rotation(a, b) {
  const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
  return [
    [cb, 0, sb],
    [sa * sb, ca, -sa * cb],
    [-ca * sb, sa, ca * cb],
  ];
}

/**
 * @typedef {{center: number[], tilts: [number, number]}} Place center in squares, camera axes; tilts about x and y, rad
 * @param {Place} place @param {number} [samples] per pixel and axis
 * @returns {Buffer} gray, row by row
 */
function photograph({ center, tilts }, samples = 3) {
  const [R0, R1, R2] = rotation(...tilts);
  const { width, height, f, u0, v0 } = CAMERA;
  const gray = Buffer.alloc(width * height);
  const along = R0[2] * center[0] + R1[2] * center[1] + R2[2] * center[2];
  for (let v = 0; v < height; ++v)
    for (let u = 0; u < width; ++u) {
      let sum = 0;
      for (let k = 0; k < samples * samples; ++k) {
        const x = (u + ((k % samples) + 0.5) / samples - 0.5 - u0) / f;
        const y = (v + (Math.floor(k / samples) + 0.5) / samples - 0.5 - v0) / f;
        const scale = along / (R0[2] * x + R1[2] * y + R2[2]);
        const dx = scale * x - center[0];
        const dy = scale * y - center[1];
        const dz = scale - center[2];
        sum += scale > 0 ? grayAt(R0[0] * dx + R1[0] * dy + R2[0] * dz, R0[1] * dx + R1[1] * dy + R2[1] * dz) : 110;
      }
      gray[v * width + u] = sum / (samples * samples);
    }
  return gray;
}

/** Mean of the neighbors in each row, `reach` to each side: motion blur. @param {Buffer} gray @param {number} reach */
function smeared(gray, reach) {
  const { width, height } = CAMERA;
  const out = Buffer.alloc(gray.length);
  for (let v = 0; v < height; ++v)
    for (let u = 0; u < width; ++u) {
      let sum = 0;
      for (let i = -reach; i <= reach; ++i) sum += gray[v * width + Math.min(width - 1, Math.max(0, u + i))];
      out[v * width + u] = sum / (2 * reach + 1);
    }
  return out;
}

/** Places all over the image, tilted about both axes. @type {Place[]} */
const PLACES = [
  { center: [0, 0, 13], tilts: [0.5, 0] },
  { center: [-3, -1.8, 14], tilts: [0, 0.5] },
  { center: [3, -1.8, 14], tilts: [0.4, -0.3] },
  { center: [-3, 1.8, 14.5], tilts: [-0.5, 0.2] },
  { center: [3, 1.8, 14.5], tilts: [-0.2, -0.5] },
  { center: [0, -2.4, 14], tilts: [-0.4, -0.4] },
  { center: [0, 2.4, 14], tilts: [0.45, 0.35] },
  { center: [-3.4, 0, 14], tilts: [0.2, -0.5] },
  { center: [3.4, 0, 14], tilts: [-0.35, 0.45] },
];

/** Each place is held for a second; before them a wall without a board, a smeared board and a moving one. @param {string} video YUV4MPEG2 to write */
export function writeBoardVideo(video) {
  const { width, height } = CAMERA;
  const color = Buffer.alloc((width / 2) * (height / 2) * 2, 128);
  const file = openSync(video, 'w');
  writeSync(file, `YUV4MPEG2 W${width} H${height} F10:1 Ip A1:1 C420jpeg\n`);
  /** @param {Buffer} gray @param {number} count */
  const show = (gray, count) => {
    for (let k = 0; k < count; ++k) for (const part of [Buffer.from('FRAME\n'), gray, color]) writeSync(file, part);
  };
  show(Buffer.alloc(width * height, 110), 8);
  show(smeared(photograph({ center: [0, 0, 14], tilts: [0, 0] }), 5), 8);
  for (let k = 0; k < 12; ++k) show(photograph({ center: [-2 + 0.3 * k, 1, 14], tilts: [0.3, 0.2] }, 2), 1);
  for (const place of PLACES) show(photograph(place), 10);
  closeSync(file);
}
