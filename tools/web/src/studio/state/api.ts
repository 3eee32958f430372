// Requests to the server that gave the page, with the token of the page's address.

const token = new URLSearchParams(location.search).get("token") ?? "";

// The server's one sentence about what was wrong. Status 0: it does not answer at all.
export class ServerError extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly reason = "",
  ) {
    super(message);
  }
}

export type Query = Record<string, string>;

// The address of something that cannot send a header: an image, a frame, a stream of events.
export function address(path: string, query: Query = {}): string {
  return `${path}?${new URLSearchParams({ ...query, token })}`;
}

async function request(method: string, path: string, query: Query, body?: BodyInit, type?: string) {
  const headers: Record<string, string> = { "X-Retarget-Token": token };
  if (type) headers["Content-Type"] = type;
  const suffix = Object.keys(query).length > 0 ? `?${new URLSearchParams(query)}` : "";
  let reply: Response;
  try {
    reply = await fetch(path + suffix, { method, headers, body, cache: "no-store" });
  } catch {
    throw new ServerError(0, "The studio's server does not answer. Was `retarget studio` stopped?");
  }
  if (reply.ok) return reply;
  const text = await reply.text();
  let said: { error?: string; reason?: string } = {};
  try {
    said = JSON.parse(text) as typeof said;
  } catch {
    /* not JSON: the text itself is the message */
  }
  throw new ServerError(
    reply.status,
    said.error ?? (text || `status ${reply.status}`),
    said.reason,
  );
}

export async function get<T>(path: string, query: Query = {}): Promise<T> {
  return (await request("GET", path, query)).json() as Promise<T>;
}
// Does what asks the server; says what was wrong, if anything.
export async function trying(say: (text: string, kind: "bad") => void, act: () => Promise<void>) {
  try {
    await act();
  } catch (error) {
    if (!(error instanceof ServerError)) throw error;
    say(error.message, "bad");
  }
}
export async function getText(path: string, query: Query = {}): Promise<string> {
  return (await request("GET", path, query)).text();
}
export async function post<T>(path: string, body: object): Promise<T> {
  const reply = await request("POST", path, {}, JSON.stringify(body), "application/json");
  return reply.json() as Promise<T>;
}
export async function postFile<T>(path: string, query: Query, file: Blob): Promise<T> {
  return (
    await request("POST", path, query, file, file.type || "application/octet-stream")
  ).json() as Promise<T>;
}
export async function remove<T>(path: string, query: Query): Promise<T> {
  return (await request("DELETE", path, query)).json() as Promise<T>;
}
