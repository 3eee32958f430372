// The one frame that everything on the page shows, and its running.

export class Clock {
  time = 0; // in frames; a whole number unless playing
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

  step(by: number): void {
    this.seek(this.frame + by);
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
