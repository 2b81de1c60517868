'use strict';
// Where a ray meets the fronts of the mesh.

// The nearest triangle before the eye, with the barycentric coordinates of the place and the place itself [m]; null if
// the ray meets none. Every triangle is asked: a click can wait the milliseconds.
function firstHit(data, eye, direction) {
  const origin = minus(eye, data.centre);
  let nearest = null;
  for (let i = 0; i < data.triangleCount; ++i) {
    const corner = data.corner(i, 0);
    const u = minus(data.corner(i, 1), corner), v = minus(data.corner(i, 2), corner);
    const normal = cross(u, v), slope = dot(normal, direction);
    if (!(slope < 0)) continue;  // the back, or the edge
    const from = minus(origin, corner), distance = -dot(normal, from) / slope;
    if (!(distance > 0) || (nearest && distance >= nearest.distance)) continue;
    const across = cross(from, direction);
    const s = dot(v, across) / -slope, t = -dot(u, across) / -slope;
    if (s < 0 || t < 0 || s + t > 1) continue;
    nearest = {triangle: i, s, t, distance};
  }
  if (nearest) nearest.point = plus(eye, direction, nearest.distance);
  return nearest;
}
