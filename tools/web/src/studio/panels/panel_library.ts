// Panel "Library": what the template says of itself, and the folder of templates.

import { element } from "../../shared/dom";
import { get, post, trying } from "../state/api";
import type { Actions } from "../editing/actions";
import { asked, confirmed } from "../controls/dialogs";
import type { TemplateInfo } from "../state/protocol";
import type { Session } from "../editing/session";
import type { Store } from "../state/store";
import { templateTile } from "./template_tile";
import { button, note, row, section } from "../controls/widgets";

export class LibraryPanel {
  readonly element = element("div", { class: "panel" });
  private readonly name = element("input", {
    type: "text",
    title: "name of the template",
    maxlength: "120",
  });
  private readonly description = element("textarea", {
    rows: "2",
    title: "what the template shows, in a sentence",
  });
  private readonly tags = element("input", {
    type: "text",
    title: "words to find it by, with commas between",
  });
  private readonly search = element("input", {
    type: "search",
    placeholder: "Search names and tags",
    "aria-label": "search names and tags",
  });
  private readonly items = element("ul", { class: "templates" });
  private readonly where = note("");
  private templates: TemplateInfo[] = [];
  private stamp = 0;

  constructor(
    private readonly store: Store,
    actions: Actions,
    private readonly session: Session,
  ) {
    const field = (label: string, input: HTMLElement) =>
      element("label", { class: "field" }, label, input);
    const save = button("Save", "save the template (Ctrl+S)", () => void session.save(), "primary");
    this.element.append(
      section(
        "This template",
        field("Name", this.name),
        field("Description", this.description),
        field("Tags", this.tags),
        row(
          save,
          button("Save as…", "save under another name (Ctrl+Shift+S)", () => void session.saveAs()),
        ),
      ),
      section("Templates", this.search, this.items, this.where),
    );
    const edit = (
      input: HTMLInputElement | HTMLTextAreaElement,
      now: () => string,
      act: (text: string) => void,
    ) =>
      input.addEventListener(
        "change",
        () => input.value.trim() !== now() && act(input.value.trim()),
      );
    edit(
      this.name,
      () => store.state.name,
      (name) =>
        void (name ? actions.do({ op: "set_name", name }) : (this.name.value = store.state.name)),
    );
    edit(
      this.description,
      () => store.state.description,
      (description) => void actions.do({ op: "set_description", description }),
    );
    edit(
      this.tags,
      () => store.state.tags_words.join(", "),
      (text) =>
        void actions.do({
          op: "set_tags",
          tags: text
            .split(",")
            .map((t) => t.trim())
            .filter(Boolean),
        }),
    );
    this.search.addEventListener("input", () => this.list());
    session.onLibrary = () => void this.load();
    store.onChange(() => this.refresh());
  }

  async load(): Promise<void> {
    await trying(this.store.say.bind(this.store), async () => {
      const { folder, templates } = await get<{ folder: string; templates: TemplateInfo[] }>(
        "/api/library",
      );
      this.templates = templates;
      this.where.textContent = `Folder: ${folder}`;
      ++this.stamp;
      this.list();
    });
  }
  get known(): TemplateInfo[] {
    return this.templates;
  }

  private refresh(): void {
    const { state } = this.store;
    const write = (input: HTMLInputElement | HTMLTextAreaElement, text: string) => {
      if (document.activeElement !== input && input.value !== text) input.value = text;
    };
    write(this.name, state.name);
    write(this.description, state.description);
    write(this.tags, state.tags_words.join(", "));
    for (const item of this.items.children) {
      item.classList.toggle("current", item.getAttribute("data-id") === state.saved_as);
    }
  }

  private list(): void {
    const wanted = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const hits = this.templates.filter(({ name, tags, description, id }) => {
      const text = `${name} ${id} ${tags.join(" ")} ${description}`.toLowerCase();
      return wanted.every((word) => text.includes(word));
    });
    this.items.replaceChildren(...hits.map((t) => this.item(t)));
    if (hits.length === 0)
      this.items.append(
        element(
          "li",
          { class: "note" },
          this.templates.length === 0
            ? "No templates yet: Save makes the first."
            : "Nothing by these words.",
        ),
      );
    this.refresh();
  }

  private item(template: TemplateInfo): HTMLElement {
    const { id, name, tags, read_only, description, error } = template;
    const open = templateTile(template, {
      title: `open: ${description || name}`,
      about: error ?? [read_only ? "shipped" : "", ...tags].filter(Boolean).join(" · "),
      version: String(this.stamp),
      act: () => void this.open(template),
    });
    const copy = button(
      "Duplicate",
      `make a copy of ${name}`,
      () => void this.duplicate(template),
      "plain",
    );
    const drop = button(
      "Delete",
      `delete ${name}`,
      () => void this.delete(template),
      "plain danger",
    );
    drop.disabled = read_only;
    if (read_only) drop.title = "a shipped template is not deleted";
    return element("li", { "data-id": id }, open, element("span", { class: "more" }, copy, drop));
  }

  async open({ id, name }: TemplateInfo): Promise<void> {
    const { dirty } = this.store.state;
    const text =
      "Its changes are not saved. They stay in the undo history until the page is closed.";
    if (dirty && !(await confirmed(`Open "${name}"?`, text, "Open"))) return;
    await this.session.load({ template: id });
  }
  private async duplicate({ id, name }: TemplateInfo): Promise<void> {
    const as = await asked("Duplicate", "Name of the copy", `${name} copy`, "Duplicate");
    if (as) await this.change("/api/duplicate", { id, as }, `Copied as "${as}".`);
  }
  private async delete({ id, name }: TemplateInfo): Promise<void> {
    const sure = await confirmed(
      `Delete "${name}"?`,
      "The file and its thumbnail go. This cannot be undone.",
      "Delete",
      "danger",
    );
    if (sure) await this.change("/api/delete", { id }, `Deleted "${name}".`);
  }
  private async change(path: string, body: object, said: string): Promise<void> {
    await trying(this.store.say.bind(this.store), async () => {
      await post(path, body);
      this.store.say(said, "good");
    });
    await this.load();
  }
}
