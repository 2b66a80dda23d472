// A video file as the camera of Chromium, from the images of a recording: YUV4MPEG2, gray.
import { closeSync, openSync, readFileSync, writeSync } from 'node:fs';
import { join } from 'node:path';
import { inflateSync } from 'node:zlib';

/** @typedef {{width: number, height: number, gray: Buffer}} GrayImage */

/** Value that PNG's filter number 4 predicts. @param {number} left @param {number} up @param {number} upLeft */
function paeth(left, up, upLeft) {
  const guess = left + up - upLeft;
  const [a, b, c] = [Math.abs(guess - left), Math.abs(guess - up), Math.abs(guess - upLeft)];
  return a <= b && a <= c ? left : b <= c ? up : upLeft;
}

/** A PNG of 8 bits, gray, not interlaced, as the program writes them. @param {Buffer} png @returns {GrayImage} */
function grayOfPng(png) {
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  const data = [];
  for (let at = 8; at < png.length; ) {
    const length = png.readUInt32BE(at);
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') data.push(png.subarray(at + 8, at + 8 + length));
    at += length + 12;
  }
  const filtered = inflateSync(Buffer.concat(data));
  const gray = Buffer.alloc(width * height);
  for (let v = 0; v < height; ++v) {
    const filter = filtered[v * (width + 1)];
    for (let u = 0; u < width; ++u) {
      const at = v * width + u;
      const left = u > 0 ? gray[at - 1] : 0;
      const up = v > 0 ? gray[at - width] : 0;
      const upLeft = u > 0 && v > 0 ? gray[at - width - 1] : 0;
      const guess = [0, left, up, (left + up) >> 1, paeth(left, up, upLeft)][filter];
      gray[at] = filtered[v * (width + 1) + 1 + u] + guess;
    }
  }
  return { width, height, gray };
}

/** @param {Buffer} pgm binary, of 8 bits @returns {GrayImage} */
function grayOfPgm(pgm) {
  const head = /^P5\s+(?:#.*\s+)*(\d+)\s+(\d+)\s+255\s/.exec(pgm.toString('latin1', 0, 200));
  const [width, height] = [Number(head[1]), Number(head[2])];
  return { width, height, gray: pgm.subarray(head[0].length, head[0].length + width * height) };
}

/**
 * @param {string} video to write @param {string[]} images PNG or PGM, all of one size @param {number} rateHz
 */
export function writeVideo(video, images, rateHz) {
  const file = openSync(video, 'w');
  images.forEach((path, k) => {
    const { width, height, gray } = (path.endsWith('.pgm') ? grayOfPgm : grayOfPng)(readFileSync(path));
    if (k === 0) writeSync(file, `YUV4MPEG2 W${width} H${height} F${rateHz}:1 Ip A1:1 C420jpeg\n`);
    writeSync(file, 'FRAME\n');
    writeSync(file, gray);
    writeSync(file, Buffer.alloc((width / 2) * (height / 2) * 2, 128));
  });
  closeSync(file);
}

/** The images of a recording in TUM layout. @param {string} folder */
export function imagesOf(folder) {
  return readFileSync(join(folder, 'rgb.txt'), 'utf8')
    .split('\n')
    .filter((line) => line && !line.startsWith('#'))
    .map((line) => join(folder, line.split(' ')[1]));
}
