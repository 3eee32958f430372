// The one frame that everything on the page shows, and its running.

export class Clock {
  time = 0; // in frames; unless playing a whole number, or a half: between two frames
  playing = false;
  speed = 1;
  loop = true;
  private last = 0;
  private listeners: (() => void)[] = [];

  constructor(
    readonly frames: number,
    readonly fps: number,
  ) {}

  get frame(): number {
    return Math.min(this.frames - 1, Math.floor(this.time + 1e-9));
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  // Goes to a whole frame and stays there.
  seek(frame: number): void {
    this.playing = false;
    this.move(Math.round(Math.min(Math.max(frame, 0), this.frames - 1)));
  }

  // The same, half way between frames, too.
  show(time: number): void {
    this.playing = false;
    this.move(Math.round(2 * Math.min(Math.max(time, 0), this.frames - 1)) / 2);
  }

  // Whether it rests between two frames.
  get between(): boolean {
    return !this.playing && this.time !== this.frame;
  }

  step(by: number): void {
    this.seek(by > 0 || !this.between ? this.frame + by : this.frame + 1 + by);
  }

  toggle(): void {
    if (this.playing) return this.seek(this.frame);
    if (this.frame >= this.frames - 1) this.time = 0;
    this.playing = true;
    this.last = performance.now();
    this.tell();
    requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number): void {
    if (!this.playing) return;
    const end = this.frames - 1;
    let next = this.time + (Math.max(0, now - this.last) / 1000) * this.fps * this.speed;
    this.last = now;
    if (next >= end) {
      if (!this.loop || end === 0) return this.seek(end);
      next %= end;
    }
    this.move(next);
    requestAnimationFrame((later) => this.tick(later));
  }

  private move(time: number): void {
    this.time = time;
    this.tell();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
