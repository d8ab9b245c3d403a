// SPDX-License-Identifier: Apache-2.0
// The 3D view's frame: what is shown, from where, what the colours mean, and how fast.
import {button, el, prefersStill, say, setOn, toggle} from '../dom';
import {spread} from '../labels';
import {kBody, materialColours} from '../palette';
import type {Store} from '../store';
import {texts} from '../texts';
import {kPresets} from '../view3d/camera';
import {View3d, type Look} from '../view3d/view3d';

const kTurnDegrees = 6;
const kNearer = 0.9;
type Switch = 'surface'|'xray'|'lattice'|'particles'|'cut';
const kSwitches: Switch[] = ['surface', 'xray', 'lattice', 'particles', 'cut'];

// What each view begins with; the trainee sees what a patient shows: no needle inside.
const kLooks: Record<string, Partial<Look>> = {
  trainee: {surface: true, xray: false, lattice: false, particles: false, cut: false},
  teacher: {surface: true, xray: true, lattice: false, particles: false, cut: false},
  engineer: {surface: true, xray: true, lattice: true, particles: true, cut: false},
};

export class ScenePanel {
  readonly root: HTMLElement;
  readonly canvas = el('canvas', {
    id: 'scene-canvas',
    tabindex: 0,
    role: 'application',
    'aria-label': texts.view3d.canvas,
  });
  view: View3d|null = null;
  private readonly switches: Record<Switch, HTMLButtonElement>;
  private readonly cutAt = el('input', {
    type: 'range',
    min: 0,
    max: 1,
    step: 0.01,
    value: 0.5,
    'aria-label': texts.view3d.cutAt,
    hidden: true,
  });
  private readonly rate = el('span', {class: 'rate', title: texts.view3d.frameRateLabel});
  private readonly legend = el('ul', {class: 'key', 'aria-label': texts.view3d.legend});
  private readonly labels = el('div', {class: 'labels', 'aria-hidden': 'true'});
  private readonly organText = el('span', {class: 'organ-text'});
  private looks = structuredClone(kLooks);

  constructor(private readonly store: Store) {
    this.switches =
        Object.fromEntries(
            kSwitches.map(
                (name) => [name, toggle(texts.view3d[name], (on) => this.change({[name]: on}))]),
            ) as Record<Switch, HTMLButtonElement>;
    const presets =
        kPresets.map((name) => button(texts.view3d.presets[name], () => this.view?.preset(name)));
    this.root = el(
        'section',
        {class: 'scene', 'aria-label': texts.view3d.label, id: 'scene'},
        this.canvas,
        this.labels,
        el('div', {class: 'scene-top'}, this.legend,
           el('div', {class: 'scene-numbers'}, this.organText, this.rate)),
        el(
            'div',
            {class: 'scene-tools'},
            el('div', {class: 'group', role: 'group', 'aria-label': texts.view3d.presetsLabel},
               ...presets),
            el(
                'div',
                {class: 'group looks', role: 'group', 'aria-label': texts.view3d.toolbar},
                ...kSwitches.map((name) => this.switches[name]),
                this.cutAt,
                ),
            ),
    );
    this.cutAt.addEventListener(
        'input', () => this.view?.setLook({cutAt: Number(this.cutAt.value)}));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    store.on(['view'], () => this.applyView());
    store.on(['organ'], () => this.applyOrgan());
    window.setInterval(() => this.showRate(), 500);
  }

  // Once the canvas is in the document; false: no WebGL 2.
  begin(): boolean {
    try {
      this.view = new View3d(this.canvas, this.store, prefersStill);
    } catch {
      return false;
    }
    this.view.drawn = () => this.placeLabels();
    this.applyView();
    return true;
  }

  // The same as by the switches.
  setLook(look: Partial<Record<Switch, boolean>>): void {
    for (const name of kSwitches)
      if (look[name] !== undefined) setOn(this.switches[name], look[name]);
    this.change(look);
  }

  private change(look: Partial<Look>): void {
    Object.assign((this.looks[this.store.view] ??= {}), look);
    this.view?.setLook(look);
    this.cutAt.hidden = !(this.view?.look.cut ?? false);
    this.cutAt.value = String(this.view?.look.cutAt ?? 0.5);
    this.drawLegend();
  }

  private applyView(): void {
    const look = this.looks[this.store.view];
    if (look === undefined) return;
    for (const name of kSwitches) setOn(this.switches[name], look[name] === true);
    this.change(look);
  }

  private applyOrgan(): void {
    const {organ} = this.store;
    if (organ === null) return;
    say(this.organText, texts.loop.voxels(organ.voxelCount, organ.triangles.length / 3));
    this.labels.replaceChildren(
        ...(this.store.hello?.targets ?? []).map((t) => el('span', {}, t.name)));
    this.drawLegend();
  }

  private drawLegend(): void {
    const {organ, hello} = this.store;
    const look = this.view?.look;
    if (organ === null || hello === null || look === undefined) return;
    const used = new Set<number>();
    for (const voxel of organ.vertexVoxel) used.add(organ.voxelMaterial[voxel]);
    if (look.cut)
      for (const material of organ.voxelMaterial) used.add(material);
    const colours = materialColours(organ.materials);
    const items: [string, string, string][] =
        [...used].sort((a, b) => a - b).map((m) => [organ.materials[m] ?? '', colours[m], 'dot']);
    if (look.particles) {
      items.push([texts.view3d.legendParticle, kBody.particle, 'dot']);
      items.push([texts.view3d.legendGoal, kBody.goal, 'dot']);
    }
    if (look.lattice) items.push([texts.view3d.legendLattice, kBody.lattice, 'line']);
    if (hello.targets.some((t) => !t.forbidden))
      items.push([texts.view3d.legendTarget, kBody.target, 'ring']);
    if (hello.targets.some((t) => t.forbidden))
      items.push([texts.view3d.legendForbidden, kBody.forbidden, 'bars']);
    items.push([texts.view3d.legendForce, kBody.force, 'line']);
    this.legend.replaceChildren(
        ...items.map(([name, colour, kind]) => {
          const sign = el('span', {class: `sign ${kind}`});
          sign.style.setProperty('--sign', colour);
          return el('li', {}, sign, name);
        }),
    );
  }

  private placeLabels(): void {
    const shown = this.store.view !== 'trainee';
    const targets = this.store.hello?.targets ?? [];
    const labels = [...this.labels.children].map((label, i) => {
      const at = shown && targets[i] ? this.view?.project(targets[i].position) : null;
      const {style} = label as HTMLElement;
      style.display = at ? '' : 'none';
      return {label: label as HTMLElement, at: at ?? null};
    });
    const visible = labels.flatMap(({label, at}) => at ? [{label, x: at.x, y: at.y}] : []);
    const heights = spread(visible.map(({label, x, y}) => ({
                                         x,
                                         y,
                                         width: label.offsetWidth,
                                         height: label.offsetHeight,
                                       })));
    visible.forEach(({label, x}, i) => {
      label.style.transform = `translate(${x.toFixed(1)}px, ${heights[i].toFixed(1)}px)`;
    });
  }

  private showRate(): void {
    say(this.rate, texts.view3d.frameRate(this.view?.budget.perSecond() ?? 0));
  }

  private key(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey || this.view === null) return;
    const man = this.view.cameraMan;
    const press = (name: Switch) => () => this.switches[name].click();
    const trainee = this.store.view === 'trainee';
    const acts: Record<string, () => void> = {
      ArrowLeft: () => man.nudge(-kTurnDegrees, 0, 1),
      ArrowRight: () => man.nudge(kTurnDegrees, 0, 1),
      ArrowUp: () => man.nudge(0, kTurnDegrees, 1),
      ArrowDown: () => man.nudge(0, -kTurnDegrees, 1),
      '+': () => man.nudge(0, 0, kNearer),
      '=': () => man.nudge(0, 0, kNearer),
      '-': () => man.nudge(0, 0, 1 / kNearer),
      ...(trainee ?
              {} :
              {x: press('xray'), l: press('lattice'), p: press('particles'), c: press('cut')}),
      ...Object.fromEntries(
          kPresets.map((name, i) => [String(i + 1), () => this.view?.preset(name)])),
    };
    const act = acts[event.key];
    if (act === undefined) return;
    event.preventDefault();
    act();
  }
}
