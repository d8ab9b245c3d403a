// SPDX-License-Identifier: Apache-2.0
// What the user must not miss: a lost connection, a wrong protocol, a refusal. And the keys.
import {button, el, say} from '../dom';
import type {Connection} from '../connection';
import {kProtocol} from '../protocol';
import type {Store} from '../store';
import {texts} from '../texts';

const kNoticeMs = 8000;

export class Status {
  readonly banner = el('div', {class: 'banner', role: 'alert', hidden: true});
  readonly notices = el('div', {class: 'notices', role: 'status', 'aria-live': 'polite'});
  private readonly words = el('span');
  private readonly again = button(texts.link.retry, () => this.act());

  constructor(
      store: Store,
      private readonly connection: () => Connection,
  ) {
    this.banner.append(this.words, this.again);
    store.on(['link'], () => this.show());
    window.setInterval(() => this.connection().link.state === 'waiting' && this.show(), 500);
  }

  notice(text: string): void {
    const made = el('p', {}, text);
    this.notices.append(made);
    while (this.notices.children.length > 3) this.notices.firstChild?.remove();
    window.setTimeout(() => made.remove(), kNoticeMs);
  }

  private act(): void {
    if (this.connection().link.state === 'closed')
      window.location.reload();
    else
      this.connection().open();
  }

  private show(): void {
    const {link} = this.connection();
    const everOpen = document.body.dataset.seen === 'true';
    if (link.state === 'open') document.body.dataset.seen = 'true';
    document.body.dataset.link = link.state;
    this.banner.hidden = link.state === 'open' || (link.state === 'connecting' && !everOpen);
    const left = (link.retryAt - performance.now()) / 1000;
    const text = {
      open: '',
      connecting: texts.link.trying,
      waiting: texts.link.lost(left),
      closed: texts.link.protocol(link.theirs, kProtocol),
    }[link.state];
    say(this.words, text);
    say(this.again, link.state === 'closed' ? texts.link.reload : texts.link.retry);
  }
}

export function makeHelp(): HTMLDialogElement {
  const rows =
      texts.help.keys.map(([keys, what]) => el('div', {}, el('dt', {}, keys), el('dd', {}, what)));
  const dialog: HTMLDialogElement = el(
      'dialog',
      {'aria-labelledby': 'help-heading'},
      el('h2', {id: 'help-heading'}, texts.help.heading),
      el('dl', {class: 'facts'}, ...rows),
      button(texts.help.close, () => dialog.close(), {class: 'primary'}),
  );
  return dialog;
}
