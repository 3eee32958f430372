// The studio's server as a test starts and ends it, with a home and a library of its own.
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

// Whether the program has a studio, and the studio its page.
export function hasStudio(program) {
  const usage = spawnSync(program, ["studio", "--help"], { encoding: "utf8" });
  return usage.status === 0 && !/no page/.test(usage.stdout);
}

export class StudioServer {
  #program;
  home = mkdtempSync(join(tmpdir(), "retarget-studio-"));
  #process = null;
  library = join(this.home, "library");
  url = null; // with the token

  constructor(program) {
    this.#program = program;
    mkdirSync(this.library);
  }

  // Resolves when it has said its address.
  async start(...args) {
    const env = { ...process.env, HOME: this.home, XDG_DATA_HOME: join(this.home, "data") };
    const all = ["studio", "--no-browser", "--library", this.library, ...args];
    const started = spawn(this.#program, all, { env });
    this.#process = started;
    this.url = await new Promise((done, failed) => {
      let said = "";
      started.stdout.on("data", (data) => {
        said += data;
        const found = /http:\/\/127\.0\.0\.1:\d+\/\?token=\S+/.exec(said);
        if (found) done(found[0]);
      });
      started.stderr.on("data", (data) => (said += data));
      started.on("error", failed);
      started.on("exit", () => failed(new Error(`the studio ended: ${said}`)));
    });
  }

  async stop() {
    const ending = this.#process;
    this.#process = null;
    if (!ending || ending.exitCode !== null || ending.signalCode !== null) return;
    const ended = new Promise((done) => ending.once("exit", done));
    ending.kill("SIGINT");
    await ended;
  }

  // Starts anew at the same address but for the token.
  async restart(...args) {
    const { port } = new URL(this.url);
    await this.stop();
    await this.start("--port", port, ...args);
  }

  // Stops it and deletes its home.
  async remove() {
    await this.stop();
    rmSync(this.home, { recursive: true });
  }

  // What it answers to a request of the page's kind.
  async post(path, body) {
    const { origin, searchParams } = new URL(this.url);
    const headers = {
      "X-Retarget-Token": searchParams.get("token"),
      "Content-Type": "application/json",
    };
    const reply = await fetch(origin + path, {
      method: "POST",
      headers,
      body: JSON.stringify(body),
    });
    if (!reply.ok) throw new Error(`${path}: ${await reply.text()}`);
    return reply.json();
  }
}
