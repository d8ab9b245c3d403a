// SPDX-License-Identifier: Apache-2.0
// Top of the page: views, scene, trainee, and the attempt's start, pause and reset.
import {button, el, say} from '../dom';
import {Activity, ask} from '../protocol';
import {isBusy, type Store, type ViewName} from '../store';
import {texts} from '../texts';

export const kViews: ViewName[] = ['trainee', 'teacher', 'engineer', 'report'];

// A scene is known by its file, without the ending.
const sceneName = (file: string): string => file.replace(/\.toml$/, '');

export class SessionBar {
  readonly root: HTMLElement;
  private readonly tabs: HTMLButtonElement[];
  private readonly scene = el('select', {'aria-label': texts.session.scene});
  private readonly trainee = el('input', {
    type: 'text',
    maxlength: 60,
    autocomplete: 'off',
    placeholder: texts.session.trainee,
    'aria-label': `${texts.session.trainee}: ${texts.session.traineeHint}`,
  });
  private readonly main = button('', () => this.act(), {class: 'primary'});
  private readonly end = button(texts.session.end, () => this.send(ask.end()));
  private readonly reset = button(texts.session.reset, () => this.send(ask.reset()));
  private readonly clear =
      button(texts.session.acknowledge, () => this.acknowledge(), {class: 'warning'});
  private readonly state = el('span', {class: 'activity', role: 'status'});
  private readonly clock = el('span', {class: 'clock'});
  private readonly controls: HTMLElement;

  constructor(
      private readonly store: Store,
      private readonly send: (bytes: Uint8Array) => void,
      openHelp: () => void,
  ) {
    this.tabs = kViews.map(
        (name) => button(texts.views[name], () => store.select(name), {
          role: 'tab',
          id: `tab-${name}`,
          'aria-controls': 'main',
        }),
    );
    const tabs =
        el('div', {role: 'tablist', class: 'tabs', 'aria-label': texts.viewsLabel}, ...this.tabs);
    tabs.addEventListener('keydown', (event) => this.walkTabs(event));
    this.controls = el(
        'div',
        {class: 'controls', role: 'group', 'aria-label': texts.session.label},
        this.scene,
        this.trainee,
        this.main,
        this.end,
        this.reset,
        this.clear,
    );
    this.root = el(
        'header',
        {class: 'top'},
        el('h1', {}, texts.brand),
        tabs,
        this.controls,
        el('div', {class: 'state'}, this.state, this.clock),
        button(texts.help.open, openHelp, {class: 'quiet', 'aria-keyshortcuts': '?'}),
    );
    this.scene.addEventListener('change', () => send(ask.choose(this.scene.value)));
    store.on(['hello'], () => this.begin());
    store.on(['frame', 'link'], () => this.show());
    store.on(['view'], () => this.showTabs());
  }

  // Start, pause or resume: whatever comes next.
  act(): void {
    const {hello, frame} = this.store;
    if (hello === null || !hello.mayControl || this.store.playback) return;
    if (frame?.activity === Activity.Running)
      this.send(ask.pause());
    else if (frame?.activity === Activity.Paused)
      this.send(ask.resume());
    else
      this.send(ask.start(this.trainee.value.trim()));
  }

  private acknowledge(): void {
    const {frame} = this.store;
    frame?.needles.forEach((needle, i) => {
      if (needle.fault !== '') this.send(ask.acknowledge(frame, i));
    });
  }

  private walkTabs(event: KeyboardEvent): void {
    const at = kViews.indexOf(this.store.view);
    const next =
        {ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: kViews.length - 1}[event.key];
    if (next === undefined) return;
    event.preventDefault();
    const name = kViews[(next + kViews.length) % kViews.length];
    this.store.select(name);
    this.tabs[kViews.indexOf(name)].focus();
  }

  private begin(): void {
    const {hello} = this.store;
    if (hello === null) return;
    const names =
        hello.scenes.includes(hello.scene) ? hello.scenes : [hello.scene, ...hello.scenes];
    this.scene.replaceChildren(
        ...names.map((name) => el('option', {value: name}, sceneName(name))));
    this.scene.value = hello.scene;
    this.scene.disabled = hello.scenes.length < 2 || !hello.mayControl;
    const live = !this.store.playback;
    for (const control of [this.trainee, this.main, this.end, this.reset]) {
      control.hidden = !live;
      control.disabled = !hello.mayControl;
      control.title = hello.mayControl ? '' : texts.session.watching;
    }
    document.title = `${sceneName(hello.scene)} - ${texts.title}`;
    this.show();
  }

  private show(): void {
    const {frame, hello} = this.store;
    const activity = frame?.activity ?? Activity.Ready;
    const next = {[Activity.Running]: texts.session.pause, [Activity.Paused]: texts.session.resume};
    say(this.main, next[activity as keyof typeof next] ?? texts.session.start);
    say(this.state, hello === null ? texts.link.waiting : (texts.session.activity[activity] ?? ''));
    this.state.dataset.activity = Activity[activity];
    say(this.clock, frame === null ? '' : texts.units.s(this.store.seconds(frame.tick), 1));
    this.clear.hidden = !hello?.mayControl || !frame?.needles.some((n) => n.fault !== '');
    const busy = isBusy(activity);
    this.trainee.readOnly = busy;
    this.end.disabled = !hello?.mayControl || !busy;
  }

  private showTabs(): void {
    kViews.forEach((name, i) => {
      const on = name === this.store.view;
      this.tabs[i].setAttribute('aria-selected', String(on));
      this.tabs[i].tabIndex = on ? 0 : -1;
    });
  }
}
