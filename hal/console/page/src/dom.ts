// SPDX-License-Identifier: Apache-2.0
// Making elements. Text only ever goes in as text, so nothing a server says can become markup.
type Child = Node|string;
type Attributes = Record<string, string|number|boolean|((event: never) => void)>;

// Attributes whose names begin with "on" are listeners; true sets an empty one, false none.
export function el<Tag extends keyof HTMLElementTagNameMap>(
    tag: Tag, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') {
      element.addEventListener(name.slice(2), value as unknown as EventListener);
    } else if (value === true)
      element.setAttribute(name, '');
    else if (value !== false)
      element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

// Sets text only where it differs: what does not change is not announced or laid out again.
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function button(label: string, act: () => void, more: Attributes = {}): HTMLButtonElement {
  return el('button', {type: 'button', onclick: act, ...more}, label);
}

// A button that is on or off.
export function toggle(label: string, act: (on: boolean) => void): HTMLButtonElement {
  const made = button(label, () => setOn(made, made.getAttribute('aria-pressed') !== 'true', act), {
    'aria-pressed': 'false',
    class: 'toggle',
  });
  return made;
}

export function setOn(made: HTMLButtonElement, on: boolean, act?: (on: boolean) => void): void {
  made.setAttribute('aria-pressed', String(on));
  act?.(on);
}

let lastId = 0;
// A labelled control; returns the wrapper.
export function field(label: string, control: HTMLElement): HTMLElement {
  control.id ||= `field-${++lastId}`;
  return el('div', {class: 'field'}, el('label', { for: control.id
            }, label), control);
}

// A section with a heading, and the views it is shown in.
export function panel(
    name: string, heading: string, views: string, ...children: Child[]): HTMLElement {
  const id = `${name}-heading`;
  return el(
      'section',
      {class: `panel ${name}`, 'data-in': views, 'aria-labelledby': id},
      el('h2', {id}, heading),
      ...children,
  );
}

export function table(head: string[], rows: string[][], caption = ''): HTMLTableElement {
  const made = el('table');
  if (caption !== '') made.append(el('caption', {}, caption));
  made.append(el('thead', {}, el('tr', {}, ...head.map((h) => el('th', {scope: 'col'}, h)))));
  made.append(
      el(
          'tbody',
          {},
          ...rows.map(
              ([first, ...rest]) =>
                  el('tr', {}, el('th', {scope: 'row'}, first),
                     ...rest.map((cell) => el('td', {}, cell))),
              ),
          ),
  );
  return made;
}

export function save(name: string, type: string, content: BlobPart): void {
  const url = URL.createObjectURL(new Blob([content], {type}));
  el('a', {href: url, download: name}).click();
  window.setTimeout(() => URL.revokeObjectURL(url), 1000);
}

export const prefersDark = (): boolean => matchMedia('(prefers-color-scheme: dark)').matches;
export const prefersStill = (): boolean => matchMedia('(prefers-reduced-motion: reduce)').matches;

// At most once in `ms`, and once more for what came meanwhile.
export function seldom(ms: number, work: () => void): () => void {
  let waiting = false;
  let last = -Infinity;
  return () => {
    if (waiting) return;
    waiting = true;
    const wait = Math.max(0, ms - (performance.now() - last));
    window.setTimeout(() => {
      waiting = false;
      last = performance.now();
      work();
    }, wait);
  };
}
