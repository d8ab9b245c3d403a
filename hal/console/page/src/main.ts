// SPDX-License-Identifier: Apache-2.0
// The page: makes its parts, ties them to the connection, and says which keys go where.
import './app.css';

import {Connection, withToken} from './connection';
import {el} from './dom';
import {misfit, readOrgan} from './organ';

import {Activity, type FromServer} from './protocol';
import {ForcePanel} from './panels/force_panel';
import {LoopPanel} from './panels/loop_panel';
import {PlaybackBar} from './panels/playback_bar';
import {PlotPanels} from './panels/plot_panels';
import {PointerPanel} from './panels/pointer_panel';
import {ReportPanel} from './panels/report_panel';
import {ScenePanel} from './panels/scene_panel';
import {kViews, SessionBar} from './panels/session_bar';
import {makeHelp, Status} from './panels/status';
import {ComparePanel, MarksPanel, ScorePanel} from './panels/training_panels';
import {isBusy, Store} from './store';
import {texts} from './texts';

const store = new Store();
const connection: Connection = new Connection(
    hear,
    () => store.tell('link'),
    () => status.notice(texts.link.garbled),
    (work) => scene.view ? scene.view.budget.time('message', work) : work(),
);
const send = (bytes: Uint8Array) => void connection.send(bytes);

const help = makeHelp();
const status = new Status(store, () => connection);
const scene = new ScenePanel(store);
const session = new SessionBar(store, send, () => help.showModal());
const playback = new PlaybackBar(store, send);
const seek = (tick: number) => playback.seek(tick);
const force = new ForcePanel(store);
const plots = new PlotPanels(store, send, seek);
const loop = new LoopPanel(store, () => scene.view, () => plots.drawMs);
const marks = new MarksPanel(store, send, seek);
const pointer = new PointerPanel(store, send);
const score = new ScorePanel(store);
const compare = new ComparePanel(store);
const report = new ReportPanel(store);
const side = el(
    'div',
    {class: 'side'},
    ...[force, pointer, plots, marks, score, compare, loop, report].map((p) => p.root),
);
const main = el('main', {id: 'main', role: 'tabpanel'}, scene.root, side);

// The organ belongs to the newest Hello: an answer that comes after another was asked is dropped.
let organAsked = 0;
async function fetchOrgan(): Promise<void> {
  const mine = ++organAsked;
  try {
    const answer = await fetch(withToken('organ', window.location));
    if (!answer.ok) throw new Error(`HTTP ${answer.status}`);
    const organ = readOrgan(await answer.arrayBuffer());
    if (mine !== organAsked || store.hello === null) return;
    const trouble = misfit(organ, store.hello);
    if (trouble !== '') throw new Error(trouble);
    store.organ = organ;
    store.tell('organ');
  } catch (error) {
    if (mine === organAsked)
      status.notice(texts.link.organ(error instanceof Error ? error.message : ''));
  }
}

// Numbers and curves follow the frames once a picture, and where pictures are slow, without them.
const kLongestSilenceMs = 100;
let told = 0;
function tellAll(): void {
  told = performance.now();
  store.flush();
}

function hear(message: FromServer): void {
  if (message.kind === 'refused') status.notice(message.what);
  store.take(message);
  if (performance.now() - told > kLongestSilenceMs) tellAll();
  if (message.kind !== 'hello') return;
  store.organ = null;
  void fetchOrgan();
}

function key(event: KeyboardEvent): void {
  const at = event.target as HTMLElement;
  const typing = at.matches('input, select, textarea');
  const view = event.altKey ? kViews[Number(event.key) - 1] : undefined;
  if (view !== undefined) {
    event.preventDefault();
    store.select(view);
    return;
  }
  if (typing || event.altKey || event.ctrlKey || event.metaKey || help.open) return;
  if (event.key === '?')
    help.showModal();
  else if (event.key === ' ' && !at.matches('button, [role=tab]')) {
    event.preventDefault();
    if (store.playback)
      playback.toggle();
    else
      session.act();
  } else if (event.key === 'm') {
    event.preventDefault();
    if (store.view !== 'teacher') store.select('teacher');
    marks.input.focus();
  }
}

document.title = texts.title;
document.documentElement.lang = texts.language;
document.body.append(
    el('a', {class: 'skip', href: '#scene-canvas'}, texts.skip),
    session.root,
    status.banner,
    main,
    playback.root,
    status.notices,
    help,
);
document.addEventListener('keydown', key);
store.on(['view'], () => {
  document.body.dataset.view = store.view;
  // Back goes to the view before, not away from the session.
  if (window.location.hash.slice(1) !== store.view)
    window.history.pushState(null, '', `#${store.view}`);
  main.setAttribute('aria-labelledby', `tab-${store.view}`);
});
const viewAsked = () => kViews.find((name) => name === window.location.hash.slice(1)) ?? 'trainee';
window.addEventListener('popstate', () => store.select(viewAsked()));
window.history.replaceState(null, '', `#${viewAsked()}`);
store.select(viewAsked());
// Leaving in the middle of an attempt lets go of the needle: the browser asks first.
window.addEventListener('beforeunload', (event) => {
  if (store.hello?.mayControl && !store.playback && isBusy(store.frame?.activity ?? Activity.Ready))
    event.preventDefault();
});
if (!scene.begin()) status.notice(texts.link.webgl);
connection.open();

function picture(): void {
  requestAnimationFrame(picture);
  tellAll();
  scene.view?.step();
}
requestAnimationFrame(picture);

// For tests: what the page holds, and what the GPU made of it.
Object.assign(window, {stylet: {store, view: () => scene.view}});
