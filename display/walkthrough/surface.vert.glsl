#version 300 es
// A corner of a triangle of the irradiance mesh. There are no vertex arrays: the corner finds its triangle by its number.
precision highp float;
precision highp int;

uniform highp sampler2D positions;    // a texel a vertex [m], from the centre of the scene
uniform highp usampler2D triangles;   // two a triangle: vertices, bits of the scale; material, flags, number
uniform highp isampler2D samples;     // six a triangle: irradiance at the corners, then at the middles of 01, 12 and 20
uniform highp sampler2D materials;    // two a material: reflectance; emittance [W/m^2]
uniform int texelsAcross;             // of each of the four
uniform vec3 eye, right, up, forward; // the eye [m] from the centre of the scene; unit axes of the camera
uniform vec2 perTangent;              // clip coordinates per tangent of the angle to the view, across and up
uniform vec2 depthTerms;              // clip depth is depthTerms.x * depth + depthTerms.y
uniform vec2 halfSize;                // half the width and height of the picture [pixels]
uniform float near;                   // depth at which triangles are cut off [m]
uniform float fringe;                 // by how much a triangle is enlarged [pixels]; 0: not at all

// R(s, t) = (a s + b t + c) s + (d t + e) t + f: the six coefficients of the irradiance [W/m^2]
flat out vec3 a, b, c, d, e, f;
flat out vec3 reflectance, emittance;
flat out int flags;  // bit k: the edge from corner k to the next is a discontinuity; bit 3: the triangle emits
centroid out vec2 st;

// A corner moves by at most this many widths of the fringe: the tips of slivers would otherwise move far.
const float kLongestMove = 3.0;
// A triangle counts as a line if enlarging would multiply its height by more than this: floats hold no more digits.
const float kLargestStep = 1e6;

ivec2 place(int texel) { return ivec2(texel % texelsAcross, texel / texelsAcross); }

vec4 clip(vec3 position) {
  vec3 v = position - eye;
  float depth = dot(forward, v);
  return vec4(vec2(dot(right, v), dot(up, v)) * perTangent, depthTerms.x * depth + depthTerms.y, depth);
}

vec3 unmoved(int corner) { return vec3(corner == 0, corner == 1, corner == 2); }

// The barycentric coordinates of a corner of the triangle p after each edge has moved outwards by `width`.
vec3 enlarged(vec3 p[3], int corner, float width) {
  vec3 lengths = vec3(distance(p[1], p[2]), distance(p[2], p[0]), distance(p[0], p[1]));
  float area = length(cross(p[1] - p[0], p[2] - p[0]));  // twice the triangle's
  vec3 steps = width * lengths;                          // times `area`: the width, in heights of the triangle
  if (area * kLargestStep <= max(steps.x, max(steps.y, steps.z))) return unmoved(corner);
  steps /= area;
  int next = (corner + 1) % 3, last = (corner + 2) % 3;
  float move = length(steps[next] * (p[next] - p[corner]) + steps[last] * (p[last] - p[corner]));
  steps *= min(1.0, kLongestMove * width / move);
  vec3 moved;
  moved[next] = -steps[next];
  moved[last] = -steps[last];
  moved[corner] = 1.0 + steps[next] + steps[last];
  return moved;
}

// Triangles whose borders meet have no common vertices where patches meet, and graphics systems round corners to a part
// of a pixel. The fringe covers the gaps that would be seen between them.
vec3 coordinates(vec3 p[3], int corner) {
  vec4 q[3];
  vec3 onScreen[3];
  for (int k = 0; k < 3; ++k) {
    q[k] = clip(p[k]);
    onScreen[k] = vec3(q[k].xy / q[k].w * halfSize, 0.0);
  }
  if (min(q[0].w, min(q[1].w, q[2].w)) > near) {
    vec3 moved = enlarged(onScreen, corner, fringe) / vec3(q[0].w, q[1].w, q[2].w);
    float sum = moved.x + moved.y + moved.z;
    if (sum > 0.0) return moved / sum;
  }
  // Part of it lies behind the eye, where there is no screen.
  return enlarged(p, corner, fringe * distance(p[corner], eye) / (halfSize.y * perTangent.y));
}

void main() {
  int triangle = gl_VertexID / 3, corner = gl_VertexID % 3;
  uvec4 first = texelFetch(triangles, place(2 * triangle), 0);
  uvec4 second = texelFetch(triangles, place(2 * triangle + 1), 0);
  vec3 p[3];
  for (int k = 0; k < 3; ++k) p[k] = texelFetch(positions, place(int(first[k])), 0).xyz;
  vec3 moved = fringe > 0.0 ? coordinates(p, corner) : unmoved(corner);
  st = moved.yz;
  gl_Position = clip(moved.x * p[0] + moved.y * p[1] + moved.z * p[2]);

  float scale = uintBitsToFloat(first.w);
  vec3 r[6];
  for (int k = 0; k < 6; ++k) r[k] = scale * vec3(texelFetch(samples, place(6 * int(second.z) + k), 0).xyz);
  a = 2.0 * (r[0] + r[1]) - 4.0 * r[3];
  b = 4.0 * (r[0] + r[4] - r[3] - r[5]);
  c = 4.0 * r[3] - 3.0 * r[0] - r[1];
  d = 2.0 * (r[0] + r[2]) - 4.0 * r[5];
  e = 4.0 * r[5] - 3.0 * r[0] - r[2];
  f = r[0];
  reflectance = texelFetch(materials, place(2 * int(second.x)), 0).xyz;
  emittance = texelFetch(materials, place(2 * int(second.x) + 1), 0).xyz;
  flags = int(second.y);
}
