#version 300 es
// The second pass: the light at a pixel, from the interpolant of its triangle, and its colour on the screen.
precision highp float;
precision highp int;

const int kPicture = 0, kRadiosity = 1, kIrradiance = 2, kLinear = 3;

uniform int show;         // one of these; kLinear: radiosity itself, and 2 as alpha on emitters, else 1
uniform float exposure;   // [m^2/W]
uniform float top;        // the end of the scale of false colours [W/m^2]
uniform vec3 scale[7];    // sRGB, from 0 to `top`
uniform float height;     // of the picture [pixels]
uniform bool meshLines, discontinuityLines;
uniform float lineWidth;  // [pixels]

flat in vec3 a, b, c, d, e, f;
flat in vec3 reflectance, emittance;
flat in int flags;
centroid in vec2 st;
out vec4 colour;

const int kEmits = 8;

vec3 srgb(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}

// Bayer's matrix: where between two codes the pixel rounds up, so that slow gradients show no bands.
float ditherOffset() {
  int x = int(gl_FragCoord.x), y = int(height - gl_FragCoord.y), rank = 0;
  for (int bit = 0; bit < 3; ++bit) {
    int bx = (x >> bit) & 1, by = (y >> bit) & 1;
    rank = 4 * rank + 2 * (bx ^ by) + by;
  }
  return 0.5 + (float(rank) - 31.5) / 64.0;
}

vec3 falseColour(float value) {
  float at = clamp(value, 0.0, 1.0) * 6.0;
  int i = min(int(at), 5);
  return mix(scale[i], scale[i + 1], at - float(i));
}

// How much of the pixel a line covers along the edge where the coordinate x is 0; half of its width lies in this triangle.
float line(float x, float width) {
  float pixels = x / max(length(vec2(dFdx(x), dFdy(x))), 1e-20);
  return clamp(0.5 + 0.5 * width - pixels, 0.0, 1.0);
}

vec3 withLines(vec3 under, vec3 toEdge) {  // toEdge[k]: the coordinate that is 0 on the edge from corner k to the next
  float mesh = 0.0, discontinuity = 0.0;
  for (int k = 0; k < 3; ++k) {
    mesh = max(mesh, line(toEdge[k], lineWidth));
    float wide = line(toEdge[k], 2.0 * lineWidth);
    if ((flags >> k & 1) != 0) discontinuity = max(discontinuity, wide);
  }
  if (meshLines) under = mix(under, vec3(0.55, 0.75, 0.8), 0.55 * mesh);
  if (discontinuityLines) under = mix(under, vec3(0.85, 0.3, 1.0), 0.9 * discontinuity);
  return under;
}

void main() {
  float s = clamp(st.x, 0.0, 1.0), t = clamp(st.y, 0.0, 1.0 - s);  // the fringe takes the colour of the border
  vec3 irradiance = max((a * s + b * t + c) * s + (d * t + e) * t + f, 0.0);
  vec3 radiosity = irradiance * reflectance + emittance;
  bool emits = (flags & kEmits) != 0;
  if (show == kLinear) {
    colour = vec4(radiosity, emits ? 2.0 : 1.0);
    return;
  }
  vec3 shown = vec3(1.0);
  if (show == kPicture) {
    if (!emits) shown = srgb(clamp(exposure * radiosity, 0.0, 1.0));
    shown = floor(255.0 * shown + ditherOffset()) / 255.0;
  } else if (!emits || show == kIrradiance) {
    vec3 value = show == kRadiosity ? radiosity : irradiance;
    shown = falseColour((value.r + value.g + value.b) / (3.0 * top));
  }
  if (meshLines || discontinuityLines) shown = withLines(shown, vec3(st.y, 1.0 - st.x - st.y, st.x));
  colour = vec4(shown, 1.0);
}
