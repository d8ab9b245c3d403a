// SPDX-License-Identifier: Apache-2.0
// How often a picture is drawn, and of how many pixels.
//
// The tissue comes first: where a processor draws, each picture takes from the ticks. So there
// are no more than 30 a second; and where ticks or pictures stay behind, pictures become
// coarser, a step at a time, and finer again when there is room. A step that was too much is not
// tried again for a while.
const kLessMs = 4;  // a picture of the browser may come so much early
const kJudgeMs = 1000;
const kSteps = [1, 0.85, 0.7];  // of the screen's own pixels, each way
const kBehind = 0.97;           // ticks of those that time asks for
const kFewer = 0.85;            // pictures of those wanted
const kFineForMs = 4000;
const kNotAgainMs = 30000;

export class Pace {
  readonly perSecond: number;
  private step = 0;
  private last = -Infinity;  // a picture
  private judged = -Infinity;
  private drawn = 0;   // since then
  private lowest = 1;  // speed since then
  private fineSince = 0;
  private readonly failedAt = kSteps.map(() => -Infinity);

  constructor(byGpu: boolean) { this.perSecond = byGpu ? 60 : 30; }

  get scale(): number { return kSteps[this.step]; }

  // Whether a picture may be drawn now; counts it.
  due(now: number): boolean {
    if (now - this.last < 1000 / this.perSecond - kLessMs) return false;
    this.last = now;
    ++this.drawn;
    return true;
  }

  // speed: ticks a second over those that time asks for. A page that was hidden is not judged.
  see(now: number, speed: number): void {
    this.lowest = Math.min(this.lowest, speed);
    const passed = now - this.judged;
    if (passed < kJudgeMs) return;
    const judge = passed < 2 * kJudgeMs;
    const behind = this.lowest < kBehind || 1000 * this.drawn < kFewer * this.perSecond * passed;
    if (judge) this.turn(now, behind);
    this.judged = now;
    this.drawn = 0;
    this.lowest = 1;
  }

  private turn(now: number, behind: boolean): void {
    if (behind) {
      this.fineSince = now;
      this.failedAt[this.step] = now;
      this.step = Math.min(this.step + 1, kSteps.length - 1);
    } else if (
        this.step > 0 && now - this.fineSince > kFineForMs &&
        now - this.failedAt[this.step - 1] > kNotAgainMs) {
      this.fineSince = now;
      --this.step;
    }
  }
}
