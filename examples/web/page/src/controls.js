// The panel: every control has a label, a value, and a line that says what it means. What the module refuses is
// said at the control, which then goes back.

/** @param {string} tag @param {Record<string, any>} [props] @param {...(Node | string)} children */
export function element(tag, props = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** A group of controls. */
export function group(title, props, ...children) {
  return element('fieldset', props, element('legend', { className: props.side ?? '' }, title), ...children);
}

/** A control, from its inputs, `say` for what a value means, and `set`, which may throw. */
function control(id, label, inputs, { read, write, say, set, value }) {
  const says = element('output', { id: `says-${id}`, htmlFor: id });
  const refused = element('p', { className: 'refused', role: 'alert' });
  let current = value;
  const show = () => {
    write(current);
    says.textContent = say(current);
  };
  const change = (input) => {
    try {
      const wanted = read(input);
      set(wanted);
      current = wanted;
      refused.textContent = '';
      inputs.forEach((each) => each.removeAttribute('aria-invalid'));
    } catch (error) {
      refused.textContent = error instanceof Error ? error.message : String(error);
      input.setAttribute('aria-invalid', 'true');
      if (input.type !== 'text') show();
      return;
    }
    show();
  };
  for (const input of inputs) {
    input.addEventListener(input.type === 'range' ? 'input' : 'change', () => change(input));
  }
  const box = element('div', { className: 'control' }, element('label', { htmlFor: id }, label), ...inputs, says, refused);
  show();
  return {
    box,
    get value() {
      return current;
    },
    /** Shows another value, which is known to be good. */
    show(other) {
      current = other;
      refused.textContent = '';
      inputs.forEach((each) => each.removeAttribute('aria-invalid'));
      show();
    },
  };
}

/** A number by slider and by field; the slider is logarithmic where `log` says so. */
export function numberControl(id, label, options) {
  const { min, max, log = false, whole = false, digits = 4 } = options;
  const to = log ? Math.log10 : (x) => x;
  const from = log ? (x) => Number((10 ** x).toPrecision(2)) : (x) => Number(x.toPrecision(digits));
  const step = whole && !log ? 1 : (to(max) - to(min)) / 200;
  const range = element('input', { type: 'range', id, min: to(min), max: to(max), step });
  const field = element('input', { type: 'text', id: `${id}-field`, inputMode: 'decimal', 'aria-label': `${label}, number` });
  return control(id, label, [range, field], {
    ...options,
    read: (input) => {
      if (input === range) return whole ? Math.round(from(Number(range.value))) : from(Number(range.value));
      const value = Number(field.value.trim().replace(',', '.'));
      if (field.value.trim() === '' || Number.isNaN(value)) throw new Error(`“${field.value}” is not a number`);
      return value;
    },
    write: (value) => {
      range.value = String(to(value));
      field.value = value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3) ? value.toExponential().replace('e+', 'e') : String(value);
    },
  });
}

/** One of a few. `choices` gives what each value means. */
export function choiceControl(id, label, { choices, ...options }) {
  const select = element('select', { id }, ...Object.entries(choices).map(([value, text]) => element('option', { value }, text[0])));
  return control(id, label, [select], {
    say: (value) => choices[value]?.[1] ?? '',
    ...options,
    read: () => select.value,
    write: (value) => (select.value = value),
  });
}
