// The session with the server: opened, taken up again after a reload, saved; and the draft that
// survives even the server.

import { get, getText, post, postFile, remove, ServerError, type Query } from "../state/api";
import { asked, confirmed } from "../controls/dialogs";
import type { Reply } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Store } from "../state/store";
import type { Viewport } from "../stage/viewport";

const kSession = "retarget-studio-session";
const kDraft = "retarget-studio-draft:";
const kDraftPause = 300; // ms

interface Draft {
  yaml: string;
  name: string;
  time: number;
}

export class Session {
  onLoad: () => void = () => {}; // another posture, not an edit
  onLibrary: () => void = () => {};
  resumed = false; // the session was there before the page
  private timer = 0;

  constructor(
    private readonly store: Store,
    private readonly sender: Sender,
    private readonly viewport: Viewport,
  ) {
    sender.connect(
      (error) => this.mend(error),
      () => this.keepDraft(),
    );
  }

  // Ours from before a reload, else a new one.
  async open(): Promise<void> {
    const old = sessionStorage.getItem(kSession);
    if (old) {
      try {
        this.store.take({ ...(await get<Reply>("/api/state", { session: old })), session: old });
        this.resumed = true;
        return;
      } catch (error) {
        if (!(error instanceof ServerError) || error.status !== 404) throw error;
      }
    }
    await this.openNew(old);
  }

  private async openNew(old: string | null): Promise<void> {
    const reply = await post<Reply>("/api/session", {});
    sessionStorage.setItem(kSession, reply.session!);
    this.store.take(reply);
    const draft = old ? this.draft(old) : this.newestDraft();
    if (!draft) return;
    if (!old) {
      const when = new Date(draft.time).toLocaleString();
      const text = `"${draft.name}" was not saved when the studio was closed (${when}).`;
      const wanted = await confirmed("Take up the unsaved work?", text, "Take it up");
      if (!wanted) return this.dropDrafts();
    }
    this.store.take(await post<Reply>("/api/load", { session: reply.session, yaml: draft.yaml }));
    this.dropDrafts();
    this.keepDraft();
    this.store.say(`The unsaved work on "${draft.name}" is back.`, "good");
  }

  // -- Drafts ------------------------------------------------------------------------------------

  private draft(session: string): Draft | null {
    const text = localStorage.getItem(kDraft + session);
    return text ? (JSON.parse(text) as Draft) : null;
  }
  private drafts(): string[] {
    return Object.keys(localStorage).filter((key) => key.startsWith(kDraft));
  }
  private newestDraft(): Draft | null {
    const all = this.drafts().map((key) => this.draft(key.slice(kDraft.length))!);
    return all.sort((a, b) => b.time - a.time)[0] ?? null;
  }
  private dropDrafts(): void {
    for (const key of this.drafts()) localStorage.removeItem(key);
  }

  // Soon after each whole change.
  private keepDraft(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.writeDraft(), kDraftPause);
  }
  private async writeDraft(): Promise<void> {
    const { session, state } = this.store;
    if (!state.dirty) return localStorage.removeItem(kDraft + session);
    try {
      const yaml = await getText("/api/yaml", { session });
      const draft: Draft = { yaml, name: state.name, time: Date.now() };
      localStorage.setItem(kDraft + session, JSON.stringify(draft));
    } catch {
      /* a posture that cannot be written now, or no room: the session itself still holds it */
    }
  }

  // What a request could not: another session where ours is gone, patience where nobody answers.
  private async mend(error: ServerError): Promise<void> {
    if (error.status === 404 && /session/i.test(error.message)) {
      const old = this.store.session;
      await this.openNew(old);
      this.onLoad();
      return;
    }
    if (error.status !== 0 || !this.store.connected) return;
    this.store.connected = false;
    this.store.changed();
    const again = window.setInterval(() => {
      void get<Reply>("/api/state", { session: this.store.session }).then(
        (reply) => {
          clearInterval(again);
          this.store.connected = true;
          this.store.take(reply);
          this.store.say("The server answers again.", "good");
        },
        (failure: ServerError) => {
          if (failure.status !== 404) return;
          clearInterval(again);
          this.store.connected = true;
          void this.mend(failure);
        },
      );
    }, 2000);
  }

  // -- Loading and saving ------------------------------------------------------------------------

  load(what: object): Promise<boolean> {
    return this.sender.run(async () => {
      ++this.store.photoVersion;
      this.store.take(await post<Reply>("/api/load", { session: this.store.session, ...what }));
      this.keepDraft();
      this.onLoad();
    });
  }

  async save(): Promise<void> {
    const { saved_as } = this.store.state;
    if (saved_as === null) return this.saveAs();
    await this.write({ id: saved_as });
  }

  async saveAs(): Promise<void> {
    const name = await asked("Save as", "Name of the template", this.store.state.name, "Save");
    if (!name) return;
    if (name !== this.store.state.name) await this.sender.do({ op: "set_name", name });
    await this.write({ as: name });
  }

  private async write(how: { id?: string; as?: string; overwrite?: boolean }): Promise<void> {
    const thumbnail = this.viewport.thumbnail(320, 240);
    let refused: ServerError | null = null;
    await this.sender.run(async () => {
      try {
        const body = { session: this.store.session, ...how, thumbnail };
        const reply = await post<Reply & { id: string }>("/api/save", body);
        this.store.take(reply);
        this.store.say(reply.warning ?? `Saved as ${reply.id}.`, reply.warning ? "bad" : "good");
        localStorage.removeItem(kDraft + this.store.session);
        this.onLibrary();
      } catch (error) {
        if (!(error instanceof ServerError) || error.status !== 409) throw error;
        refused = error;
      }
    });
    if (refused) await this.overwrite(refused, how);
  }

  private async overwrite(refused: ServerError, how: { id?: string; as?: string }): Promise<void> {
    if (refused.reason === "read_only") {
      this.store.say(refused.message);
      return this.saveAs();
    }
    const title =
      refused.reason === "changed" ? "The file has changed meanwhile" : "Replace the template?";
    if (await confirmed(title, refused.message, "Replace it", "danger")) {
      await this.write({ ...how, overwrite: true });
    }
  }

  // -- Photo -------------------------------------------------------------------------------------

  photo(file: Blob): Promise<boolean> {
    return this.sender.run(async () => {
      const query: Query = { session: this.store.session };
      const reply = await postFile<Reply>("/api/photo", query, file);
      this.store.take(reply);
      ++this.store.photoVersion;
      this.keepDraft();
    });
  }
  removePhoto(): Promise<boolean> {
    return this.sender.run(async () => {
      const query: Query = { session: this.store.session };
      const reply = await remove<Reply>("/api/photo", query);
      this.store.take(reply);
      this.keepDraft();
    });
  }
}
