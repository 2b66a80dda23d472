// Check that no message of a stream was lost without being counted as dropped.

export class SequenceMonitor {
  /** Number of the last message; -1 before the first. */
  lastSeq = -1;
  /** Missed messages that the sender did not count as dropped. */
  gaps = 0;
  /** Dropped messages as counted by the sender. */
  dropped = 0;

  /** @param {number} seq @param {number} dropped messages that this viewer has missed so far */
  accept(seq, dropped) {
    if (this.lastSeq >= 0) {
      const missed = seq - this.lastSeq - 1;
      const explained = Math.max(0, dropped - this.dropped);
      this.gaps += Math.max(0, missed - explained);
    }
    this.lastSeq = seq;
    this.dropped = dropped;
  }

  /** Forgets the last number, for a new run or a new connection; the counts of gaps stay. */
  restart() {
    this.lastSeq = -1;
    this.dropped = 0;
  }
}
