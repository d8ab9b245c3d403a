// SPDX-License-Identifier: Apache-2.0
// A plot as data, and how it is saved: the same drawing as SVG or PNG, and the numbers as CSV.
//
// Saved figures are dark on white whatever the screen shows: they are for papers and reports.
export interface Curve {
  name: string;
  colour: string;
  dash: number[];
  width: number;
  xs: number[];
  ys: number[];
}
export interface Figure {
  title: string;
  xLabel: string;
  yLabel: string;
  curves: Curve[];
  bands: {from: number; to: number; label: string}[];
  marks: {x: number; label: string; strong: boolean}[];
}

// What a drawing needs of its paper.
interface Pen {
  line(points: number[], colour: string, width: number, dash: number[]): void;
  box(x: number, y: number, width: number, height: number, colour: string): void;
  text(x: number, y: number, text: string, size: number, align: 'start'|'middle'|'end'): void;
  turnedText(x: number, y: number, text: string, size: number): void;
}

const kFont = 'system-ui, "DejaVu Sans", sans-serif';
const kInk = '#1d2733';
const kGrid = '#dde3ea';

const xml = (text: string): string => text.replace(
    /[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[c] ?? c);

class SvgPen implements Pen {
  private parts: string[] = [];
  line(points: number[], colour: string, width: number, dash: number[]): void {
    const places = points.map((p) => p.toFixed(2));
    const pairs = places.flatMap((x, i) => (i % 2 === 0 ? [`${x},${places[i + 1]}`] : []));
    const dashes = dash.length > 0 ? ` stroke-dasharray="${dash.join(' ')}"` : '';
    this.parts.push(
        `<polyline points="${pairs.join(' ')}" fill="none" stroke="${colour}" ` +
            `stroke-width="${width}" stroke-linejoin="round"${dashes}/>`,
    );
  }
  box(x: number, y: number, width: number, height: number, colour: string): void {
    const place = `x="${x.toFixed(2)}" y="${y.toFixed(2)}"`;
    const size = `width="${width.toFixed(2)}" height="${height.toFixed(2)}"`;
    this.parts.push(`<rect ${place} ${size} fill="${colour}"/>`);
  }
  text(x: number, y: number, text: string, size: number, align: string): void {
    const place = `x="${x.toFixed(2)}" y="${y.toFixed(2)}"`;
    this.parts.push(
        `<text ${place} font-size="${size}" text-anchor="${align}">${xml(text)}</text>`);
  }
  turnedText(x: number, y: number, text: string, size: number): void {
    const turn = `transform="translate(${x} ${y}) rotate(-90)"`;
    this.parts.push(`<text ${turn} font-size="${size}" text-anchor="middle">${xml(text)}</text>`);
  }
  finish(width: number, height: number): string {
    return (
        `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" ` +
        `width="${width}" height="${height}" font-family='${kFont}' fill="${kInk}">\n` +
        `${this.parts.join('\n')}\n</svg>\n`);
  }
}

class CanvasPen implements Pen {
  constructor(private readonly context: CanvasRenderingContext2D) {}
  line(points: number[], colour: string, width: number, dash: number[]): void {
    const c = this.context;
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.lineJoin = 'round';
    c.setLineDash(dash);
    c.beginPath();
    for (let i = 0; i < points.length; i += 2) c.lineTo(points[i], points[i + 1]);
    c.stroke();
  }
  box(x: number, y: number, width: number, height: number, colour: string): void {
    this.context.fillStyle = colour;
    this.context.fillRect(x, y, width, height);
  }
  text(x: number, y: number, text: string, size: number, align: 'start'|'middle'|'end'): void {
    const c = this.context;
    c.font = `${size}px ${kFont}`;
    c.textAlign = align === 'middle' ? 'center' : align;
    c.fillStyle = kInk;
    c.fillText(text, x, y);
  }
  turnedText(x: number, y: number, text: string, size: number): void {
    this.context.save();
    this.context.translate(x, y);
    this.context.rotate(-Math.PI / 2);
    this.text(0, 0, text, size, 'middle');
    this.context.restore();
  }
}

// About `count` round values within the range.
export function ticksOf(low: number, high: number, count: number): number[] {
  const rough = (high - low) / count;
  if (!(rough > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= rough) ?? 10 * power;
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    ticks.push(Number((k * step).toPrecision(12)));
  }
  return ticks;
}

// With a little room, and with zero.
export function rangeOf(values: number[][]): [number, number] {
  let [low, high] = [0, 0];
  for (const list of values) {
    for (const value of list) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (low === high) high = low + 1;
  const room = 0.06 * (high - low);
  return [low === 0 ? 0 : low - room, high === 0 ? 0 : high + room];
}

export function xRangeOf(figure: Figure): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const {xs} of figure.curves) {
    for (const x of xs) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
  }
  return low < high ? [low, high] : [0, 1];
}

function drawFigure(figure: Figure, pen: Pen, width: number, height: number): void {
  const [left, right, top, bottom] = [64, 20, 64, 48];
  const [w, h] = [width - left - right, height - top - bottom];
  const [x0, x1] = xRangeOf(figure);
  const [y0, y1] = rangeOf(figure.curves.map((c) => c.ys));
  const px = (x: number) => left + ((x - x0) / (x1 - x0)) * w;
  const py = (y: number) => top + ((y1 - y) / (y1 - y0)) * h;
  pen.box(0, 0, width, height, '#ffffff');
  pen.text(left, 24, figure.title, 16, 'start');
  figure.bands.forEach((band, i) => {
    const [from, to] = [px(Math.max(x0, band.from)), px(Math.min(x1, band.to))];
    if (to <= from) return;
    pen.box(from, top, to - from, h, i % 2 === 0 ? '#f3f5f8' : '#e8ecf1');
    if (to - from > 40) pen.text((from + to) / 2, top + h - 6, band.label, 11, 'middle');
  });
  for (const x of ticksOf(x0, x1, 8)) {
    pen.line([px(x), top, px(x), top + h], kGrid, 1, []);
    pen.text(px(x), top + h + 18, String(x), 12, 'middle');
  }
  for (const y of ticksOf(y0, y1, 6)) {
    pen.line([left, py(y), left + w, py(y)], kGrid, 1, []);
    pen.text(left - 8, py(y) + 4, String(y), 12, 'end');
  }
  pen.line([left, top, left, top + h, left + w, top + h], kInk, 1, []);
  for (const mark of figure.marks) {
    if (mark.x < x0 || mark.x > x1) continue;
    pen.line([px(mark.x), top, px(mark.x), top + h], kInk, 1, mark.strong ? [] : [2, 3]);
    pen.text(px(mark.x) + 3, top + 12, mark.label, 11, 'start');
  }
  for (const curve of figure.curves) {
    const points = curve.xs.flatMap((x, i) => [px(x), py(curve.ys[i])]);
    pen.line(points, curve.colour, curve.width, curve.dash);
  }
  let at = left;
  for (const curve of figure.curves) {
    pen.line([at, 46, at + 26, 46], curve.colour, curve.width, curve.dash);
    pen.text(at + 31, 50, curve.name, 12, 'start');
    at += 44 + 7 * curve.name.length;
  }
  pen.text(left + w / 2, height - 10, figure.xLabel, 13, 'middle');
  pen.turnedText(18, top + h / 2, figure.yLabel, 13);
}

const kWidth = 960;
const kHeight = 480;

export function figureSvg(figure: Figure): string {
  const pen = new SvgPen();
  drawFigure(figure, pen, kWidth, kHeight);
  return pen.finish(kWidth, kHeight);
}

export function figureCanvas(figure: Figure, scale = 2): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  canvas.width = kWidth * scale;
  canvas.height = kHeight * scale;
  const context = canvas.getContext('2d');
  if (context !== null) {
    context.scale(scale, scale);
    drawFigure(figure, new CanvasPen(context), kWidth, kHeight);
  }
  return canvas;
}

// A value a cell, as few digits as are needed to read the same number again.
export function csv(
    head: string[], columns: ArrayLike<number>[], cell: (v: number) => string): string {
  const lines = [head.join(',')];
  for (let i = 0; i < (columns[0]?.length ?? 0); ++i) {
    lines.push(columns.map((column) => cell(column[i])).join(','));
  }
  return `${lines.join('\n')}\n`;
}
