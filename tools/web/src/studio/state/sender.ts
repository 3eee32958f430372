// Operations on their way to the server, one request at a time. Of a drag the newest target alone
// waits, so that nothing piles up.

import { post, ServerError } from "./api";
import type { Op, Reply } from "./protocol";
import type { Store } from "./store";

type Task = () => Promise<void>;

export class Sender {
  requests = 0; // made so far
  private readonly tasks: Task[] = [];
  private live: Op[] | null = null;
  private busy = false;
  private waiting: (() => void)[] = [];
  private failed: (error: ServerError) => Promise<void> = async () => {};
  private settled: () => void = () => {};

  constructor(private readonly store: Store) {}

  // `failed`: what cannot be mended here (the session is gone); `settled`: after each whole change.
  connect(failed: (error: ServerError) => Promise<void>, settled: () => void): void {
    this.failed = failed;
    this.settled = settled;
  }

  // A step of a gesture: replaces the one that still waits.
  drag(...ops: Op[]): void {
    this.live = ops;
    void this.work();
  }

  // Whole changes, in the order of the calls. A waiting step of a gesture is overtaken. True where
  // the server took it.
  do(...ops: Op[]): Promise<boolean> {
    this.live = null;
    return this.run(async () => {
      this.store.take(await this.post(ops, false));
      this.settled();
    });
  }

  // Any other request that must not cross the operations.
  run(task: Task): Promise<boolean> {
    return new Promise((done) => {
      this.tasks.push(async () => done(await this.guarded(task)));
      void this.work();
    });
  }

  // Resolves when nothing is under way.
  idle(): Promise<void> {
    if (!this.busy) return Promise.resolve();
    return new Promise((done) => this.waiting.push(done));
  }

  private post(ops: Op[], live: boolean): Promise<Reply> {
    ++this.requests;
    return post<Reply>("/api/do", { session: this.store.session, ops, live });
  }

  private async guarded(task: Task): Promise<boolean> {
    try {
      await task();
      if (!this.store.connected) {
        this.store.connected = true;
        this.store.say("The server answers again.");
      }
      return true;
    } catch (error) {
      if (!(error instanceof ServerError)) throw error;
      this.store.say(error.message, "bad");
      if (error.status === 0 || error.status === 404) await this.failed(error);
      return false;
    }
  }

  private async work(): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    try {
      for (;;) {
        const task = this.tasks.shift();
        if (task) {
          await task();
        } else if (this.live) {
          const ops = this.live;
          this.live = null;
          await this.guarded(async () => this.store.take(await this.post(ops, true)));
        } else {
          break;
        }
      }
    } finally {
      this.busy = false;
      for (const done of this.waiting.splice(0)) done();
    }
  }
}
