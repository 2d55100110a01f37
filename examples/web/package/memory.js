// What every object of the module shares: its exports, its memory, and how it refuses.

import { FAULTS } from './faults.js';

/** What the module says no to. The module is as usable as before. */
export class FemtoError extends Error {
  name = 'FemtoError';
}

/** @param {string} what @param {unknown} value */
export function number(what, value) {
  if (typeof value !== 'number' || !Number.isFinite(value)) {
    throw new FemtoError(`${what} must be a finite number, not ${String(value)}`);
  }
  return value;
}

/** @param {string} what @param {unknown} value @param {number} most */
export function count(what, value, most = 0xffffffff) {
  if (typeof value !== 'number' || !Number.isInteger(value) || value < 0 || value > most) {
    throw new FemtoError(`${what} must be a whole number from 0 to ${most}, not ${String(value)}`);
  }
  return value;
}

/** Three finite numbers. @param {string} what @param {unknown} value @returns {number[]} */
export function vector(what, value) {
  const list = /** @type {ArrayLike<unknown>} */ (value);
  if (value === null || typeof value !== 'object' || list.length !== 3) {
    throw new FemtoError(`${what} must be three numbers`);
  }
  return [0, 1, 2].map((axis) => number(`${what}[${axis}]`, list[axis]));
}

/** One of a list of names; its place there. @param {string} what @param {readonly string[]} names @param {unknown} value */
export function choice(what, names, value) {
  const place = names.indexOf(/** @type {string} */ (value));
  if (place < 0) throw new FemtoError(`${what} must be one of ${names.join(', ')}, not ${String(value)}`);
  return place;
}

export class Memory {
  /** @param {WebAssembly.Instance} instance */
  constructor(instance) {
    this.exports = /** @type {Record<string, any>} */ (instance.exports);
    this.buffer = /** @type {ArrayBuffer} */ (this.exports.memory.buffer);
  }

  /** The memory as it is now: growing it detaches the old buffer. */
  get bytes() {
    this.buffer = this.exports.memory.buffer;
    return this.buffer;
  }

  /** Why the last call was refused. */
  reason() {
    const { message, message_number } = this.exports;
    const code = message() >>> 0;
    const text = FAULTS.get(code) ?? `refused for a reason of another version (${code})`;
    return text.replace(/\{([01])\}/g, (_, which) => String(Number(message_number(+which).toPrecision(7))));
  }

  /** What a call returned, or its refusal as an error. @template T @param {T} result */
  accepted(result) {
    if (!result) throw new FemtoError(this.reason());
    return result;
  }

  /** Numbers that the last call left. @param {number} length */
  numbers(length) {
    return new Float64Array(this.bytes, this.exports.numbers(), length);
  }

  /** Hands bytes over, for the call that comes next. @param {...ArrayBufferView} parts */
  input(...parts) {
    const length = parts.reduce((sum, part) => sum + part.byteLength, 0);
    const at = this.exports.input(length) >>> 0;
    if (at === 0) throw new FemtoError(`no memory for ${length} bytes`);
    const room = new Uint8Array(this.bytes, at, length);
    let used = 0;
    for (const part of parts) {
      room.set(new Uint8Array(part.buffer, part.byteOffset, part.byteLength), used);
      used += part.byteLength;
    }
    return length;
  }
}
