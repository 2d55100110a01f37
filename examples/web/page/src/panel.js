// The panel of controls, and the two checks below it.

import { hasSimd, load } from '../../package/index.js';
import { choiceControl, element, group, numberControl } from './controls.js';
import golden from './golden.json';
import { runGolden } from './golden.js';
import { matches, runScenes } from './scenes.js';
import { CONVERGED } from './side.js';

const PRECONDITIONERS = {
  identity: ['none', 'plain conjugate gradients'],
  mass: ['mass', 'divides by the mass'],
  jacobi: ['Jacobi', 'divides by the diagonal; needs nothing prepared'],
  'block-jacobi': ['block Jacobi', 'inverts a 3×3 block a node'],
  'two-level': ['two-level', 'block Jacobi, and rigid motions of 8 parts'],
  factor: ['factor', 'the rest matrix, factored by femto bake'],
};

const STARTS = {
  zero: ['from rest', 'damps motion unless it converges'],
  velocity: ['velocity', 'can add energy when stopped early'],
  'velocity-force': ['velocity and force', 'unstable where bodies are stiff'],
  'galerkin-1': ['galerkin-1', 'never adds energy; exact linear momentum'],
  'galerkin-2': ['galerkin-2', 'two past velocities: smooth motions'],
  'rigid-1': ['rigid-1', 'and rotations: bodies that fly and spin'],
  'rigid-2': ['rigid-2', 'rotations and two past velocities'],
};

const whole = (value, unit) => `${value.toLocaleString('en')} ${unit}`;
const plural = (value, one) => whole(value, value === 1 ? one : `${one}s`);

/** A value with an SI prefix. */
function si(value, unit) {
  const [factor, prefix] = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k']].find(([factor]) => value >= factor) ?? [1, ''];
  return `${Number((value / factor).toPrecision(3))} ${prefix}${unit}`;
}

/** Controls of one body's budget; `apply` gives them to the module, which may throw. */
function budget(side, apply) {
  const values = { iterations: 5, sweeps: 2, start: 'rigid-1', preconditioner: 'jacobi' };
  const set = (name) => (value) => {
    apply({ ...values, [name]: value });
    values[name] = value;
  };
  const controls = {
    iterations: numberControl(`iterations-${side}`, 'Iterations', {
      min: 0, max: 60, whole: true, value: values.iterations, set: set('iterations'),
      say: (n) => `exactly ${plural(n, 'iteration')} in every step`,
    }),
    sweeps: numberControl(`sweeps-${side}`, 'Sweeps', {
      min: 0, max: 10, whole: true, value: values.sweeps, set: set('sweeps'),
      say: (n) => (n === 0 ? 'rotations never follow' : `${plural(n, 'sweep')} to follow the rotation`),
    }),
    start: choiceControl(`start-${side}`, 'Start', { choices: STARTS, value: values.start, set: set('start') }),
    preconditioner: choiceControl(`preconditioner-${side}`, 'Preconditioner', {
      choices: PRECONDITIONERS, value: values.preconditioner, set: set('preconditioner'),
    }),
  };
  return {
    values,
    boxes: Object.values(controls).map(({ box }) => box),
    show(changes) {
      for (const [name, value] of Object.entries(changes)) {
        values[name] = value;
        controls[name].show(value);
      }
    },
  };
}

/** Builds it into #panel. @param {any} page */
export function buildPanel(page) {
  const compared = { mode: 'converged' };
  const applyRight = (values) => page.world.configure(1, { ...values, converged: compared.mode === 'converged' });
  const left = budget('a', (values) => page.world.configure(0, values));
  const right = budget('b', applyRight);
  right.show({ iterations: 20 });
  const rightGroup = group('Right', { side: 'b', id: 'budget-b' }, ...right.boxes);

  const showMode = (mode) => {
    compared.mode = mode;
    page.setSingle(mode === 'single');
    rightGroup.disabled = mode !== 'budget';
    applyRight(right.values);
    document.getElementById('name-a').textContent = mode === 'single' ? 'Budget' : 'Left budget';
    document.getElementById('name-b').textContent = mode === 'converged' ? 'Converged' : 'Right budget';
  };
  const mode = choiceControl('mode', 'Beside it', {
    value: compared.mode,
    set: (value) => {
      const before = compared.mode;
      try {
        showMode(value);
      } catch (error) {
        showMode(before);
        throw error;
      }
      page.restart(0);
    },
    choices: {
      converged: ['the converged solution', `${CONVERGED.warped} or ${CONVERGED.laplacian} iterations with the factor`],
      budget: ['another budget', 'set below'],
      single: ['nothing', 'all time for one body'],
    },
  });

  const body = choiceControl('body', 'Body', {
    value: 'snowman',
    set: (name) => page.setBody(name),
    say: () => (page.world ? `${whole(page.world.asset.tets, 'tetrahedra')}, ${whole(page.world.asset.nodes, 'nodes')}` : ''),
    choices: { snowman: ['snowman'], cube: ['cube'], beam: ['beam, held at one end'], tower: ['tower, held at its foot'] },
  });
  const material = (name) => (value) => page.world.setMaterial({ [name]: value });
  const materials = {
    young: numberControl('young', 'Stiffness', { min: 1e3, max: 1e8, log: true, value: 1e5, set: material('young'), say: (e) => `Young's modulus ${si(e, 'Pa')}` }),
    poisson: numberControl('poisson', 'Poisson', { min: 0, max: 0.495, digits: 3, value: 0.4, set: material('poisson'), say: (nu) => (nu > 0.45 ? `ratio ${nu}: nearly keeps its volume, locks` : `ratio ${nu}`) }),
    density: numberControl('density', 'Density', { min: 50, max: 8000, log: true, value: 1000, set: material('density'), say: (rho) => whole(rho, 'kg/m³') }),
    beta: numberControl('beta', 'Damping', { min: 0, max: 0.05, digits: 2, value: 0, set: material('beta'), say: (b) => (b === 0 ? 'none of its own' : `β = ${b} s, of the stiffness`) }),
  };
  const dt = numberControl('dt', 'Time step', {
    min: 1, max: 33, log: true, value: 6.667, set: (ms) => page.world.setDt(ms / 1000),
    say: (ms) => `ms: ${plural(Math.round(1000 / ms), 'step')} a second`,
  });
  const gravity = numberControl('gravity', 'Gravity', {
    min: 0, max: 25, digits: 3, value: 9.81, set: (g) => page.world.setGravity(g), say: (g) => (g === 0 ? 'none: it floats' : `${g} m/s² downwards`),
  });

  const module = choiceControl('module', 'Module', {
    value: hasSimd() ? 'simd' : 'plain',
    set: (kind) => {
      if (kind === 'simd' && !hasSimd()) throw new Error('this browser has no simd128');
      page.loadModule(kind === 'simd').then(() => page.setBody(page.name));
    },
    choices: { simd: ['simd128', 'four tetrahedra at once'], plain: ['plain', 'one after the other: the same bits'] },
  });

  const mark = element('p', { className: 'note', id: 'mark' });
  const verdict = element('p', { className: 'note', id: 'verdict', role: 'status' });
  const check = element('button', { type: 'button', id: 'check' }, 'Check this browser’s bits');
  const scenes = element('ul', { className: 'note', id: 'scenes' });
  check.addEventListener('click', () => checkBits(page, check, verdict, scenes));

  const progress = element('progress', { max: 1, value: 0, hidden: true });
  const passed = element('p', { className: 'note', id: 'passed', role: 'status' });
  const buttons = [['minute', 60], ['hour', 3600]].map(([name, seconds]) => {
    const button = element('button', { type: 'button', id: `ahead-${name}` }, `One ${name} ahead`);
    button.addEventListener('click', () => runAhead(page, seconds, buttons, progress, passed));
    return button;
  });

  document.getElementById('panel').append(
    group('Scene', {}, body.box, mode.box, dt.box, gravity.box),
    group('Left', { side: 'a' }, ...left.boxes),
    rightGroup,
    group('Material', {}, ...Object.values(materials).map(({ box }) => box)),
    group('Same bits everywhere', {}, element('div', { className: 'row' }, check), verdict, scenes, mark, module.box),
    group('Far ahead', {}, element('div', { className: 'row' }, ...buttons), progress, passed),
  );

  return {
    /** Takes over what a new body brings. */
    takeBody(world) {
      const { settings, material: of } = world.asset;
      const { iterations, sweeps, start } = settings;
      left.show({ iterations, sweeps, start, preconditioner: 'jacobi' });
      right.show({ iterations: 20, sweeps, start, preconditioner: 'jacobi' });
      for (const [name, { show }] of Object.entries(materials)) show(Number(of[name].toPrecision(6)));
      dt.show(Number((1000 * settings.dt).toPrecision(4)));
      gravity.show(9.81);
      body.show(page.name);
      page.world.configure(0, left.values);
      showMode(compared.mode);
    },
    /** What is new a few times a second. */
    sample(hash) {
      mark.textContent = hash
        ? `Untouched after 300 steps, this scene is ${hash}: compare it with another browser.`
        : '';
    },
  };
}

/** The committed run, and the golden scenes, in both modules of this browser. */
async function checkBits(page, button, verdict, scenes) {
  button.disabled = true;
  verdict.className = 'note';
  scenes.replaceChildren();
  const kinds = hasSimd() ? ['-simd', ''] : [''];
  const wrong = [];
  try {
    for (const kind of kinds) {
      const file = `femto${kind}.wasm`;
      verdict.textContent = `${golden.steps} steps with ${file}…`;
      await new Promise((done) => setTimeout(done));
      const femto = await load(await page.fetched(file));
      for (const [k, [step, hash]] of [...runGolden(femto.asset(page.assets[golden.asset]), golden)].entries()) {
        const [at, expected] = golden.hashes[k];
        if (step !== at || hash !== expected) wrong.push(`${file}, step ${step}: ${hash} instead of ${expected}`);
      }
    }
    const right = new Map();
    for (const kind of kinds) {
      for await (const scene of runScenes(await page.fetched(`assets/cases${kind}.wasm`))) {
        verdict.textContent = `Golden scenes: ${scene.name}…`;
        right.set(scene.name, (right.get(scene.name) ?? true) && matches(scene));
      }
    }
    for (const [name, same] of right) {
      if (!same) wrong.push(name);
      scenes.append(element('li', { className: same ? 'good' : 'bad' }, `${name}: ${same ? 'the same' : 'other bits'}`));
    }
    const last = golden.hashes.at(-1)[1];
    verdict.textContent = wrong.length
      ? `This browser gives other bits. ${wrong.join('; ')}`
      : `This browser gives the committed bits: ${last} after ${golden.steps} steps, and those of all ${right.size} golden scenes, with ${kinds.length === 2 ? 'both modules' : 'the plain module'}.`;
    verdict.classList.add(wrong.length ? 'bad' : 'good');
  } catch (error) {
    verdict.textContent = `The check did not run: ${error.message}`;
    verdict.classList.add('bad');
  } finally {
    button.disabled = false;
  }
}

/** Steps as fast as it goes, in slices, so that the page stays alive. */
async function runAhead(page, seconds, buttons, progress, passed) {
  buttons.forEach((button) => (button.disabled = true));
  progress.hidden = false;
  page.setPlaying(false);
  const bytes = page.femto.memoryBytes;
  const begin = performance.now();
  const steps = Math.round(seconds / page.world.dt);
  const { world } = page;
  let taken = 0;
  while (taken < steps && page.world === world && page.refusalOf() === null) {
    const slice = performance.now();
    while (taken < steps && performance.now() - slice < 40 && !page.step()) taken += 1;
    progress.value = taken / steps;
    await new Promise((done) => setTimeout(done));
  }
  const { minDet } = world.sides[0].body.measure();
  const finite = world.sides.every(({ body }) => body.positions.every(Number.isFinite));
  const grown = page.femto.memoryBytes - bytes;
  passed.textContent =
    `${taken.toLocaleString('en')} steps in ${((performance.now() - begin) / 1000).toFixed(1)} s. ` +
    `All positions ${finite ? 'are' : 'are not'} finite, the smallest det F is ${minDet.toFixed(2)}, ` +
    `and memory grew by ${grown} bytes.`;
  progress.hidden = true;
  buttons.forEach((button) => (button.disabled = false));
  page.sample();
}
