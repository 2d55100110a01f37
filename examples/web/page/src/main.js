// The page: loads the module and the assets, runs the two bodies in real time, and shows what they do.

import { hasSimd, load } from '../../package/index.js';
import { buildPanel } from './panel.js';
import { Plots } from './plots.js';
import { length } from './side.js';
import { View } from './view.js';
import { World } from './world.js';

const BODIES = ['snowman', 'cube', 'beam', 'tower'];
/** Milliseconds of a frame that the simulation may take; past them it runs slower than real time. */
const SHARE = 11;
/** The step after which the hash of an untouched run is kept, so that browsers can be compared. */
const MARK = 300;
/** Frames between two samples of the plots. */
const SAMPLED = 5;

const by = (id) => document.getElementById(id);

class Page {
  playing = true;
  pinning = false;
  single = false;
  debt = 0;
  last = 0;
  frame = 0;
  pace = 1;
  mark = null;
  untouched = true;

  async start() {
    this.view = new View(by('view'));
    this.plots = new Plots();
    this.assets = Object.fromEntries(
      await Promise.all(BODIES.map(async (name) => [name, await this.fetched(`assets/${name}.femto`)])),
    );
    await this.loadModule(hasSimd());
    this.panel = buildPanel(this);
    this.listen();
    this.setBody('snowman');
    by('loading').hidden = true;
    requestAnimationFrame((now) => this.tick(now));
  }

  async fetched(path) {
    const response = await fetch(path);
    if (!response.ok) throw new Error(`${path}: ${response.status}`);
    return response.arrayBuffer();
  }

  async loadModule(simd) {
    this.world = undefined;
    this.femto = await load(await this.fetched(simd ? 'femto-simd.wasm' : 'femto.wasm'));
  }

  setBody(name) {
    const world = new World(this.femto, this.assets[name]);
    this.world?.free();
    this.world = world;
    this.name = name;
    this.view.setBody(world.asset.corners, Math.max(world.top, world.size * 0.75));
    this.panel.takeBody(world);
    this.restart(0);
  }

  restart(lift) {
    this.world.place(lift);
    this.view.goHome();
    this.plots.clear();
    this.mark = null;
    this.untouched = true;
    this.refuse(null);
    this.sample();
  }

  /** Shows what was refused, or nothing. */
  refuse(why) {
    by('refusal').hidden = why === null;
    by('refusal').textContent = why ?? '';
  }

  refusalOf() {
    return by('refusal').hidden ? null : by('refusal').textContent;
  }

  step() {
    const refusal = this.world.step(this.single);
    if (refusal) {
      this.refuse(`A step was refused: ${refusal}. The body is as it was.`);
      this.setPlaying(false);
    }
    const [{ steps, body }] = this.world.sides;
    if (steps === MARK && this.untouched) this.mark = body.hash();
    return refusal;
  }

  tick(now) {
    requestAnimationFrame((next) => this.tick(next));
    const passed = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    const { world } = this;
    if (!world) return;
    if (this.playing) {
      this.debt += passed;
      const begin = performance.now();
      let advanced = 0;
      while (this.debt >= world.dt && performance.now() - begin < SHARE && this.playing) {
        this.step();
        this.debt -= world.dt;
        advanced += world.dt;
      }
      if (this.debt > world.dt) this.debt = 0;
      if (passed > 0) this.pace += 0.05 * (advanced / passed - this.pace);
      if (!world.hand.held) this.view.goAlong(world.sides[0].body.positions);
    }
    if (this.frame++ % SAMPLED === 0) this.sample();
    this.view.draw(world.sides, world.hand.pinned);
  }

  sample() {
    const { world, plots } = this;
    const [a, b] = world.sides;
    const [of, other] = world.measures();
    const total = ({ kinetic, elastic, potential }) => kinetic + elastic + potential;
    const second = (value) => (this.single ? null : value);
    if (this.playing) {
      plots.error.add(world.time, [second(100 * world.gap)]);
      plots.energy.add(world.time, [total(of), of.kinetic, of.elastic, second(total(other))]);
      plots.momentum.add(world.time, [length(of.linear), second(length(other.linear)), length(of.angular), second(length(other.angular))]);
      plots.time.add(world.time, [a.perStep, second(b.perStep)]);
      plots.show();
    }
    by('step').textContent = String(a.steps);
    by('hash').textContent = a.body.hash();
    by('pace').textContent = this.playing ? `${Math.min(1, this.pace).toFixed(2)}× real time` : 'paused';
    const says = (side) => `${side.perStep.toFixed(2)} ms a step, residual ${side.residual.toExponential(0)}`;
    by('says-a').textContent = says(a);
    by('says-b').textContent = this.single ? '' : `${says(b)}, ${(100 * world.gap).toPrecision(2)} % apart`;
    this.panel.sample(this.mark);
  }

  setPlaying(playing) {
    this.playing = playing;
    this.debt = 0;
    by('play').textContent = playing ? 'Pause' : 'Play';
    this.sample();
  }

  setSingle(single) {
    this.single = this.view.single = single;
    document.body.classList.toggle('single', single);
    this.view.fit();
  }

  touched() {
    this.untouched = false;
  }

  listen() {
    const { view } = this;
    const canvas = view.canvas;
    const actions = {
      play: () => this.setPlaying(!this.playing),
      once: () => {
        this.setPlaying(false);
        this.step();
        this.sample();
      },
      drop: () => this.restart(0.5),
      throw: () => {
        this.touched();
        this.world.throw();
      },
      reset: () => this.restart(0),
      pin: () => {
        this.pinning = !this.pinning;
        by('pin').setAttribute('aria-pressed', String(this.pinning));
      },
      unpin: () => {
        this.touched();
        this.world.hand.pinned.clear();
      },
    };
    for (const [id, act] of Object.entries(actions)) by(id).addEventListener('click', act);
    by('theme').addEventListener('click', () => {
      const dark = matchMedia('(prefers-color-scheme: dark)').matches;
      const now = document.documentElement.dataset.theme ?? (dark ? 'dark' : 'light');
      document.documentElement.dataset.theme = now === 'dark' ? 'light' : 'dark';
      this.repaint();
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.repaint());

    /** The finger, or the mouse, that holds the body. */
    let holder = null;
    const down = (event) => {
      if (event.button > 0 || this.world.hand.held) return;
      const hit = view.pick(event);
      if (!hit) return;
      this.touched();
      view.orbit.enabled = false;
      const { hand, sides, size } = this.world;
      const x = sides[hit.half].body.positions;
      if (this.pinning) {
        hand.togglePins(x, hit.node, 0.07 * size);
        return;
      }
      hand.grab(x, hit.node, 0.09 * size, hit.point);
      canvas.setPointerCapture(event.pointerId);
      holder = event.pointerId;
      canvas.classList.add('holding');
    };
    // Before the orbit controls, which listen on the canvas.
    canvas.parentElement.addEventListener('pointerdown', down, { capture: true });
    canvas.addEventListener('pointermove', (event) => {
      const { hand } = this.world;
      if (hand.held && event.pointerId === holder) hand.target = view.follow(event) ?? hand.target;
    });
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => {
        if (this.world.hand.held && event.pointerId !== holder) return;
        this.world.hand.release();
        view.orbit.enabled = true;
        canvas.classList.remove('holding');
      });
    }

    const keys = { ' ': 'play', '.': 'once', d: 'drop', t: 'throw', r: 'reset', p: 'pin' };
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    addEventListener('keydown', (event) => {
      if (event.target instanceof Element && event.target.closest('input, select, button, textarea')) return;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const { hand, sides, size } = this.world;
      if (event.key === 'g') {
        this.touched();
        if (hand.held) hand.release();
        else {
          const x = sides[0].body.positions;
          const top = [...view.nodes].reduce((a, b) => (x[3 * b + 1] > x[3 * a + 1] ? b : a));
          hand.grab(x, top, 0.09 * size, x.slice(3 * top, 3 * top + 3));
        }
      } else if (event.key in arrows && hand.held) {
        const way = view.across(...arrows[event.key].map((c) => 0.05 * size * c));
        hand.target = hand.target.map((c, axis) => c + way[axis]);
      } else if (event.key in keys) {
        actions[keys[event.key]]();
      } else return;
      event.preventDefault();
    });
  }

  repaint() {
    this.view.paint();
    this.plots.redraw();
  }
}

const page = new Page();
page.start().catch((error) => {
  by('loading').textContent = `The page could not start: ${error.message}`;
  throw error;
});
