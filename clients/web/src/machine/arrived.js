// @ts-check
/** Bytes of a connection that have arrived and were not read. */
export class Arrived {
  bytes = new Uint8Array();

  /** @param {Uint8Array} more */
  add(more) {
    const all = new Uint8Array(this.bytes.length + more.length);
    all.set(this.bytes);
    all.set(more, this.bytes.length);
    this.bytes = all;
  }
  /** @param {number} size @param {boolean} peek they stay */
  read(size, peek) {
    const read = this.bytes.slice(0, size);
    if (!peek) this.bytes = this.bytes.slice(size);
    return read;
  }
}
