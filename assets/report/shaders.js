// GLSL of the 3-D view.

const VOXEL_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 face;
layout(location = 2) in uvec4 cell;     // indices; step, with the kind in the highest bit
layout(location = 3) in vec4 shading;   // smoothed normal; openness
uniform mat4 worldToClip;
uniform vec3 eye, gridMin, cellSize, toLight;
uniform vec3 stops[6];
uniform vec4 flatColour;                // used where its opacity is above 0
uniform float cellsHigh, lastStep;
uniform bool byScan;
uniform float share;                    // of a cell that its cube fills
out vec4 colour;
vec3 ramp(float share) {
  float at = clamp(share, 0.0, 1.0) * 5.0;
  int i = min(4, int(at));
  return mix(stops[i], stops[i + 1], at - float(i));
}
void main() {
  vec3 centre = gridMin + (vec3(cell.xyz) + 0.5) * cellSize;
  vec3 side = mix(vec3(-1.0), vec3(1.0), greaterThan(eye, centre));
  gl_Position = worldToClip * vec4(centre + share * corner * side * cellSize, 1.0);
  vec3 normal = normalize(0.8 * shading.xyz + 0.28 * face * side);
  float lit = (0.50 + 0.58 * max(0.0, dot(normal, toLight))) * mix(1.0, shading.w, 0.4);
  if (share < 1.0 && cell.z == 0u) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // the room has its floor
  float step = float(cell.w & 0x7FFFu);
  float place = byScan ? step / max(1.0, lastStep) : float(cell.z) / max(1.0, cellsHigh - 1.0);
  colour = flatColour.a > 0.0 ? vec4(flatColour.rgb * mix(1.0, lit, 0.6), flatColour.a) : vec4(ramp(place) * lit, 1.0);
  colour.rgb *= colour.a;
}`;

const LINE_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec4 lineColour;
layout(location = 3) in vec2 widthAndStep;
uniform mat4 worldToClip;
uniform vec2 viewport;                  // px
uniform float shownStep, opacity, pixelRatio;
out vec4 colour;
void main() {
  vec4 a = worldToClip * vec4(start, 1.0), b = worldToClip * vec4(end, 1.0);
  float near = 0.01;
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(0.0);
  vec4 p = gl_VertexID < 2 ? a : b;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  p.xy += side * across * widthAndStep.x * pixelRatio / viewport * p.w;
  bool hidden = widthAndStep.y > shownStep || (a.w < near && b.w < near);
  gl_Position = hidden ? vec4(0.0, 0.0, 2.0, 1.0) : p;
  colour = vec4(lineColour.rgb, 1.0) * lineColour.a * opacity;
}`;

const POINT_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 quantised;
uniform mat4 worldToClip;
uniform vec3 cloudMin, cloudScale, pointColour;
uniform float pixelRatio;
out vec4 colour;
void main() {
  gl_Position = worldToClip * vec4(cloudMin + quantised * cloudScale, 1.0);
  gl_PointSize = 2.0 * pixelRatio;
  colour = vec4(pointColour, 1.0);
}`;

const PLAIN_FRAGMENT = `#version 300 es
precision mediump float;
in vec4 colour;
out vec4 pixel;
void main() { pixel = colour; }`;

const SURFACE_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 quantised;
layout(location = 1) in vec3 tint;
uniform mat4 worldToClip;
uniform vec3 sceneMin, sceneScale;
out vec3 world, shade;
void main() {
  world = sceneMin + quantised * sceneScale;
  shade = tint;
  gl_Position = worldToClip * vec4(world, 1.0);
}`;

// Each triangle is flat, and lit from whichever side it is seen.
const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 world, shade;
uniform vec3 eye, toLight;
out vec4 pixel;
void main() {
  vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
  if (dot(normal, eye - world) < 0.0) normal = -normal;
  float lit = 0.60 + 0.30 * max(0.0, dot(normal, toLight)) + 0.14 * max(0.0, normal.z);
  pixel = vec4(min(vec3(1.0), shade * lit), 1.0);
}`;
