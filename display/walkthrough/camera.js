'use strict';
// Vectors, and the camera that `penumbra render` has: eye, look-at, up, and the vertical field of view in degrees.

const plus = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];  // a + k b
const minus = (a, b) => plus(a, b, -1);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const times = (a, k) => [k * a[0], k * a[1], k * a[2]];
const unit = (a) => times(a, 1 / (norm(a) || 1));

// The vector turned about a unit axis, counter-clockwise as seen from the tip of the axis.
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return plus(plus(times(v, c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

const PARALLEL_SINE = 1e-6;              // a direction closer to the view than this cannot be up
const STEEPEST = 89.5 * Math.PI / 180;   // the view never turns over the top

class Camera {
  constructor({eye, lookAt, up = [0, 0, 1], fov = 45}) {
    Object.assign(this, {eye: [...eye], lookAt: [...lookAt], up: [...up], fov});
  }

  get view() { return minus(this.lookAt, this.eye); }
  get tangent() { return Math.tan(this.fov * Math.PI / 360); }  // of half the field of view

  // Unit axes of the picture.
  axes() {
    const forward = unit(this.view);
    for (const up of [unit(this.up), [0, 0, 1], [0, 1, 0]]) {
      if (norm(cross(forward, up)) < PARALLEL_SINE) continue;
      const right = unit(cross(forward, up));
      return {right, up: cross(right, forward), forward};
    }
    return {right: [1, 0, 0], up: [0, 1, 0], forward: [0, 0, -1]};
  }

  // The direction through a point of the picture, with component 1 along the view; (-1, -1) is the lower left corner.
  direction(x, y, aspect) {
    const {right, up, forward} = this.axes();
    return plus(plus(forward, right, x * this.tangent * aspect), up, y * this.tangent);
  }

  // The view after a turn about `up` and a tilt, in radians.
  turnedView(turn, tilt) {
    const up = unit(this.up), view = turned(this.view, up, turn);
    const elevation = Math.asin(Math.max(-1, Math.min(1, dot(unit(view), up))));
    const limited = Math.max(-STEEPEST, Math.min(STEEPEST, elevation + tilt)) - elevation;
    const right = cross(view, up);
    return norm(right) > PARALLEL_SINE * norm(view) ? turned(view, unit(right), limited) : view;
  }

  // Moves the eye around the point in the middle.
  orbit(turn, tilt) { this.eye = minus(this.lookAt, this.turnedView(turn, tilt)); }
  // Looks elsewhere from where it stands.
  look(turn, tilt) { this.lookAt = plus(this.eye, this.turnedView(turn, tilt)); }

  move(by) {
    this.eye = plus(this.eye, by);
    this.lookAt = plus(this.lookAt, by);
  }
  // Moves parallel to the picture, so that the point in the middle moves by these fractions of the picture's height.
  pan(across, upwards) {
    const {right, up} = this.axes(), height = 2 * this.tangent * norm(this.view);
    this.move(plus(times(right, -across * height), up, -upwards * height));
  }
  // Changes the distance to the point in the middle.
  approach(factor, least) {
    const distance = Math.max(norm(this.view) * factor, least);
    this.eye = minus(this.lookAt, times(unit(this.view), distance));
  }
  // Walks on the level: forward, to the right, upwards [m].
  walk(ahead, aside, upwards) {
    const up = unit(this.up), {right} = this.axes();
    this.move(plus(plus(times(cross(up, right), ahead), right, aside), up, upwards));
  }
  // Turns to the point, and from now on about it.
  centreOn(point) { this.lookAt = [...point]; }
}
