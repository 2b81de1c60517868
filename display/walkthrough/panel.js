'use strict';
// The panel with the settings, the bar of false colours, and the table of a measurement.

const element = (id) => document.getElementById(id);

// A number with so many digits as a reader can use.
function told(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
}

// The round numbers from 0 to `top`: four to eight of them.
function roundTicks(top) {
  const power = 10 ** Math.floor(Math.log10(top));
  const step = [0.1, 0.2, 0.5, 1, 2].map((x) => x * power).find((x) => top / x <= 8);
  return Array.from({length: Math.floor(top / step + 1e-9) + 1}, (_, i) => i * step);
}

class Panel {
  // `page` has data, settings, changed(), useCamera(index), meter(), home() and link().
  constructor(page) {
    this.page = page;
    const {data, settings} = page;
    element('title').textContent = document.title = data.title || 'Penumbra';
    data.cameras.forEach(({name}, i) => element('camera').add(new Option(name || `camera ${i}`, i)));
    element('camera').addEventListener('change', () => page.useCamera(Number(element('camera').value)));
    element('show').addEventListener('change', () => this.set('show', element('show').value));
    element('exposure').addEventListener('input', () => {
      page.setExposure(page.firstExposure * 2 ** Number(element('exposure').value));
    });
    for (const name of ['walk', 'mesh', 'discontinuities'])
      element(name).addEventListener('change', () => this.set(name, element(name).checked));
    for (const name of ['meter', 'home', 'link']) element(name).addEventListener('click', () => page[name]());
    element('fold').addEventListener('click', () => this.fold(!element('panel').hidden));
    if (window.innerWidth <= 560) this.fold(true);
    this.paintBar(data.scale);
    this.update(settings);
  }

  set(name, value) {
    this.page.settings[name] = value;
    this.page.changed();
  }

  fold(away) {
    element('panel').hidden = away;
    element('fold').setAttribute('aria-expanded', String(!away));
  }

  paintBar(scale) {
    const canvas = element('bar-colours'), context = canvas.getContext('2d');
    for (let y = 0; y < canvas.height; ++y) {
      const at = (1 - (y + 0.5) / canvas.height) * (scale.length - 1), i = Math.min(Math.trunc(at), scale.length - 2);
      const colour = scale[i].map((x, c) => Math.round(x + (at - i) * (scale[i + 1][c] - x)));
      context.fillStyle = `rgb(${colour})`;
      context.fillRect(0, y, 1, 1);
    }
  }

  // Shows the settings as they are.
  update(settings) {
    element('show').value = settings.show;
    for (const name of ['walk', 'mesh', 'discontinuities']) element(name).checked = settings[name];
    element('exposure').value = Math.log2(settings.exposure / this.page.firstExposure);
    element('exposure-value').textContent = `${told(settings.exposure)} m²/W`;
    for (const id of ['interface', 'bar']) element(id).hidden = !settings.interface;
    if (settings.show === 'picture') element('bar').hidden = true;
    const top = 1 / settings.exposure;
    element('bar-title').textContent = `${settings.show === 'irradiance' ? 'Irradiance' : 'Radiosity'} [W/m²]`;
    element('bar-ticks').replaceChildren(...roundTicks(top).map((value) => {
      const tick = document.createElement('span');
      tick.textContent = told(value);
      tick.style.bottom = `${100 * value / top}%`;
      return tick;
    }));
  }

  // The table of a measurement; null clears it.
  tell(measured) {
    element('probe').hidden = !measured;
    if (!measured) return;
    const {light, point} = measured;
    const rows = [['irradiance', ...light.irradiance.map(told), 'W/m²'], ['radiosity', ...light.radiosity.map(told), 'W/m²'],
      ['patch', light.patch], ['material', light.material], ['object', light.object], ['at', ...point.map((x) => told(x)), 'm']];
    element('probe').tBodies[0].replaceChildren(...rows.filter((row) => row[1] !== '').map(([name, ...values]) => {
      const row = document.createElement('tr'), head = document.createElement('th');
      head.textContent = name;
      const cells = values.map((value) => {
        const cell = document.createElement('td');
        cell.textContent = value;
        if (values.length === 1) cell.colSpan = 4;
        return cell;
      });
      row.replaceChildren(head, ...cells);
      return row;
    }));
  }
}
