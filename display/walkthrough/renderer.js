'use strict';
// Draws the mesh by WebGL 2, with all data in textures that the shaders read.

const SHOW = {picture: 0, radiosity: 1, irradiance: 2, linear: 3};

// Depths at which triangles are cut off in front of the eye, as a part of the scene's radius: 24 bits of depth then
// separate surfaces that are 3e-5 radii apart at the far end of the scene.
const NEAREST = 1e-2;
// How much deeper: in changes of the depth from pixel to pixel, and in steps of the depth's rounding.
const DEEPER = [1, 4], DEEPEST = [2, 8];
// A triangle is dark if its irradiance is below this part of the largest: no more than a code of the screen where the
// largest is white. What is covered receives the rounding errors of light.
const DARK = 1e-4;
const TEXELS_ACROSS = 4096;  // of the textures, where the graphics system has textures that large
const METERED_SIDE = 640;    // the longer side of the picture from which the exposure is metered [pixels]

class Renderer {
  // Throws an Error, to be shown to the reader, if the page cannot be drawn here.
  constructor(canvas, data) {
    this.canvas = canvas;
    this.data = data;
    this.gl = canvas.getContext('webgl2', {alpha: false, antialias: true, powerPreference: 'high-performance'});
    if (!this.gl) throw new Error('This page needs WebGL 2, which this browser does not offer or has switched off.');
    this.prepare();
  }

  // Makes all objects of the graphics system, at the start and after the system has lost them.
  prepare() {
    const gl = this.gl;
    this.across = Math.min(TEXELS_ACROSS, gl.getParameter(gl.MAX_TEXTURE_SIZE));
    this.program = this.makeProgram();
    this.places = new Map();
    gl.useProgram(this.program);
    gl.bindVertexArray(gl.createVertexArray());
    const {positions, samples} = this.data;
    this.bindTexture(0, 'positions', [gl.RGB32F, gl.RGB, gl.FLOAT, 3], positions);
    this.bindTexture(1, 'triangles', [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, 4], this.triangleTexels());
    this.bindTexture(2, 'samples', [gl.RGB16I, gl.RGB_INTEGER, gl.SHORT, 3], samples);
    this.bindTexture(3, 'materials', [gl.RGB32F, gl.RGB, gl.FLOAT, 3], this.materialTexels());
    gl.uniform1i(this.place('texelsAcross'), this.across);
    gl.uniform3fv(this.place('scale'), this.data.scale.flat().map((code) => code / 255));
    // Corners are rounded to a part of a pixel, on both sides of a gap, and once more where triangles are clipped.
    this.fringe = 4 / (1 << gl.getParameter(gl.SUBPIXEL_BITS));
    gl.enable(gl.CULL_FACE);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.disable(gl.DITHER);
  }

  makeProgram() {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, id] of [[gl.VERTEX_SHADER, 'vertex-shader'], [gl.FRAGMENT_SHADER, 'fragment-shader']]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, document.getElementById(id).textContent.trim());
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error('The graphics system refuses the shaders: ' + gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error('The graphics system refuses the shaders: ' + gl.getProgramInfoLog(program));
    return program;
  }

  place(name) {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name);
  }

  // A texture of as many rows as the values need.
  bindTexture(number, name, [internal, format, type, components], values) {
    const gl = this.gl, rows = Math.max(1, Math.ceil(values.length / components / this.across));
    if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error('The mesh is too large for this graphics system.');
    const padded = new values.constructor(rows * this.across * components);
    padded.set(values);
    gl.activeTexture(gl.TEXTURE0 + number);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, this.across, rows, 0, format, type, padded);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    gl.uniform1i(this.place(name), number);
  }

  // Two texels a triangle, in the order in which they are drawn: triangles inside patches, then those at borders of
  // patches and of the dark, then dark ones.
  triangleTexels() {
    const {triangleCount, vertices, scales, discontinuities, runs, runOf, materials} = this.data, EMITS = 8;
    const emits = materials.map(({emittance}) => emittance.some((x) => x > 0)), emitter = (i) => emits[runs[runOf[i]].material];
    const least = DARK * scales.reduce((largest, x) => Math.max(largest, x), 0);
    const dark = (i) => !emitter(i) && scales[i] <= least, atBorder = this.trianglesAtBorders(dark);
    const groups = [[], [], []];
    for (let i = 0; i < triangleCount; ++i) groups[dark(i) ? 2 : atBorder[i]].push(i);
    this.innerCount = groups[0].length;
    this.litCount = this.innerCount + groups[1].length;
    const texels = new Uint32Array(8 * triangleCount), bits = new Uint32Array(scales.buffer, scales.byteOffset, triangleCount);
    groups.flat().forEach((i, at) => {
      texels.set(vertices.subarray(3 * i, 3 * i + 3), 8 * at);
      texels.set([bits[i], runs[runOf[i]].material, discontinuities[i] | (emitter(i) ? EMITS : 0), i], 8 * at + 3);
    });
    return texels;
  }

  // 1 for each triangle that has an edge without a lit neighbour. Patches have no vertices in common.
  trianglesAtBorders(dark) {
    const {triangleCount, vertexCount, vertices} = this.data, edges = new Set(), at = new Uint8Array(triangleCount);
    const edge = (i, from, to) => vertices[3 * i + from] * vertexCount + vertices[3 * i + to];
    for (let i = 0; i < triangleCount; ++i)
      for (let k = 0; k < 3 && !dark(i); ++k) edges.add(edge(i, k, (k + 1) % 3));
    for (let i = 0; i < triangleCount; ++i)
      at[i] = [0, 1, 2].every((k) => edges.has(edge(i, (k + 1) % 3, k))) ? 0 : 1;
    return at;
  }

  materialTexels() {
    return new Float32Array(this.data.materials.flatMap(({reflectance, emittance}) => [...reflectance, ...emittance]));
  }

  // Draws the view into the current frame buffer. `settings`: show, exposure, mesh, discontinuities.
  draw(camera, settings, width = this.canvas.width, height = this.canvas.height) {
    const gl = this.gl, place = (name) => this.place(name);
    gl.viewport(0, 0, width, height);
    const [r, g, b] = settings.show === 'linear' ? [0, 0, 0] : this.data.background;
    gl.clearColor(r / 255, g / 255, b / 255, settings.show === 'linear' ? 0 : 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const {right, up, forward} = camera.axes(), eye = minus(camera.eye, this.data.centre);
    gl.uniform3fv(place('eye'), eye);
    gl.uniform3fv(place('right'), right);
    gl.uniform3fv(place('up'), up);
    gl.uniform3fv(place('forward'), forward);
    gl.uniform2f(place('perTangent'), height / width / camera.tangent, 1 / camera.tangent);
    const radius = this.data.radius(), near = Math.max(NEAREST * radius, 0.5 * (norm(eye) - radius)), far = norm(eye) + 1.01 * radius;
    gl.uniform2f(place('depthTerms'), (far + near) / (far - near), -2 * far * near / (far - near));
    gl.uniform1f(place('near'), near);
    gl.uniform2f(place('halfSize'), 0.5 * width, 0.5 * height);
    gl.uniform1f(place('height'), height);
    gl.uniform1i(place('show'), SHOW[settings.show]);
    gl.uniform1f(place('exposure'), settings.exposure);
    gl.uniform1f(place('top'), 1 / settings.exposure);
    gl.uniform1i(place('meshLines'), settings.mesh ? 1 : 0);
    gl.uniform1i(place('discontinuityLines'), settings.discontinuities ? 1 : 0);
    gl.uniform1f(place('lineWidth'), 0.7 * Math.max(1, window.devicePixelRatio));
    this.drawTriangles();
  }

  // The triangles as they are; then those at borders larger by the fringe and slightly deeper, which fills the gaps between
  // surfaces and nothing else, because the surfaces themselves are nearer. Dark triangles are deeper still: most of them are
  // floor below things that stand on it, and must not show in a gap between the two.
  drawTriangles() {
    const gl = this.gl, count = this.data.triangleCount, {innerCount, litCount} = this;
    const draw = (first, last, fringe, deeper) => {
      gl.uniform1f(this.place('fringe'), fringe);
      gl.polygonOffset(...deeper);
      gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * (last - first));
    };
    draw(0, litCount, 0, [0, 0]);
    draw(innerCount, litCount, this.fringe, DEEPER);
    draw(litCount, count, this.fringe, DEEPEST);
  }

  // The exposure [m^2/W] that `penumbra render` finds for this view: all but a part of the surfaces' pixels stay below
  // the metered value. Null where nothing is lit, and where the graphics system draws no floats.
  meter(camera) {
    const gl = this.gl;
    if (!gl.getExtension('EXT_color_buffer_float')) return null;
    const shrink = Math.min(1, METERED_SIDE / Math.max(this.canvas.width, this.canvas.height));
    const width = Math.max(1, Math.round(shrink * this.canvas.width)), height = Math.max(1, Math.round(shrink * this.canvas.height));
    const frame = gl.createFramebuffer(), buffers = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    [[gl.RGBA32F, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]].forEach(([format, attachment], i) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffers[i]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffers[i]);
    });
    const pixels = new Float32Array(4 * width * height);
    this.draw(camera, {show: 'linear', exposure: 1}, width, height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer));
    gl.deleteFramebuffer(frame);
    return this.exposureFor(pixels);
  }

  exposureFor(pixels) {
    const brightest = [];
    for (let i = 0; i < pixels.length; i += 4)
      if (pixels[i + 3] === 1) brightest.push(Math.max(pixels[i], pixels[i + 1], pixels[i + 2]));
    brightest.sort((x, y) => x - y);
    const {meteredFraction, meteredValue} = this.data;
    const metered = brightest[Math.trunc(meteredFraction * (brightest.length - 1))] || brightest[brightest.length - 1];
    return metered > 0 ? meteredValue / metered : null;
  }

  // Frames a second along a full orbit, each drawn to its last pixel.
  benchmark(camera, settings, frames) {
    const gl = this.gl, from = new Camera(camera), pixel = new Uint8Array(4), begin = performance.now();
    for (let i = 0; i < frames; ++i) {
      from.orbit(2 * Math.PI / frames, 0);
      this.draw(from, settings);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    return 1000 * frames / (performance.now() - begin);
  }
}
