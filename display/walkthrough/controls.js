'use strict';
// Mouse, touch and keys move the camera.

const CLICK_DISTANCE = 5;    // a pointer that moved less is a click [CSS pixels]
const CLICK_TIME = 600;      // and was down for less [ms]
const WALKED_PER_SECOND = 0.25;  // of the scene's radius; shift is four times as fast
const NEAREST_APPROACH = 1e-3;   // of the scene's radius

class Controls {
  // `page` has camera, settings, data, requestFrame(), click(x, y), doubleClick(x, y) and key(event).
  constructor(canvas, page) {
    this.canvas = canvas;
    this.page = page;
    this.pointers = new Map();
    this.pressed = new Set();
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.moved(event));
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => this.up(event));
    canvas.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('dblclick', (event) => page.doubleClick(event.offsetX, event.offsetY));
    window.addEventListener('keydown', (event) => this.keyDown(event));
    window.addEventListener('keyup', (event) => this.pressed.delete(event.key.toLowerCase()));
    window.addEventListener('blur', () => this.pressed.clear());
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.focus({preventScroll: true});
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.start = this.pointers.size === 1 ? {x: event.clientX, y: event.clientY, time: event.timeStamp} : null;
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    if (event.type === 'pointerup' && this.start && event.button === 0 && event.timeStamp - this.start.time < CLICK_TIME)
      this.page.click(event.offsetX, event.offsetY);
    this.start = null;
  }

  moved(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    if (this.start && Math.hypot(event.clientX - this.start.x, event.clientY - this.start.y) < CLICK_DISTANCE) return;
    this.start = null;
    const now = [event.clientX, event.clientY];
    if (this.pointers.size === 2) this.pinch(event.pointerId, before, now);
    else if (this.pointers.size === 1) this.drag(now[0] - before[0], now[1] - before[1], event.buttons > 1 || event.shiftKey);
    this.pointers.set(event.pointerId, now);
    this.page.requestFrame();
  }

  drag(dx, dy, moves) {
    const {camera, settings} = this.page, height = this.canvas.clientHeight;
    if (moves) {
      camera.pan(dx / height, -dy / height);
    } else if (settings.walk) {
      const angle = camera.fov * Math.PI / 180 / height;  // what lies below the pointer stays there
      camera.look(dx * angle, dy * angle);
    } else {
      camera.orbit(-dx * Math.PI / height, -dy * Math.PI / height);
    }
  }

  // Two fingers: their middle moves the view, their distance comes nearer; on a walk both walk.
  pinch(id, before, now) {
    const [other] = [...this.pointers].filter(([key]) => key !== id).map(([, at]) => at);
    const {camera, settings} = this.page, height = this.canvas.clientHeight;
    const dx = (now[0] - before[0]) / 2, dy = (now[1] - before[1]) / 2;
    const spread = (at) => Math.max(1, Math.hypot(at[0] - other[0], at[1] - other[1]));
    if (settings.walk) {
      const length = 2 * this.page.data.radius() / height;
      camera.walk((dy + spread(now) - spread(before)) * length, -dx * length, 0);
    } else {
      camera.pan(dx / height, -dy / height);
      this.approach(spread(before) / spread(now));
    }
  }

  approach(factor) { this.page.camera.approach(factor, NEAREST_APPROACH * this.page.data.radius()); }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 0 ? event.deltaY / 100 : event.deltaY / 3;
    if (this.page.settings.walk) this.page.camera.walk(-0.08 * lines * this.page.data.radius(), 0, 0);
    else this.approach(Math.exp(0.12 * lines));
    this.page.requestFrame();
  }

  keyDown(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('select, input[type=range]')) return;
    const key = event.key.toLowerCase();
    if (!Controls.WALK.has(key)) {
      this.page.key(event.key);
      return;
    }
    event.preventDefault();
    if (this.pressed.size === 0) this.walkedAt = performance.now();
    this.pressed.add(key);
    this.faster = event.shiftKey;
    this.page.requestFrame();
  }

  // Walks on while keys are down; true if it did.
  step(now) {
    if (this.pressed.size === 0) return false;
    const seconds = Math.min(0.1, Math.max(0, now - this.walkedAt) / 1000);
    const length = seconds * WALKED_PER_SECOND * this.page.data.radius() * (this.faster ? 4 : 1);
    this.walkedAt = now;
    const sum = [0, 0, 0];
    for (const key of this.pressed) Controls.WALK.get(key).forEach((x, i) => { sum[i] += x * length; });
    this.page.camera.walk(...sum);
    return true;
  }
}

// Ahead, to the right, upwards.
Controls.WALK = new Map([['w', [1, 0, 0]], ['s', [-1, 0, 0]], ['a', [0, -1, 0]], ['d', [0, 1, 0]], ['q', [0, 0, -1]], ['e', [0, 0, 1]],
  ['arrowup', [1, 0, 0]], ['arrowdown', [-1, 0, 0]], ['arrowleft', [0, -1, 0]], ['arrowright', [0, 1, 0]]]);
