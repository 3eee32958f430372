// The posing studio: opens the session and wires stage, panels and keys to one store.

import "../shared/theme.css";
import "./studio.css";
import { byId, element } from "../shared/dom";
import { Actions } from "./editing/actions";
import { fillStatus, fillToolbar, fillTopBar } from "./panels/bars";
import { CameraSection } from "./panels/camera_section";
import { Gizmo } from "./stage/gizmo";
import { exposeHook } from "./editing/hook";
import { Keys } from "./editing/keys";
import { Overlay } from "./stage/overlay";
import { FiguresPanel } from "./panels/panel_figures";
import { HoldsPanel } from "./panels/panel_holds";
import { LibraryPanel } from "./panels/panel_library";
import { PhotoPanel } from "./panels/panel_photo";
import { TanglesPanel } from "./panels/panel_tangles";
import { TryPanel } from "./panels/panel_try";
import { PhotoLayer } from "./editing/photo_layer";
import { Pointer } from "./editing/pointer";
import { Sender } from "./state/sender";
import { Session } from "./editing/session";
import { fillSide } from "./panels/side";
import { openStartDialog } from "./panels/start_dialog";
import { Store } from "./state/store";
import { Viewport } from "./stage/viewport";

async function start(): Promise<void> {
  const store = new Store();
  const sender = new Sender(store);
  const viewport = new Viewport(byId("viewport"), store);
  const session = new Session(store, sender, viewport);
  await session.open();

  const actions = new Actions(store, sender, viewport);
  const gizmo = new Gizmo(viewport, store, sender);
  const pointer = new Pointer(viewport, store, sender, gizmo, actions);
  const overlay = new Overlay(store);
  const photoLayer = new PhotoLayer(actions, store);
  viewport.onDraw(
    (context, view) => overlay.draw(context, view),
    () => photoLayer.place(),
  );

  const library = new LibraryPanel(store, actions, session);
  const camera = new CameraSection(store, actions);
  const photo = new PhotoPanel(store, actions, session, camera);
  const tryIt = new TryPanel(store);
  const startFrom = () => openStartDialog(store, session, library.known);
  const figures = new FiguresPanel(store, actions, sender, startFrom);
  fillSide(store, {
    figures: figures.element,
    holds: new HoldsPanel(store, actions).element,
    tangles: new TanglesPanel(store, actions).element,
    photo: photo.element,
    library: library.element,
    try: tryIt.element,
  });
  const escape = () => {
    if (pointer.cancel()) return;
    if (store.ui.tool !== "pose" || store.ui.holdFrom) actions.tool("pose");
    else store.select(null);
  };
  const keys = new Keys(
    store,
    actions,
    session,
    escape,
    () => camera.setLock(!store.ui.locked),
    startFrom,
  );
  fillTopBar(store, actions, session, () => keys.help());
  fillToolbar(store, actions);
  fillStatus(store);
  session.onLoad = () => {
    store.select(null);
    camera.loaded();
  };
  session.onLoad();
  camera.keepView(session.resumed);
  await Promise.all([library.load(), tryIt.load()]);
  exposeHook(store, sender, viewport);
}

start().catch((error: Error) => {
  const said =
    error.message === "no WebGL"
      ? "The studio draws with WebGL, which this browser does not offer."
      : error.message;
  byId("viewport").append(element("p", { class: "failure", role: "alert" }, said));
});
