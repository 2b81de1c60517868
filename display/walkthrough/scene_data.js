'use strict';
// The mesh with its light, as the file holds it.

// The bytes that a text in base64 stands for.
function decodeBase64(text) {
  const raw = atob(text.trim());
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

class SceneData {
  // `description` is the JSON of the page, `text` the arrays in base64, one after the other, little-endian.
  constructor(description, text) {
    Object.assign(this, description);  // title, centre, bounds, materials, objects, runs, cameras, ...
    const buffer = decodeBase64(text).buffer, n = this.triangleCount;
    let at = 0;
    const take = (type, count) => {
      const array = new type(buffer, at, count);
      at += array.byteLength;
      return array;
    };
    this.positions = take(Float32Array, 3 * this.vertexCount);  // [m], from the centre
    this.vertices = take(Uint32Array, 3 * n);
    this.scales = take(Float32Array, n);         // [W/m^2] for each unit of the samples of a triangle
    this.samples = take(Int16Array, 18 * n);     // at corners 0, 1, 2, then at the middles of 01, 12, 20; red, green, blue
    this.discontinuities = take(Uint8Array, n);  // bit k: the edge from corner k to the next
    this.runOf = new Uint32Array(n);             // the entry of `runs` that describes a triangle
    let triangle = 0;
    this.runs.forEach((run, i) => {
      this.runOf.fill(i, triangle, triangle + run.count);
      triangle += run.count;
    });
  }

  // Corner k of a triangle [m], from the centre.
  corner(triangle, k) {
    const at = 3 * this.vertices[3 * triangle + k];
    return [this.positions[at], this.positions[at + 1], this.positions[at + 2]];
  }

  // What is known of a place on a triangle: light in W/m^2 by channel, number of the face, names.
  lightAt(triangle, s, t) {
    const run = this.runs[this.runOf[triangle]], material = this.materials[run.material];
    const r = 1 - s - t;
    const weights = [r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * r * s, 4 * s * t, 4 * t * r];
    const irradiance = [0, 1, 2].map((channel) => {
      const sum = weights.reduce((all, w, k) => all + w * this.samples[18 * triangle + 3 * k + channel], 0);
      return Math.max(sum * this.scales[triangle], 0);
    });
    const radiosity = irradiance.map((x, i) => x * material.reflectance[i] + material.emittance[i]);
    return {irradiance, radiosity, patch: run.patch, material: material.name, object: this.objects[run.object]};
  }

  // Half the diagonal of the scene [m].
  radius() {
    const {min, max} = this.bounds;
    return Math.max(0.5 * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]), 1e-6);
  }
}
