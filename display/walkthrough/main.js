'use strict';
// The page: a camera, settings, and what follows from changes of either.

// What an address may change, and what holds where it is silent.
const DEFAULTS = {show: 'picture', mesh: false, discontinuities: false, walk: false, interface: true};

class Page {
  constructor() {
    this.data = new SceneData(JSON.parse(element('description').textContent), element('data').textContent);
    this.canvas = element('picture');
    this.settings = {...DEFAULTS, exposure: this.data.exposure};
    this.cameraIndex = this.data.firstCamera;
    this.camera = new Camera(this.data.cameras[this.cameraIndex]);
    this.firstExposure = this.settings.exposure;
    this.renderer = new Renderer(this.canvas, this.data);
    this.panel = new Panel(this);
    this.controls = new Controls(this.canvas, this);
    window.addEventListener('resize', () => this.resize());
    window.addEventListener('hashchange', () => this.obeyAddress());
    this.canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.renderer.prepare();
      this.requestFrame();
    });
    this.obeyAddress();
  }

  // Shows what the fragment of the address asks for. `metered`: nobody asked for an exposure, so that it follows the camera
  // that is chosen.
  obeyAddress() {
    const asked = readAddress(location.hash);
    const named = this.data.cameras.findIndex(({name}, i) => name === asked.camera || String(i) === asked.camera);
    this.cameraIndex = named >= 0 ? named : this.data.firstCamera;
    element('camera').value = this.cameraIndex;
    const view = {};
    for (const name of ['eye', 'lookAt', 'up', 'fov']) if (asked[name] !== null) view[name] = asked[name];
    this.camera = new Camera({...this.data.cameras[this.cameraIndex], ...view});
    for (const name of Object.keys(DEFAULTS)) this.settings[name] = asked[name] === null ? DEFAULTS[name] : asked[name];
    this.size = asked.size;
    this.measured = null;
    this.resize();
    this.metered = this.data.metered && asked.exposure === null;
    if (asked.exposure !== null) this.settings.exposure = asked.exposure;
    else if (this.metered) this.meterView();
    else this.settings.exposure = this.data.exposure;
    this.firstExposure = this.settings.exposure;
    this.changed();
  }

  // The canvas fills the window, or has the size that the address asks for.
  resize() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = this.size || [Math.round(window.innerWidth * ratio), Math.round(window.innerHeight * ratio)];
    this.canvas.width = width;
    this.canvas.height = height;
    this.canvas.style.width = `${width / ratio}px`;
    this.canvas.style.height = `${height / ratio}px`;
    this.requestFrame();
  }

  changed() {
    this.panel.update(this.settings);
    this.requestFrame();
  }

  requestFrame() {
    if (this.frame) return;
    this.frame = requestAnimationFrame((now) => {
      this.frame = 0;
      if (this.controls && this.controls.step(now)) this.requestFrame();
      this.drawNow();
    });
  }

  drawNow() {
    this.renderer.draw(this.camera, this.settings);
    this.showMarker();
  }

  setExposure(exposure) {
    this.settings.exposure = exposure;
    this.metered = false;
    this.changed();
  }

  meterView() { this.settings.exposure = this.renderer.meter(this.camera) || this.data.exposure; }
  meter() {
    this.meterView();
    this.changed();
  }

  useCamera(index) {
    this.cameraIndex = index;
    this.home();
  }
  home() {
    this.camera = new Camera(this.data.cameras[this.cameraIndex]);
    if (this.metered) this.meterView();
    this.changed();
  }

  link() { history.replaceState(null, '', writeAddress(this.camera, this.settings)); }

  key(key) {
    const toggle = {t: 'mesh', x: 'discontinuities', n: 'walk'}[key], kinds = ['picture', 'radiosity', 'irradiance'];
    if (toggle) this.settings[toggle] = !this.settings[toggle];
    else if (key === 'o') this.settings.show = kinds[(kinds.indexOf(this.settings.show) + 1) % kinds.length];
    else if (key === '+' || key === '-') this.setExposure(this.settings.exposure * 2 ** (key === '+' ? 0.25 : -0.25));
    else if (key === 'r') this.meterView();
    else if (key === 'h') this.home();
    else if (key === 'Escape') this.measure(null);
    this.changed();
  }

  // The place on the mesh at a point of the canvas [CSS pixels].
  hitAt(x, y) {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    return firstHit(this.data, this.camera.eye, this.camera.direction(2 * x / width - 1, 1 - 2 * y / height, width / height));
  }

  click(x, y) {
    const hit = this.hitAt(x, y);
    this.measure(hit && {point: hit.point, light: this.data.lightAt(hit.triangle, hit.s, hit.t)});
  }

  doubleClick(x, y) {
    const hit = this.hitAt(x, y);
    if (hit) this.camera.centreOn(hit.point);
    this.requestFrame();
  }

  measure(measured) {
    this.measured = measured;
    this.panel.tell(measured);
    this.showMarker();
  }

  // A ring stays where it was measured, also behind other things.
  showMarker() {
    const marker = element('marker');
    marker.hidden = true;
    if (!this.measured) return;
    const {right, up, forward} = this.camera.axes(), v = minus(this.measured.point, this.camera.eye), depth = dot(forward, v);
    if (!(depth > 0)) return;
    const height = this.canvas.clientHeight, perTangent = 0.5 * height / this.camera.tangent / depth;
    marker.style.left = `${0.5 * this.canvas.clientWidth + dot(right, v) * perTangent}px`;
    marker.style.top = `${0.5 * height - dot(up, v) * perTangent}px`;
    marker.hidden = false;
  }
}

let page = null;
try {
  page = new Page();
} catch (error) {
  element('problem').textContent = error.message;
  element('problem').hidden = false;
}
